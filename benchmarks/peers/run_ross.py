"""FluidFlow of ROSS: finite differences of the whole bearing on its own grid, to be run in its own environment.

Timed is `calculate_pressure_matrix_numerical` alone: its coefficients, its matrix (dense, which is why it ends
at about 1e4 unknowns), the sparse solve and the clip to positive pressures. It carries the curvature of the
film; the radial clearance is 1e-3 of the radius, with which that is 0.1 % of the load.
"""

from __future__ import annotations

from importlib.metadata import version

from peer import asked, least, report
from ross.bearings.fluid_flow import FluidFlow
from ross.bearings.fluid_flow_coefficients import calculate_oil_film_force

CLEARANCE = 1e-3

case = asked()
film = FluidFlow(
    nz=case.rows + 1,
    ntheta=case.cells + 1,
    length=2.0,
    omega=1.0,
    p_in=0.0,
    p_out=0.0,
    radius_rotor=1.0,
    radius_stator=1.0 + CLEARANCE,
    viscosity=1.0,
    density=1.0,
    attitude_angle=0.0,
    eccentricity=case.eccentricity * CLEARANCE,
    immediately_calculate_pressure_matrix_numerically=False,
)
film.calculate_pressure_matrix_numerical()
solve = least(film.calculate_pressure_matrix_numerical, case.repeats)
radial, tangential, *_ = calculate_oil_film_force(film, "numerical")
scale = CLEARANCE**2  # pressures go with viscosity x speed x radius / clearance^2
report(version("ross-rotordynamics"), film.ntotal, solve, -scale * abs(radial), scale * abs(tangential))
