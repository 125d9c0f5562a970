"""Comparison of two maps: over their common box, number by number, with the possible error of both."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, InputFaults
from system.maps.data import LOSSES, MapData, objects
from system.maps.interpolation import MapError, MapInterpolant, inside
from system.maps.plan import MapAxis, MapInput
from system.maps.specific import of_two_sizes, specific_numbers
from system.pump.efficiency import EfficiencyDefinition
from system.work.tasks import PartStatus

COMPARED = {
    "shaft_torque": ("shaft torque", "N m"),
    "delivery_flow": ("delivery flow", "m3/s"),
    "drain_flow": ("case flow", "m3/s"),
    "shaft_power": ("shaft power", "W"),
    **{column: (words, "W") for column, words in LOSSES.items()},
}


@dataclass(frozen=True)
class Extreme:
    """A difference (other less one) at a point of two maps, with the possible error of both there. SI."""

    value: float
    at: Mapping[MapInput, float]
    error: float

    @property
    def significant(self) -> bool:
        """True if the difference exceeds the error of both."""
        return abs(self.value) > self.error


@dataclass(frozen=True)
class Difference:
    """A number of two maps over their common box: means, and the largest rise and fall from one to the other.

    error: mean of the possible error of both, by interpolation (the largest measured errors of either map) and by
    the solvers' own balances; above, below: share of the points where the other exceeds the one, or falls below
    it, by more than that error. SI.
    """

    words: str
    unit: str
    one: float
    other: float
    rise: Extreme
    fall: Extreme
    error: float
    above: float
    below: float

    @property
    def largest(self) -> Extreme:
        """The larger of rise and fall."""
        return max(self.rise, self.fall, key=lambda extreme: abs(extreme.value))

    @property
    def significant(self) -> bool:
        """True if the maps differ at some point by more than the error of both."""
        return self.above > 0.0 or self.below > 0.0


@dataclass(frozen=True)
class MapComparison:
    """Two maps at the same levels, and their differences; specific: those free of size, of pumps of two sizes."""

    one: MapData
    other: MapData
    differences: tuple[Difference, ...]
    specific: tuple[Difference, ...]


def compare(one: MapData, other: MapData, errors: tuple[MapError | None, MapError | None]) -> MapComparison:
    """Both maps at common levels: their own where these are the same, else those of the first within both boxes.

    Raises InputFaults for maps that are not whole or have no box in common.
    """
    axes = common_axes(one.axes, other.axes)
    exact = axes == one.axes == other.axes
    here, there = (at_levels(MapInterpolant(data), axes) for data in (one, other))
    known = [] if exact else [error for error in errors if error is not None]
    rows = specific_numbers(here, there, known) if of_two_sizes(here, there) else ()
    specific = tuple(_difference(words, unit, here, *pair, error) for words, unit, pair, error in rows)
    return MapComparison(here, there, tuple(_differences(here, there, known)), specific)


def common_axes(one: Sequence[MapAxis], other: Sequence[MapAxis]) -> tuple[MapAxis, ...]:
    """Levels of the first within both boxes, and the ends of these; raises InputFaults where boxes lie apart."""
    found, faults = [], []
    for mine, theirs in zip(one, other, strict=True):
        lower, upper = max(mine.values[0], theirs.values[0]), min(mine.values[-1], theirs.values[-1])
        given = mine.input
        if lower > upper and not (inside(mine, np.array([lower]))[0] and inside(theirs, np.array([lower]))[0]):
            box, own = (_range(axis) for axis in (theirs, mine))
            remedy = "maps of both over the same levels, or a pump in place of one map"
            faults.append(Fault(given.words, f"{box} in the second map", f"some of {own}, the first map's", remedy))
            continue
        levels = {lower, max(lower, upper)} | {value for value in mine.values if lower < value < upper}
        found.append(MapAxis(given, tuple(sorted(levels))))
    if faults:
        raise InputFaults("both maps", faults)
    return tuple(found)


def _range(axis: MapAxis) -> str:
    ends = dict.fromkeys(axis.input.text(value) for value in (axis.values[0], axis.values[-1]))
    return " .. ".join(ends)


def at_levels(interpolant: MapInterpolant, axes: tuple[MapAxis, ...]) -> MapData:
    """A map at other levels inside its box; it keeps no warnings."""
    shape = tuple(len(axis.values) for axis in axes)
    grid = np.meshgrid(*(axis.values for axis in axes), indexing="ij")
    interpolated = interpolant.at({axis.input: level.ravel() for axis, level in zip(axes, grid, strict=True)})
    count = int(np.prod(shape))
    return replace(
        interpolant.data,
        axes=axes,
        values={name: np.reshape(values, shape) for name, values in interpolated.items()},
        status=objects([PartStatus.SOLVED.value] * count, shape),
        reason=objects([""] * count, shape),
        warnings=objects([()] * count, shape),
    )


def _differences(one: MapData, other: MapData, errors: list[MapError]) -> Iterator[Difference]:
    both = (one, other)
    balance = sum(np.abs(data.values["energy_balance_error"]) for data in both)
    least = np.minimum(*(data.values["shaft_power"] for data in both))
    power = np.where(least > 0.0, least, np.nan)  # elsewhere no efficiency, which has no error
    for definition in EfficiencyDefinition:
        pair = one.efficiency(definition).overall, other.efficiency(definition).overall
        if all(np.isfinite(values).any() for values in pair):
            between = sum(error.largest["shaft_power"] + error.largest["hydraulic_power"] for error in errors)
            words = f"overall efficiency, {definition.label}"
            yield _difference(words, "1", one, *pair, balance + between / power)
    for column, (words, unit) in COMPARED.items():
        pair = one.values[column], other.values[column]
        if any(np.any(values) for values in pair):
            between = sum(error.largest[column] for error in errors)
            yield _difference(words, unit, one, *pair, between + _own_error(both, unit))


def _own_error(both: tuple[MapData, MapData], unit: str) -> Array:
    """Error of a number at every point by the solvers' balances: of the shaft power, or of the flow."""
    found = [
        np.abs(data.values["mass_balance_error"]) * data.values["delivery_flow"]
        if unit == "m3/s"
        else np.abs(data.values["energy_balance_error"]) * data.values["shaft_power"]
        for data in both
    ]
    return np.asarray(sum(found) / (both[0].grid[MapInput.SPEED] if unit == "N m" else 1.0))


def _difference(words: str, unit: str, data: MapData, one: Array, other: Array, error: Array) -> Difference:
    off = other - one

    def extreme(flat: int) -> Extreme:
        index = np.unravel_index(flat, off.shape)
        at = {given: float(values[index]) for given, values in data.grid.items()}
        return Extreme(float(off[index]), at, float(error[index]))

    return Difference(
        words, unit, float(np.nanmean(one)), float(np.nanmean(other)), extreme(int(np.nanargmax(off))),
        extreme(int(np.nanargmin(off))), float(np.nanmean(error)), float(np.mean(off > error)),
        float(np.mean(off < -error)),
    )  # fmt: skip
