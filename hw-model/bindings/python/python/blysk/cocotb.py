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

from __future__ import annotations

import random
import re
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge
from cocotb.types import Logic

from . import Model, Pipeline, Probe, stimulus

#: Where the emitted RTL has the valid flags of its ranks, that of rank 0 in bit 0.
VALID_FLAGS = "handshake.valid_q"

#: Cycles beyond the latency in which a design may show nothing new before it counts as stuck.
PATIENCE = 1000


class Mismatch(AssertionError):
    """The design and the model differ; the message names the port or the first register that is wrong."""


class Request(NamedTuple):
    """What a request puts on the ports `address_i` and `x_i`."""

    address: int
    #: The word on the port: the bits in the input format, in two's complement.
    x: int


class Sample(NamedTuple):
    """The levels of all ports in one cycle, before the edge that ends it; None where a bit is unknown."""

    cycle: int
    rst: int | None
    in_valid: int | None
    in_ready: int | None
    address: int | None
    x: int | None
    out_valid: int | None
    out_ready: int | None
    intensity: int | None
    status: int | None

    @property
    def taken(self) -> bool:
        """A request is taken at the edge."""
        return self.in_valid == 1 and self.in_ready == 1 and self.rst == 0

    @property
    def delivered(self) -> bool:
        """A result is taken at the edge."""
        return self.out_valid == 1 and self.out_ready == 1 and self.rst == 0


def word(handle: Any) -> int | None:
    """The level of a port or register as an unsigned number; None where a bit is unknown."""
    value = handle.value
    try:
        return int(value) if isinstance(value, Logic) else int(value.to_unsigned())
    except ValueError:
        return None


def shown(bits: int | None) -> str:
    """Bits as messages have them."""
    return "x" if bits is None else f"{bits:#x}"


def find(top: Any, path: str) -> Any:
    """The handle of a path below `top`, such as `polynomial.stage[1].multiply_add.t_q`; None where it is not shown."""
    for part in re.findall(r"[^.\[\]]+|\[\d+\]", path):
        try:
            top = top[int(part[1:-1]) if part.startswith("[") else part]
        except (KeyError, IndexError, TypeError):
            return None
    return top


class Ports:
    """The ports of the design, by the emitted RTL's names; `others` says what they are called where that differs."""

    def __init__(self, dut: Any, model: Model, others: Mapping[str, str]) -> None:
        names = {port.name: others.get(port.name, port.name) for port in model.ports}
        unknown = sorted(set(others) - set(names))
        if unknown:
            raise ValueError(f"there is no port {unknown[0]}; the ports are {', '.join(names)}")
        found = {port: find(dut, name) for port, name in names.items()}
        missing = [f"{names[port]} (for {port})" for port, handle in found.items() if handle is None]
        if missing:
            raise ValueError(f"the design has no port {', '.join(missing)}; say in `ports` what it is called")
        self._found = found

    def __getitem__(self, port: str) -> Any:
        return self._found[port]

    def sample(self, cycle: int) -> Sample:
        """Every port but the clock."""
        return Sample(cycle, *(word(handle) for port, handle in self._found.items() if port != "clk_i"))


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


