"""Two pumps side by side: without and with the effects that a diagnosis claims."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from system.description.pump import PumpDescription
from system.points.films import FilmsPoint
from system.points.floating import FloatingPoint
from system.pump.assembly import PumpPoint

WITHOUT, WITH = "without", "with"
"""Names of the two pumps, and of their run folders."""


@dataclass(frozen=True)
class Change:
    """A quantity of both pumps, in its unit."""

    quantity: str
    unit: str
    without: float
    found: float


@dataclass(frozen=True)
class FilmChange:
    """A quantity of a gap by name of the pump, in its unit: by closed-form laws and by solved films.

    lumped: empty beside floating films.
    """

    quantity: str
    unit: str
    lumped: Mapping[str, float]
    films: Mapping[str, float]


@dataclass(frozen=True)
class FilmComparison:
    """Films of both pumps by name, empty without a solution; text: settings and accuracy, or the reason.

    points: at given positions; floating: by balance of forces.
    """

    points: Mapping[str, FilmsPoint] = field(default_factory=dict)
    changes: tuple[FilmChange, ...] = ()
    text: str = ""
    floating: Mapping[str, FloatingPoint] = field(default_factory=dict)


@dataclass(frozen=True)
class PumpComparison:
    """Both pumps and their lumped points by name, empty without a solution; text: the point, or the reason."""

    pumps: Mapping[str, PumpDescription] = field(default_factory=dict)
    points: Mapping[str, PumpPoint] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()
    text: str = ""
    films: FilmComparison = FilmComparison()


NO_COMPARISON = PumpComparison()
