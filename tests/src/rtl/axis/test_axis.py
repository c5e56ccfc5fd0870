"""Two pipelines in one top module through AXI4-Stream, with sources and sinks of cocotbext-axi.

Each pipeline gets the vectors of its own bundle. Sources and sinks pause at random, from a seed, and a reset comes in
mid-flight before the run that counts. Every result must be that of the bundle, in order.
"""

import itertools
import json
import logging
import os
import random
from pathlib import Path

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, gather
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSink, AxiStreamSource

BUNDLES = json.loads(os.environ["BUNDLES"])
# expected.mem, or negative_control.mem, in which one answer is wrong.
EXPECTED = os.environ["EXPECTED"]
SEED = 1


def words(path):
    """The words of a memory file."""
    lines = path.read_text().splitlines()
    return [int(line, 16) for line in lines if not line.startswith("//")]


def field(layout, name, word):
    """A field of a word, by the manifest's layout."""
    place = next(field for field in layout["fields"] if field["name"] == name)
    return (word >> place["lsb"]) & ((1 << (place["msb"] - place["lsb"] + 1)) - 1)


class Bundle:
    """The requests of a bundle as s_axis_tdata, and its answers as m_axis_tdata and m_axis_tuser."""

    def __init__(self, directory):
        manifest = json.loads((directory / "manifest.json").read_text())
        asked, answered = manifest["words"]["stimulus"], manifest["words"]["expected"]
        bytes_of_x = (manifest["hardware"]["port_widths"]["x"] + 7) // 8
        self.requests = [
            field(asked, "x", word) | field(asked, "address", word) << 8 * bytes_of_x
            for word in words(directory / "stimulus.mem")
        ]
        self.answers = [
            (field(answered, "intensity", word), field(answered, "status", word))
            for word in words(directory / EXPECTED)
        ]


def pauses(seed, share):
    """True where a cycle waits: in blocks of many, few and no pauses."""
    source = random.Random(seed)
    for block in itertools.count():
        likely = (0.0, share, 0.9)[block % 3]
        for _ in range(source.randrange(20, 200)):
            yield source.random() < likely


class Pipeline:
    """A pipeline of the top module, by its prefix."""

    def __init__(self, dut, prefix, directory, seed):
        self.prefix = prefix
        self.bundle = Bundle(directory)
        bus = {"reset": dut.aresetn, "reset_active_level": False, "byte_lanes": 1}
        self.source = AxiStreamSource(AxiStreamBus.from_prefix(dut, f"{prefix}_s_axis"), dut.aclk, **bus)
        self.sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, f"{prefix}_m_axis"), dut.aclk, **bus)
        for end in (self.source, self.sink):
            end.log.setLevel(logging.ERROR)
        self.source.set_pause_generator(pauses(seed, 0.3))
        self.sink.set_pause_generator(pauses(seed + 1, 0.5))

    async def ask(self, count=None):
        """Sends every request, or the first ones; a frame here is a burst of transfers."""
        await self.source.send(AxiStreamFrame(self.bundle.requests[:count]))

    async def compare(self):
        """Every answer, in order."""
        for index, wanted in enumerate(self.bundle.answers):
            frame = await self.sink.recv(compact=False)
            got = (int(frame.tdata[0]), int(frame.tuser[0]))
            if got != wanted:
                print(f"FAIL {self.prefix}: answer {index} is {got}, expected {wanted}", flush=True)
            assert got == wanted
        return len(self.bundle.answers)


@cocotb.test()
async def both(dut):
    """Both pipelines answer as the model does."""
    dut.aresetn.value = 0
    cocotb.start_soon(Clock(dut.aclk, 10, unit="ns").start())
    pipelines = [
        Pipeline(dut, prefix, Path(directory), SEED + 10 * index)
        for index, (prefix, directory) in enumerate(BUNDLES.items())
    ]
    await ClockCycles(dut.aclk, 4)
    dut.aresetn.value = 1
    for pipeline in pipelines:
        await pipeline.ask(100)
    await ClockCycles(dut.aclk, 40)
    # What is under way is lost.
    dut.aresetn.value = 0
    await ClockCycles(dut.aclk, 4)
    for pipeline in pipelines:
        pipeline.source.clear()
        pipeline.sink.clear()
    dut.aresetn.value = 1
    for pipeline in pipelines:
        await pipeline.ask()
    counts = await gather(*(pipeline.compare() for pipeline in pipelines))
    await ClockCycles(dut.aclk, 200)
    assert all(pipeline.sink.empty() for pipeline in pipelines), "an answer to no request"
    print(f"PASS {sum(counts)} results", flush=True)
