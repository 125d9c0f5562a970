"""One cause concealed in the plant, recorded on a grid and by planned campaigns of the same size, all diagnosed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

import numpy as np
from numpy.typing import NDArray

from diagnosis.explain.ranked import Explanation
from diagnosis.next_point.operating_box import rows
from diagnosis.planning.design import reading_order
from diagnosis.planning.further_meters import FurtherMeter
from diagnosis.planning.plan import Plan
from diagnosis.planning.suspects import suspect_name
from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.recording.model import Recording
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.thresholds import Thresholds, load_thresholds
from reynolds.numerics.arrays import Array
from system.description.tolerances import tolerances
from system.effects.effect import Kind
from system.inputs.channels import ChannelName
from system.pump_file.file import load_known_pump

from ..campaigns import Campaign, campaigns, held
from ..cases import NEEDS, PARAMETERS, PHYSICS, SENSORS, Case, Concealed
from ..parts import Part
from ..plant.bench import run
from ..recordings import STEPS, Made, make
from ..sensors import Readings, read
from ..worth import settings_of
from ..writing import BENCH, write_recording
from .plans import GRID, SCORE, planned

SEED = 54_000
"""Of the draws: of no case of the proof."""
ODDS = 20.0


@dataclass(frozen=True)
class ByGrid:
    """The grid's diagnosis of a case: concealed cause, probability of each explanation by one cause, verdict."""

    name: str
    truth: str
    chances: dict[str, float]
    said: str
    seconds: float

    @property
    def open(self) -> list[str]:
        """The rivals that stay open beside the truth; none where the truth is not among the explanations."""
        if self.truth not in self.chances:
            return []
        least = self.chances[self.truth] / ODDS
        return [name for name, chance in self.chances.items() if name != self.truth and chance > least]


@dataclass(frozen=True)
class Told:
    """Result of a planned campaign for a pair: predicted distance in sigma, odds for the truth.

    told: its readings are predicted to separate the two.
    """

    distance: float
    told: bool
    odds: float

    @property
    def is_settled(self) -> bool:
        """True if the odds for the truth are 20 to 1."""
        return self.odds >= ODDS


@dataclass(frozen=True)
class Pair:
    """A pair that the grid leaves open: the rival, odds for the truth by the grid, distance predicted for the grid.

    points: by the available meters; meter: with the one that the plan proposes; never: no point separates the two;
    best, best_told: distance by the best campaign of as many readings for this pair alone, and whether it separates the
    two.
    """

    rival: str
    odds: float
    distance: float
    never: bool
    best: float
    best_told: bool
    points: Told
    meter: Told


@dataclass(frozen=True)
class Trial:
    """The planned campaigns of a case: its pairs, the proposed meter, verdicts, readings, process time in s."""

    name: str
    truth: str
    pairs: tuple[Pair, ...]
    asked: str
    said: tuple[str, str]
    readings: tuple[int, int]
    seconds: float

    @property
    def settled(self) -> tuple[int, int]:
        """Pairs that are decided by points alone, and with the meter."""
        return sum(one.points.is_settled for one in self.pairs), sum(one.meter.is_settled for one in self.pairs)


def concealed() -> tuple[Concealed, ...]:
    """Effects that the check conceals, in a drawn order: all that a grid of steady points can show."""
    outputs = {f"{one}_" for one in campaigns()[GRID].outputs}
    faults = [one for one in SENSORS if any(one.id.startswith(name) for name in (*outputs, "p_out", "T_case"))]
    known = [*(one for one in PHYSICS if one.label not in NEEDS), *PARAMETERS, *faults]
    return tuple(known[at] for at in np.random.default_rng(SEED).permutation(len(known)))


def by_grid(one: Concealed, number: int) -> ByGrid:
    """The grid recorded and diagnosed."""
    begun = process_time()
    chances, said = _diagnosed(campaigns()[GRID], _made(one, number).readings, load_thresholds())
    truth = f"{one.id}.{one.pair}" if one.pair else one.id
    return ByGrid(one.label, truth, chances, said, process_time() - begun)


