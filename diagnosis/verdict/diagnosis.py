"""Verdict on a recording: claims, certainty, and explanations that it cannot separate."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from diagnosis.detect.mismatch import Detection
from diagnosis.detect.regions import MapRegion
from diagnosis.explain.ranked import Explanation, HeldOut
from diagnosis.explain.scaling import Scaling
from diagnosis.next_point.choose import NextPoint
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.locate import Location
from system.description.gap import Gap
from system.effects.effect import EffectId, Kind
from system.estimation.posterior import FitEffort, Posterior
from system.inputs.units import Dimension


class VerdictStatus(Enum):
    """Certainty of a verdict."""

    NAMED = "named"
    CLASS = "class"
    SUSPICION = "suspicion"
    INCOMPLETE = "incomplete"


@dataclass(frozen=True)
class Estimate:
    """A parameter with one sigma, SI; dimension None: a pure number."""

    name: str
    value: float
    sigma: float
    dimension: Dimension | None


@dataclass(frozen=True)
class ClaimedEffect:
    """A claimed effect at its likeliest gap.

    equivalent: ids that this recording cannot separate from it; elsewhere: other gaps that it cannot separate from
    `pair`, each with its share of the probability.
    """

    effect: EffectId
    pair: Gap | None
    probability: float
    equivalent: tuple[EffectId, ...]
    parameters: tuple[Estimate, ...]
    elsewhere: tuple[tuple[Gap, float], ...] = ()


@dataclass(frozen=True)
class Remainder:
    """A part of the mismatch that a claim leaves, as text; region: the part of the map in which a channel stays off;
    effect: what would explain it, with its score in sigma.
    """

    text: str
    region: MapRegion | None = None
    effect: EffectId | None = None
    score: float = 0.0


@dataclass(frozen=True)
class Diagnosis:
    """Verdict on a recording with its evidence.

    hypotheses: all, the claimed one first; before: the null's fit, after: the claimed one's; fit: held-out
    residuals; not_identifiable: pairs that this recording cannot separate, as text; thresholds: decided by these;
    left: what the claim does not explain.
    """

    kind: Kind
    status: VerdictStatus
    detection: Detection
    location: Location
    effects: tuple[ClaimedEffect, ...]
    hypotheses: tuple[Explanation, ...]
    before: Posterior
    after: Posterior
    fit: HeldOut
    scaling: Scaling | None
    next_point: NextPoint | None
    not_identifiable: tuple[str, ...]
    notes: tuple[str, ...]
    effort: FitEffort
    thresholds: Thresholds
    left: tuple[Remainder, ...] = ()
