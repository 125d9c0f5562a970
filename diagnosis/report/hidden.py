"""Effects and meter faults that a diagnosis does not name, at the largest size that the recording allows.

About the fit with residual r, and the whitened column v of an effect for one spread of its size x ~ N(0, w^2), the
fitted parameters projected out (P):

    x | r ~ N(V g, V),   V = 1/(v.P v + 1/w^2),   g = v.r

to first order, cut to the sign that the law allows. The largest size is the `SHARE` quantile of |x|. Sizes of one law
are estimated together; of a grid of laws counts the one whose largest size changes the readings most.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import foldnorm, truncnorm

from diagnosis.explain.hypotheses import Hypothesis, candidates_of, hypotheses
from diagnosis.recording.units import difference, difference_unit
from diagnosis.report.format import CHANNELS, effect_words, last_word, parameter_unit
from diagnosis.report.sizes import quantity, size_words
from diagnosis.study.model import Candidate, Study
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis, Estimate
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import EffectId, Kind
from system.estimation.evidence import Sign, project
from system.estimation.posterior import Posterior, settled

SHARE = 0.95
"""Probability that an effect is no larger than its largest size."""
NARROWED = 0.5
"""Of the prior's sigma: a size known no better is not limited by the recording."""
MATERIAL = 0.002
"""Of the median of a channel: smaller changes are not reported."""
UNSEEN = 0.01
"""Share of one sigma of a channel below which a change of it counts as zero."""
MOST_TOLD = 3
"""Effects in a sentence."""
HEAD = (
    "effect", "pair", "size", "parameter", "value", "unit", "limited", "channel", "change", "change_unit",
)  # fmt: skip
"""Columns of hidden.csv."""


@dataclass(frozen=True)
class HiddenEffect:
    """An effect at the largest size that the recording allows.

    limited: the recording narrows the size; otherwise `size` is the prior's limit. changes: (C,) in SI, largest
    addition of the effect alone to each channel, 0 where the meter does not see it (`UNSEEN`). relative: largest of
    them over the median of its channel.
    """

    effect: EffectId
    pair: Gap | None
    size: Estimate
    limited: bool
    changes: Array
    relative: float

    @property
    def words(self) -> str:
        """Its name with its place: "elastic opening at the slippers"."""
        return effect_words([self.effect], self.pair)

    @property
    def size_words(self) -> str:
        """Its size to two digits, in the form of its finding, if any: "12 % per 100 bar", "rate 0.002"."""
        rounded = replace(self.size, value=float(f"{self.size.value:.2g}"))
        told = size_words(ClaimedEffect(self.effect, self.pair, 0.0, (), (rounded,)))
        return told or f"{last_word(self.size.name)} {quantity(rounded)}"


def hidden_effects(study: Study, diagnosis: Diagnosis) -> tuple[HiddenEffect, ...]:
    """Every effect and meter fault that is not claimed, at each place where it may act; largest changes first.

    Those that change no channel by `MATERIAL` of its median at any size that the prior allows are left out. A fault is
    an error of a meter beyond its calibration.
    """
    fit, thresholds = settled(diagnosis.after), diagnosis.thresholds
    claimed = {claim.effect for claim in diagnosis.effects}
    width = max(thresholds.name.mixture_widths)
    open_ones = (own for own in hypotheses(study, thresholds) if own.laws or own.kind is Kind.SENSOR_FAULT)
    hiding = (own for own in open_ones if not claimed & set(own.effects))
    found = [one for own in hiding if (one := _largest(study, fit, own, width)) is not None]
    return tuple(sorted(found, key=lambda one: (not one.limited, -one.relative)))


def hidden_examples(study: Study, hidden: Sequence[HiddenEffect]) -> str:
    """The effects with the largest changes among those that the recording limits, in words; empty without one."""
    first: dict[EffectId, HiddenEffect] = {}
    for one in hidden:
        if one.limited:
            first.setdefault(one.effect, one)
    chosen = list(first.values())[:MOST_TOLD]
    return "; ".join(f"{one.words}, up to {_change_words(study, one)}" for one in chosen)


