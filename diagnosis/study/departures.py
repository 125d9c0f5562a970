"""Departures of a law over the map, known only to depend on few inputs.

A law a(x) becomes a(x) (1 + Phi b), b ~ N(0, w^2). Phi are the shapes of one family: a polynomial of second order in
one to four of the inputs, or any course over one of them. Families of as many inputs share a mass, and so do the
courses. A departure by one input costs little evidence, one by many costs more: the important inputs are found, not
assumed (Occam's factor; MacKay 1992, doi:10.1162/neco.1992.4.3.415). A constant factor does not count: it is a wrong
value, a meter's gain, or a law of the catalogue, which are hypotheses of their own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import comb, log

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from diagnosis.recording.line_pressures import varied_lines
from diagnosis.recording.model import Recording
from diagnosis.study.map_axes import axis_values, on_axis
from reynolds.numerics.arrays import Array
from system.estimation.evidence import family_evidences, taken_up
from system.estimation.folds import levels
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName

MOST = 4
"""Inputs of a polynomial."""
COSINES = 12
"""Of a course over one input; fewer where there are fewer levels."""


@dataclass(frozen=True)
class Family:
    """Shapes that act together: their columns, and the natural logarithm of their prior share."""

    inputs: tuple[ChannelName, ...]
    columns: NDArray[np.int64]
    log_prior: float


@dataclass(frozen=True)
class Shapes:
    """Shapes (N, m) of all families over the points of a recording."""

    values: Array
    families: tuple[Family, ...]


@dataclass(frozen=True)
class DepartureEvidence:
    """ln evidence of a law's departure over none, averaged over families; the family with the largest part.

    taken: nats of the objective that this family absorbs.
    """

    log_evidence: float
    family: Family
    taken: float


def departure_shapes(recording: Recording) -> Shapes:
    """All families of shapes over the inputs that move in a recording; a constant without any."""
    inputs = _inputs(recording)
    names, scaled = tuple(inputs), [on_axis(name, values) for name, values in inputs.items()]
    columns, places = _monomials(scaled, len(next(iter(inputs.values()), recording.steady.values)))
    most = min(MOST, len(names))
    kinds = most + 1
    families = [] if names else [Family((), np.zeros(1, dtype=np.int64), 0.0)]
    for count in range(1, most + 1):
        share = -log(kinds) - log(comb(len(names), count))
        for chosen in combinations(range(len(names)), count):
            own = [places[()], *(places[one,] for one in chosen)]
            own += [places[one, other] for k, one in enumerate(chosen) for other in chosen[k:]]
            families.append(Family(tuple(names[k] for k in chosen), np.array(own), share))
    for name, axis in zip(names, scaled, strict=True):
        course = _course(axis)
        own = [places[()], *range(len(columns), len(columns) + len(course))]
        families.append(Family((name,), np.array(own), -log(kinds) - log(len(names))))
        columns += course
    return Shapes(np.stack(columns, axis=1), tuple(families))


def departure_columns(posterior: Posterior, law: Array, shapes: Shapes) -> Array:
    """Whitened columns (n, m) of a law's readings (N, C) times each shape."""
    return posterior.whitening.whiten(law[:, :, None] * shapes.values[:, None, :])


def departure_evidence(posterior: Posterior, law: Array, shapes: Shapes, widths: Sequence[float]) -> DepartureEvidence:
    """Evidence of a departure of a law with readings (N, C) about a posterior without it; widths: w."""
    columns = departure_columns(posterior, law, shapes)
    found = family_evidences(posterior, columns, [each.columns for each in shapes.families], widths)
    found = found + np.array([each.log_prior for each in shapes.families])
    family = shapes.families[int(np.argmax(found))]
    return DepartureEvidence(float(logsumexp(found)), family, taken_up(posterior, columns[:, family.columns], widths))


def _inputs(recording: Recording) -> Mapping[ChannelName, Array]:
    """Inputs that move, each (N,) in SI."""
    return {**axis_values(recording), **{name: recording.steady.column(name) for name in varied_lines(recording)}}


def _monomials(scaled: Sequence[Array], count: int) -> tuple[list[Array], dict[tuple[int, ...], int]]:
    """Monomials to second order, each (N,), and their places by the numbers of their inputs."""
    numbers = range(len(scaled))
    order: list[tuple[int, ...]] = [(), *((k,) for k in numbers), *((j, k) for j in numbers for k in numbers if k >= j)]
    columns = [np.prod([np.ones(count), *(scaled[k] for k in each)], axis=0) for each in order]
    return columns, {each: place for place, each in enumerate(order)}


def _course(axis: Array) -> list[Array]:
    """Cosines over an axis of -1 .. 1, as many as its levels allow."""
    known = int(levels(axis).max())
    orders = range(1, min(COSINES, known or COSINES) + 1)
    return [np.cos(0.5 * np.pi * order * (axis + 1.0)) for order in orders]
