"""The loss model of Schlosser (1961, Hydraulic Power Transmission 7): Wilson's with what density brings."""

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.loss_models.model import (
    LossModel,
    LossModelName,
    Term,
    constant,
    coulomb_drag,
    laminar_slip,
    viscous_drag,
)
from system.bench.loss_models.points import LossPoints


def turbulent_slip(points: LossPoints) -> Array:
    """V^(2/3) sqrt(2 dp/rho) in m3/s: leakage as through an orifice; none against the pressure."""
    difference = np.maximum(points.pressure_difference, 0.0)
    return np.asarray(points.displacement ** (2 / 3) * np.sqrt(2.0 * difference / points.density))


def hydrodynamic_drag(points: LossPoints) -> Array:
    """rho w^2 V^(5/3) in N m: oil thrown about and pressed through ports."""
    return points.density * points.speed**2 * points.displacement ** (5 / 3)


SCHLOSSER = LossModel(
    LossModelName.SCHLOSSER,
    "Schlosser",
    flow=(Term("C_s", "1", laminar_slip, positive=True), Term("C_st", "1", turbulent_slip, positive=True)),
    torque=(
        Term("C_d", "1", viscous_drag, positive=True),
        Term("C_f", "1", coulomb_drag, positive=True),
        Term("C_h", "1", hydrodynamic_drag, positive=True),
        Term("T_c", "N m", constant, positive=True),
    ),
    source="Schlosser 1961",
)
"""Q_L = C_s D dp/mu + C_st V^(2/3) sqrt(2 dp/rho), T_L = C_d D mu w + C_f D dp + C_h rho w^2 V^(5/3) + T_c."""
