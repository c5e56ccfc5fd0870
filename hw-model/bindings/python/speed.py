"""How fast the wheel answers, beside the Rust engine and the RTL in Verilator in the same run.

    python speed.py [PRESET …]            in the clone: a table in Markdown
    python speed.py --memory              what 10⁸ samples hold

Builds `hw-model/bindings/model/examples/speed.rs` and `tests/src/bin/verilated.rs` with cargo's profile release, which
is the wheel's. All times are those of the processor. Rust and Python take turns, as others may use the machine too: in
a turn the fastest of five runs counts, and of the turns the median. A ratio is the median of those of the turns.
"""

import json
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path

import blysk
import numpy as np

SAMPLES = 1 << 22
CALLS = 100_000
TURNS = 7


def seconds(job):
    """The least time of several runs."""

    def timed():
        # Of the processor, so that what else the machine does counts little.
        start = time.thread_time()
        job()
        return time.thread_time() - start

    return min(timed() for _ in range(5))


def call_ns(job):
    """Nanoseconds of a call of `job`, the loop around it included."""

    def loop():
        for x in range(0, 80 * CALLS, 80):
            job(x)

    return seconds(loop) / CALLS * 1e9


def measure(preset):
    """What the Rust example measures, and the clock over arrays."""
    model = blysk.Model.preset(preset)
    xs = np.arange(SAMPLES) * 2 + 1
    addresses = (np.arange(SAMPLES, dtype=np.uint32) * np.uint32(2654435761)) >> np.uint32(24)
    reals = np.linspace(0, 1, SAMPLES)
    out = np.empty(SAMPLES, np.int64), np.empty(SAMPLES, np.uint8)
    valid, ready = np.ones(SAMPLES, bool), np.arange(SAMPLES) % 8 != 0
    return {
        "one": SAMPLES / seconds(lambda: model.evaluate(63, xs)),
        "one_out": SAMPLES / seconds(lambda: model.evaluate(63, xs, out=out)),
        "each": SAMPLES / seconds(lambda: model.evaluate(addresses, xs)),
        "each_out": SAMPLES / seconds(lambda: model.evaluate(addresses, xs, out=out)),
        "highlight": SAMPLES / seconds(lambda: model.highlight(64, reals)),
        "scalar_ns": call_ns(lambda x: model.evaluate(63, x)),
        "registers_ns": call_ns(lambda x: model.registers(address=63, x_bits=x)),
        "read_ns": call_ns(lambda x: [r.bits for r in model.registers(address=63, x_bits=x).values()]),
        "tick_ns": call_ns(lambda x, tick=blysk.Pipeline(model).tick: tick(True, 63, x, x & 7 != 0)),
        "run": SAMPLES / seconds(lambda: blysk.Pipeline(model).run(valid, 63, xs, ready)),
    }


def told(command, presets):
    """What a program of the clone says of each preset, in lines of JSON."""
    run = subprocess.run(
        ["cargo", "run", "--release", "--locked", "--quiet", *command, "--", *presets],
        stdout=subprocess.PIPE,
        check=True,
        cwd=Path(__file__).parent,
    )
    return [json.loads(line) for line in run.stdout.decode().splitlines()]


def row(*cells):
    """Prints a line of the table."""
    print("| " + " | ".join(cells) + " |", flush=True)


#: Lines of the table: what is measured, its key in Python and in Rust, and its unit. These are rates.
RATES = [
    ("array, one address", "one", "block", "samples"),
    ("array, one address, `out=`", "one_out", "block", "samples"),
    ("array, an address for each", "each", "each", "samples"),
    ("array, an address for each, `out=`", "each_out", "each", "samples"),
    ("`highlight`, real numbers", "highlight", None, "samples"),
    ("`run`, cycles in arrays", "run", "tick", "cycles"),
]
#: The others are times of a call.
CALLED = [
    ("`evaluate`, a call", "scalar_ns", "scalar_ns"),
    ("`registers`, a call", "registers_ns", "registers_ns"),
    ("`registers`, and every one read", "read_ns", "registers_ns"),
    ("`tick`, a call", "tick_ns", "tick_ns"),
]


def turn(preset):
    """What Rust and Python measure, one after the other."""
    [rust] = told(["--package", "model", "--example", "speed"], [preset])
    return rust | {"tick": 1e9 / rust["tick_ns"]}, measure(preset)


def table(preset, rtl, turns):
    """Prints the lines of a preset. A sample of the RTL, of which there are `rtl` a second, is a cycle."""

    def line(what, ours, theirs, told, rate):
        there = statistics.median(rust[theirs] for rust, _ in turns) if theirs else None
        here = statistics.median(python[ours] for _, python in turns)
        ratio = f"{statistics.median(python[ours] / rust[theirs] for rust, python in turns):.2f}" if theirs else ""
        row(f"`{preset}`", what, told(there) if theirs else "", told(here), ratio, f"{rate(here) / rtl:.2g} x")

    for what, ours, theirs, unit in RATES:
        line(what, ours, theirs, lambda rate, unit=unit: f"{rate / 1e6:.1f} M {unit}/s", lambda rate: rate)
    for what, ours, theirs in CALLED:
        line(what, ours, theirs, lambda ns: f"{ns:.0f} ns", lambda ns: 1e9 / ns)
    row(f"`{preset}`", "the RTL in Verilator", "", "", "", f"{rtl / 1e6:.1f} M cycles/s")


def speeds(presets):
    """Prints the table."""
    row("preset", "what", "Rust", "Python", "Python to Rust", "beside the RTL in Verilator")
    row(*["---"] * 6)
    for preset in presets:
        [rtl] = told(["--package", "blysk-tests", "--bin", "verilated"], [preset])
        table(preset, rtl["cycles"], [turn(preset) for _ in range(TURNS)])


def memory():
    """Prints what an array of 10⁸ samples and its answers hold."""

    def held():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10

    model = blysk.Model.preset("compact")
    x = np.arange(10**8)
    x %= 1 << 23
    before = held()
    intensity, status = model.evaluate(63, x)
    sizes = ", ".join(f"{array.nbytes >> 20} MiB" for array in (x, intensity, status))
    print(f"x, intensity and status of 10⁸ samples: {sizes}; most held before {before} MiB, after {held()} MiB")


if __name__ == "__main__":
    if sys.argv[1:] == ["--memory"]:
        memory()
    else:
        speeds(sys.argv[1:] or ["compact", "paper", "precise"])
