"""Columns of a table as channels: by their heads, else by their sizes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.guess.heads import Head, Place, Quantity, read_head
from diagnosis.recording.tables.table import TableColumns
from diagnosis.recording.units import OTHER_UNITS, channel_unit
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.inputs.units import LPM, RPM, Dimension, unit_scale

_PLACED: Mapping[Quantity, Mapping[Place, ChannelName]] = {
    Quantity.PRESSURE: {Place.OUT: ChannelName.P_OUT, Place.IN: ChannelName.P_IN, Place.CASE: ChannelName.P_CASE},
    Quantity.FLOW: {Place.OUT: ChannelName.Q_OUT, Place.IN: ChannelName.Q_IN, Place.CASE: ChannelName.Q_CASE},
    Quantity.TEMPERATURE: {Place.OUT: ChannelName.T_OUT, Place.IN: ChannelName.T_IN, Place.CASE: ChannelName.T_CASE},
}
_SINGLE = {
    Quantity.SPEED: ChannelName.SPEED,
    Quantity.TORQUE: ChannelName.TORQUE,
    Quantity.RATIO: ChannelName.DISPLACEMENT_RATIO,
}
_BY_SIZE: Mapping[Quantity, tuple[ChannelName, ...]] = {
    Quantity.PRESSURE: (ChannelName.P_OUT, ChannelName.P_IN),
    Quantity.FLOW: (ChannelName.Q_OUT,),
    Quantity.TEMPERATURE: (ChannelName.T_IN,),
}
"""Channels assigned to columns without a place, the largest first."""
_USUAL = {Dimension.PRESSURE: 30e6, Dimension.ANGULAR_SPEED: 2000 * RPM, Dimension.VOLUME_FLOW: 150 / LPM}
"""Largest reading of a usual bench, SI: an unknown unit is assumed to be the one nearest to it."""
_WARMEST = 200.0  # degC: a larger number is in kelvin


@dataclass(frozen=True)
class GuessedChannel:
    """A channel with its column and unit; doubts: guesses beyond the content of the head, in words."""

    name: ChannelName
    column: str
    unit: str
    reference: PressureReference | None
    doubts: tuple[str, ...]


@dataclass(frozen=True)
class GuessedColumns:
    """Channels of a table, its column of time with its unit, if any, and the other columns; angles: of the swash plate,
    among the others.
    """

    channels: tuple[GuessedChannel, ...]
    time: tuple[str, str] | None
    others: tuple[str, ...]
    angles: tuple[str, ...] = ()


def guessed_columns(table: TableColumns) -> GuessedColumns:
    """Return the channels of a table's columns; each channel once, that of the first head with it."""
    heads = [read_head(name, table.units.get(name, "")) for name in table.values]
    time = next((head for head in heads if head.quantity is Quantity.TIME), None)
    taken: dict[ChannelName, tuple[Head, tuple[str, ...]]] = {}
    for head in heads:
        name = _told(head)
        if name is not None and name not in taken:
            taken[name] = (head, ())
    _by_size(heads, table.values, taken)
    used = {head.column for head, _ in taken.values()} | ({time.column} if time else set())
    channels = _with_units(taken, table.values)
    others = tuple(name for name in table.values if name not in used)
    angles = tuple(head.column for head in heads if _is_angle(head))
    return GuessedColumns(channels, None if time is None else (time.column, _time_unit(time)), others, angles)


def _told(head: Head) -> ChannelName | None:
    """Return the channel that the words of a head name."""
    if head.quantity is None:
        return None
    if head.quantity is Quantity.POWER:
        return ChannelName.ELECTRIC_POWER if head.electric else None
    if _is_angle(head):
        return None
    if head.quantity in _SINGLE:
        return _SINGLE[head.quantity]
    return _PLACED[head.quantity].get(head.place) if head.quantity in _PLACED and head.place else None


def _is_angle(head: Head) -> bool:
    """True for an angle or a volume of the stroke, whose share of full stroke its size does not tell."""
    return head.quantity is Quantity.RATIO and bool(head.unknown)


def _by_size(
    heads: Iterable[Head], values: Mapping[str, Array], taken: dict[ChannelName, tuple[Head, tuple[str, ...]]]
) -> None:
    """Assign columns with a quantity but no place to the remaining channels, the largest first."""
    for quantity, names in _BY_SIZE.items():
        bare = [head for head in heads if head.quantity is quantity and head.place is None]
        bare.sort(key=lambda head: -_largest(values[head.column]))
        free = [name for name in names if name not in taken]
        for name, head in zip(free, bare, strict=False):
            taken[name] = (head, ("place, by its size",))


def _with_units(
    taken: Mapping[ChannelName, tuple[Head, tuple[str, ...]]], values: Mapping[str, Array]
) -> tuple[GuessedChannel, ...]:
    """Return the channels in their usual order, with their units."""
    channels: list[GuessedChannel] = []
    for name in ChannelName:
        if name not in taken:
            continue
        head, doubts = taken[name]
        unit = head.unit.unit if head.unit else _unit(name, values[head.column], channels)
        if not head.unit:
            doubts = (
                *doubts,
                f"unit, by its size{f': {head.unknown!r} is none that is known' if head.unknown else ''}",
            )
        channels.append(GuessedChannel(name, head.column, unit, head.reference, doubts))
    return tuple(channels)


def _unit(name: ChannelName, readings: Array, before: Iterable[GuessedChannel]) -> str:
    """Return the unit of a channel whose head has none: that of a channel of its kind, else by size."""
    dimension, largest = name.dimension, _largest(readings)
    if dimension is None:
        return "%" if largest > 2.0 else "1"
    alike = next((one.unit for one in before if one.name.dimension is dimension), "")
    if alike:
        return alike
    if dimension is Dimension.TEMPERATURE:
        return "K" if largest > _WARMEST else "degC"
    usual = _USUAL.get(dimension)
    if usual is None or largest <= 0.0:
        return channel_unit(name)

    def away(unit: str) -> float:
        return abs(math.log(largest * unit_scale(unit, dimension)[0] / usual))

    return min(OTHER_UNITS[dimension], key=away)


def _time_unit(head: Head) -> str:
    return head.unit.unit if head.unit else "s"


def _largest(readings: Array) -> float:
    """Return the largest reading, 0 without readings."""
    known = np.abs(readings[np.isfinite(readings)])
    return float(known.max()) if len(known) else 0.0
