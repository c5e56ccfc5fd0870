"""Clock, driver, monitor and scoreboard together."""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge

from .. import Model, stimulus
from .agents import Driver, Monitor
from .lockstep import Lockstep
from .ports import Ports, Request
from .scoreboard import Mismatch, Scoreboard

#: Cycles beyond the latency in which a design may show nothing new before it counts as stuck.
PATIENCE = 1000


class Highlight:
    """A bench for a highlight pipeline: clock, driver, monitor and scoreboard.

    `dut` is the design, with the ports of `model.ports` or, by `ports`, others: `{"in_valid_i": "s_valid", …}`.
    `registers` demands (True) or forbids (False) that registers are compared; None compares them where all of them are
    shown, as they are in the emitted RTL. `gaps` and `stalls` are the chances of a cycle without a request and of one
    in which no result is taken. `period` is that of the clock in ns, which is driven from here.
    """

    def __init__(
        self,
        dut: Any,
        model: Model,
        *,
        ports: Mapping[str, str] | None = None,
        registers: bool | None = None,
        seed: int = 1,
        gaps: float = 0.25,
        stalls: float = 0.25,
        period: float = 10.0,
    ) -> None:
        self.model, self.seed, self._period = model, seed, period
        self.ports = Ports(dut, model, ports or {})
        self.monitor = Monitor(self.ports)
        # A pipeline that nothing stops shows a result for one cycle, which is to be taken.
        stalls = 0.0 if model.handshake == "none" else stalls
        self.driver = Driver(self.ports, self.monitor, random.Random(seed), gaps, stalls)
        self.scoreboard = Scoreboard(model)
        self.lockstep: Lockstep | None = Lockstep(dut, self.scoreboard) if registers is not False else None
        if self.lockstep is not None and self.lockstep.hidden:
            if registers:
                raise ValueError(f"the simulator does not show {self.lockstep.hidden[0]}; give registers=False")
            self.lockstep = None
        # The first register that is wrong says more than the result that it spoils.
        if self.lockstep is not None:
            self.monitor.listeners.append(self.lockstep.cycle)
        self.monitor.listeners.append(self.scoreboard.cycle)
        self._started = False

    async def reset(self, cycles: int = 3) -> None:
        """Resets for some cycles; what is under way is lost. The first call starts clock, driver and monitor."""
        self.ports.reset(True)
        if not self._started:
            self._started = True
            self.ports["address_i"].value = 0
            self.ports["x_i"].value = 0
            self.driver.idle()
            Clock(self.ports["clk_i"], self._period, unit="ns").start()
            cocotb.start_soon(self.monitor.run())
            cocotb.start_soon(self.driver.run())
        for _ in range(cycles):
            await RisingEdge(self.ports["clk_i"])
        self.ports.reset(False)

    def stimulus(self, count: int, strategy: str = "corners") -> list[Request]:
        """Requests as `blysk.vectors` chooses them, from the bench's seed.

        Corners are where hardware goes wrong, and chosen in a blink; "mixed" searches seconds for what kills faults.
        """
        addresses, xs = stimulus(self.model, strategy=strategy, count=count, seed=self.seed)
        word = next(port.format for port in self.model.ports if port.name == "x_i").word
        return [Request(int(address), word(int(x))) for address, x in zip(addresses, xs, strict=True)]

    async def send(self, requests: Iterable[Request]) -> int:
        """Presents requests and waits until all are answered. Returns how many results have been compared so far.

        Raises `Mismatch` where the design differs from the model or answers no more.
        """
        self.driver.waiting.extend(requests)
        await self.drain()
        return self.scoreboard.results

    async def drain(self) -> None:
        """Waits until every request is answered. Raises `Mismatch` where none is answered any more."""
        seen = (self.scoreboard.results, len(self.driver.waiting), self.monitor.cycles)
        while not (self.driver.is_done and self.scoreboard.is_empty):
            await RisingEdge(self.ports["clk_i"])
            now = (self.scoreboard.results, len(self.driver.waiting), self.monitor.cycles)
            if now[:2] != seen[:2]:
                seen = now
            elif now[2] - seen[2] > self.model.latency + PATIENCE:
                raise Mismatch(f"cycle {now[2]}: no request was taken and no result came for {now[2] - seen[2]} cycles")
        if self.scoreboard.results == 0:
            raise Mismatch("no result was compared: nothing was sent")
