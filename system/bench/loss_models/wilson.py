"""The loss model of Wilson (1946; Positive-Displacement Pumps and Fluid Motors, 1950)."""

from system.bench.loss_models.model import (
    LossModel,
    LossModelName,
    Term,
    constant,
    coulomb_drag,
    laminar_slip,
    viscous_drag,
)

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
