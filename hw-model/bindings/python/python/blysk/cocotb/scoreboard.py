"""Results against the golden model."""

from __future__ import annotations

from collections import deque

from .. import Model
from .ports import Request, Sample


class Mismatch(AssertionError):
    """The design and the model differ; the message names the port or the first register that is wrong."""


def shown(bits: int | None) -> str:
    """Bits as messages have them."""
    return "x" if bits is None else f"{bits:#x}"


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
