"""Course of a gap over one step of its march: its instants, the states between them, and the flows that pass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache, cached_property
from typing import Generic, TypeVar, cast

import numpy as np

from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import cavitated_fraction

SAME = 1e-9  # of an angle or a step: round-off

Value = TypeVar("Value")
Item = TypeVar("Item")


@dataclass(frozen=True)
class GapInstant(Generic[Value]):
    """A gap at one shaft angle (rad): position (k,) m, rate (k,) m/s, forces (k,) N along the position, film.

    Forces of film, contact, outside and inertia, -M q'', add up to zero.

    least_gap m is the least distance of the mean planes, negative where rough walls overlap; film_thickness_min
    and mean_film m the least and the area mean of the film's thickness; thinnest m, place in the film's plane of
    its thinnest vertex (between known angles that of the later one); pressure_max Pa; cavitated_area_fraction;
    report: of the gap at the instant; passed: its mean since the angle before, in which flows balance as in the
    march; pushed: power (W) of the film on the outer forces, such a mean too.
    """

    angle: float
    position: Array
    rate: Array
    film_force: Array
    contact_force: Array
    outer_force: Array
    inertia_force: Array
    least_gap: float
    film_thickness_min: float
    mean_film: float
    thinnest: tuple[float, float]
    pressure_max: float
    cavitated_area_fraction: float
    report: Value
    passed: Value
    pushed: float


@dataclass(frozen=True)
class Course(Generic[Value]):
    """A gap over one step (s): its instants at the stages, the last at the end, and that at the step's start.

    Between them the parabola through all; flows the line through the stages alone, whose integral over the step is the
    method's: the flows of parts of a step add up to the balance of the march.
    """

    behind: GapInstant[Value] | None
    stages: tuple[GapInstant[Value], ...]
    holds: tuple[Array, ...]
    step: float
    speed: float

    @property
    def end(self) -> GapInstant[Value]:
        """The gap at the end of the step."""
        return self.stages[-1]

    def at(self, angle: float, since: Passed[Value]) -> GapInstant[Value]:
        """The gap at a shaft angle (rad) of the step; `since`: mean of the flows since the reported angle before."""
        known = self.stages if self.behind is None else (self.behind, *self.stages)
        shares = self._shares(angle, [one.angle for one in known])
        found = with_numbers(known[-1], shares @ self._instants)
        return replace(found, angle=angle, passed=since.mean, pushed=since.mean_pushed)

    def oil(self, angle: float) -> Array:
        """State (held,) at a shaft angle (rad)."""
        shares = self._shares(angle, [one.angle for one in self.stages])
        return np.asarray(sum(share * held for share, held in zip(shares, self.holds, strict=True)))

    def passed(self, began: float, ended: float, since: Passed[Value]) -> None:
        """Add the flows from one time (s) of the step to another."""
        middle = 0.5 * self.speed * (began + ended)
        shares = self._shares(middle, [one.angle for one in self.stages])
        since.add(ended - began, self.end, shares @ self._flows)

    @cached_property
    def _instants(self) -> Array:
        """Numbers of the known instants, the one behind first, (known, n)."""
        known = self.stages if self.behind is None else (self.behind, *self.stages)
        return np.array([numbers_of(one) for one in known])

    @cached_property
    def _flows(self) -> Array:
        """Numbers of the stages' reports, and last the power on the outer forces, (stages, n + 1)."""
        return np.array([[*numbers_of(one.report), one.pushed] for one in self.stages])

    def _shares(self, angle: float, known: list[float]) -> Array:
        """Lagrange's weights of known angles (rad) at another one; that of the end alone there."""
        places = np.array(known)
        if abs(angle - places[-1]) <= SAME * self.speed * self.step:
            return np.eye(len(places))[-1]
        others = places[:, None] - places + np.eye(len(places))
        ways = angle - np.tile(places, (len(places), 1))
        np.fill_diagonal(ways, 1.0)
        return np.asarray(np.prod(ways / others, axis=1))


def instant_of_stage(angle: float, stage: FloatingStage, report: Value) -> GapInstant[Value]:
    """The instant of a stage; the flows are those of its report."""
    space, film = stage.solution.problem.space, stage.solution.film
    area, at_vertices = space.area, vertex_thickness(stage.solution)
    x, y = space.vertices[int(np.argmin(at_vertices))]
    return GapInstant(
        angle=angle,
        position=stage.q,
        rate=stage.rate,
        film_force=stage.film_force,
        contact_force=stage.contact_force,
        outer_force=stage.outer.force,
        inertia_force=stage.inertia_force,
        least_gap=stage.least_gap,
        film_thickness_min=float(min(at_vertices.min(), film.thickness.min())),
        mean_film=float(np.sum(film.thickness * area) / np.sum(area)),
        thinnest=(float(x), float(y)),
        pressure_max=float(stage.solution.pressure.max()),
        cavitated_area_fraction=cavitated_fraction(stage.solution),
        report=report,
        passed=report,
        pushed=-float(stage.outer.force @ stage.rate),
    )


def numbers_of(item: object) -> list[float]:
    """The numbers of a report in a row: its own, those of its arrays, and those of dataclasses in it."""
    if isinstance(item, float):
        return [item]
    if isinstance(item, np.ndarray):
        return cast("list[float]", item.ravel().tolist())
    if is_dataclass(item) and not isinstance(item, type):
        return [number for name in _names(type(item)) for number in numbers_of(getattr(item, name))]
    return []


def with_numbers(item: Item, numbers: Array) -> Item:
    """A report with other numbers, in the row of `numbers_of`; anything else is the item's."""
    return cast(Item, _rebuilt(item, iter(numbers.tolist())))


def _rebuilt(item: object, numbers: Iterator[float]) -> object:
    if isinstance(item, float):
        return next(numbers)
    if isinstance(item, np.ndarray):
        return np.array([next(numbers) for _ in range(item.size)]).reshape(item.shape)
    if is_dataclass(item) and not isinstance(item, type):
        kind = type(item)
        return kind(*(_rebuilt(getattr(item, name), numbers) for name in _names(kind)))
    return item


@cache
def _names(kind: type) -> tuple[str, ...]:
    """Names of the fields of a dataclass."""
    return tuple(field.name for field in fields(kind))


class Passed(Generic[Value]):
    """Mean over the time (s) of parts of steps, of reports and of the power on outer forces."""

    def __init__(self) -> None:
        self._time, self._total = 0.0, np.zeros(1)
        self._last: GapInstant[Value] | None = None

    def add(self, time: float, last: GapInstant[Value], flows: Array) -> None:
        """One more part; flows: the numbers of its report, then the power (W) of its film on the outer forces."""
        self._time, self._total, self._last = self._time + time, self._total + time * flows, last

    @property
    def mean(self) -> Value:
        """Mean of the reports."""
        assert self._last is not None
        return with_numbers(self._last.report, self._total[:-1] / self._time)

    @property
    def mean_pushed(self) -> float:
        """Mean of the power (W)."""
        return float(self._total[-1] / self._time)
