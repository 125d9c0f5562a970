"""Problem of an optimisation: dimensions with bounds, objectives, constraints; and the designs that are tried."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.keys import PumpKey
from system.pump_file.file import Variant
from system.variation.measures import Measure
from system.variation.scatter import Bound
from system.work.tasks import PartStatus

MET = 1e-6
"""Violation, of the constraint's scale, up to which a constraint counts as met: round-off of the search."""


class Aim(Enum):
    """Direction of an objective."""

    LEAST = "least"
    MOST = "most"

    @property
    def sign(self) -> float:
        """Factor with which less is better."""
        return 1.0 if self is Aim.LEAST else -1.0


@dataclass(frozen=True)
class Varied:
    """A dimension that varies between bounds, SI; tied: others that change by the same amount."""

    key: PumpKey
    low: float
    high: float
    tied: tuple[PumpKey, ...] = ()

    @property
    def name(self) -> str:
        """Its path."""
        return self.key.path

    @property
    def paths(self) -> tuple[str, ...]:
        """Its own path, then those that are tied to it."""
        return (self.key.path, *(one.path for one in self.tied))

    def at(self, value: float) -> Variant:
        """Return the values of the dimension and of those that are tied to it; of the stated value all stated ones."""
        change = value - self.key.value
        return ((self.name, value), *((one.path, one.value + change) for one in self.tied))


AT_START = 1e-12
"""Of the unit cube: distance of a place from the start that is round-off."""


@dataclass(frozen=True)
class Objective:
    """A measure that shall be least, or most."""

    measure: Measure
    aim: Aim


@dataclass(frozen=True)
class Constraint:
    """A measure that must not pass a value, SI, or `of_start` times its value at the start.

    text: as stated.
    """

    measure: Measure
    bound: Bound
    value: float
    text: str
    of_start: float | None = None

    def at_start(self, start: float) -> Constraint:
        """Return the constraint with its value, given the measure of the start."""
        return self if self.of_start is None else replace(self, value=self.of_start * start)

    @property
    def scale(self) -> float:
        """Size by which violations are compared: the value, or one of the unit that people read where it is zero."""
        return abs(self.value) or 1.0 / self.measure.scale

    def violation(self, numbers: Array) -> Array:
        """Return the violations of numbers (..,), over the scale; negative: the margin."""
        sign = 1.0 if self.bound is Bound.MOST else -1.0
        return sign * (numbers - self.value) / self.scale

    @property
    def words(self) -> str:
        """Measure, sign and value as people read them."""
        return f"{self.measure.words} {self.bound.value} {self.measure.text(self.value)}"


@dataclass(frozen=True)
class Problem:
    """Dimensions, objectives and constraints of an optimisation, and all measures of its designs."""

    space: tuple[Varied, ...]
    objectives: tuple[Objective, ...]
    constraints: tuple[Constraint, ...]
    measures: tuple[Measure, ...]

    def variant(self, place: Array) -> Variant:
        """Return the pump's values at a place (k,) of the unit cube."""
        values = self.low + np.clip(place, 0.0, 1.0) * (self.high - self.low)
        return tuple(pair for one, value in zip(self.space, values, strict=True) for pair in one.at(float(value)))

    def changes(self, place: Array) -> Variant:
        """Return the values of a place that differ from the pump's own: none at the start."""
        return () if np.allclose(place, self.start, rtol=0.0, atol=AT_START) else self.variant(place)

    @cached_property
    def low(self) -> Array:
        """Lower bounds (k,), SI."""
        return np.array([one.low for one in self.space])

    @cached_property
    def high(self) -> Array:
        """Upper bounds (k,), SI."""
        return np.array([one.high for one in self.space])

    @cached_property
    def start(self) -> Array:
        """Place (k,) of the stated pump in the unit cube; outside it where its values are outside the bounds."""
        return (np.array([one.key.value for one in self.space]) - self.low) / (self.high - self.low)

    @property
    def holds_start(self) -> bool:
        """True where the bounds hold the stated pump."""
        return bool(np.all((self.start >= 0.0) & (self.start <= 1.0)))

    @property
    def asked(self) -> tuple[Measure, ...]:
        """Measures of objectives and constraints, each once."""
        found = [*(one.measure for one in self.objectives), *(one.measure for one in self.constraints)]
        return tuple(dict.fromkeys(found))

    def aims(self, designs: Sequence[Design]) -> Array:
        """Return the objectives (N, m) of designs, less being better."""
        columns = [one.aim.sign * self.column(designs, one.measure) for one in self.objectives]
        return np.stack(columns, axis=-1)

    def violations(self, designs: Sequence[Design]) -> Array:
        """Return the violations (N, c) of designs."""
        columns = [one.violation(self.column(designs, one.measure)) for one in self.constraints]
        return np.stack(columns, axis=-1) if columns else np.zeros((len(designs), 0))

    def feasible(self, designs: Sequence[Design]) -> Array:
        """Return True (N,) for designs with a result that meet all constraints."""
        solved = np.array([one.solved for one in designs], dtype=bool)
        with np.errstate(invalid="ignore"):
            return solved & np.all(self.violations(designs) <= MET, axis=-1)

    def column(self, designs: Sequence[Design], measure: Measure) -> Array:
        """Return a measure (N,) of designs, nan where a design has no result."""
        at = self.measures.index(measure)
        return np.array([one.numbers[at] if one.solved else np.nan for one in designs])


MapRecord = tuple[list[float], list[list[str]]]
"""Numbers of a map's point in the order of its columns, SI, and its warnings, [name, text] each."""


@dataclass(frozen=True)
class Design:
    """A design: its place (k,) in the unit cube, the generation that tried it, and its measures (M,), SI.

    at_sites: NUMBERS (P, ..) at each operating point; of_map: numbers and warnings of a map there, where they are kept;
    warnings: their names. Without a result all are empty, and `reason` has the cause.
    """

    place: Array
    generation: int
    status: PartStatus
    numbers: Array
    at_sites: Array
    warnings: tuple[str, ...] = ()
    reason: str = ""
    of_map: tuple[MapRecord, ...] = ()

    @property
    def solved(self) -> bool:
        """True for a design with a result."""
        return self.status is PartStatus.SOLVED
