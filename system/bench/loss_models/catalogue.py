"""Loss models of the literature by name.

Wilson (1946; Positive-Displacement Pumps and Fluid Motors, 1950); Schlosser (1961, Hydraulic Power Transmission 7):
Wilson's with the effect of density; McCandlish and Dorey (1984, Proc. IMechE 198B): compression, and coefficients that
vary with pressure, speed and displacement, here linearly, "after" them; Zarotti and Nevegna (1981, 6th BHRA Fluid Power
Symposium), with the regressors as later authors cite them: the original was not available.
"""

from collections.abc import Callable, Mapping

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
from system.bench.loss_models.polynomials import ivantysyn

Column = Callable[[LossPoints], Array]


def turbulent_slip(points: LossPoints) -> Array:
    """V^(2/3) sqrt(2 dp/rho) in m3/s: leakage as through an orifice; zero against the pressure."""
    difference = np.maximum(points.pressure_difference, 0.0)
    return np.asarray(points.displacement ** (2 / 3) * np.sqrt(2.0 * difference / points.density))


def hydrodynamic_drag(points: LossPoints) -> Array:
    """rho w^2 V^(5/3) in N m: oil accelerated and forced through ports."""
    return points.density * points.speed**2 * points.displacement ** (5 / 3)


def compression(points: LossPoints) -> Array:
    """D w dp/K in m3/s: compression of the oil of the full displacement."""
    return points.per_radian * points.speed * points.pressure_difference / points.bulk_modulus


def _swept_compression(points: LossPoints) -> Array:
    return compression(points) * (1.0 + points.ratio) / 2.0


def _times(column: Column, scaled: int) -> Column:
    """A column times w/w_rated (0), dp/p_rated (1) or eps (2)."""
    return lambda points: column(points) * points.scaled[scaled]


def _product(speed: int, pressure: int, ratio: int) -> Column:
    """x^speed y^pressure eps^ratio, x = w/w_rated and y = dp/p_rated."""

    def column(points: LossPoints) -> Array:
        x, y, z = points.scaled
        return x**speed * y**pressure * z**ratio

    return column


def _term(name: str, unit: str, *powers: int) -> Term:
    return Term(name, unit, _product(*powers))


WILSON = LossModel(
    LossModelName.WILSON,
    "Wilson",
    flow=(Term("C_s", "1", laminar_slip, positive=True), Term("Q_r", "m3/s", constant)),
    torque=(
        Term("C_d", "1", viscous_drag, positive=True),
        Term("C_f", "1", coulomb_drag, positive=True),
        Term("T_c", "N m", constant, positive=True),
    ),
    source="Wilson 1946, 1950",
)
"""Q_L = C_s D dp/mu + Q_r, T_L = C_d D mu w + C_f D dp + T_c."""
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
MCCANDLISH_DOREY = LossModel(
    LossModelName.MCCANDLISH_DOREY,
    "after McCandlish-Dorey",
    flow=(
        Term("C_s0", "1", laminar_slip),
        Term("C_s1", "1", _times(laminar_slip, 1)),
        Term("C_s2", "1", _times(laminar_slip, 0)),
        Term("V_r", "1", compression, positive=True),
        Term("C_K", "1", _swept_compression, positive=True),
    ),
    torque=(
        Term("C_v0", "1", viscous_drag),
        Term("C_v1", "1", _times(viscous_drag, 2)),
        Term("C_f0", "1", coulomb_drag),
        Term("C_f1", "1", _times(coulomb_drag, 0)),
        Term("C_f2", "1", _times(coulomb_drag, 2)),
        Term("T_c", "N m", constant, positive=True),
    ),
    source="after McCandlish and Dorey 1984",
)
"""Q_L = C_s D dp/mu + D w dp/K (V_r + C_K (1 + eps)/2), C_s = C_s0 + C_s1 dp/p_b + C_s2 w/w_b;
T_L = (C_v0 + C_v1 eps) D mu w + (C_f0 + C_f1 w/w_b + C_f2 eps) D dp + T_c, p_b and w_b rated."""
ZAROTTI_NEVEGNA = LossModel(
    LossModelName.ZAROTTI_NEVEGNA,
    "after Zarotti-Nevegna",
    flow=(
        _term("C1", "m3/s", 0, 1, 0),
        _term("C2", "m3/s", 0, 2, 0),
        _term("C3", "m3/s", 1, 1, 0),
        _term("C4", "m3/s", 1, 1, 1),
        _term("C5", "m3/s", 1, 0, 2),
        _term("C6", "m3/s", 1, 0, 0),
    ),
    torque=(
        _term("C1", "N m", 0, 1, 0),
        _term("C2", "N m", 0, 1, 1),
        _term("C3", "N m", 1, 0, 0),
        _term("C4", "N m", 1, 0, 1),
        _term("C5", "N m", 2, 0, 2),
        _term("C6", "N m", 1, 1, 0),
        Term("C7", "N m", constant),
    ),
    source="after Zarotti and Nevegna 1981",
)
"""Q_L = C1 y + C2 y^2 + C3 x y + C4 eps x y + C5 eps^2 x + C6 x,
T_L = C1 y + C2 eps y + C3 x + C4 eps x + C5 eps^2 x^2 + C6 x y + C7; x = w/w_rated, y = dp/p_rated."""
LOSS_MODELS: Mapping[LossModelName, LossModel] = {
    model.name: model for model in (WILSON, SCHLOSSER, MCCANDLISH_DOREY, ZAROTTI_NEVEGNA, ivantysyn())
}
"""All except Polymod, whose orders depend on the readings: `orders.polymod_for`."""
