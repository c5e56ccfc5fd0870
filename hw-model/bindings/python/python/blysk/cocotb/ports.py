"""The ports of a design, and what they show in a cycle."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from cocotb.types import Logic

from .. import Model


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
        self._reset = next(port for port in names if port.startswith("rst"))
        self._active = 0 if model.reset_active_low else 1

    def __getitem__(self, port: str) -> Any:
        return self._found[port]

    def reset(self, on: bool) -> None:
        """Drives the reset, by the level that it has."""
        self._found[self._reset].value = self._active if on else 1 - self._active

    def sample(self, cycle: int) -> Sample:
        """Every port but the clock; of the reset whether there is one."""
        levels = {port: word(handle) for port, handle in self._found.items() if port != "clk_i"}
        if levels[self._reset] is not None:
            levels[self._reset] = int(levels[self._reset] == self._active)
        return Sample(cycle, *levels.values())
