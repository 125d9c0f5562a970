"""How surely explanations are told apart whose laws are true to a part of what they explain only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import log_softmax

from diagnosis.thresholds import Thresholds
from diagnosis.weighed import Weighed
from system.physics.effects import Kind

TRUE_TO = 0.01  # of what an explanation brings: the square of a form that is off by a tenth


def widening(weighed: Sequence[Weighed], thresholds: Thresholds) -> float:
    """By how much the gap of a class is wider than noise alone makes it, 1 at least.

    A form off by a tenth leaves TRUE_TO of the ln evidence that the best explanation gains over nothing; up to
    300 nats that is less than the gap.
    """
    nothing = max(each.log_evidence for each in weighed if each.hypothesis.kind is Kind.NO_MISMATCH)
    gained = max(each.log_evidence for each in weighed) - nothing
    return max(1.0, TRUE_TO * gained / thresholds.name.class_gap)


def shared_out(
    weighed: Sequence[Weighed], members: Sequence[Weighed], thresholds: Thresholds
) -> tuple[tuple[Weighed, ...], tuple[Weighed, ...]]:
    """The explanations and the members of a class among them, the class's probability shared out by its widening.

    P ~ exp(ln weight / (widening temperature)): a likelihood that holds only about is tempered (Miller and Dunson
    2019, doi:10.1080/01621459.2018.1469995). Where the widening is 1 the probabilities are as they were.
    """
    total = sum(each.probability for each in members)
    warm = widening(weighed, thresholds) * thresholds.name.temperature
    shares = np.exp(log_softmax(np.array([each.log_weight for each in members]) / warm))
    told = {
        id(each): replace(each, probability=total * float(share))
        for each, share in zip(members, shares, strict=True)
    }
    return tuple(told.get(id(each), each) for each in weighed), tuple(told[id(each)] for each in members)
