"""The box of operating points of a recording, over which tables of a pump's films are built."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, floor

import numpy as np

from diagnosis.recording.model import Recording
from diagnosis.study.inputs import bench_points, complete
from diagnosis.study.map_axes import axis_values
from gaps.response import Axis
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.channels import ChannelName
from system.inputs.units import TURN
from system.points.table.build import Range, table_axes

MARGIN = 0.02
"""Of an end of the box: sensors' zeros and slopes by difference reach a little beyond the readings."""
WARMER = 2.0
"""K, the same for temperatures."""
STEPS = {
    ChannelName.SPEED: 100.0 * TURN / 60.0,
    ChannelName.P_OUT: 1e6,
    ChannelName.DISPLACEMENT_RATIO: 0.05,
    ChannelName.T_CASE: 5.0,
}
"""Steps, SI, to which ends are rounded outwards: recordings of one bench share their tables."""
HELD = {
    ChannelName.SPEED: ("shaft_speed", "speed", TURN / 6.0),
    ChannelName.P_OUT: ("delivery_pressure", "pressure", 1e5),
    ChannelName.DISPLACEMENT_RATIO: ("displacement_ratio", "displacement_ratio", 0.01),
    ChannelName.T_CASE: ("viscosity", "temperature", 1.0),
}
"""Of an input that the recording holds: the table's input, the key of [operating], the step of its value, SI."""
ZERO = 273.15


@dataclass(frozen=True)
class FilmBox:
    """The pump at the values of the inputs that a recording holds, and the axes of the inputs that it varies."""

    pump: PumpDescription
    axes: tuple[Axis, ...]


def film_box(pump: PumpDescription, recording: Recording) -> FilmBox:
    """The box around a recording's points; inlet and case pressure are the pump file's.

    Raises InputError for an empty box, as `table_axes`.
    """
    usable = complete(recording)
    moving, points = axis_values(usable), bench_points(usable, pump)[0]
    held = {name: own for name, own in HELD.items() if name not in moving}
    stated = {key: _rounded(name, getattr(points, name.value), step) for name, (_, key, step) in held.items()}
    at = replace(pump, operating=replace(pump.operating, **stated))
    ends = {name: _ends(name, values) for name, values in moving.items()}
    speeds, pressures, ratios, warmths = (ends.get(name) for name in HELD)
    return FilmBox(at, table_axes(at, speeds, pressures, ratios, warmths, [one for one, *_ in held.values()]))


def _rounded(name: ChannelName, values: Array, step: float) -> float:
    zero = ZERO if name is ChannelName.T_CASE else 0.0
    return zero + step * round((float(np.median(values)) - zero) / step)


def _ends(name: ChannelName, values: Array) -> Range:
    """Ends beyond all values; a displacement ratio is 1 at most."""
    step, zero = STEPS[name], ZERO if name is ChannelName.T_CASE else 0.0
    low, high = float(values.min()) - zero, float(values.max()) - zero
    if name is ChannelName.T_CASE:
        low, high = low - WARMER, high + WARMER
    else:
        low, high = low * (1.0 - MARGIN), high * (1.0 + MARGIN)
    ends = zero + step * floor(low / step), zero + step * ceil(high / step)
    return (max(ends[0], step), min(ends[1], 1.0)) if name is ChannelName.DISPLACEMENT_RATIO else ends