def hidden_rows(study: Study, diagnosis: Diagnosis) -> Iterator[Mapping[str, str]]:
    """Rows of hidden.csv (`HEAD`): one for each effect and channel."""
    for one in hidden_effects(study, diagnosis):
        unit, factor = parameter_unit(one.size.dimension, one.size.value)
        for channel, change in zip(study.channels, one.changes, strict=True):
            texts = (
                one.effect.value, one.pair.value if one.pair else "", one.size_words, one.size.name,
                f"{factor * one.size.value:.4g}", unit, "yes" if one.limited else "no",
                channel.value, f"{difference(channel, float(change)):.4g}", difference_unit(channel),
            )  # fmt: skip
            yield dict(zip(HEAD, texts, strict=True))


def _change_words(study: Study, one: HiddenEffect) -> str:
    """The change that is largest beside its channel: "0.11 L/min of case drain"."""
    at = int(np.argmax(np.abs(one.changes) / _medians(study)))
    channel = study.channels[at]
    return f"{difference(channel, float(abs(one.changes[at]))):.2g} {difference_unit(channel)} of {CHANNELS[channel]}"


def _largest(study: Study, fit: Posterior, own: Hypothesis, width: float) -> HiddenEffect | None:
    """The law of a hypothesis's grid, and the size of it, that may change the readings most."""
    found = (one for member in own.members for one in _sizes(study, fit, candidates_of(study, member), width))
    told = [one for one in found if one.relative > MATERIAL]
    return max(told, key=lambda one: one.relative, default=None)


def _sizes(study: Study, fit: Posterior, candidates: Sequence[Candidate], width: float) -> Iterator[HiddenEffect]:
    """Each size of one law at its largest."""
    if not candidates:
        return
    spreads = np.array([width * one.width for one in candidates])
    columns = np.stack([one.column for one in candidates], axis=1) * spreads
    covariance = np.linalg.inv(np.eye(spreads.size) + columns.T @ project(fit, columns))
    means, sigmas = covariance @ (columns.T @ fit.residual), np.sqrt(np.diag(covariance))
    for one, spread, mean, sigma in zip(candidates, spreads, means, sigmas, strict=True):
        known = study.base.parameters if one.extension is None else one.extension.parameters
        parameter = next(each for each in known if each.name == one.parameter)
        size = spread * largest_size(float(mean), float(sigma), one.sign)
        xi = float(np.clip(size, parameter.lowest, parameter.highest))
        value = Estimate(parameter.name, parameter.value(xi), 0.0, parameter.dimension)
        changes = _seen(study, _strongest(study.base.whitening.unwhiten(one.column * xi)[:, : len(study.channels)]))
        relative = float(np.max(np.abs(changes) / _medians(study)))
        pair = None if one.extension is None else one.extension.pair
        yield HiddenEffect(one.entry.id, pair, value, bool(sigma < NARROWED), changes, relative)


def largest_size(mean: float, sigma: float, sign: Sign) -> float:
    """Quantile `SHARE` of |x|, x ~ N(mean, sigma^2) cut to a sign, with that sign; EITHER: with that of the mean."""
    if sign is Sign.EITHER:
        size = float(foldnorm.ppf(SHARE, abs(mean) / sigma, scale=sigma))
        return size if mean >= 0.0 else -size
    side = -1.0 if sign is Sign.NEGATIVE else 1.0
    return side * float(truncnorm.ppf(SHARE, -side * mean / sigma, np.inf, loc=side * mean, scale=sigma))


def _strongest(changes: Array) -> Array:
    """(C,), of changes (N, C) of each channel the one of largest absolute value."""
    return np.asarray(np.take_along_axis(changes, np.abs(changes).argmax(axis=0)[None], axis=0)[0])


def _seen(study: Study, changes: Array) -> Array:
    """The changes (C,), 0 where smaller than `UNSEEN` of the channel's sigma, its readings' step included."""
    own, count = study.observations, len(study.channels)
    sigma = np.nanmedian(np.hypot(own.sigma, own.quantum / np.sqrt(12.0)), axis=0)[:count]
    return np.where(np.abs(changes) < np.maximum(UNSEEN * sigma, np.finfo(float).eps * _medians(study)), 0.0, changes)


def _medians(study: Study) -> Array:
    """(C,) in SI, median absolute reading of each channel."""
    values = study.observations.values[:, : len(study.channels)]
    return np.asarray(np.maximum(np.nanmedian(np.abs(values), axis=0), np.finfo(float).tiny))