class Scoreboard:
    """Compares every result with the model's answer to the request that it answers, and how results are held."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self._formats = {port.name: port.format for port in model.ports}
        self._under_way: deque[Request] = deque()
        self._held: Sample | None = None
        #: Results that were compared.
        self.results = 0

    @property
    def is_empty(self) -> bool:
        """True where every request has its result."""
        return not self._under_way

    def cycle(self, sample: Sample) -> None:
        """Listens to a monitor. Raises `Mismatch`."""
        if sample.rst != 0:
            self._under_way.clear()
            self._held = None
            return
        for port in ("in_ready", "out_valid"):
            if getattr(sample, port) is None:
                raise Mismatch(f"cycle {sample.cycle}: {port}_o is unknown")
        self._compare_held(sample)
        if sample.delivered:
            self._compare(sample)
        if sample.taken and sample.address is not None and sample.x is not None:
            self._under_way.append(Request(sample.address, sample.x))

    def told(self, request: Request) -> str:
        """A request in words."""
        exponents = self.model.exponents
        n = f"{exponents[request.address]:g}" if request.address < len(exponents) else "none"
        x = self._formats["x_i"]
        return f"n = {n} (address {request.address}), x = {request.x:#x} ({x.value(x.bits(request.x))})"

    def _compare(self, sample: Sample) -> None:
        if not self._under_way:
            raise Mismatch(f"cycle {sample.cycle}: a result without a request")
        request = self._under_way.popleft()
        intensity, status = self.model.evaluate(request.address, self._formats["x_i"].bits(request.x))
        wanted = {"intensity": self._formats["intensity_o"].word(intensity), "status": status}
        for port, bits in wanted.items():
            got = getattr(sample, port)
            if got != bits:
                raise Mismatch(
                    f"cycle {sample.cycle}, result {self.results}: {self.told(request)}: "
                    f"{port}_o is {shown(got)}, and {shown(bits)} in the model"
                )
        self.results += 1

    def _compare_held(self, sample: Sample) -> None:
        """A result that was not taken stays."""
        held, self._held = self._held, None
        if held is not None:
            for port in ("out_valid", "intensity", "status"):
                got, was = getattr(sample, port), getattr(held, port)
                if got != was:
                    raise Mismatch(
                        f"cycle {sample.cycle}: {port}_o is {shown(got)}, and was {shown(was)} while the result waited"
                    )
        if sample.out_valid == 1 and sample.out_ready == 0:
            self._held = sample


class Lockstep:
    """Compares every register of every cycle with the clocked model, the first rank first."""

    def __init__(self, dut: Any, scoreboard: Scoreboard) -> None:
        self._scoreboard, model = scoreboard, scoreboard.model
        self._pipeline = Pipeline(model)
        self._ranks, self._x = model.ranks, next(port.format for port in model.ports if port.name == "x_i")
        self._valid = find(dut, VALID_FLAGS)
        self._registers: list[tuple[Probe, Any]] = [(probe, find(dut, probe.path)) for probe in model.probes]
        self._was_reset = False
        self._under_way: deque[Request] = deque()
        #: Registers that were compared, over all cycles.
        self.compared = 0

    @property
    def hidden(self) -> list[str]:
        """The registers that the simulator does not show."""
        hidden = [probe.path for probe, handle in self._registers if handle is None]
        return hidden if self._valid is not None else [VALID_FLAGS, *hidden]

    def cycle(self, sample: Sample) -> None:
        """Listens to a monitor. Raises `Mismatch`."""
        reset, known = sample.rst != 0, sample.in_valid == 1 and sample.address is not None and sample.x is not None
        if self._was_reset:
            self._compare(sample)
        x = self._x.bits(sample.x) if known and sample.x is not None else 0
        outputs = self._pipeline.tick(
            in_valid=known, address=sample.address or 0, x=x, out_ready=sample.out_ready == 1, reset=reset
        )
        if self._was_reset:
            for port in ("in_ready", "out_valid"):
                got, wanted = getattr(sample, port), int(getattr(outputs, port))
                if got != wanted:
                    raise Mismatch(f"cycle {sample.cycle}: {port}_o is {shown(got)}, and {wanted} in the model")
        self._was_reset |= reset
        self._follow(sample)

    def _follow(self, sample: Sample) -> None:
        if sample.rst != 0:
            self._under_way.clear()
        if sample.delivered and self._under_way:
            self._under_way.popleft()
        if sample.taken and sample.address is not None and sample.x is not None:
            self._under_way.append(Request(sample.address, sample.x))

    def _compare(self, sample: Sample) -> None:
        valid, words = self._pipeline.words()
        flags = word(self._valid)
        for rank, wanted in enumerate(valid):
            got = None if flags is None else flags >> rank & 1
            if got != wanted:
                path = f"{VALID_FLAGS}[{rank}]"
                raise Mismatch(self._said(sample, f"{self._ranks[rank]}.valid", path, got, int(wanted), None))
        for (probe, handle), bits in zip(self._registers, words, strict=True):
            if bits is not None:
                got = word(handle)
                if got != bits:
                    standing = self._standing(valid, probe.rank)
                    raise Mismatch(self._said(sample, probe.name, probe.path, got, bits, standing))
                self.compared += 1

    def _standing(self, valid: list[bool], rank: int) -> Request | None:
        """The request in a rank: they do not overtake each other, so the ranks behind it hold the older ones."""
        older = sum(valid[rank + 1 :])
        return self._under_way[older] if valid[rank] and older < len(self._under_way) else None

    def _said(
        self, sample: Sample, name: str, path: str, got: int | None, wanted: int, request: Request | None
    ) -> str:
        of = "" if request is None else f"; it holds {self._scoreboard.told(request)}"
        return f"cycle {sample.cycle}: {name} ({path}) is {shown(got)}, and {shown(wanted)} in the model{of}"


class Highlight:
    """A bench for a highlight pipeline: clock, driver, monitor and scoreboard.

    `dut` is the design, with the ports of `model.ports` or, by `ports`, others: `{"in_valid_i": "s_valid", …}`.
    `registers` demands (True) or forbids (False) that registers are compared; None compares them where all of them are
    shown, as they are in the emitted RTL. `gaps` and `stalls` are the chances of a cycle without a request and of one in
    which no result is taken. `period` is that of the clock in ns, which is driven from here.
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
        self.ports["rst_i"].value = 1
        if not self._started:
            self._started = True
            self.ports["address_i"].value = 0
            self.ports["x_i"].value = 0
            self.driver.idle()
            cocotb.start_soon(Clock(self.ports["clk_i"], self._period, unit="ns").start())
            cocotb.start_soon(self.monitor.run())
            cocotb.start_soon(self.driver.run())
        for _ in range(cycles):
            await RisingEdge(self.ports["clk_i"])
        self.ports["rst_i"].value = 0

    def stimulus(self, count: int, strategy: str = "mixed") -> list[Request]:
        """Requests as `blysk.vectors` chooses them, from the bench's seed."""
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