def tried(one: Concealed, number: int, grid: ByGrid) -> Trial:
    """Both planned campaigns on the same pump, the bench calibrated anew for each."""
    begun, thresholds, made = process_time(), load_thresholds(), _made(one, number)
    found = planned([grid.truth, *grid.open], thresholds)
    plan = found.plan
    hopeless = {never.pair for never in plan.never}
    where = {rival: (0, at) for at, rival in enumerate(grid.open, start=1)}
    hopeful = any(pair not in hopeless for pair in where.values())
    chances, said = _recorded(plan, plan.counts, (), made, number, thresholds) if hopeful else ({}, "")
    own = _told(plan.after, plan.told, chances, grid.truth, where)
    with_meter, said_with, readings = own, said, int(plan.counts.sum())
    if plan.equipped is not None:
        more = plan.equipped
        chances, said_with = _recorded(plan, more.counts, more.meters, made, number, thresholds)
        with_meter, readings = _told(more.after, more.told, chances, grid.truth, where), int(more.counts.sum())
    pairs = tuple(
        Pair(rival, _odds(grid.chances, grid.truth, rival), float(found.grid[at]), (0, at) in hopeless,
             float(found.best[at]), bool(found.best_told[at]), own[rival], with_meter[rival])
        for at, rival in enumerate(grid.open, start=1)
    )  # fmt: skip
    asked = " + ".join(meter.name for meter in plan.equipped.meters) if plan.equipped else ""
    return Trial(
        one.label, grid.truth, pairs, asked, (said, said_with), (int(plan.counts.sum()), readings),
        process_time() - begun,
    )  # fmt: skip


def _made(one: Concealed, number: int) -> Made:
    return make(Case(Part.GRADED, GRID, SEED + number, (one,), SCORE))


def _told(
    distances: Array,
    told: tuple[tuple[int, int], ...],
    chances: Mapping[str, float],
    truth: str,
    where: Mapping[str, tuple[int, int]],
) -> dict[str, Told]:
    return {
        rival: Told(float(distances[pair]), pair in told, _odds(chances, truth, rival)) for rival, pair in where.items()
    }


def _odds(found: Mapping[str, float], truth: str, rival: str) -> float:
    return found.get(truth, 0.0) / max(found.get(rival, 0.0), 1e-12)


def _recorded(
    plan: Plan,
    counts: NDArray[np.int64],
    meters: tuple[FurtherMeter, ...],
    made: Made,
    number: int,
    thresholds: Thresholds,
) -> tuple[dict[str, float], str]:
    """The diagnosis of a planned campaign on the same pump, the bench calibrated anew."""
    which = reading_order(counts, plan.points)
    driven = replace(campaigns()[GRID], points=settings_of(rows(plan.points, which)))
    for meter in meters:
        driven = _with(driven, meter, which)
    rng = np.random.default_rng(SEED + 1000 * (1 + len(meters)) + number)
    at = held(driven, rng)
    truth = run(made.machine, at.moved("ratio", made.setting), made.hidden, STEPS)
    return _diagnosed(driven, read(driven, at, truth, made.faults, rng), thresholds)


def _with(campaign: Campaign, meter: FurtherMeter, which: NDArray[np.int64]) -> Campaign:
    """The campaign with a further meter; `which`: the point of each reading."""
    if meter.channel is ChannelName.P_CHAMBER:
        return replace(campaign, traces=tuple(int(np.flatnonzero(which == at)[0]) for at in meter.points))
    if meter.channel is ChannelName.TORQUE_UNCOUPLED:
        return replace(campaign, uncoupled=(0, which.size - 1))
    return replace(campaign, outputs=(*campaign.outputs, meter.name))


def _diagnosed(campaign: Campaign, readings: Readings, thresholds: Thresholds) -> tuple[dict[str, float], str]:
    """Probability of each refitted explanation by one effect, and the verdict in words."""
    known = load_known_pump(BENCH)
    with tempfile.TemporaryDirectory() as folder:
        write_recording(Path(folder), "planned", readings, campaign.circuit)
        recording = checked_recording(Path(folder), known)

    def prepared(usable: Recording) -> Study:
        return prepare(known.pump, usable, tolerances(known.pump)[0], thresholds)

    _, found = diagnose_recording(known.pump, recording, prepared, thresholds)
    chances: dict[str, float] = {}
    for name, chance in _named(found.hypotheses):
        chances[name] = max(chances.get(name, 0.0), chance)
    said = " + ".join(claim.effect.value for claim in found.effects)
    return chances, f"{found.kind.value}, {found.status.value}: {said}"


def _named(explanations: tuple[Explanation, ...]) -> Iterator[tuple[str, float]]:
    for each in explanations:
        own = each.hypothesis
        if each.posterior is not None and len(own.effects) == 1 and own.kind is not Kind.UNKNOWN_PHYSICS:
            yield suspect_name(own), each.probability
