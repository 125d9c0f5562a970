"""Suspects: hypotheses of the catalogue by name, each at the size that a test has to separate.

The size costs one point of overall efficiency on the mean of the campaign's points, or changes the drain flow by half
of itself where that is less; no more than `MOST` sigma of its prior. A suspect of several sizes has all of them at the
same share of their priors.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.explain.hypotheses import Hypothesis, candidates_of, gap_of, hypotheses
from diagnosis.planning.responses import Foreseen
from diagnosis.report.explanations import explanation_words, named_apart
from diagnosis.study.model import Candidate, concerned
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.outputs import SIMULATED
from system.effects.catalogue.entries import CATALOGUE
from system.effects.effect import EffectId, Kind
from system.effects.extension import Entry
from system.estimation.evidence import Sign
from system.estimation.parameters import Parameter
from system.inputs.channels import ChannelName
from system.inputs.units import format_quantity

COST = 0.01
"""Of the overall efficiency: the size of a suspect, unless another is stated."""
DRAINED = 0.5
"""Of the drain flow: the equivalent change."""
MOST = 2.0
"""Largest size, in sigma of the prior."""
SIGNS = {Sign.POSITIVE: 1.0, Sign.NEGATIVE: -1.0, Sign.EITHER: 0.0}


@dataclass(frozen=True)
class Suspect:
    """A hypothesis at its size.

    name: as on a command line; members: columns of each member of its grid; truth: (Q,), its size in spreads of each
    column; costs: mean loss of efficiency by it; capped: the prior allows no size of the requested cost.
    """

    name: str
    words: str
    hypothesis: Hypothesis
    members: tuple[tuple[int, ...], ...]
    truth: Array
    costs: float
    capped: bool
    size: str

    @property
    def effect(self) -> EffectId:
        """The effect at any place."""
        return self.hypothesis.effects[0]


def possible_suspects(foreseen: Foreseen, thresholds: Thresholds) -> tuple[Hypothesis, ...]:
    """Every single hypothesis of the catalogue that any meter could show, in the catalogue's order."""
    found = hypotheses(foreseen.study, thresholds)
    return tuple(one for one in found if one.effects and one.component is None)


def suspect_names(parameters: Sequence[Parameter]) -> tuple[str, ...]:
    """Names of all suspects of a pump with these uncertain parameters, in the catalogue's order."""
    return tuple(suspect_name(own) for entry in CATALOGUE for own in _of_entry(entry, parameters))


def entries_of(names: Collection[str]) -> tuple[Entry, ...]:
    """The entries of the catalogue of some suspects."""
    return tuple(one for one in CATALOGUE if one.id.value in {name.partition(".")[0] for name in names})


def _of_entry(entry: Entry, parameters: Sequence[Parameter]) -> Iterator[Hypothesis]:
    for law in entry.extensions:
        yield Hypothesis((entry.id,), law.pair, entry.verdict, law.parameters, (), 0.0, (law,))
    for name in () if entry.extensions else concerned(entry.id, parameters):
        yield Hypothesis((entry.id,), gap_of(name), entry.verdict, (), (name,), 0.0)


def suspect_name(own: Hypothesis) -> str:
    """Name of a suspect on a command line: its id, with its place, if any: "elastic_opening.slipper"."""
    if own.pair is not None:
        return f"{own.effects[0].value}.{own.pair.value}"
    if named_apart(own, 0):
        return f"{own.effects[0].value}.{str(own.subjects[0]).rpartition('.')[2]}"
    return own.effects[0].value


def meter_of(own: Hypothesis) -> ChannelName | None:
    """The meter whose fault a suspect is, None for any other suspect."""
    if own.kind is not Kind.SENSOR_FAULT:
        return None
    return ChannelName.named(own.widened[0].partition(".")[0])


def suspects_of(
    foreseen: Foreseen,
    chosen: Sequence[Hypothesis],
    campaign: NDArray[np.int64],
    thresholds: Thresholds,
    cost: float = COST,
) -> tuple[Suspect, ...]:
    """The chosen hypotheses at the size of `cost`, on the mean of the campaign's points (rows)."""
    return tuple(_suspect(foreseen, one, campaign, thresholds, cost) for one in chosen)


def signs_of(candidates: Sequence[Candidate]) -> Array:
    """(Q,), the sign that each column's size must have; 0 for either."""
    return np.array([SIGNS[one.sign] for one in candidates])


def _suspect(
    foreseen: Foreseen, own: Hypothesis, campaign: NDArray[np.int64], thresholds: Thresholds, cost: float
) -> Suspect:
    places = {id(one): at for at, one in enumerate(foreseen.candidates)}
    members = tuple(tuple(places[id(one)] for one in candidates_of(foreseen.study, member)) for member in own.members)
    members = tuple(one for one in members if one)
    middle = members[len(members) // 2]
    share = np.zeros(len(foreseen.candidates))
    for at in middle:
        one = foreseen.candidates[at]
        share[at] = one.width * (SIGNS[one.sign] or 1.0)
    lost, drained = _changes(foreseen, share, campaign)
    wanted = min(cost / max(lost, 1e-12), DRAINED / max(drained, 1e-12))
    factor = min(wanted, MOST)
    return Suspect(
        name=suspect_name(own),
        words=explanation_words(own),
        hypothesis=own,
        members=members,
        truth=factor * share,
        costs=factor * lost,
        capped=wanted > MOST,
        size=", ".join(_sizes(foreseen, middle, factor * share)),
    )


def _changes(foreseen: Foreseen, share: Array, campaign: NDArray[np.int64]) -> tuple[float, float]:
    """Mean change of the overall efficiency, and of the drain flow as a share of its mean, by sizes (Q,)."""
    responses = foreseen.responses
    readings, moved = responses.readings.values[campaign], (responses.columns @ share)[campaign]
    flow, drain, torque = (SIMULATED.index(one) for one in (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE))
    points = foreseen.points
    rise = (points.p_out - points.p_in)[campaign]
    efficiency = rise * readings[:, flow] / (readings[:, torque] * points.speed[campaign])
    relative = moved[:, flow] / readings[:, flow] - moved[:, torque] / readings[:, torque]
    lost = float(np.mean(np.abs(efficiency * relative)))
    return lost, float(np.mean(np.abs(moved[:, drain])) / np.mean(np.abs(readings[:, drain])))


def _sizes(foreseen: Foreseen, member: Collection[int], truth: Array) -> Iterator[str]:
    """The sizes of a member in words: "churning.factor 0.43"."""
    known = {one.name: one for one in foreseen.study.base.parameters}
    for at in member:
        one = foreseen.candidates[at]
        law = () if one.extension is None else one.extension.parameters
        parameter = next((each for each in law if each.name == one.parameter), None) or known[one.parameter]
        value = parameter.value(float(truth[at]))
        dimension = parameter.dimension
        shown = f"{value:.3g}" if dimension is None else format_quantity(value, dimension, digits=3)
        yield f"{one.parameter} {shown}"
