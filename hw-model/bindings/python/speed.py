"""How fast the wheel answers, beside the Rust engine and the RTL in Verilator in the same run.

    python speed.py [PRESET …]            in the clone: a table in Markdown
    python speed.py --memory              what 10⁸ samples hold

Builds `hw-model/bindings/model/examples/speed.rs` and `tests/src/bin/verilated.rs` with cargo's profile release, which
is the wheel's. All times are those of the processor. Rust and Python take turns, as others may use the machine too, and
the median of the turns counts; a ratio is the median of the ratios.
"""

import json
import resource
import statistics
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import blysk
import numpy as np

SAMPLES = 1 << 22
CALLS = 20_000
TURNS = 15


def nanoseconds(job):
    """The time that the processor had for a job: what else the machine does counts little."""
    start = time.thread_time_ns()
    job()
    return time.thread_time_ns() - start


def a_sample(job):
    """Nanoseconds of a sample or a cycle, where the job is one over arrays."""
    return lambda: nanoseconds(job) / SAMPLES


def a_call(job):
    """Nanoseconds of a call of the job, the loop around it included."""

    def loop():
        for x in range(0, 80 * CALLS, 80):
            job(x)

    return lambda: nanoseconds(loop) / CALLS


def measures(model):
    """What is measured: its name, how, the measure of the Rust example beside it, and the unit of a rate."""
    xs = np.arange(SAMPLES) * 2 + 1
    addresses = (np.arange(SAMPLES, dtype=np.uint32) * np.uint32(2654435761)) >> np.uint32(24)
    reals = np.linspace(0, 1, SAMPLES)
    out = np.empty(SAMPLES, np.int64), np.empty(SAMPLES, np.uint8)
    valid, ready = np.ones(SAMPLES, bool), xs & 7 != 0
    tick = blysk.Pipeline(model).tick

    def run():
        return blysk.Pipeline(model).run(valid, 63, xs, ready)

    def into(address):
        return lambda: model.evaluate(address, xs, out=out)

    def read_bits(x):
        return model.registers(address=63, x_bits=x).bits()

    def read_all(x):
        return [register.bits for register in model.registers(address=63, x_bits=x).values()]

    return [
        ("array, one address", a_sample(lambda: model.evaluate(63, xs)), "block", "samples"),
        ("array, one address, `out=`", a_sample(into(63)), "block", "samples"),
        ("array, an address for each", a_sample(lambda: model.evaluate(addresses, xs)), "each", "samples"),
        ("array, an address for each, `out=`", a_sample(into(addresses)), "each", "samples"),
        ("`highlight`, real numbers", a_sample(lambda: model.highlight(64, reals)), None, "samples"),
        ("`run`, cycles in arrays", a_sample(run), "tick", "cycles"),
        ("`evaluate`, a call", a_call(lambda x: model.evaluate(63, x)), "scalar", None),
        ("`registers`, a call", a_call(lambda x: model.registers(address=63, x_bits=x)), "registers", None),
        ("`registers`, and all bits read", a_call(read_bits), "registers", None),
        ("`registers`, and every one read", a_call(read_all), "registers", None),
        ("`tick`, a call", a_call(lambda x: tick(True, 63, x, x & 7 != 0)), "tick", None),
    ]


def cargo(*command):
    """A program of the clone, as its users build it."""
    return {"args": ["cargo", "run", "--release", "--locked", "--quiet", *command], "cwd": Path(__file__).parent}


@contextmanager
def rust(preset):
    """A function that has the Rust example measure something."""
    with subprocess.Popen(
        **cargo("--package", "model", "--example", "speed", "--", preset),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as example:

        def ask(what):
            print(what, file=example.stdin, flush=True)
            return float(example.stdout.readline())

        yield ask
        example.stdin.close()


def rtl_cycles(preset):
    """Cycles a second of the RTL in Verilator."""
    command = cargo("--package", "blysk-tests", "--bin", "verilated", "--", preset)
    return json.loads(subprocess.run(**command, stdout=subprocess.PIPE, check=True).stdout)["cycles"]


def row(*cells):
    """Prints a line of the table."""
    print("| " + " | ".join(cells) + " |", flush=True)


def told(ns, unit):
    """A time as the table has it: as a rate where there is a unit."""
    return f"{1e3 / ns:.1f} M {unit}/s" if unit else f"{ns:.0f} ns"


def speeds(presets):
    """Prints the table. A sample of the RTL is a cycle."""
    row("preset", "what", "Rust", "Python", "speed of Python to Rust", "beside the RTL in Verilator")
    row(*["---"] * 6)
    for preset in presets:
        rtl = rtl_cycles(preset)
        with rust(preset) as ask:
            for what, measure, beside, unit in measures(blysk.Model.preset(preset)):
                turns = [(ask(beside) if beside else 0, measure()) for _ in range(TURNS)]
                theirs, ours = (statistics.median(times) for times in zip(*turns))
                ratio = f"{statistics.median(their / our for their, our in turns):.2f}"
                there, ratio = (told(theirs, unit), ratio) if beside else ("", "")
                row(f"`{preset}`", what, there, told(ours, unit), ratio, f"{1e9 / ours / rtl:.2g} x")
        row(f"`{preset}`", "the RTL in Verilator", "", "", "", f"{rtl / 1e6:.1f} M cycles/s")


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
