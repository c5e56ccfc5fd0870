"""A design of one's own under cocotb: other names of ports, another latency, registers that nobody else knows."""

import os

import blysk
import cocotb
from blysk.cocotb import Highlight

PORTS = {
    "clk_i": "clk",
    "rst_i": "rst",
    "in_valid_i": "s_valid",
    "in_ready_o": "s_ready",
    "address_i": "s_material",
    "x_i": "s_cosine",
    "out_valid_o": "m_valid",
    "out_ready_i": "m_ready",
    "intensity_o": "m_intensity",
    "status_o": "m_status",
}


@cocotb.test()
async def answers_as_the_model(dut):
    bench = Highlight(dut, blysk.Model.from_file(os.environ["BLYSK_CONFIGURATION"]), ports=PORTS, registers=False)
    await bench.reset()
    results = await bench.send(bench.stimulus(500))
    dut._log.info(f"{results} results compared")


@cocotb.test()
async def answers_without_a_gap(dut):
    bench = Highlight(dut, blysk.Model.from_file(os.environ["BLYSK_CONFIGURATION"]), ports=PORTS, gaps=0, stalls=0)
    await bench.reset()
    await bench.send(bench.stimulus(200, strategy="random"))
    assert bench.monitor.cycles < 200 + bench.model.latency + 20
