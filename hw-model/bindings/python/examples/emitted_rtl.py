"""The emitted RTL under cocotb: ten lines."""

import os

import blysk
import cocotb
from blysk.cocotb import Highlight


@cocotb.test()
async def answers_as_the_model(dut):
    bench = Highlight(dut, blysk.Model.from_file(os.environ["BLYSK_CONFIGURATION"]), seed=1, registers=True)
    await bench.reset()
    results = await bench.send(bench.stimulus(500))
    dut._log.info(f"{results} results, {bench.lockstep.compared} registers compared")
