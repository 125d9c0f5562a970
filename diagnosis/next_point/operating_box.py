"""The box of operating points that the rig of a recording can run, and points in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import nan

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import Circuit, Recording
from diagnosis.study.inputs import WARMER, bench_points, measured
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.inputs.channels import INPUTS, ChannelName

BEYOND = 0.1  # of a range as recorded, beyond each of its ends
SLOW, UNLOADED, SWIVELLED = 0.25, 0.1, 0.2  # of rated speed, rise of pressure, displacement: least on a bench
COLD, HOT = 303.15, 353.15  # K: inlet temperatures that a bench with heater and cooler holds
CHARGED = (0.6, 1.2)  # of the charge pressure of a closed circuit: its relief valve is set within it
VARIED = 0.05  # of the greatest displacement ratio: the swash angle of such a pump is variable


@dataclass(frozen=True)
class BenchBox:
    """Ends of speed, delivery pressure, displacement ratio, case temperature, SI; other inputs are held.

    A fifth pair of ends, if any, is that of the inlet pressure.

    inlet_pressure, case_pressure in Pa gauge; warmer: case over inlet temperature in K; last: order and hours of
    the recording's end.
    """

    ends: tuple[tuple[float, float], ...]
    inlet_pressure: float
    case_pressure: float
    warmer: float
    last: tuple[float, float]

    def points(self, levels: Sequence[Array]) -> BenchPoints:
        """Every combination of levels of the axes, measured after the recording's last point."""
        speed, pressure, ratio, temperature, *inlet = (axis.ravel() for axis in np.meshgrid(*levels, indexing="ij"))
        order, hours = self.last
        return BenchPoints(
            speed=speed,
            displacement_ratio=ratio,
            p_out=pressure,
            p_in=inlet[0] if inlet else np.full(speed.size, self.inlet_pressure),
            p_case=np.full(speed.size, self.case_pressure),
            T_case=temperature,
            T_in=temperature - self.warmer,
            hours=np.full(speed.size, hours),
            order=np.full(speed.size, order),
            warming=np.zeros(speed.size),
        )


def rows(points: BenchPoints, chosen: NDArray[np.int64]) -> BenchPoints:
    """Some of the points."""
    return replace(points, **{name: values[chosen] for name, values in vars(points).items()})


def rig_box(recording: Recording, pump: PumpDescription) -> BenchBox:
    """The ranges of a recording and a tenth beyond each end, within the pump's rating and its full displacement.

    Delivery pressure is relative to the inlet's. Inputs that were not measured are assumed as in a simulation of
    the recording (`diagnosis.study.inputs.bench_points`); other pressures and the difference of case and inlet
    temperature stay at their median.
    """
    points, _ = bench_points(recording, pump)
    rated, inlet = pump.pump, float(np.median(points.p_in))
    least, most = _ends(points.p_out - inlet, rated.rated_pressure - inlet)
    return BenchBox(
        ends=(
            _ends(points.speed, rated.rated_speed),
            (inlet + least, inlet + most),
            _ends(points.displacement_ratio, 1.0),
            _ends(points.T_case, np.inf),
        ),
        inlet_pressure=inlet,
        case_pressure=float(np.median(points.p_case)),
        warmer=float(np.median(points.T_case - points.T_in)),
        last=(float(points.order.max()) + 1.0, float(points.hours.max())),
    )


def ordinary_box(recording: Recording, pump: PumpDescription) -> BenchBox:
    """The box of `rig_box`, widened to the range of an ordinary bench along each measured axis.

    From a quarter of the rated speed and a tenth of the rated rise of pressure to both, displacement from a fifth to
    full for a pump with variable swash angle, the inlet at 30 to 80 degC; the charge pressure of a closed circuit,
    where it was measured, from 0.6 to 1.2 of its median.
    """
    box = rig_box(recording, pump)
    known = set(measured(recording, INPUTS))
    least_ratio, most_ratio = box.ends[2]
    swivels = most_ratio - least_ratio > VARIED * most_ratio
    speed, pressure, ratio, temperature = _ordinary_ends(pump, box.inlet_pressure, box.warmer)
    wide = speed, pressure, ratio if swivels else box.ends[2], temperature
    axes = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.T_CASE)
    ends = tuple(
        (min(own[0], more[0]), max(own[1], more[1])) if axis in known else own
        for axis, own, more in zip(axes, box.ends, wide, strict=True)
    )
    if recording.circuit is Circuit.CLOSED and ChannelName.P_IN in known and box.inlet_pressure > 0.0:
        ends = (*ends, (CHARGED[0] * box.inlet_pressure, CHARGED[1] * box.inlet_pressure))
    return replace(box, ends=ends)


def pump_box(pump: PumpDescription) -> BenchBox:
    """The range of an ordinary bench for a pump without a recording: other inputs as at the pump's own point."""
    stated = pump.operating
    ends = _ordinary_ends(pump, stated.inlet_pressure, WARMER)
    return BenchBox(ends, stated.inlet_pressure, stated.case_pressure, WARMER, (0.0, nan))


def _ordinary_ends(pump: PumpDescription, inlet: float, warmer: float) -> tuple[tuple[float, float], ...]:
    rated = pump.pump
    return (
        (SLOW * rated.rated_speed, rated.rated_speed),
        (inlet + UNLOADED * (rated.rated_pressure - inlet), rated.rated_pressure),
        (SWIVELLED, 1.0),
        (COLD + warmer, HOT + warmer),
    )


def _ends(values: Array, rating: float) -> tuple[float, float]:
    """A widened range: not beyond the rating unless the recording is, not below half its least."""
    lower, upper = float(values.min()), float(values.max())
    more = BEYOND * (upper - lower)
    return max(lower - more, 0.5 * lower), min(upper + more, max(rating, upper))
