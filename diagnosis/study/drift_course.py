"""Course of a meter's drift: a smooth function of time that no law of the pump's inputs replaces.

    y = f(inputs) + sum over k of a_k (cos(k pi t) - 1),   t: elapsed share of the recording, a_k ~ N(0, w^2)

A meter drifts where these columns in its channel alone are likelier than a free smooth multiplier over the map on any
part of the pump: a pressure that is swept many times separates the two, a warm-up that is recorded once does not.

The course is found about the prior mean, where the pump's other errors distort it. In a fit each of its cosines
departs from the course by a share of its height.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from diagnosis.study.model import Study
from diagnosis.study.multipliers import multiplier_columns
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.sensors import drift_parameter
from system.estimation.evidence import multiplier_evidence, project
from system.estimation.parameters import Parameter
from system.inputs.channels import ChannelName

ORDERS = 6
"""Cosines of a course."""
FEWEST = 30
"""Points of a recording in which a course is sought."""


def drift_courses(study: Study, thresholds: Thresholds) -> Mapping[ChannelName, Array]:
    """Course (N,) in SI of the drift of each meter that has one, 0 at the first point."""
    hours = study.recording.steady.hours
    if len(hours) < FEWEST or not np.all(np.isfinite(hours)) or np.ptp(hours) == 0.0:
        return {}
    shapes = _shapes(hours)
    widths, base = thresholds.locate.multiplier_widths, study.base
    laws = [multiplier_evidence(base, multiplier_columns(study, base, each), widths) for each in study.components]
    found = {}
    for at, channel in enumerate(study.channels):
        columns = _columns(study, at, shapes)
        if multiplier_evidence(base, columns, widths) > max(0.0, *laws) + thresholds.name.odds:
            found[channel] = shapes @ _likeliest(study, columns, thresholds) * _level(study, at)
    return found


def course_departures(study: Study, courses: Mapping[ChannelName, Array], share: float) -> Array:
    """Departures (N, C, k) from the courses (N,) of some drifts, SI per sigma: each cosine by a share of the height."""
    blocks = [np.zeros((*study.observations.values.shape, 0))]
    for channel, course in courses.items():
        block = np.zeros((*study.observations.values.shape, ORDERS))
        block[:, study.channels.index(channel)] = share * np.abs(course).max() * _shapes(study.recording.steady.hours)
        blocks.append(block)
    return np.concatenate(blocks, axis=2)


def _shapes(hours: Array) -> Array:
    """Cosines (N, ORDERS) of the elapsed share of the recording, 0 at its first point."""
    past = (hours - hours.min()) / np.ptp(hours)
    return np.stack([np.cos(order * np.pi * past) - 1.0 for order in range(1, ORDERS + 1)], axis=1)


def _level(study: Study, at: int) -> float:
    return float(np.nanmedian(np.abs(study.observations.values[:, at])))


def drift_parameters(study: Study, courses: Mapping[ChannelName, Array]) -> tuple[Parameter, ...]:
    """CHANNEL.drift of each meter with a course; its prior is that of the meter's zero."""
    channels = [channel for channel in study.recording.channels if channel.name in courses]
    return tuple(drift_parameter(one.name, one.zero_sigma) for one in channels if one.zero_sigma > 0.0)


def _columns(study: Study, at: int, shapes: Array) -> Array:
    """Whitened columns (n, m) of the shapes (N, m) in one channel, in units of its median reading."""
    columns = np.zeros((*study.observations.values.shape, shapes.shape[1]))
    columns[:, at] = _level(study, at) * shapes
    return study.base.whitening.whiten(columns)


def _likeliest(study: Study, columns: Array, thresholds: Thresholds) -> Array:
    """Mean (m,) of the coefficients given the readings, at the width of greatest evidence."""
    base, widths = study.base, thresholds.locate.multiplier_widths
    width = max(widths, key=lambda width: multiplier_evidence(base, columns, [width]))
    precision = columns.T @ project(base, columns) + np.eye(columns.shape[1]) / width**2
    return np.asarray(np.linalg.solve(precision, columns.T @ base.residual), dtype=float)
