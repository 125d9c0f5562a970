"""The four axes of a bench map: speed, delivery pressure, displacement ratio, case temperature."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import Recording
from diagnosis.recording.units import channel_unit
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.inputs.units import in_unit

AXES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.T_CASE)
LEAST_SPAN = 0.05  # of the largest value: set points that scatter by less are one
LEAST_WARMING = 3.0  # K, the same for temperatures


def axis_values(recording: Recording) -> Mapping[ChannelName, Array]:
    """The axes along which the recording varies, each (N,) in SI."""
    order = list(ChannelName)
    columns = {axis: recording.steady.values[:, order.index(axis)] for axis in AXES}
    return {axis: values for axis, values in columns.items() if _moves(axis, values)}


def scaled_axes(recording: Recording) -> Array:
    """(N, 4), each axis scaled to [-1, 1], speed by its logarithm; 0 for a constant axis."""
    moving = axis_values(recording)
    scaled = np.zeros((len(recording.steady.values), len(AXES)))
    for at, axis in enumerate(AXES):
        if axis in moving:
            scaled[:, at] = on_axis(axis, moving[axis])
    return scaled


def on_axis(axis: ChannelName, values: Array) -> Array:
    """Values (N,) of an input that moves, scaled to [-1, 1], speed by its logarithm."""
    along = np.log(values) if axis is ChannelName.SPEED else values
    return np.asarray(2.0 * (along - along.min()) / np.ptp(along) - 1.0)


def smooth_shapes(axes: Array) -> Array:
    """(N, 15): 1, the four axes, their squares and products: any smooth law of the map to second order."""
    count = axes.shape[1]
    products = [axes[:, one] * axes[:, two] for one in range(count) for two in range(one, count)]
    return np.stack([np.ones(len(axes)), *axes.T, *products], axis=1)


def bound_text(axis: ChannelName, lower: float | None, upper: float | None) -> str:
    """Words for a part of an axis: "p_out above 250 bar", "speed 500 to 1000 rpm"."""
    match lower, upper:
        case float(), float():
            return f"{axis.value} {_number(axis, lower)} to {_number(axis, upper)} {_unit(axis)}".rstrip()
        case float(), None:
            return f"{axis.value} above {_number(axis, lower)} {_unit(axis)}".rstrip()
        case None, float():
            return f"{axis.value} below {_number(axis, upper)} {_unit(axis)}".rstrip()
        case _:
            return f"all {axis.value}"


def inside(
    axes: Mapping[ChannelName, Array], lower: Mapping[str, float], upper: Mapping[str, float]
) -> NDArray[np.bool_]:
    """(N,), true for points within bounds by axis name; the lower bound belongs to the part."""
    within = np.ones(len(next(iter(axes.values()))), dtype=bool)
    for axis, values in axes.items():
        within &= (values >= lower.get(axis.value, -np.inf)) & (values < upper.get(axis.value, np.inf))
    return within


def _moves(axis: ChannelName, values: Array) -> bool:
    """True if an axis moves by more than the scatter of one set point, and is known at all points."""
    if not np.all(np.isfinite(values)):
        return False
    least = LEAST_WARMING if axis is ChannelName.T_CASE else LEAST_SPAN * float(np.abs(values).max())
    return bool(np.ptp(values) > least)


def _unit(axis: ChannelName) -> str:
    return "" if axis.dimension is None else channel_unit(axis)


def _number(axis: ChannelName, value: float) -> str:
    shown = value if axis.dimension is None else float(in_unit(value, _unit(axis), axis.dimension))
    return f"{shown:.3g}" if abs(shown) < 1000 else f"{shown:.0f}"
