"""Value of the next test: the rig run at its points, and at as many points drawn at random, and the evidence of the
readings for the two explanations that the test was to separate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import log

import numpy as np

from diagnosis.next_point.forecast import log_density, outlook
from diagnosis.next_point.operating_box import BenchBox
from diagnosis.procedure.next_test import contender, rivals
from diagnosis.recording.model import RecordedChannel
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.inputs.channels import ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE
from system.pump.operating import OperatingPoint

from .campaigns import Campaign, campaigns, held
from .oracle import is_of_truth
from .outcome import Outcome, Worth
from .plant.machine import Array
from .plant.settings import Settings
from .rig import Rig
from .sensors import METERS, calibrated, read_after, uncoupled

Places = Sequence[tuple[float, ...]]
"""Of points along the axes of a box."""
SEEDS = 900_000  # added to a case's: draws of its own
GAUGE = ("p_out", "p_in", "p_case")
NAMES = {"ratio": "displacement_ratio"}  # of the plant's settings, where the simulation's differ


def worth(
    study: Study, pump: PumpDescription, found: Diagnosis, rig: Rig, expected: Outcome, thresholds: Thresholds
) -> Worth | None:
    """Nats for the truth by the recording, by the proposed test, by random points; None without a proposal.

    None too where neither of the two explanations is the truth.
    """
    asked, two = found.next_point, rivals(found, thresholds)
    if asked is None or two is None or not any(is_of_truth(each, expected) for each in two):
        return None
    true, false = two if is_of_truth(two[0], expected) else two[::-1]
    box, rng = asked.box, np.random.default_rng(SEEDS + rig.seed)
    explained = [contender(study, each, thresholds) for each in (true, false)]

    def told(places: Places, further: tuple[RecordedChannel, ...]) -> float:
        points, values = _recorded(study, box, places, rig, asked.limits.readings, rng, further)
        one, other = (log_density(study, each, points, values, further) for each in explained)
        return one - other

    there = [_place(one.point, box) for one in asked.places]
    further = () if asked.meter is None else (asked.meter,)
    anywhere = [tuple(float(rng.uniform(*ends)) for ends in box.ends) for _ in there]
    foretold = outlook(study, explained[0], explained[1], _points(box, there), further).foretold(further)
    brought, _ = foretold.together(np.arange(len(there))).odds(asked.limits.readings)
    before = log(true.probability / false.probability)
    meter = "" if asked.meter is None else asked.meter.name.value
    return Worth(
        before, told(there, further), told(anywhere, ()), asked.chance, float(brought.mean), len(there), meter
    )  # fmt: skip


def _place(point: OperatingPoint, box: BenchBox) -> tuple[float, ...]:
    """A point along the axes of a box."""
    found = (
        point.shaft_speed, point.delivery_pressure, point.displacement_ratio, point.temperature, point.inlet_pressure,
    )  # fmt: skip
    return found[: len(box.ends)]


def _points(box: BenchBox, places: Places) -> BenchPoints:
    """Places of the box as points, in their order."""
    single = [box.points(tuple(np.array([value]) for value in place)) for place in places]
    return BenchPoints(**{name: np.concatenate([vars(one)[name] for one in single]) for name in vars(single[0])})


def _recorded(
    study: Study,
    box: BenchBox,
    places: Places,
    rig: Rig,
    count: int,
    rng: np.random.Generator,
    further: tuple[RecordedChannel, ...],
) -> tuple[BenchPoints, Array]:
    """`count` readings at each place of the box, as by the bench: inputs as read, outputs (n, C) in SI."""
    wanted = _points(box, places)
    wanted = replace(wanted, **{name: np.repeat(value, count) for name, value in vars(wanted).items()})
    known = campaigns()[rig.campaign]
    added = tuple(one.name.value for one in further)
    alone = ChannelName.TORQUE_UNCOUPLED.value
    outputs = (*known.outputs, *(name for name in added if name != alone))
    campaign = replace(known, points=settings_of(wanted), traces=(), outputs=outputs)
    at = held(campaign, rng)
    truth = rig.run(at.moved("ratio", rig.setting))
    calibrations = rig.calibrations | {name: calibrated(METERS[name], rng) for name in added}
    columns = read_after(campaign, at, truth, rig.faults, calibrations, rng)
    if alone in added:
        columns[alone] = uncoupled(at.speed.size, rig.faults, rig.calibrations["torque"], rng)
    values = [_si(name, columns[name]) for name in (*(one.value for one in study.channels), *added)]
    return _as_read(wanted, campaign, columns), np.stack(values, axis=1)


def settings_of(points: BenchPoints) -> Settings:
    """The points for the plant: pressures absolute."""
    return Settings(
        points.speed, points.displacement_ratio, points.p_out + STANDARD_ATMOSPHERE,
        points.p_in + STANDARD_ATMOSPHERE, points.p_case + STANDARD_ATMOSPHERE, points.T_in, points.T_case,
    )  # fmt: skip


def _as_read(points: BenchPoints, campaign: Campaign, columns: dict[str, Array]) -> BenchPoints:
    """The points with their measured values in place of the requested ones."""
    read = {NAMES.get(name, name): _si(name, columns[name]) for name in campaign.inputs}
    return replace(points, **read)


def _si(name: str, column: Array) -> Array:
    """A column of the bench's file in SI, pressures gauge."""
    meter = METERS[name]
    absolute = column * meter.scale + meter.origin
    return absolute - STANDARD_ATMOSPHERE if name in GAUGE else absolute
