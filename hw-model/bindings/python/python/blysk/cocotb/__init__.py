"""Drives a highlight pipeline in a simulation by cocotb 2 and compares it with the golden model.

A test of the emitted RTL (`blysk.rtl`, or `blysk rtl`):

    import blysk, cocotb
    from blysk.cocotb import Highlight

    @cocotb.test()
    async def answers_as_the_model(dut):
        bench = Highlight(dut, blysk.Model.preset("compact"), seed=1)
        await bench.reset()
        await bench.send(bench.stimulus(1000))

Requests are presented with random gaps, and results taken with random stalls, from a seed. Where the simulator shows
the registers of the emitted RTL, every register of every cycle is compared with `blysk.Pipeline`, so that a mistake is
named at the first register that has it. A design of your own with other names of its ports gives `ports`; its latency
may be any, and its answers are compared in their order.
"""

from .agents import Driver, Monitor
from .bench import Highlight
from .lockstep import Lockstep
from .ports import Ports, Request, Sample
from .scoreboard import Mismatch, Scoreboard

__all__ = ["Driver", "Highlight", "Lockstep", "Mismatch", "Monitor", "Ports", "Request", "Sample", "Scoreboard"]
