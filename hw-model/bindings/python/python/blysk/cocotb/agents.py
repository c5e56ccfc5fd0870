"""What drives the ports and what looks at them."""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable

from cocotb.triggers import FallingEdge, RisingEdge

from .ports import Ports, Request, Sample


class Monitor:
    """Looks at the ports in every cycle, while they are stable, and tells its listeners."""

    def __init__(self, ports: Ports) -> None:
        self._ports = ports
        self.listeners: list[Callable[[Sample], None]] = []
        #: The last cycle that was seen.
        self.last: Sample | None = None
        self.cycles = 0

    async def run(self) -> None:
        """One sample a cycle, at the falling edge: inputs change at the rising one, and what follows has settled."""
        while True:
            await FallingEdge(self._ports["clk_i"])
            self.last = self._ports.sample(self.cycles)
            self.cycles += 1
            for listener in self.listeners:
                listener(self.last)


class Driver:
    """Presents requests with random gaps and holds each until it is taken; takes results with random stalls."""

    def __init__(self, ports: Ports, monitor: Monitor, rng: random.Random, gaps: float, stalls: float) -> None:
        self._ports, self._monitor, self._rng = ports, monitor, rng
        #: The chance of a cycle without a request, and of one in which no result is taken.
        self.gaps, self.stalls = gaps, stalls
        self.waiting: deque[Request] = deque()
        self._presented: Request | None = None

    @property
    def is_done(self) -> bool:
        """True where every request has been taken."""
        return not self.waiting and self._presented is None

    def idle(self) -> None:
        """Nothing is presented and every result is taken."""
        self._present(None)
        self._ports["out_ready_i"].value = 1

    async def run(self) -> None:
        """After each rising edge the inputs of the next cycle."""
        while True:
            await RisingEdge(self._ports["clk_i"])
            last = self._monitor.last
            if last is not None and last.taken:
                self._presented = None
            if self._presented is None:
                request = self.waiting.popleft() if self.waiting and self._rng.random() >= self.gaps else None
                self._present(request)
            self._ports["out_ready_i"].value = int(self._rng.random() >= self.stalls)

    def _present(self, request: Request | None) -> None:
        self._presented = request
        self._ports["in_valid_i"].value = int(request is not None)
        if request is not None:
            self._ports["address_i"].value = request.address
            self._ports["x_i"].value = request.x
