"""The tables of a diagnosis, as rows of text by column: readings and simulation, parameters, hypotheses.

The unit of a number is in brackets in the name of its column, or in the row's column `unit` (K for differences of
degC); probabilities, scores, pulls and counts have none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from diagnosis.explain.explained import explained_mismatch
from diagnosis.next_point.choose import NextPoint
from diagnosis.recording.model import Recording
from diagnosis.recording.units import channel_head, channel_unit, difference, reading
from diagnosis.report.format import parameter_unit
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis
from diagnosis.verdict.row_numbers import table_rows
from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName

AXES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.T_CASE)
Row = Mapping[str, str]


def steady_rows(recording: Recording) -> Iterator[Row]:
    """The steady points as read: row, from 1, and every channel that was measured, in its reading unit."""
    table = recording.steady
    names = list(ChannelName)
    recorded = [name for name in names if np.any(np.isfinite(table.values[:, names.index(name)]))]
    for number, values in zip(table_rows(recording), table.values, strict=True):
        row = {"point": str(number)}
        for name in recorded:
            row[channel_head(name)] = _reading(name, float(values[names.index(name)]))
        yield row


def added_by_claim(study: Study, diagnosis: Diagnosis) -> Array:
    """(N, C) in SI, addition of the claimed effects to the readings, other parameters as fitted; 0 without a claim."""
    if not diagnosis.effects:
        return np.zeros_like(study.observations.values)
    return explained_mismatch(study, diagnosis.hypotheses[0], diagnosis.thresholds).added


def residual_rows(study: Study, diagnosis: Diagnosis) -> Iterator[Row]:
    """Each reading: row from 1, operating point, measured, simulated by the null and by the claimed explanation.

    sigma is that of a reading, the noise of the point's inputs included; pull = (measured - simulated) / sigma;
    added: part of the claimed effects in the reading simulated after.
    """
    order, added = list(ChannelName), added_by_claim(study, diagnosis)
    sigma = diagnosis.before.whitening.sigma
    before, after = diagnosis.before.predictions, diagnosis.after.predictions
    numbers = table_rows(study.recording)
    for point, at in np.argwhere(study.observations.measured[:, : len(study.channels)]):
        channel = study.channels[at]
        measured, one = study.observations.values[point, at], sigma[point, at]
        place = {
            channel_head(axis): _reading(axis, float(study.recording.steady.values[point, order.index(axis)]))
            for axis in AXES
        }
        yield {
            "point": str(numbers[point]),
            "channel": channel.value,
            "unit": channel_unit(channel),
            **place,
            "measured": _text(reading(channel, measured)),
            "before": _text(reading(channel, before[point, at])),
            "after": _text(reading(channel, after[point, at])),
            "added": _text(difference(channel, added[point, at])),
            "sigma": _text(difference(channel, one)),
            "pull_before": _text((measured - before[point, at]) / one),
            "pull_after": _text((measured - after[point, at]) / one),
        }


def hypothesis_rows(diagnosis: Diagnosis) -> Iterator[Row]:
    """The explanations: nats behind the best, probability, score, gain of the folds held out."""
    best = max((one.log_evidence for one in diagnosis.hypotheses), default=0.0)
    for one in diagnosis.hypotheses:
        heldout = one.heldout
        yield {
            "hypothesis": one.hypothesis.text,
            "effects": " + ".join(effect.value for effect in one.hypothesis.effects),
            "pair": one.hypothesis.pair.value if one.hypothesis.pair else "",
            "kind": one.hypothesis.kind.value,
            "probability": _text(one.probability),
            "behind [nats]": _text(best - one.log_evidence),
            "refitted": "no" if one.linear else "yes",
            "z": _text(one.z),
            "held_out_gain [nats]": _text(sum(heldout.gains.values())) if heldout else "",
            "vetoed": ("yes" if heldout.vetoed else "no") if heldout else "",
        }


def parameter_rows(diagnosis: Diagnosis) -> Iterator[Row]:
    """Every parameter of the claimed fit: prior, value and pull by the null's fit and by the claimed one.

    A parameter claimed to be wrong has its stated prior, and no pull after: it was free.
    """
    before, after = diagnosis.before, diagnosis.after
    known = {parameter.name for parameter in before.parameters}
    free = set(_set_free(before, after))
    for at, fitted in enumerate(after.parameters):
        had = before.index(fitted.name) if fitted.name in known else None
        parameter = fitted if had is None else before.parameters[had]
        found, spread = float(after.values[at]), abs(parameter.stretch(0.0))
        unit, factor = parameter_unit(parameter.dimension, found or parameter.centre or spread)
        yield {
            "name": parameter.name,
            "unit": unit,
            "role": parameter.role.value,
            "prior": _text(factor * parameter.centre),
            "prior_sigma": _text(factor * spread),
            "before": _text(factor * float(before.values[had])) if had is not None else "",
            "after": _text(factor * found),
            "sigma": _text(factor * after.sigma(parameter.name)),
            "pull_before": _text(float(before.pulls[had])) if had is not None else "",
            "pull_after": "" if parameter.name in free else _text(float(after.pulls[at])),
            "source": parameter.source,
        }


def next_point_head() -> tuple[str, ...]:
    """Columns of the points for a next measurement."""
    inputs = (
        ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.P_IN, ChannelName.T_IN,
        ChannelName.T_CASE,
    )  # fmt: skip
    return (*map(channel_head, inputs), "gain [nats]")


def next_point_rows(found: NextPoint | None) -> Iterator[Row]:
    """Points of the test's box by the gain of readings at each by itself, in nats, the best first."""
    for one in () if found is None else found.ranked:
        point = one.point
        values = (
            _reading(ChannelName.SPEED, point.shaft_speed),
            _reading(ChannelName.P_OUT, point.delivery_pressure),
            _text(point.displacement_ratio),
            _reading(ChannelName.P_IN, point.inlet_pressure),
            _reading(ChannelName.T_IN, one.inlet_temperature),
            _reading(ChannelName.T_CASE, point.temperature),
            _text(one.gain),
        )
        yield dict(zip(next_point_head(), values, strict=True))


def pull_sums(before: Posterior, after: Posterior) -> tuple[float, float]:
    """Sums of the squared pulls of parameters that both fits hold to stated values: less if a name is right."""
    skipped = set(_set_free(before, after))
    known = {one.name for one in after.parameters} - skipped
    names = [one.name for one in before.parameters if one.name in known]

    def total(fit: Posterior) -> float:
        return float(sum(fit.pulls[fit.index(name)] ** 2 for name in names))

    return total(before), total(after)


def _set_free(before: Posterior, after: Posterior) -> Iterator[str]:
    """Names of the parameters with another prior after: widened by the claim."""
    stated = {one.name: one for one in before.parameters}
    for one in after.parameters:
        if one.name in stated and one.spread != stated[one.name].spread:
            yield one.name


def _reading(channel: ChannelName, value: float) -> str:
    """A reading in SI in its unit, empty without one."""
    return _text(reading(channel, value)) if np.isfinite(value) else ""


def _text(value: float) -> str:
    return f"{value:.6g}" if np.isfinite(value) else ""
