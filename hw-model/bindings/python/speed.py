"""How fast the wheel answers, beside the Rust engine and the RTL in Verilator in the same run.

    python speed.py [PRESET …]            in the clone: a table in Markdown
    python speed.py --memory              what 10⁸ samples hold

Builds `hw-model/bindings/model/examples/speed.rs` and `tests/src/bin/verilated.rs` with cargo's profile release, which
is the wheel's. All times are those of the processor, and of nine runs (of Verilator five) the fastest counts.
"""

import json
import resource
import subprocess
import sys
import time
from pathlib import Path

import blysk
import numpy as np

SAMPLES = 1 << 22
CALLS = 100_000


def seconds(job):
    """The least time of several runs."""

    def timed():
        # Of the processor, so that what else the machine does counts little.
        start = time.thread_time()
        job()
        return time.thread_time() - start

    return min(timed() for _ in range(9))


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
    valid, ready = np.ones(SAMPLES, bool), np.arange(SAMPLES) % 8 != 0
    return {
        "one": SAMPLES / seconds(lambda: model.evaluate(63, xs)),
        "each": SAMPLES / seconds(lambda: model.evaluate(addresses, xs)),
        "highlight": SAMPLES / seconds(lambda: model.highlight(64, reals)),
        "scalar_ns": call_ns(lambda x: model.evaluate(63, x)),
        "registers_ns": call_ns(lambda x: model.registers(address=63, x_bits=x)),
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


def speeds(presets):
    """Prints the table."""
    row("preset", "what", "Rust", "Python", "Python to Rust", "beside the RTL in Verilator")
    row(*["---"] * 6)
    for preset in presets:
        [rtl] = told(["--package", "blysk-tests", "--bin", "verilated"], [preset])
        [rust] = told(["--package", "model", "--example", "speed"], [preset])
        python, name = measure(preset), f"`{preset}`"

        def rates(what, unit, ours, theirs=None):
            # A sample of the RTL is a cycle.
            there, ratio = (f"{theirs / 1e6:.1f} M {unit}/s", f"{ours / theirs:.2f}") if theirs else ("", "")
            row(name, what, there, f"{ours / 1e6:.1f} M {unit}/s", ratio, f"{ours / rtl['cycles']:.2g} x")

        rates("array, one address", "samples", python["one"], rust["block"])
        rates("array, an address for each", "samples", python["each"], rust["each"])
        rates("`highlight`, real numbers", "samples", python["highlight"])
        rates("`run`, cycles in arrays", "cycles", python["run"], 1e9 / rust["tick_ns"])
        for call, what in (("scalar", "`evaluate`"), ("registers", "`registers`"), ("tick", "`tick`")):
            ours, theirs = python[f"{call}_ns"], rust[f"{call}_ns"]
            beside = f"{1e9 / ours / rtl['cycles']:.2g} x"
            row(name, f"{what}, a call", f"{theirs:.0f} ns", f"{ours:.0f} ns", f"{ours / theirs:.1f}", beside)
        row(name, "the RTL in Verilator", "", "", "", f"{rtl['cycles'] / 1e6:.1f} M cycles/s")


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
