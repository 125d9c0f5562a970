"""The box of operating points that the rig of a recording can be asked for, and points in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.readings import bench_points
from diagnosis.recording import Recording
from system.bench_points import BenchPoints
from system.description import PumpDescription
from system.kinematics import Array

BEYOND = 0.1  # of a range as recorded, beyond each of its ends


@dataclass(frozen=True)
class BenchBox:
    """Ends of speed, delivery pressure, displacement ratio, case temperature, SI; all else is held.

    inlet_pressure, case_pressure in Pa gauge; warmer: case over inlet temperature in K; last: order and hours of
    the recording's end.
    """

    ends: tuple[tuple[float, float], ...]
    inlet_pressure: float
    case_pressure: float
    warmer: float
    last: tuple[float, float]

    def points(self, levels: Sequence[Array]) -> BenchPoints:
        """Every combination of levels of the four axes, taken after the recording's last point."""
        speed, pressure, ratio, temperature = (axis.ravel() for axis in np.meshgrid(*levels, indexing="ij"))
        order, hours = self.last
        return BenchPoints(
            speed=speed,
            displacement_ratio=ratio,
            p_out=pressure,
            p_in=np.full(speed.size, self.inlet_pressure),
            p_case=np.full(speed.size, self.case_pressure),
            T_case=temperature,
            T_in=temperature - self.warmer,
            hours=np.full(speed.size, hours),
            order=np.full(speed.size, order),
        )


def rows(points: BenchPoints, chosen: NDArray[np.int64]) -> BenchPoints:
    """Some of the points."""
    return replace(points, **{name: values[chosen] for name, values in vars(points).items()})


def rig_box(recording: Recording, pump: PumpDescription) -> BenchBox:
    """The ranges of a recording and a tenth beyond each end, within the pump's rating and its full displacement.

    What was not measured is as a simulation of the recording takes it (`diagnosis.readings.bench_points`); other
    pressures and the difference of case and inlet temperature stay at their median.
    """
    points, _ = bench_points(recording, pump)
    rated = pump.pump
    return BenchBox(
        ends=(
            _ends(points.speed, rated.rated_speed),
            _ends(points.p_out, rated.rated_pressure),
            _ends(points.displacement_ratio, 1.0),
            _ends(points.T_case, np.inf),
        ),
        inlet_pressure=float(np.median(points.p_in)),
        case_pressure=float(np.median(points.p_case)),
        warmer=float(np.median(points.T_case - points.T_in)),
        last=(float(points.order.max()) + 1.0, float(points.hours.max())),
    )


def _ends(values: Array, rating: float) -> tuple[float, float]:
    """A range widened: not beyond the rating unless the recording went there itself, not below half its least."""
    lower, upper = float(values.min()), float(values.max())
    more = BEYOND * (upper - lower)
    return max(lower - more, 0.5 * lower), min(upper + more, max(rating, upper))
