"""Ports of the valve plate: opening area and orifice law, Eq. (20) of Xu, Hu, Zhang and Mao (2017) made regular.

Over the turn a port opens by its relief grooves (the paper has one, growing with the square of the angle), its
kidney opens linearly, stays open and closes linearly, and grooves behind it shut last; shut elsewhere. The
suction port counts its angles from the inner dead centre (shaft angle 0), the delivery port from the outer (pi).
"""

from dataclasses import dataclass

import numba
import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.units import TURN
from system.pump.ports.flow_coefficients import FLOW_SIZE, FlowTable
from system.pump.ports.relief_grooves import SIZE, ReliefGroove, throat_area
from system.pump.ports.webs import WEBS_SIZE, PortWebs, covered_share

SAME_ANGLE = 1e-9  # rad
MOST_GROOVES = 8
NUMBERS = 9
"""Of a port as compiled code reads it, before its grooves, webs and flow coefficients."""
WEBS_FROM = NUMBERS + MOST_GROOVES * SIZE
FLOW_FROM = WEBS_FROM + WEBS_SIZE
PORT_SIZE = FLOW_FROM + FLOW_SIZE
NO_WEBS = PortWebs()
PLAIN = FlowTable()


@dataclass(frozen=True)
class PortOpening:
    """One port: angles in rad from its own dead centre, in rising order, and the area of its kidney in m2.

    `dead_centre` is the shaft angle of that dead centre: 0 for suction, pi for delivery. Grooves that sink with
    the angle lie before `kidney_full_start`, those that rise after `kidney_full_end`. Raises ValueError for more
    than MOST_GROOVES.
    """

    dead_centre: float
    kidney_start: float
    kidney_full_start: float
    kidney_full_end: float
    kidney_end: float
    kidney_area: float
    grooves: tuple[ReliefGroove, ...] = ()
    webs: PortWebs = NO_WEBS
    coefficients: FlowTable = PLAIN

    def __post_init__(self) -> None:
        if len(self.grooves) > MOST_GROOVES:
            raise ValueError(f"port: found {len(self.grooves)} grooves, expected at most {MOST_GROOVES}")

    @property
    def opens(self) -> float:
        """Angle from the dead centre at which the port begins to open, rad."""
        return min([self.kidney_start, *(groove.begins for groove in self.grooves)])

    @property
    def shuts(self) -> float:
        """Angle from the dead centre at which the port is shut, rad."""
        return max([self.kidney_end, *(groove.begins for groove in self.grooves)])


@numba.njit("f8(f8,f8[:])", cache=True)
def _one_kidney(x, port):  # type: ignore[no-untyped-def]
    """Opening area of a port without webs, at an angle from its dead centre."""
    if port[2] <= x < port[3]:
        return port[5]
    opening = x < port[2]
    area = 0.0
    for n in range(int(port[7])):
        groove = port[NUMBERS + n * SIZE : NUMBERS + (n + 1) * SIZE]
        if (groove[0] < groove[1]) == opening:
            area += throat_area(x, groove)
    if opening:
        if x < port[1]:
            return area
        return area + (port[5] - area) * (x - port[1]) / (port[2] - port[1])
    if x < port[4]:
        return area + (port[5] - area) * (port[4] - x) / (port[4] - port[3])
    return area


@numba.njit("f8(f8,f8[:])", cache=True)
def section_area(shaft_angle, port):  # type: ignore[no-untyped-def]
    """Opening area in m2 at one shaft angle; `port` is the array of `as_array`. For use inside compiled code."""
    start = port[6]
    x = shaft_angle - port[0] - start
    x += start - TURN * np.floor(x / TURN)
    if x > port[8]:
        return 0.0
    return _one_kidney(x, port) - port[5] * covered_share(x, port[WEBS_FROM:FLOW_FROM])


@numba.njit("f8(f8,f8,f8,f8,f8)", cache=True)
def critical_pressure_drop(area, flow_coefficient, density, kinematic_viscosity, critical_reynolds):  # type: ignore[no-untyped-def]
    """Pressure drop in Pa at which an orifice of given area in m2 turns from laminar to turbulent.

    dp_cr = rho/2 (Re_cr nu/(Cd d_h))^2 with d_h = sqrt(4 A/pi). Source: Borutzky, Barnard, Thoma (2002), "An
    orifice flow model for laminar and turbulent conditions", Simulation Modelling Practice and Theory 10.
    """
    diameter = np.sqrt(4.0 * area / np.pi)
    return 0.5 * density * (critical_reynolds * kinematic_viscosity / (flow_coefficient * diameter)) ** 2


