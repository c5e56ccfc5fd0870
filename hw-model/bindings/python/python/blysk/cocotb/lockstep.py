"""Registers against the clocked model."""

from __future__ import annotations

from collections import deque
from typing import Any

from .. import Pipeline, Probe
from .ports import Request, Sample, find, word
from .scoreboard import Mismatch, Scoreboard, shown

#: Where the emitted RTL has the valid flags of its ranks, that of rank 0 in bit 0.
VALID_FLAGS = "handshake.valid_q"


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
        x = self._x.bits(sample.x) if known and sample.x is not None else 0
        inputs = (known, sample.address or 0, x, sample.out_ready == 1, reset)
        # Before the registers are compared: an asynchronous reset clears flags without an edge.
        outputs = self._pipeline.outputs(*inputs)
        if self._was_reset:
            self._compare(sample)
            for port in ("in_ready", "out_valid"):
                got, wanted = getattr(sample, port), int(getattr(outputs, port))
                if got != wanted:
                    raise Mismatch(f"cycle {sample.cycle}: {port}_o is {shown(got)}, and {wanted} in the model")
        self._pipeline.tick(*inputs)
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
        if self._scoreboard.model.ready_slice == "output":
            # The oldest have results in the slice behind the ranks already.
            older += max(0, len(self._under_way) - sum(valid))
        return self._under_way[older] if valid[rank] and older < len(self._under_way) else None

    def _said(
        self, sample: Sample, name: str, path: str, got: int | None, wanted: int, request: Request | None
    ) -> str:
        of = "" if request is None else f"; it holds {self._scoreboard.told(request)}"
        return f"cycle {sample.cycle}: {name} ({path}) is {shown(got)}, and {shown(wanted)} in the model{of}"
