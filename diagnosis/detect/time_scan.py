"""Mismatch over time: a drift or an onset in the order of the points."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from scipy.stats import norm

from diagnosis.detect.contrasts import Contrasts, contrasts
from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName


class TimeKind(Enum):
    """Course of a mismatch over the order of the points."""

    DRIFT = "drift"
    ONSET = "onset"


@dataclass(frozen=True)
class TimeMark:
    """A drift, or an onset at point `at`, of a channel."""

    kind: TimeKind
    channel: ChannelName
    at: int
    p_value: float


def scan_time(study: Study, thresholds: Thresholds) -> TimeMark | None:
    """The drift or onset of least p among all channels and places, or None above the threshold.

    Contrasts of a straight line and of steps (Page 1954) along the rows. A smooth mismatch over the map is fitted
    too, so that an effect of pressure is no drift if pressure rose with time; contrasts are in units of the
    remaining scatter of the channel, so that an effect without a smooth law is no drift either. p: the greatest
    contrast against that of drawn readings (Westfall and Young 1993), or Bonferroni's bound where it is less.
    """
    limits = thresholds.locate
    patterns = _patterns(len(study.observations.values), limits.ends)
    shapes = smooth_shapes(study.axes)
    found = []
    for at, name in enumerate(study.channels):
        own = contrasts(study.base, at, beside=_smooth_columns(study, at, shapes, thresholds.mismatch.smooth))
        found.append((name, own, own.z(patterns) / own.scatter))
    best = max(found, key=lambda each: np.abs(each[2]).max())
    channel, own, z = best
    p_value = min(1.0, len(found) * _greatest_p(own, patterns, z, limits.draws, thresholds.seeds.locate))
    if p_value > limits.p_value:
        return None
    place = int(np.abs(z).argmax())
    kind = TimeKind.DRIFT if place == 0 else TimeKind.ONSET
    return TimeMark(kind, channel, 0 if place == 0 else place - 1 + limits.ends, p_value)


def remains(mark: TimeMark, study: Study, fit: Posterior, thresholds: Thresholds) -> bool:
    """True if a drift or an onset remains beside an explanation: a mismatch that it explains is not of time."""
    at = study.channels.index(mark.channel)
    own = contrasts(fit, at)
    place = 0 if mark.kind is TimeKind.DRIFT else mark.at - thresholds.locate.ends + 1
    pattern = _patterns(len(study.observations.values), thresholds.locate.ends)[:, [place]]
    return bool(2.0 * norm.sf(abs(float(own.z(pattern)[0])) / own.scatter) <= thresholds.locate.p_value)


def _patterns(points: int, ends: int) -> Array:
    """(N, m): a straight line, then a step at each point except those near the ends."""
    order = np.arange(points)
    steps = order[:, None] >= order[None, ends : points - ends + 1]
    return np.column_stack([np.linspace(-0.5, 0.5, points), steps.astype(float)])


def _smooth_columns(study: Study, channel: int, shapes: Array, width: float) -> Array:
    whitening = study.base.whitening
    columns = np.zeros((*whitening.measured.shape, shapes.shape[1]))
    columns[:, channel] = width * whitening.sigma[:, channel, None] * shapes
    return whitening.whiten(columns)


def _greatest_p(own: Contrasts, patterns: Array, z: Array, draws: int, seed: int) -> float:
    """Chance of as great a contrast among all patterns of one channel without an effect of time."""
    greatest = float(np.abs(z).max())
    level, axes = np.linalg.eigh(own.content)
    root = axes * np.sqrt(np.maximum(level, 0.0))
    drawn = root @ np.random.default_rng(seed).standard_normal((len(root), draws))
    content = np.einsum("nm,nm->m", patterns, own.content @ patterns)
    size = np.sqrt(np.where(content > 0, content, np.inf))
    chance = np.abs(patterns.T @ drawn / size[:, None]).max(axis=0)
    counted = (1 + np.count_nonzero(chance >= greatest)) / (draws + 1)
    return float(min(counted, 2.0 * norm.sf(greatest) * patterns.shape[1]))
