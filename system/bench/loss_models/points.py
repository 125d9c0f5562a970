"""Variables of loss models: speed, pressure difference, displacement ratio and the oil, scaled by the pump."""

from dataclasses import dataclass

import numpy as np

from reynolds.laws.oil import walther
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.inputs.units import TURN
from system.pump.lumped import full_drive, swept_displacement


@dataclass(frozen=True)
class LossPoints:
    """N points in SI: speed in rad/s, pressure_difference in Pa, ratio to full displacement, viscosity in Pa s.

    displacement: m3 per revolution at ratio 1; density in kg/m3 and bulk_modulus in Pa of the oil; with rated_speed and
    rated_pressure the arguments of polynomials are near one.
    """

    speed: Array
    pressure_difference: Array
    ratio: Array
    viscosity: Array
    displacement: float
    density: float
    bulk_modulus: float
    rated_speed: float
    rated_pressure: float

    @property
    def per_radian(self) -> float:
        """Full displacement in m3/rad: D = V/(2 pi)."""
        return self.displacement / TURN

    @property
    def ideal_flow(self) -> Array:
        """eps D w in m3/s."""
        return self.ratio * self.per_radian * self.speed

    @property
    def ideal_torque(self) -> Array:
        """eps D dp in N m."""
        return self.ratio * self.per_radian * self.pressure_difference

    @property
    def scaled(self) -> tuple[Array, Array, Array]:
        """w/w_rated, dp/p_rated and eps."""
        return self.speed / self.rated_speed, self.pressure_difference / self.rated_pressure, self.ratio


def loss_points(pump: PumpDescription, points: BenchPoints) -> LossPoints:
    """The points of a bench as inputs of loss models: V swept by the pump's geometry, viscosity at the case."""
    return LossPoints(
        speed=points.speed,
        pressure_difference=points.p_out - points.p_in,
        ratio=points.displacement_ratio,
        viscosity=np.asarray(walther(points.T_case, pump.oil.fluid) * pump.oil.density),
        displacement=swept_displacement(pump, full_drive(pump)),
        density=pump.oil.density,
        bulk_modulus=pump.oil.bulk_modulus,
        rated_speed=pump.pump.rated_speed,
        rated_pressure=pump.pump.rated_pressure,
    )