@numba.njit("UniTuple(f8,2)(f8,f8,f8,f8,f8)", cache=True)
def orifice_coefficients(area, flow_coefficient, density, kinematic_viscosity, critical_reynolds):  # type: ignore[no-untyped-def]
    """Cd A sqrt(2/rho) and the square of the critical pressure drop. For use inside compiled code."""
    if area <= 0.0:
        return 0.0, 1.0
    critical_drop = critical_pressure_drop(area, flow_coefficient, density, kinematic_viscosity, critical_reynolds)
    return flow_coefficient * area * np.sqrt(2.0 / density), critical_drop * critical_drop


@numba.njit("UniTuple(f8,2)(f8,f8,f8)", cache=True)
def orifice(pressure_drop, conductance, critical_square):  # type: ignore[no-untyped-def]
    """Volume flow in m3/s and its slope in m3/(s Pa); see `orifice_flow`. For use inside compiled code."""
    if conductance == 0.0:
        return 0.0, 0.0
    square = pressure_drop * pressure_drop + critical_square
    scaled = conductance / np.sqrt(np.sqrt(square))
    return scaled * pressure_drop, scaled * (1.0 - 0.5 * pressure_drop * pressure_drop / square)


@numba.njit("f8[::1](f8[::1],f8[::1])", cache=True)
def section_areas(shaft_angles, port):  # type: ignore[no-untyped-def]
    """`section_area` at each shaft angle."""
    out = np.empty_like(shaft_angles)
    for i in range(shaft_angles.size):
        out[i] = section_area(shaft_angles[i], port)
    return out


def as_array(port: PortOpening) -> Array:
    """The port as the flat array (PORT_SIZE,) that the compiled functions read."""
    found = np.zeros(PORT_SIZE)
    found[:NUMBERS] = (
        port.dead_centre,
        port.kidney_start,
        port.kidney_full_start,
        port.kidney_full_end,
        port.kidney_end,
        port.kidney_area,
        port.opens,
        len(port.grooves),
        port.shuts,
    )
    for n, groove in enumerate(port.grooves):
        found[NUMBERS + n * SIZE : NUMBERS + (n + 1) * SIZE] = groove.row
    found[WEBS_FROM:FLOW_FROM] = port.webs.row
    found[FLOW_FROM:] = port.coefficients.row
    return found


def opening_area(port: PortOpening, shaft_angle: Array | float) -> Array:
    """Opening area in m2 at shaft angles in rad (any number of turns); continuous, one bend per break angle."""
    angles = np.asarray(shaft_angle, dtype=float)
    return np.asarray(section_areas(angles.ravel(), as_array(port))).reshape(angles.shape)


def break_angles(port: PortOpening) -> Array:
    """Shaft angles in [0, 2 pi), ascending, where the opening law changes: no integration step may cross one."""
    kidney = (port.kidney_start, port.kidney_full_start, port.kidney_full_end, port.kidney_end)
    own = [*kidney, *port.webs.breaks, *(angle for groove in port.grooves for angle in groove.breaks)]
    found = np.sort((port.dead_centre + np.array(own)) % TURN)
    return found[np.diff(found, prepend=-1.0) > SAME_ANGLE]


def orifice_flow(
    pressure_drop: Array | float,
    area: float,
    flow_coefficient: float,
    density: float,
    kinematic_viscosity: float,
    critical_reynolds: float,
) -> Array:
    """Volume flow in m3/s through a port of given area in m2, of the sign of the pressure drop; paper Eq. (20).

    Eq. (20) has an infinite slope at zero. Here q = Cd A sqrt(2/rho) dp/(dp^2 + dp_cr^2)^(1/4), which is linear
    (laminar) well below `critical_pressure_drop` and Eq. (20) to 0.3 % above ten times it.
    """
    law = (flow_coefficient, density, kinematic_viscosity, critical_reynolds)
    conductance, critical_square = orifice_coefficients(area, *law)
    drop = np.asarray(pressure_drop, dtype=float)
    return np.asarray(conductance * drop / (drop**2 + critical_square) ** 0.25)
