"""Leakage of the three gaps at given film thickness: Eqs. (15)-(17) of Xu, Hu, Zhang and Mao (2017).

Every flow is positive out of the chamber.

Each law is a conductance in m3/(s Pa): leakage flow = conductance x (chamber pressure - case pressure). The
piston adds the oil that its moving wall carries along.
"""

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import Number


def piston_conductance(
    piston_diameter: float,
    radial_clearance: float,
    engaged_length: Array | float,
    eccentricity_ratio: float,
    viscosity: Array | float,
) -> Array:
    """Pressure-driven leakage of one piston per pascal; first term of paper Eq. (15).

    G = pi dp delta^3 (1 + 1.5 eps^2)/(12 mu l). Exact for a parallel eccentric annulus (0 <= eps < 1, delta much
    smaller than dp); a tilted piston leaks less. The engaged length l in m varies with the stroke.
    """
    eccentric = 1.0 + 1.5 * eccentricity_ratio**2
    return np.asarray(
        np.pi * piston_diameter * radial_clearance**3 * eccentric / (12.0 * viscosity * np.asarray(engaged_length))
    )


def piston_drag_flow(piston_diameter: float, radial_clearance: float, velocity: Array | float) -> Array:
    """Drag flow of the moving piston out of the chamber in its gap, in m3/s; second term of Eq. (15), corrected.

    q = + pi dp delta v/2 for v > 0 out of the block: the wall that moves out drags the film out with it. The
    printed sign is that of a plane moving with the piston's end, whose chamber would be V0 + (bore area) S; with
    the chamber V0 + Ap S of Eq. (18) the plane is fixed in the bore. Either way the swept area is
    Ap + pi dp delta/2, the mean of piston and bore. Independent of eccentricity.
    """
    return np.asarray(np.pi * piston_diameter * radial_clearance * np.asarray(velocity) / 2.0)


def slipper_conductance(
    log_ratio: float, film_thickness: float, orifice_diameter: float, orifice_length: float, viscosity: Number
) -> Number:
    """Leakage of one slipper per pascal: capillary orifice and parallel disc lands in series; paper Eq. (16).

    G = pi d^4 h^3/(mu [6 d^4 ln(r2/r1) + 128 h^3 l_o]), ln(r2/r1) the log_ratio, of several lands the sum.
    Laminar in both; an orifice shorter than some ten diameters also has the entry and exit loss of
    `gaps.films.slipper.orifice_and_capillary`.
    """
    d4, h3 = orifice_diameter**4, film_thickness**3
    resistance = 6.0 * d4 * log_ratio + 128.0 * h3 * orifice_length
    return np.pi * d4 * h3 / (viscosity * resistance)


def valve_plate_conductance(
    land_radii: tuple[float, float, float, float],
    film_thickness: float,
    pistons: int,
    viscosity: Number,
    extra_logs: tuple[float, float] = (0.0, 0.0),
) -> Number:
    """Leakage of one chamber over both sealing lands of the valve plate per pascal; paper Eq. (17).

    G = alpha h^3/(12 mu) [1/ln(R2/R1) + 1/ln(R4/R3)], alpha = 2 pi/z: each chamber pressurises its own pitch. Parallel
    film, radii R1 < R2 < R3 < R4 in m. extra_logs: additions of edges to the two logarithms.
    """
    r1, r2, r3, r4 = land_radii
    pitch = 2.0 * np.pi / pistons
    lands = 1.0 / (np.log(r2 / r1) + extra_logs[0]) + 1.0 / (np.log(r4 / r3) + extra_logs[1])
    return pitch * film_thickness**3 / (12.0 * viscosity) * float(lands)
