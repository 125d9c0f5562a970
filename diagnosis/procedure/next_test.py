"""The next test: points, or an additional meter, that separate the first explanation from its likeliest rival."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.explain.hypotheses import simulator_of
from diagnosis.explain.ranked import Explanation
from diagnosis.next_point.choose import NextPoint, metered_test, next_point
from diagnosis.next_point.forecast import Contender
from diagnosis.next_point.meters import meters
from diagnosis.next_point.operating_box import ordinary_box, rig_box
from diagnosis.recording.model import RecordedChannel
from diagnosis.report.explanations import explanation_words
from diagnosis.study.model import Study
from diagnosis.study.traces.bench import TracedBench
from diagnosis.thresholds import NextPointLimits, Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from reynolds.errors import InputError, NotConverged
from system.bench.outputs import DRAINS, SIMULATED
from system.bench.simulator import LumpedBench
from system.description.pump import PumpDescription
from system.inputs.channels import ChannelName


def with_next_point(study: Study, pump: PumpDescription, found: Diagnosis, thresholds: Thresholds) -> Diagnosis:
    """The diagnosis with the test that separates its first explanation from the likeliest other.

    Unchanged if there is no refitted rival. Raises NotConverged where a point cannot be simulated.
    """
    asked = rivals(found, thresholds)
    if asked is None:
        return found
    first, second = (contender(study, each, thresholds) for each in asked)
    return replace(found, next_point=proposed_point(study, pump, first, second, thresholds.next_point))


def proposed_point(
    study: Study, pump: PumpDescription, first: Contender, second: Contender, limits: NextPointLimits
) -> NextPoint:
    """Points of the rig's box if they decide the two, else of an ordinary bench's, else with an additional meter.

    If none of them decides, the test of the largest chance. Raises NotConverged if a point of the rig's box cannot be
    simulated; for a point farther out the failure is part of the text.
    """
    near = next_point(study, pump, rig_box(study.recording, pump), first, second, limits)
    if near.settles or not near.is_open:
        return near
    tests = [near]
    try:
        farther = next_point(study, pump, ordinary_box(study.recording, pump), first, second, limits)
        tests.append(replace(farther, beyond=True))
    except (NotConverged, InputError) as reason:
        tests = [replace(near, note=f"Farther out nothing can be predicted: {reason}.")]
    if not tests[-1].settles and (further := further_meters(study, pump, limits)):
        tests.append(metered_test(study, pump, near.box, first, second, limits, further))
    return max(tests, key=lambda test: (test.settles, test.chance, test.after))


def further_meters(study: Study, pump: PumpDescription, limits: NextPointLimits) -> tuple[RecordedChannel, ...]:
    """Meters that the bench of a recording lacks and could add, none for a user's own simulator.

    The drain of one gap is read as by the drain's meter, its gain known to `limits.gauge`. The torque meter reads the
    uncoupled shaft as it reads the pump. Others are those of an ordinary bench.
    """
    if not isinstance(study.simulator, LumpedBench | TracedBench):
        return ()
    usual = {one.name: one for one in meters(pump, {})}
    drain = study.recording.channel(ChannelName.Q_CASE) or usual[ChannelName.Q_CASE]
    torque = study.recording.channel(ChannelName.TORQUE)
    found = [usual[one] for one in SIMULATED if one not in study.channels]
    found += [replace(drain, name=one, gain_sigma=limits.gauge) for one in DRAINS.values() if one not in study.channels]
    if torque is not None and ChannelName.TORQUE in study.channels:
        found.append(replace(torque, name=ChannelName.TORQUE_UNCOUPLED, gain_sigma=0.0, zero_sigma=0.0))
    return tuple(one for one in found if one.name not in study.channels)


def rivals(found: Diagnosis, thresholds: Thresholds) -> tuple[Explanation, Explanation] | None:
    """The first explanation and its likeliest rival, both refitted; None without a rival."""
    fitted = [each for each in found.hypotheses if each.posterior is not None]
    rival = _rival(fitted, thresholds.next_point.rival)
    return None if rival is None else (fitted[0], rival)


def _rival(fitted: Sequence[Explanation], least: float) -> Explanation | None:
    """The likeliest of the explanations that are not the first at the same places."""
    others = [
        each
        for each in fitted[1:]
        if each.probability >= least and each.hypothesis.open_names != fitted[0].hypothesis.open_names
    ]
    return max(others, key=lambda each: each.probability, default=None)


def contender(study: Study, explanation: Explanation, thresholds: Thresholds) -> Contender:
    """A refitted explanation with the simulator of its fit."""
    if explanation.posterior is None:
        raise ValueError(f"{explanation.hypothesis.text}: not refitted")
    simulator = simulator_of(study, explanation.hypothesis, thresholds)
    own = explanation.hypothesis
    text = explanation_words(own) + (", of another form" if own.other_form else "")
    return Contender(own.effects, simulator, explanation.posterior, text, explanation.probability)
