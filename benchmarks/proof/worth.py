"""What the next point is worth: the rig run there and at a point drawn at random, and what the readings say of the
two explanations that the point was to separate."""

from __future__ import annotations

from dataclasses import replace
from math import log

import numpy as np

from diagnosis.next_point.forecast import forecasts, log_density
from diagnosis.next_point.operating_box import BenchBox
from diagnosis.procedure.next_test import contender, rivals
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.inputs.units import STANDARD_ATMOSPHERE

from .campaigns import Campaign, campaigns, held
from .oracle import is_of_truth
from .outcome import Outcome, Worth
from .plant.machine import Array
from .plant.settings import Settings
from .rig import Rig
from .sensors import METERS, read_after

SEEDS = 900_000  # added to a case's: draws of its own
GAUGE = ("p_out", "p_in", "p_case")
NAMES = {"ratio": "displacement_ratio"}  # of the plant's settings, where the simulation's differ


def worth(
    study: Study, pump: PumpDescription, found: Diagnosis, rig: Rig, expected: Outcome, thresholds: Thresholds
) -> Worth | None:
    """Nats for the truth by the recording, by the point asked for, by a random one; None where nothing is asked.

    None too where neither of the two explanations is the truth.
    """
    asked, two = found.next_point, rivals(found, thresholds)
    if asked is None or two is None or not any(is_of_truth(each, expected) for each in two):
        return None
    true, false = two if is_of_truth(two[0], expected) else two[::-1]
    box, rng = asked.box, np.random.default_rng(SEEDS + rig.seed)
    explained = [contender(study, each, thresholds) for each in (true, false)]

    def told(place: tuple[float, ...]) -> float:
        points, values = _recorded(study, box, place, rig, asked.limits.readings, rng)
        one, other = (log_density(study, each, points, values) for each in explained)
        return one - other

    point = asked.point
    there = point.shaft_speed, point.delivery_pressure, point.displacement_ratio, point.temperature
    anywhere = tuple(float(rng.uniform(*ends)) for ends in box.ends)
    wanted = box.points(tuple(np.array([value]) for value in there))
    brought, _ = forecasts(study, *explained, wanted).at(0).odds(asked.limits.readings)
    before = log(true.probability / false.probability)
    return Worth(before, told(there), told(anywhere), asked.chance, float(brought.mean))


def _recorded(
    study: Study, box: BenchBox, place: tuple[float, ...], rig: Rig, count: int, rng: np.random.Generator
) -> tuple[BenchPoints, Array]:
    """`count` readings at a place of the box as the bench takes them: inputs as read, outputs (n, C) in SI."""
    wanted = box.points(tuple(np.array([value]) for value in place))
    wanted = replace(wanted, **{name: np.repeat(value, count) for name, value in vars(wanted).items()})
    campaign = replace(campaigns()[rig.campaign], points=settings_of(wanted), traces=())
    at = held(campaign, rng)
    truth = rig.run(at.moved("ratio", rig.setting))
    columns = read_after(campaign, at, truth, rig.faults, rig.calibrations, rng)
    values = [_si(name.value, columns[name.value]) for name in study.channels]
    return _as_read(wanted, campaign, columns), np.stack(values, axis=1)


def settings_of(points: BenchPoints) -> Settings:
    """The points as the plant has them: pressures absolute."""
    return Settings(
        points.speed, points.displacement_ratio, points.p_out + STANDARD_ATMOSPHERE,
        points.p_in + STANDARD_ATMOSPHERE, points.p_case + STANDARD_ATMOSPHERE, points.T_in, points.T_case,
    )  # fmt: skip


def _as_read(points: BenchPoints, campaign: Campaign, columns: dict[str, Array]) -> BenchPoints:
    """The points with what is measured of them in the place of what was wanted."""
    read = {NAMES.get(name, name): _si(name, columns[name]) for name in campaign.inputs}
    return replace(points, **read)


def _si(name: str, column: Array) -> Array:
    """A column of the bench's file in SI, pressures gauge."""
    meter = METERS[name]
    absolute = column * meter.scale + meter.origin
    return absolute - STANDARD_ATMOSPHERE if name in GAUGE else absolute
