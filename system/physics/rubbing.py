"""Friction of the seven pairs as effects change it."""

from __future__ import annotations

from dataclasses import replace

from system.kinematics import Array
from system.pairs import FrictionPairs, PairLoss
from system.physics.effects import Effects
from system.physics.state import GAPS
from system.pump_gap import Gap

OF_GAP = {
    Gap.PISTON: "piston_cylinder",
    Gap.SLIPPER: "slipper_swash_plate",
    Gap.VALVE_PLATE: "valve_plate_cylinder",
}
"""The pair of each gap, by its field in `FrictionPairs`."""
SOCKET, GUIDE = 3, 4
"""Rows of `Effects.extra_coulomb` behind those of the gaps."""


def rubbed(losses: FrictionPairs, effects: Effects) -> FrictionPairs:
    """The pairs' losses over N points and M angles, arrays (N, M), with an effect's factors and additions."""
    changed = {
        name: _rubbed(
            getattr(losses, name), effects.coulomb[row], effects.viscous[row], effects.extra_coulomb[row]
        )
        for row, name in enumerate(OF_GAP[gap] for gap in GAPS)
    }
    return replace(
        losses,
        **changed,
        piston_slipper_socket=_rubbed(losses.piston_slipper_socket, 1.0, 1.0, effects.extra_coulomb[SOCKET]),
        ball_guide_retainer=_rubbed(losses.ball_guide_retainer, 1.0, 1.0, effects.extra_coulomb[GUIDE]),
    )


def _rubbed(loss: PairLoss, coulomb: Array | float, viscous: Array | float, extra: Array) -> PairLoss:
    return replace(loss, coulomb=loss.coulomb * coulomb + extra, viscous=loss.viscous * viscous)
