"""The golden model of the Blysk highlight pipeline: cos(γ)^n by hardware, bit for bit and cycle for cycle.

>>> import blysk
>>> model = blysk.Model.preset("compact")
>>> model.highlight(64, 0.99)
0.5257568359375
>>> model.evaluate(63, 8304722)  # the ports address and x; intensity and status
(17228, 0)

`Model` answers requests, one or an array of them, and tells every register; `Pipeline` is clocked; `vectors`, `rtl` and
`check` are the files of a testbench; `report` measures errors; `blysk.cocotb` drives a simulated design.
"""

from __future__ import annotations

import enum
import json
import os
from collections.abc import Mapping
from typing import Any, NamedTuple

from . import _native
from ._native import (
    BlyskError,
    Bound,
    ConfigurationError,
    ExponentError,
    FileError,
    Format,
    InputError,
    Model,
    Outputs,
    Pipeline,
    Port,
    Probe,
    Rank,
    Register,
    Registers,
    Worst,
    report,
    stimulus,
)

__version__: str = _native.__version__

Mapping.register(Registers)

#: The flags of the status port: `Status(3)` is `Status.NO_WORD | Status.ABOVE_ONE`.
Status = enum.IntFlag("Status", {name.upper(): bit for name, bit in _native.STATUS_FLAGS})  # type: ignore[misc]


#: The files of the RTL that `rtl` writes, the package first, each behind what it names.
RTL_SOURCES: tuple[str, ...] = tuple(_native.RTL_SOURCES)


class Verdict(NamedTuple):
    """What `check` found."""

    #: True where every vector is answered as it should be.
    holds: bool
    #: How many vectors the bundle has.
    vectors: int
    #: How many of them are answered otherwise, or not at all.
    failing: int
    #: The verdict in words: the first vector that fails, and the register at which it departs.
    text: str


def vectors(
    model: Model, out: str | os.PathLike[str], *, strategy: str = "mixed", count: int = 4096, seed: int = 1
) -> dict[str, Any]:
    """Write test vectors to the directory `out`, as `blysk vectors` does, and return the manifest.

    `strategy` is mixed, compact, corners, even, random or exhaustive; `count` is how many vectors (compact and
    exhaustive settle that themselves). The same call writes the same bytes. Raises `FileError`.
    """
    manifest: dict[str, Any] = json.loads(
        _native.vectors(model, out, strategy=strategy, count=count, seed=seed)
    )
    return manifest


def rtl(
    model: Model,
    out: str | os.PathLike[str],
    *,
    prefix: str = "blysk",
    dut: str | None = None,
    strategy: str = "mixed",
    count: int = 4096,
    seed: int = 1,
) -> dict[str, Any]:
    """Write the RTL with testbench, vectors and Makefile to the directory `out`, as `blysk rtl` does.

    Names of modules and files begin with `prefix`; `dut` is a module of your own with the same ports, which the
    testbench then has in place of ours. Returns the manifest of the vectors. Raises `FileError`.
    """
    manifest: dict[str, Any] = json.loads(
        _native.rtl(model, out, prefix=prefix, dut=dut, strategy=strategy, count=count, seed=seed)
    )
    return manifest


def check(vectors: str | os.PathLike[str], log: str | os.PathLike[str]) -> Verdict:
    """Judge the log of a simulation against the directory that `vectors` or `rtl` wrote, as `blysk check` does.

    The log is CSV with a line for each vector: `intensity`, and if you like `index`, `status` and registers such as
    `front_end.region`, all but the index in hex. Raises `FileError` where one of them cannot be read.
    """
    return Verdict(*_native.check(vectors, log))


__all__ = [
    "RTL_SOURCES",
    "BlyskError",
    "Bound",
    "ConfigurationError",
    "ExponentError",
    "FileError",
    "Format",
    "InputError",
    "Model",
    "Outputs",
    "Pipeline",
    "Port",
    "Probe",
    "Rank",
    "Register",
    "Registers",
    "Status",
    "Verdict",
    "Worst",
    "check",
    "report",
    "rtl",
    "stimulus",
    "vectors",
]
