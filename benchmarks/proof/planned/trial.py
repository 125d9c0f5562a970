"""One thing concealed on the plant, recorded on a grid and by a planned campaign of the same size, both diagnosed."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

import numpy as np

from diagnosis.explain.ranked import Explanation
from diagnosis.next_point.operating_box import pump_box
from diagnosis.planning.apart import Apart
from diagnosis.planning.plan import Asked, Plan, contest_of, plan_campaign, readings_of, spread_order
from diagnosis.planning.responses import foresee
from diagnosis.planning.suspects import COST, entries_of, possible_suspects, suspect_name, suspects_of
from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.recording.model import RecordedChannel, Recording
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.thresholds import Thresholds, load_thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.description.tolerances import tolerances
from system.effects.effect import Kind
from system.inputs.channels import ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE
from system.pump_file.file import load_known_pump

from ..campaigns import Campaign, campaigns, held
from ..cases import NEEDS, PARAMETERS, PHYSICS, SENSORS, Case, Concealed
from ..parts import Part
from ..plant.bench import run
from ..recordings import STEPS, Made, make
from ..sensors import METERS, read
from ..worth import GAUGE, NAMES, settings_of
from ..writing import BENCH, write_recording

SEED = 54_000
"""Of the draws: of no case of the proof."""
GRID = "grid"
SCORE = 8.0
"""z of what is concealed, by the grid: it is seen, and seldom named."""
ODDS = 20.0
CORNERS, ADDED = 8, 28
AIM = 7.0
"""Sigma of every pair that the plan aims at, so that it spends as many readings as the grid."""
LEVELS = (5, 5, 3, 3)
MIDDLE = 328.15  # K, of the case at the corners


@dataclass(frozen=True)
class Pair:
    """A pair that the grid leaves open: the rival, probability of the truth over its own by the grid and by the plan.

    grid, planned: distance in sigma as the plan foresees it; told: it foresees that its readings tell the two apart;
    never: that no point does.
    """

    rival: str
    odds_grid: float
    odds_planned: float
    grid: float
    planned: float
    told: bool
    never: bool


@dataclass(frozen=True)
class Trial:
    """A case: what is concealed, its pairs, both verdicts, readings of the planned campaign, process time in s."""

    name: str
    truth: str
    pairs: tuple[Pair, ...]
    said_grid: str
    said_planned: str
    readings: int
    seconds: float


def concealed() -> tuple[Concealed, ...]:
    """Effects that the check conceals, in a drawn order: all that a grid of steady points can show."""
    outputs = {f"{one}_" for one in campaigns()[GRID].outputs}
    faults = [one for one in SENSORS if any(one.id.startswith(name) for name in (*outputs, "p_out", "T_case"))]
    known = [*(one for one in PHYSICS if one.label not in NEEDS), *PARAMETERS, *faults]
    return tuple(known[at] for at in np.random.default_rng(SEED).permutation(len(known)))


def tried(one: Concealed, number: int) -> Trial:
    """Both campaigns on the same pump, with the bench calibrated anew between them."""
    begun, thresholds = process_time(), load_thresholds()
    made = make(Case(Part.GRADED, GRID, SEED + number, (one,), SCORE))
    truth = f"{one.id}.{one.pair}" if one.pair else one.id
    campaign = campaigns()[GRID]
    by_grid, said = _diagnosed(campaign, made.readings, thresholds)
    rivals = _open(by_grid, truth)
    if not rivals:
        return Trial(one.label, truth, (), said, "", 0, process_time() - begun)
    plan, on_grid = _planned([truth, *rivals], campaign, thresholds)
    hopeless = {never.pair for never in plan.never}
    where = {rival: (0, at) for at, rival in enumerate(rivals, start=1)}
    hopeful = any(pair not in hopeless for pair in where.values())
    by_plan, said_planned = _recorded_as_planned(plan, made, number, thresholds) if hopeful else ({}, "")
    pairs = tuple(
        Pair(
            rival, _odds(by_grid, truth, rival), _odds(by_plan, truth, rival), float(on_grid[pair]),
            float(plan.after[pair]), pair in plan.told, pair in hopeless,
        )
        for rival, pair in where.items()
    )  # fmt: skip
    return Trial(one.label, truth, pairs, said, said_planned, int(plan.counts.sum()), process_time() - begun)


def _recorded_as_planned(plan: Plan, made: Made, number: int, thresholds: Thresholds) -> tuple[dict[str, float], str]:
    """The diagnosis of the planned campaign on the same pump, the bench calibrated anew."""
    driven = replace(campaigns()[GRID], points=settings_of(readings_of(plan)))
    rng = np.random.default_rng(SEED + 1000 + number)
    at = held(driven, rng)
    truth = run(made.machine, at.moved("ratio", made.setting), made.hidden, STEPS)
    return _diagnosed(driven, read(driven, at, truth, made.faults, rng), thresholds)


def _open(found: dict[str, float], truth: str) -> list[str]:
    """The rivals that the grid leaves open beside the truth; none where the truth is not among the explanations."""
    if truth not in found:
        return []
    return [name for name, chance in found.items() if name != truth and found[truth] < ODDS * chance]


def _odds(found: dict[str, float], truth: str, rival: str) -> float:
    return found.get(truth, 0.0) / max(found.get(rival, 0.0), 1e-12)


def _diagnosed(campaign: Campaign, readings: object, thresholds: Thresholds) -> tuple[dict[str, float], str]:
    """Probability of each refitted explanation by one effect, and the verdict in words."""
    known = load_known_pump(BENCH)
    with tempfile.TemporaryDirectory() as folder:
        write_recording(Path(folder), "planned", readings, campaign.circuit)
        recording = checked_recording(Path(folder), known)

    def prepared(usable: Recording) -> Study:
        return prepare(known.pump, usable, tolerances(known.pump)[0], thresholds)

    _, found = diagnose_recording(known.pump, recording, prepared, thresholds)
    chances: dict[str, float] = {}
    for each in found.hypotheses:
        if _is_single(each):
            name = suspect_name(each.hypothesis)
            chances[name] = max(chances.get(name, 0.0), each.probability)
    said = " + ".join(claim.effect.value for claim in found.effects)
    return chances, f"{found.kind.value}, {found.status.value}: {said}"


def _is_single(each: Explanation) -> bool:
    own = each.hypothesis
    return each.posterior is not None and len(own.effects) == 1 and own.kind is not Kind.UNKNOWN_PHYSICS


def _planned(names: list[str], campaign: Campaign, thresholds: Thresholds) -> tuple[Plan, Array]:
    """The plan for some suspects, the truth first, and their distances (S, S) as it foresees them for the grid.

    It begins with the corners of the box and may add as many readings as make the grid's number, at levels over the
    box or at the grid's own points. All suspects cost as much as makes the truth stand out by SCORE on the grid.
    """
    pump = load_known_pump(BENCH).pump
    box = pump_box(pump)
    *ends, warm = box.ends
    corners = box.points([*(np.array(end) for end in ends), np.array([MIDDLE])])
    levels = box.points([np.linspace(*end, count) for end, count in zip((*ends, warm), LEVELS, strict=True)])
    grid = _bench_points(campaign)
    possible = BenchPoints(**{key: np.concatenate([own, getattr(grid, key)]) for key, own in vars(levels).items()})
    asked = Asked(
        replace(corners, order=spread_order(CORNERS)),
        np.ones(CORNERS, dtype=np.int64),
        replace(possible, order=spread_order(len(possible.speed), CORNERS)),
        tuple(_standard(name) for name in (*campaign.inputs, *campaign.outputs)),
        ADDED,
        aim=AIM,
    )
    allowed, catalogue = tolerances(pump)[0], entries_of(names)
    foreseen = foresee(pump, asked.points, _meters(campaign), allowed, thresholds, catalogue)
    known = {suspect_name(one): one for one in possible_suspects(foreseen, thresholds)}
    chosen = [known[name] for name in names]
    on_grid = np.zeros(len(asked.counts), dtype=np.int64)
    on_grid[-len(grid.speed) :] = 1

    def by_grid(cost: float) -> Apart:
        suspects = suspects_of(foreseen, chosen, np.flatnonzero(asked.counts), thresholds, cost)
        return contest_of(foreseen, asked.channels, suspects).apart(on_grid)

    cost = COST * SCORE / float(np.sqrt(by_grid(COST).seen[0]))
    plan = plan_campaign(foreseen, replace(asked, cost=cost), chosen, thresholds, meters=())
    return plan, by_grid(cost).distances


def _bench_points(campaign: Campaign) -> BenchPoints:
    """The set points of a campaign as the simulation has them: pressures gauge."""
    at = campaign.points
    gauge = {name: getattr(at, name) - STANDARD_ATMOSPHERE for name in GAUGE}
    none = np.full(at.speed.size, np.nan)
    return BenchPoints(
        speed=at.speed, displacement_ratio=at.ratio, **gauge, T_case=at.T_case, T_in=at.T_in, hours=none, order=none
    )


def _meters(campaign: Campaign) -> tuple[RecordedChannel, ...]:
    """The plant's own meters."""
    found = []
    for name in METERS:
        one = METERS[name]
        found.append(
            RecordedChannel(
                ChannelName.named(_standard(name)), one.column, one.unit, one.sigma * one.scale, one.relative, 0.0, 0.0,
                one.gain, one.zero * one.scale, (),
            )
        )  # fmt: skip
    transducer = ChannelName.P_CHAMBER
    return (*found, RecordedChannel(transducer, "", "", 4e4, 0.0, 0.0, 0.0, 0.0, 4e4, ()))


def _standard(name: str) -> str:
    return NAMES.get(name, name)
