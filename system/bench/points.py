"""The steady points of a test bench, as arrays: inputs of a simulator of a whole map."""

from dataclasses import dataclass

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.pump.operating import OperatingPoint, operating_point


@dataclass(frozen=True)
class BenchPoints:
    """N steady points: speed in rad/s, pressures in Pa gauge, temperatures in K, hours run in h; arrays (N,).

    `order` is the place of a point in the sequence of measurement, from 0. `warming` in K/s: rate at which the reading
    of T_case rises, 0 at rest.
    """

    speed: Array
    displacement_ratio: Array
    p_out: Array
    p_in: Array
    p_case: Array
    T_case: Array
    T_in: Array
    hours: Array
    order: Array
    warming: Array


def operating_at(pump: PumpDescription, points: BenchPoints, at: int) -> OperatingPoint:
    """Point number `at` as a pump's operating point, its oil at the case's temperature; raises as `operating_point`."""
    return operating_point(
        pump,
        shaft_speed=float(points.speed[at]),
        delivery_pressure=float(points.p_out[at]),
        inlet_pressure=float(points.p_in[at]),
        case_pressure=float(points.p_case[at]),
        displacement_ratio=float(points.displacement_ratio[at]),
        temperature=float(points.T_case[at]),
    )
