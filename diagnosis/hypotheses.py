"""What may be the case: nothing, an effect of the catalogue, a sensor, a parameter, something unknown."""

from __future__ import annotations

from dataclasses import dataclass

from system.estimation.parameters import Parameter
from system.physics.effects import EffectId, Kind
from system.pump_gap import Gap


@dataclass(frozen=True)
class Hypothesis:
    """One explanation: effects (several where they act together), at a gap or None.

    extra: parameters added to the simulator; widened: names of those whose prior is widened; log_prior: natural
    logarithm of its prior probability.
    """

    effects: tuple[EffectId, ...]
    pair: Gap | None
    kind: Kind
    extra: tuple[Parameter, ...]
    widened: tuple[str, ...]
    log_prior: float
