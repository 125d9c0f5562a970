"""A map between its levels: smooth along each axis, with an error measured at additional points."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, InputFaults
from system.maps.data import MapData
from system.maps.plan import MapAxis, MapInput, MapPlan
from system.maps.point import columns
from system.pump.bench import ideal_flow, ideal_torque
from system.pump.operating import OperatingPoint, operating_point

CUBIC = 3
ROUND_OFF = 1e-9  # of an axis' width, by which a point may lie outside
ROWS = 1024
"""Points at a time: limits the memory."""
CHECKED = 40
"""Number of additional points for the check of a map whose points cost little."""
IDEAL = ("delivery_flow", "inlet_flow", "shaft_torque")
"""Numbers without their lossless part in the interpolation."""


@dataclass(frozen=True)
class MapInterpolant:
    """Numbers of a whole map anywhere in its box: tensor product of splines, no-knot ends, cubic along four levels or
    more, else of the degree that fewer determine.

    Interpolated are losses: flows and torque less the ideal ones; other numbers directly. Raises InputFaults for a map
    with points that have no result.
    """

    data: MapData

    def __post_init__(self) -> None:
        lacking = int(np.sum(~self.data.solved))
        if lacking:
            reason = str(self.data.reason[~self.data.solved][0])
            found = f"{lacking} of {self.data.solved.size} points without a result, the first: {reason}"
            remedy = "swashfilm map without those levels; --resume keeps the other points"
            raise InputFaults(self.data.name, [Fault("map", found, "a whole map", remedy)])

    def at(self, inputs: Mapping[MapInput, Array]) -> dict[str, Array]:
        """Every number (N,) of the map at N points, SI; inputs of single level may be left out.

        Raises InputError with every input that lies outside the box: nothing is extrapolated.
        """
        given = {axis.input: axis.values[0] for axis in self.data.axes if len(axis.values) == 1} | dict(inputs)
        places = {axis.input: np.atleast_1d(np.asarray(given[axis.input], float)) for axis in self.data.axes}
        _hold_inside(self.data.axes, places)
        count = max(len(place) for place in places.values())
        full = {given: np.broadcast_to(place, count) for given, place in places.items()}
        rows = (slice(at, at + ROWS) for at in range(0, count, ROWS))
        found = np.concatenate([self._rows([full[axis.input][own] for axis in self.data.axes]) for own in rows])
        named = dict(zip(self._names, found.T, strict=True))
        return {name: value + ideal(name, full, named) for name, value in named.items()}

    def _rows(self, places: Sequence[Array]) -> Array:
        """Interpolated quantities (N, columns) at places (N,) on each axis."""
        kernel = np.ones((len(places[0]), 1))
        for axis, place in zip(self.data.axes, places, strict=True):
            kernel = (kernel[:, :, None] * weights(axis, place)[:, None, :]).reshape(len(place), -1)
        return np.asarray(kernel @ self._losses.reshape(kernel.shape[1], -1))

    def coefficients(self, name: str) -> Array:
        """B-spline coefficients (n1, .., n5) of a number's interpolated quantity, by the `axis_spline` of each axis."""
        found = self._losses[..., self._names.index(name)]
        for k, axis in enumerate(self.data.axes):
            found = np.moveaxis(np.tensordot(axis_spline(axis).coefficients, found, axes=(1, k)), 0, k)
        return found

    @property
    def _names(self) -> tuple[str, ...]:
        return tuple(name for name, _, _ in columns())

    @cached_property
    def _losses(self) -> Array:
        """Interpolated quantities (n1, .., n5, columns)."""
        values = self.data.values
        return np.stack([values[name] - ideal(name, self.data.grid, values) for name in self._names], axis=-1)


def ideal(name: str, inputs: Mapping[MapInput, Array], values: Mapping[str, Array]) -> Array | float:
    """The lossless part of a flow or a torque: n V and dp V/(2 pi), V geometric; 0 of other numbers."""
    if name not in IDEAL:
        return 0.0
    volume = values["geometric_displacement"]
    if name == "shaft_torque":
        return ideal_torque(volume, values["port_delivery_pressure"] - values["port_inlet_pressure"])  # type: ignore[arg-type]
    return ideal_flow(volume, inputs[MapInput.SPEED])  # type: ignore[arg-type]


@dataclass(frozen=True)
class AxisSpline:
    """B-splines of an axis over 0..1 between its ends: degree, knots (levels + degree + 1,), and the matrix (levels,
    levels) from values at the levels to their coefficients."""

    degree: int
    knots: Array
    coefficients: Array


def axis_spline(axis: MapAxis) -> AxisSpline:
    """The splines of an axis, no-knot ends, exact for polynomials of their degree."""
    from scipy.interpolate import make_interp_spline

    count = len(axis.values)
    if count == 1:
        return AxisSpline(0, np.array([0.0, 1.0]), np.eye(1))
    lower, upper = axis.values[0], axis.values[-1]
    unit = (np.array(axis.values) - lower) / (upper - lower)
    spline = make_interp_spline(unit, np.eye(count), k=min(CUBIC, count - 1))
    return AxisSpline(spline.k, spline.t, spline.c)


