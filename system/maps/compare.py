"""Comparison of two maps: over their common box, number by number, with the possible error of interpolation."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, InputFaults
from system.maps.data import LOSSES, MapData, objects
from system.maps.interpolation import MapError, MapInterpolant, inside
from system.maps.plan import MapAxis, MapInput
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
class Difference:
    """A number of two maps over their common box: means, the largest difference (other less one) and its place.

    error: possible error of both interpolations there, by the largest measured errors of either map. SI.
    """

    words: str
    unit: str
    one: float
    other: float
    largest: float
    at: Mapping[MapInput, float]
    error: float

    @property
    def significant(self) -> bool:
        """True if the largest difference exceeds the possible error of interpolation."""
        return abs(self.largest) > self.error


@dataclass(frozen=True)
class MapComparison:
    """Two maps at the same levels, and their differences."""

    one: MapData
    other: MapData
    differences: tuple[Difference, ...]


def compare(one: MapData, other: MapData, errors: tuple[MapError | None, MapError | None]) -> MapComparison:
    """Both maps at common levels: their own where these are the same, else those of the first within both boxes.

    Raises InputFaults for maps that are not whole or have no box in common.
    """
    axes = common_axes(one, other)
    exact = axes == one.axes == other.axes
    here, there = (at_levels(MapInterpolant(data), axes) for data in (one, other))
    known = [] if exact else [error for error in errors if error is not None]
    return MapComparison(here, there, tuple(_differences(here, there, known)))


def common_axes(one: MapData, other: MapData) -> tuple[MapAxis, ...]:
    """Levels of the first within both boxes, and the ends of these; raises InputFaults where boxes lie apart."""
    found, faults = [], []
    for mine, theirs in zip(one.axes, other.axes, strict=True):
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
        raise InputFaults(f"{one.name} and {other.name}", faults)
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
    for definition in EfficiencyDefinition:
        pair = one.efficiency(definition).overall, other.efficiency(definition).overall
        if all(np.isfinite(values).any() for values in pair):
            difference = _difference(f"overall efficiency, {definition.label}", "1", one, *pair, 0.0)
            yield replace(difference, error=sum(_efficiency_error(one, other, difference, each) for each in errors))
    for column, (words, unit) in COMPARED.items():
        pair = one.values[column], other.values[column]
        if any(np.any(values) for values in pair):
            yield _difference(words, unit, one, *pair, sum(error.largest[column] for error in errors))


def _difference(words: str, unit: str, data: MapData, one: Array, other: Array, error: float) -> Difference:
    off = other - one
    index = np.unravel_index(int(np.nanargmax(np.abs(off))), off.shape)
    at = {given: float(values[index]) for given, values in data.grid.items()}
    return Difference(words, unit, float(np.nanmean(one)), float(np.nanmean(other)), float(off[index]), at, error)


def _efficiency_error(one: MapData, other: MapData, difference: Difference, error: MapError) -> float:
    """Error of an efficiency P_h/P from the errors of both powers: dP_h/P + dP/P, with the lesser P."""
    at = tuple(list(axis.values).index(difference.at[axis.input]) for axis in one.axes)
    power = min(float(data.values["shaft_power"][at]) for data in (one, other))
    return (error.largest["shaft_power"] + error.largest["hydraulic_power"]) / power
