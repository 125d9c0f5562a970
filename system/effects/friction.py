"""Friction of the seven pairs as effects change it."""

from dataclasses import replace

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import Effects, Value
from system.effects.state import GAPS
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss

OF_GAP = {
    Gap.PISTON: Pair.PISTON_CYLINDER,
    Gap.SLIPPER: Pair.SLIPPER_SWASH_PLATE,
    Gap.VALVE_PLATE: Pair.VALVE_PLATE_CYLINDER,
}
SOCKET, GUIDE = 3, 4
"""Rows of `Effects.extra_coulomb` behind those of the gaps."""


def rubbed(losses: FrictionPairs[Value], effects: Effects[Value]) -> FrictionPairs[Value]:
    """The pairs' losses with an effect's factors and additions."""
    changed = {
        pair.value: _rubbed(losses.loss(pair), effects.coulomb[row], effects.viscous[row], effects.extra_coulomb[row])
        for row, pair in enumerate(OF_GAP[gap] for gap in GAPS)
    }
    return replace(
        losses,
        **changed,
        piston_slipper_socket=_rubbed(losses.piston_slipper_socket, 1.0, 1.0, effects.extra_coulomb[SOCKET]),
        ball_guide_retainer=_rubbed(losses.ball_guide_retainer, 1.0, 1.0, effects.extra_coulomb[GUIDE]),
    )


def _rubbed(loss: PairLoss[Value], coulomb: Array | float, viscous: Array | float, extra: Array) -> PairLoss[Value]:
    return replace(loss, coulomb=loss.coulomb * coulomb + extra, viscous=loss.viscous * viscous)
