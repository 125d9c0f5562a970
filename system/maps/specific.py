"""Numbers of two maps free of the size of their pumps: shares of the shaft power, torque and flow over displacement."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from system.maps.data import LOSSES, MapData
from system.maps.interpolation import MapError

SAME_SIZE = 5e-3
"""Ratio of two displacements less 1 within which pumps are of one size."""
OF_POWER = "share of the shaft power"
_OVER_DISPLACEMENT = {
    "shaft_torque": ("shaft torque over displacement", "N m/(m3/rev)"),
    "delivery_flow": ("delivery flow over displacement", "rev/s"),
    "drain_flow": ("case flow over displacement", "rev/s"),
}

Specific = tuple[str, str, tuple[Array, Array], Array]
"""Words, unit, the numbers of both maps at every point, and the possible error of both there."""


def of_two_sizes(one: MapData, other: MapData) -> bool:
    """True where the pumps of two maps at the same levels differ in displacement."""
    mine, theirs = (data.values["geometric_displacement"] for data in (one, other))
    return bool(np.nanmax(np.abs(theirs / mine - 1.0)) > SAME_SIZE)


def specific_numbers(one: MapData, other: MapData, errors: Sequence[MapError]) -> Iterator[Specific]:
    """Yield the specific numbers of two maps at the same levels; errors: of either map between its levels.

    A share is void where a shaft takes no power.
    """
    both = (one, other)
    balance = np.asarray(sum(np.abs(data.values["energy_balance_error"]) for data in both))
    powers = [np.where(data.values["shaft_power"] > 0.0, data.values["shaft_power"], np.nan) for data in both]
    volumes = [data.values["geometric_displacement"] for data in both]
    between = sum(error.largest["shaft_power"] + error.largest["hydraulic_power"] for error in errors)
    off = balance + between / np.minimum(*powers)
    yield f"total loss, {OF_POWER}", "1", _over([one.loss, other.loss], powers), off
    for column, words in LOSSES.items():
        pair = [data.values[column] for data in both]
        if any(np.any(values) for values in pair):
            off = balance + sum(error.largest[column] for error in errors) / np.minimum(*powers)
            yield f"{words}, {OF_POWER}", "1", _over(pair, powers), off
    for column, (words, unit) in _OVER_DISPLACEMENT.items():
        pair = [data.values[column] for data in both]
        off = (
            sum(error.largest[column] for error in errors) / np.minimum(*volumes)
            + balance * np.abs(pair[0]) / volumes[0]
        )
        yield words, unit, _over(pair, volumes), np.asarray(off)


def _over(pair: Sequence[Array], sizes: Sequence[Array]) -> tuple[Array, Array]:
    return np.asarray(pair[0] / sizes[0]), np.asarray(pair[1] / sizes[1])
