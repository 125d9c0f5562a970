"""A hydrostatic transmission: a pump drives a motor round a closed circuit, both in the lumped fidelity."""

from dataclasses import dataclass, replace

from system.description.pump import PumpDescription
from system.points.lumped import lumped_point
from system.pump.assembly import PumpPoint
from system.pump.operating import OperatingPoint

SPEED_RATIOS = (0.05, 2.0)
"""Interval of motor over pump speed, of that by displacements, in which the motor is sought."""
SPEED_TOLERANCE = 1e-9
"""Of that ratio."""


@dataclass(frozen=True)
class Transmission:
    """Both machines at their common operating speeds.

    The motor is a pump that turns the same way with the high pressure at its suction port: its powers count into it, so
    its shaft power is negative where it drives a load, and its efficiencies as a pump are not defined (`no_delivery`).
    A positive one is what its load must give for that speed: the pressure difference is less than its friction takes.
    """

    pump: PumpPoint
    motor: PumpPoint

    @property
    def speed_ratio(self) -> float:
        """Motor speed over pump speed."""
        return self.motor.point.shaft_speed / self.pump.point.shaft_speed

    @property
    def volumetric_efficiency(self) -> float:
        """Speed ratio over that of the geometric displacements: 1 without leakage and compression."""
        return self.speed_ratio * self.motor.geometric_displacement / self.pump.geometric_displacement


def transmission(pump: PumpDescription, motor: PumpDescription, point: OperatingPoint) -> Transmission:
    """The transmission at the pump's operating point, whose `inlet_pressure` is that of the low-pressure line.

    The motor receives the pump's delivery at full displacement, with the same temperature and case pressure; without
    losses between them. Flows of a line-to-line relief valve, a flushing valve or the control are not included: the
    flushing valve and the charge pump are at the low pressure. Raises ValueError where the pump does not deliver a flow
    to turn the motor, NotConverged as `lumped_point`.
    """
    from scipy.optimize import brentq

    driving = lumped_point(pump, point)
    turned = replace(
        point, delivery_pressure=point.inlet_pressure, inlet_pressure=point.delivery_pressure, displacement_ratio=1.0
    )

    def motor_at(speed: float) -> PumpPoint:
        return lumped_point(motor, replace(turned, shaft_speed=speed))

    def surplus(speed: float) -> float:
        return driving.bench.delivery_flow - motor_at(speed).bench.inlet_flow

    reference = point.shaft_speed * driving.geometric_displacement
    reference /= motor_at(point.shaft_speed).geometric_displacement
    slow, fast = (ratio * reference for ratio in SPEED_RATIOS)
    if surplus(slow) <= 0.0:
        raise ValueError(
            f"transmission: the pump delivers {driving.bench.delivery_flow * 6e4:.4g} L/min, less than the motor "
            f"loses at {SPEED_RATIOS[0]:g} of its speed; expected a pump that turns it"
        )
    speed = brentq(surplus, slow, fast, xtol=SPEED_TOLERANCE * reference)
    return Transmission(driving, motor_at(float(speed)))
