"""Measured data beside what the program finds: comparison error and validation uncertainty of ASME V&V 20-2009.

E = S - D, found less measured. u_val^2 = u_num^2 + u_input^2 + u_D^2, standard uncertainties of the numerical solution,
of the inputs and of the data. Where |E| <= k u_val the model's error is not told from the noise; beyond, it is about
E +- k u_val. A part that nobody computed is not zero: a larger E may come from that part. The same holds, to a lesser
extent, of a part that is a lower bound.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from math import hypot, sqrt
from typing import Any

COVERAGE = 2.0  # k: 95 % of a normal distribution
PARTS = ("film temperature", "mixed friction", "churning", "piston friction", "slipper", "block tilt", "pump", "rig")


class Verdict(Enum):
    """Verdict of a comparison on the model."""

    NOISE = "within the noise"
    MODEL = "model error"
    OPEN = "open"


@dataclass(frozen=True)
class Uncertainty:
    """A standard uncertainty in the unit of its row, None where it is not computed, and how it was found.

    lower_bound: the true one is no smaller, as the source leaves something unstated.
    """

    size: float | None
    how: str
    lower_bound: bool = False


@dataclass(frozen=True)
class Trend:
    """A measured direction: the source has no number that could carry an uncertainty."""

    part: str
    licence: str

    def __post_init__(self) -> None:
        _known(self)


@dataclass(frozen=True)
class Measured:
    """Source, licence and uncertainties of a row against a measured number."""

    part: str
    licence: str
    data: Uncertainty
    inputs: Uncertainty
    numerical: Uncertainty

    def __post_init__(self) -> None:
        _known(self)
        missing = [name for name in ("data", "inputs", "numerical") if not getattr(self, name).how]
        if missing:
            raise ValueError(f"measured: how was the uncertainty of {', '.join(missing)} found?")

    @property
    def uncertainty(self) -> float:
        """u_val, of the parts that are computed."""
        return hypot(*(part.size or 0.0 for part in (self.data, self.inputs, self.numerical)))

    @property
    def lacking(self) -> tuple[str, ...]:
        """Symbols of the parts that are not computed."""
        parts = {"u_num": self.numerical, "u_input": self.inputs, "u_D": self.data}
        return tuple(symbol for symbol, part in parts.items() if part.size is None)

    def verdict(self, error: float) -> Verdict:
        """Of a comparison error E in the row's unit."""
        if abs(error) <= COVERAGE * self.uncertainty:
            return Verdict.NOISE
        return Verdict.OPEN if self.lacking else Verdict.MODEL


Reference = Measured | Trend


def _known(reference: Reference) -> None:
    if reference.part not in PARTS:
        raise ValueError(f"measured: part {reference.part!r}, expected one of {', '.join(PARTS)}")
    if not reference.licence:
        raise ValueError("measured: under what licence, or by what right, is the number here?")


def not_computed(why: str) -> Uncertainty:
    """An uncertainty that nobody computed, and why."""
    return Uncertainty(None, f"not computed: {why}")


def within(half_width: float, how: str) -> Uncertainty:
    """Of a value that lies anywhere within +- half_width: half_width over the root of three."""
    return Uncertainty(float(abs(half_width)) / sqrt(3.0), how)


def at_least(part: Uncertainty) -> Uncertainty:
    """The same as a lower bound."""
    return replace(part, lower_bound=True)


def of_mesh(index: float, how: str) -> Uncertainty:
    """Of a grid convergence index, which holds 95 %: half of it."""
    return Uncertainty(0.5 * float(abs(index)), how)


def by_differences(
    found: Callable[[Mapping[str, float]], float], widths: Mapping[str, tuple[float, float]], how: str
) -> Uncertainty:
    """Of inputs that lie anywhere within their widths (low, high), each varied alone, the others in the middle.

    found: the row's quantity of all inputs by name.
    """
    middle = {name: 0.5 * (low + high) for name, (low, high) in widths.items()}
    halves = [
        0.5 * (found({**middle, name: high}) - found({**middle, name: low})) for name, (low, high) in widths.items()
    ]
    return within(hypot(*halves), how)


def reference_of(plain: Mapping[str, Any]) -> Reference:
    """The reference of `asdict`."""
    if "data" not in plain:
        return Trend(**plain)
    parts = {name: Uncertainty(**plain[name]) for name in ("data", "inputs", "numerical")}
    return Measured(plain["part"], plain["licence"], **parts)
