"""One displacement chamber at an operating point: geometry, oil, ports, leaking gaps."""

from dataclasses import dataclass, field
from typing import Generic

import numpy as np
from numba.extending import register_jitable

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import Number, SwashDrive
from system.pump.ports.areas import PortOpening


@register_jitable
def pressure_span(delivery_pressure: Number, inlet_pressure: Number) -> Number:
    """Pressure difference of the ports and 1 bar, Pa: a size that stays above zero."""
    return abs(delivery_pressure - inlet_pressure) + 1e5


@dataclass(frozen=True)
class LeakTable:
    """Leakage of the piston, slipper and valve-plate gap of one chamber (rows 0, 1, 2) over one turn: (3, N).

    Of P operating points at once: (P, 3, N).

    Columns: N equidistant shaft angles 2 pi j/N from 0; conductance in m3/(s Pa), all >= 0, drag_flow in m3/s, both for
    flow out of the chamber. Between the columns runs a periodic cubic spline: with two continuous derivatives it keeps
    the integrator's order, and steps need not end on the table's angles; a linear one would have a kink at each of
    them. Raises ValueError for a wrong shape or a negative conductance.
    """

    conductance: Array
    drag_flow: Array

    def __post_init__(self) -> None:
        shape = self.conductance.shape
        if len(shape) not in (2, 3) or shape[-2] != 3 or shape[-1] < 4 or self.drag_flow.shape != shape:
            raise ValueError(
                f"leak table: found shapes {shape} and {self.drag_flow.shape}, expected (3, N) with N >= 4"
            )
        if np.any(self.conductance < 0.0):
            raise ValueError(
                f"leak table: found conductance {self.conductance.min():.3g} m3/(s Pa), expected 0 or more"
            )


@dataclass(frozen=True)
class PortPressure:
    """Pressures behind delivery and suction port over one turn, (N,) Pa each at N equidistant shaft angles from 0.

    Between them runs a periodic cubic spline. Raises ValueError for other shapes or fewer than 4 angles.
    """

    delivery: Array
    suction: Array

    def __post_init__(self) -> None:
        shapes = self.delivery.shape, self.suction.shape
        if len(shapes[0]) != 1 or shapes[0][0] < 4 or shapes[1] != shapes[0]:
            raise ValueError(f"port pressures: found shapes {shapes[0]} and {shapes[1]}, expected (N,), N >= 4")


@dataclass(frozen=True)
class Chamber(Generic[Number]):
    """One chamber at one operating point without ports and gaps: SI units, pressures gauge, oil constant.

    delivery_pressure and inlet_pressure are the ports' means over the turn. Bubbles in the oil: their volume at one
    atmosphere over the oil's, free_air, goes with the absolute pressure to the power -air_exponent. Chamber[Array]: at
    N operating points, arrays (N,).
    """

    drive: SwashDrive[Number]
    shaft_speed: Number
    piston_area: float
    dead_volume: Number
    delivery_pressure: Number
    inlet_pressure: Number
    case_pressure: Number
    bulk_modulus: float
    density: float
    kinematic_viscosity: Number
    flow_coefficient: float
    critical_reynolds: float
    free_air: Number | float = field(default=0.0, kw_only=True)
    air_exponent: Number | float = field(default=1.0, kw_only=True)

    @property
    def pressure_span(self) -> Number:
        """Reference size of pressures, Pa."""
        return pressure_span(self.delivery_pressure, self.inlet_pressure)


@dataclass(frozen=True)
class ChamberProblem(Chamber):
    """One chamber at one operating point with its ports and its leaking gaps.

    Without `port_pressure` the ports' pressures are held at their means. growth (N,) m3 at N equidistant shaft angles
    from 0: growth of the volume by the parts' own small motion.
    """

    delivery_port: PortOpening
    suction_port: PortOpening
    leaks: LeakTable
    port_pressure: PortPressure | None = None
    growth: Array | None = None
