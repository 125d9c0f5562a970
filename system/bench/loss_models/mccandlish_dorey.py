"""The loss model of McCandlish and Dorey (1984, Proc. IMechE 198B): compression, and coefficients that vary.

That slip, viscous and Coulomb coefficient vary with pressure, speed and displacement is theirs; that they do so
linearly is taken here, "after" them.
"""

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


def compression(points: LossPoints) -> Array:
    """D w dp/K in m3/s: what oil of the full displacement yields to pressure."""
    return points.per_radian * points.speed * points.pressure_difference / points.bulk_modulus


def _slip_by_pressure(points: LossPoints) -> Array:
    return laminar_slip(points) * points.scaled[1]


def _slip_by_speed(points: LossPoints) -> Array:
    return laminar_slip(points) * points.scaled[0]


def _swept_compression(points: LossPoints) -> Array:
    return compression(points) * (1.0 + points.ratio) / 2.0


def _drag_by_ratio(points: LossPoints) -> Array:
    return viscous_drag(points) * points.ratio


def _coulomb_by_speed(points: LossPoints) -> Array:
    return coulomb_drag(points) * points.scaled[0]


def _coulomb_by_ratio(points: LossPoints) -> Array:
    return coulomb_drag(points) * points.ratio


MCCANDLISH_DOREY = LossModel(
    LossModelName.MCCANDLISH_DOREY,
    "after McCandlish-Dorey",
    flow=(
        Term("C_s0", "1", laminar_slip),
        Term("C_s1", "1", _slip_by_pressure),
        Term("C_s2", "1", _slip_by_speed),
        Term("V_r", "1", compression, positive=True),
        Term("C_K", "1", _swept_compression, positive=True),
    ),
    torque=(
        Term("C_v0", "1", viscous_drag),
        Term("C_v1", "1", _drag_by_ratio),
        Term("C_f0", "1", coulomb_drag),
        Term("C_f1", "1", _coulomb_by_speed),
        Term("C_f2", "1", _coulomb_by_ratio),
        Term("T_c", "N m", constant, positive=True),
    ),
    source="after McCandlish and Dorey 1984",
)
"""Q_L = C_s D dp/mu + D w dp/K (V_r + C_K (1 + eps)/2), C_s = C_s0 + C_s1 dp/p_b + C_s2 w/w_b;
T_L = (C_v0 + C_v1 eps) D mu w + (C_f0 + C_f1 w/w_b + C_f2 eps) D dp + T_c, p_b and w_b rated."""
