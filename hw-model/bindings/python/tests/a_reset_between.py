"""The emitted RTL under cocotb, with a reset while requests are under way."""

import os

import blysk
import cocotb
from blysk.cocotb import Highlight
from cocotb.triggers import ClockCycles


@cocotb.test()
async def answers_before_and_after_a_reset(dut):
    bench = Highlight(dut, blysk.Model.from_file(os.environ["BLYSK_CONFIGURATION"]), seed=1, registers=True)
    await bench.reset()
    assert await bench.send(bench.stimulus(100)) == 100
    bench.driver.waiting.extend(bench.stimulus(100))
    await ClockCycles(dut.clk_i, 40)
    assert bench.driver.waiting, "the reset comes too late"
    await bench.reset()
    await bench.drain()
    lost = 200 - bench.scoreboard.results
    assert 0 < lost <= bench.model.latency + 2, f"{lost} requests are lost"
