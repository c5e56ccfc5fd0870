"""How fast the wheel answers, beside the Rust engine in the same run: python speed.py [PRESET …], in the clone.

Builds `hw-model/bindings/model/examples/speed.rs` with cargo's profile release, which is the wheel's.
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


def main(presets):
    """Prints a table for each preset."""
    command = "cargo run --release --locked --quiet -p model --example speed --".split()
    told = subprocess.run([*command, *presets], stdout=subprocess.PIPE, check=True, cwd=Path(__file__).parent)
    for line in told.stdout.decode().splitlines():
        rust = json.loads(line)
        python = measure(rust["preset"])
        print(f"{rust['preset']}: Rust, Python")
        for name, what in (("one", "one address"), ("each", "an address for each")):
            print(f"  {what:22} {rust[name] / 1e6:8.1f} {python[name] / 1e6:8.1f} million samples a second")
        print(f"  {'the block engine':22} {rust['block'] / 1e6:8.1f}          million samples a second")
        print(f"  {'real numbers':22}          {python['highlight'] / 1e6:8.1f} million samples a second")
        for name in ("scalar_ns", "registers_ns", "tick_ns"):
            print(f"  {name.removesuffix('_ns'):22} {rust[name]:8.0f} {python[name]:8.0f} nanoseconds a call")
        print(f"  {'cycles in arrays':22}          {python['run'] / 1e6:8.1f} million cycles a second")
    print(f"most memory held: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB")


if __name__ == "__main__":
    main(sys.argv[1:] or ["compact", "paper", "precise"])