def weights(axis: MapAxis, places: Array) -> Array:
    """Weight of each level at places (N,): (N, levels), exact for polynomials of the spline's degree."""
    from scipy.interpolate import BSpline

    lower, upper = axis.values[0], axis.values[-1]
    if lower == upper:
        return np.ones((len(places), 1))
    own = axis_spline(axis)
    spline = BSpline(own.knots, own.coefficients, own.degree)
    return np.asarray(spline(np.clip((places - lower) / (upper - lower), 0.0, 1.0)))


def slack(axis: MapAxis) -> float:
    """Round-off by which a point may lie outside an axis."""
    lower, upper = axis.values[0], axis.values[-1]
    return ROUND_OFF * max(upper - lower, abs(upper))


def inside(axis: MapAxis, places: Array) -> np.ndarray:
    """Mask of places (N,) between the ends of an axis, up to round-off."""
    lower, upper = axis.values[0], axis.values[-1]
    return np.asarray((places >= lower - slack(axis)) & (places <= upper + slack(axis)))


def outside(axes: Sequence[MapAxis], places: Mapping[MapInput, Array]) -> list[tuple[MapAxis, int]]:
    """Axes that places (N,) leave, each with the first that does; an axis without places is not left."""
    return [
        (axis, int(np.argmin(good)))
        for axis in axes
        if axis.input in places and not np.all(good := inside(axis, places[axis.input]))
    ]


def box_text(axes: Sequence[MapAxis]) -> str:
    """Ends of the axes as what was expected of a place outside."""
    ends = (dict.fromkeys(map(axis.input.text, (axis.values[0], axis.values[-1]))) for axis in axes)
    return ", ".join(map(" .. ".join, ends)) + ", the map's box: nothing is extrapolated"


def _hold_inside(axes: Sequence[MapAxis], places: Mapping[MapInput, Array]) -> None:
    if out := outside(axes, places):
        raise InputError(
            ", ".join(axis.input.words for axis, _ in out),
            ", ".join(axis.input.text(float(places[axis.input][first])) for axis, first in out),
            box_text([axis for axis, _ in out]),
        )


def check_points(plan: MapPlan, count: int) -> tuple[OperatingPoint, ...]:
    """Additional points inside the box of a plan, by Sobol's sequence over the axes that have several levels."""
    from scipy.stats.qmc import Sobol

    wide = [axis for axis in plan.axes if len(axis.values) > 1]
    if not wide or count == 0:
        return ()
    places = Sobol(len(wide), scramble=False).fast_forward(1).random(count)
    lower = np.array([axis.values[0] for axis in wide])
    values = lower + places * (np.array([axis.values[-1] for axis in wide]) - lower)
    held = {axis.input.value: axis.values[0] for axis in plan.axes if len(axis.values) == 1}
    return tuple(
        operating_point(plan.pump, **held, **{axis.input.value: float(x) for axis, x in zip(wide, row, strict=True)})
        for row in values
    )


@dataclass(frozen=True)
class MapError:
    """Error of a map between its levels, by column: rms and largest, SI; number of points that measure it.

    shown_by: additional points, or inner levels predicted by the map without them.
    """

    rms: Mapping[str, float]
    largest: Mapping[str, float]
    count: int
    shown_by: str


def fresh_error(interpolant: MapInterpolant, points: Sequence[OperatingPoint], found: Mapping[str, Array]) -> MapError:
    """The error at additional points: `found` are their numbers (N,) by column."""
    at = {given: np.array([getattr(point, given.value) for point in points]) for given in MapInput}
    interpolated = interpolant.at(at)
    return _error({name: interpolated[name] - values for name, values in found.items()}, "fresh points, solved")


def left_out_error(data: MapData) -> MapError | None:
    """Error of each inner level of each axis, predicted from the others; None where an axis has two levels, along
    which nothing measures it, and without an axis of more.

    Levels are then twice as far apart: an upper bound for a smooth map, some five times too large on REF90.
    """
    if any(len(axis.values) == 2 for axis in data.axes):
        return None
    off: dict[str, list[Array]] = {}
    for k, axis in enumerate(data.axes):
        for level in range(1, len(axis.values) - 1):
            values = axis.values[:level] + axis.values[level + 1 :]
            kept = [i for i in range(len(axis.values)) if i != level]
            others = MapInterpolant(_taken(data, k, kept, MapAxis(axis.input, values)))
            inputs = {given: np.take(grid, level, axis=k).ravel() for given, grid in data.grid.items()}
            for name, numbers in others.at(inputs).items():
                off.setdefault(name, []).append(numbers - np.take(data.values[name], level, axis=k).ravel())
    return _error({name: np.concatenate(rows) for name, rows in off.items()}, "levels left out") if off else None


def _taken(data: MapData, k: int, kept: Sequence[int], axis: MapAxis) -> MapData:
    """The map with some levels of axis k alone."""
    return replace(
        data,
        axes=(*data.axes[:k], axis, *data.axes[k + 1 :]),
        values={name: np.take(values, kept, axis=k) for name, values in data.values.items()},
        status=np.take(data.status, kept, axis=k),
        reason=np.take(data.reason, kept, axis=k),
        warnings=np.take(data.warnings, kept, axis=k),
    )


def _error(off: Mapping[str, Array], shown_by: str) -> MapError:
    return MapError(
        {name: float(np.sqrt(np.mean(values**2))) for name, values in off.items()},
        {name: float(np.max(np.abs(values))) for name, values in off.items()},
        len(next(iter(off.values()))),
        shown_by,
    )
