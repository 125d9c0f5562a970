"""The plan of a case: its suspects, the bench's limits and meters, the initial campaign."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.next_point.discrimination import added_points
from diagnosis.next_point.operating_box import pump_box
from diagnosis.planning.apart import Apart, Contest, PairCampaign
from diagnosis.planning.design import Asked, spread_order
from diagnosis.planning.plan import Plan, contest_of, plan_campaign
from diagnosis.planning.responses import foresee
from diagnosis.planning.suspects import COST, entries_of, possible_suspects, suspect_name, suspects_of
from diagnosis.recording.model import RecordedChannel
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.description.tolerances import tolerances
from system.inputs.channels import ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE
from system.pump_file.file import load_known_pump

from ..campaigns import campaigns
from ..sensors import METERS
from ..worth import GAUGE, NAMES
from ..writing import BENCH

GRID = "grid"
SCORE = 8.0
"""z of the concealed cause, by the grid: it is detected, and seldom named."""
CORNERS, ADDED = 8, 28
AIM = 7.0
"""Sigma of every pair that the plan aims at, so that it spends as many readings as the grid."""
FAR = 50.0
"""Target sigma of the best campaign for a pair alone: more than any reaches."""
LEVELS = (4, 4, 2, 3, 2)
CHARGE = (15e5 - STANDARD_ATMOSPHERE, 30e5 - STANDARD_ATMOSPHERE)
"""Pa gauge, ends of the charge pressure that the bench can set."""
MIDDLE = 328.15  # K, of the case at the corners


@dataclass(frozen=True)
class CasePlan:
    """The plan of a case, and the predictions for the first suspect against each other one.

    grid, best: (S,), sigma, by the grid, and by the best campaign of as many readings for that pair alone: any points
    with any number of readings; best_told: (S,), true where that campaign separates the two.
    """

    plan: Plan
    grid: Array
    best: Array
    best_told: NDArray[np.bool_]


def planned(names: list[str], thresholds: Thresholds) -> CasePlan:
    """The plan for some suspects, the truth first.

    It begins with the corners of the box and may add as many readings as make the grid's number, at levels over the box
    or at the grid's own points, and propose one additional meter. The cost of all suspects is the one at which the
    truth has SCORE on the grid.
    """
    pump = load_known_pump(BENCH).pump
    asked, count = _asked()
    allowed, catalogue = tolerances(pump)[0], entries_of(names)
    foreseen = foresee(pump, asked.points, _meters(), allowed, thresholds, catalogue)
    known = {suspect_name(one): one for one in possible_suspects(foreseen, thresholds)}
    chosen = [known[name] for name in names]
    on_grid = np.zeros(len(asked.counts), dtype=np.int64)
    on_grid[-count:] = 1

    def by_grid(cost: float) -> Apart:
        suspects = suspects_of(foreseen, chosen, np.flatnonzero(asked.counts), thresholds, cost)
        return contest_of(foreseen, asked.channels, suspects).apart(on_grid)

    cost = COST * SCORE / float(np.sqrt(by_grid(COST).seen[0]))
    plan = plan_campaign(foreseen, replace(asked, cost=cost), chosen, thresholds)
    best, best_told = _alone(contest_of(foreseen, asked.channels, plan.suspects), plan.wanted, thresholds)
    return CasePlan(plan, by_grid(cost).distances[0], best, best_told)


def _alone(contest: Contest, wanted: float, thresholds: Thresholds) -> tuple[Array, NDArray[np.bool_]]:
    """Distances of the first suspect by the best campaign for each pair alone, by exchange; whether it separates it."""
    readings, count = CORNERS + ADDED, len(contest.white.columns)
    none, often = np.zeros(count, dtype=np.int64), np.full(count, readings)
    distances, told = np.zeros(len(contest.suspects)), np.zeros(len(contest.suspects), dtype=bool)
    for other in range(1, len(contest.suspects)):
        alone = PairCampaign(contest, ((0, other),), FAR)
        found = contest.apart(np.bincount(added_points(alone, none, often, readings, 0.0).points, minlength=count))
        distances[other] = found.distances[0, other]
        told[other] = contest.told(found, wanted, thresholds.form)[0, other]
    return distances, told


def _asked() -> tuple[Asked, int]:
    """The initial campaign and the possible additions, the grid's points last; their number."""
    campaign = campaigns()[GRID]
    box = pump_box(load_known_pump(BENCH).pump)
    *ends, warm = box.ends
    corners = box.points([*(np.array(end) for end in ends), np.array([MIDDLE])])
    axes = zip((*ends, warm, CHARGE), LEVELS, strict=True)
    levels, grid = box.points([np.linspace(*end, count) for end, count in axes]), _grid_points()
    possible = BenchPoints(**{key: np.concatenate([own, getattr(grid, key)]) for key, own in vars(levels).items()})
    asked = Asked(
        replace(corners, order=spread_order(CORNERS)),
        np.ones(CORNERS, dtype=np.int64),
        replace(possible, order=spread_order(len(possible.speed), CORNERS)),
        tuple(_standard(name) for name in (*campaign.inputs, *campaign.outputs)),
        ADDED,
        aim=AIM,
    )
    return asked, len(grid.speed)


def _grid_points() -> BenchPoints:
    """The set points of the grid for the simulation: pressures gauge."""
    at = campaigns()[GRID].points
    gauge = {name: getattr(at, name) - STANDARD_ATMOSPHERE for name in GAUGE}
    none = np.full(at.speed.size, np.nan)
    return BenchPoints(
        speed=at.speed,
        displacement_ratio=at.ratio,
        **gauge,
        T_case=at.T_case,
        T_in=at.T_in,
        hours=none,
        order=none,
        warming=np.zeros(at.speed.size),
    )


def _meters() -> tuple[RecordedChannel, ...]:
    """The plant's own meters, and those that its bench could add."""
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
