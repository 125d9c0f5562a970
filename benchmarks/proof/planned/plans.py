"""The plan of a case: its suspects, the bench's limits and meters, the campaign to begin with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from diagnosis.next_point.operating_box import pump_box
from diagnosis.planning.apart import Apart
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
"""z of what is concealed, by the grid: it is seen, and seldom named."""
CORNERS, ADDED = 8, 28
AIM = 7.0
"""Sigma of every pair that the plan aims at, so that it spends as many readings as the grid."""
LEVELS = (4, 4, 2, 3, 2)
CHARGE = (15e5 - STANDARD_ATMOSPHERE, 30e5 - STANDARD_ATMOSPHERE)
"""Pa gauge, ends of the charge pressure that the bench can set."""
MIDDLE = 328.15  # K, of the case at the corners


def planned(names: list[str], thresholds: Thresholds) -> tuple[Plan, Array]:
    """The plan for some suspects, the truth first, and their distances (S, S) as it foresees them for the grid.

    It begins with the corners of the box and may add as many readings as make the grid's number, at levels over the
    box or at the grid's own points, and ask for one meter more. All suspects cost as much as makes the truth stand out
    by SCORE on the grid.
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
    return plan, by_grid(cost).distances


def _asked() -> tuple[Asked, int]:
    """The campaign to begin with and what may be added, the grid's points last; their number."""
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
    """The set points of the grid as the simulation has them: pressures gauge."""
    at = campaigns()[GRID].points
    gauge = {name: getattr(at, name) - STANDARD_ATMOSPHERE for name in GAUGE}
    none = np.full(at.speed.size, np.nan)
    return BenchPoints(
        speed=at.speed, displacement_ratio=at.ratio, **gauge, T_case=at.T_case, T_in=at.T_in, hours=none, order=none
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
