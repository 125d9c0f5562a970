"""Next measurement: the point or the test that decides, with the readings to expect under each explanation."""

from __future__ import annotations

from diagnosis.next_point.choose import NextPoint, RankedPoint
from diagnosis.recording.units import channel_unit, reading
from diagnosis.report.certainty import stated_probability
from diagnosis.report.explanations import rivals
from diagnosis.report.format import (
    CHANNELS,
    channel_words,
    if_words,
    listed,
    pressure_text,
    region_words,
    sentence_case,
    setting_text,
)
from diagnosis.study.map_axes import axis_values
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from system.effects.effect import EffectId, Kind
from system.inputs.channels import ChannelName

NO_NEXT_POINT = "no next point can be proposed"
"""First words of the note that gives the reason."""
NOTHING_MORE = "No further measurement is needed."
NOTHING_ELSE = "No further measurement is needed: nothing else fits."
NOTHING_AS_LIKELY = "No further measurement is needed: every other cause is far less likely."
DIMENSIONS = "clearances, valve plate, ports"
NO_POINT_TELLS = (
    "No further operating point would tell more: nothing else that could be fitted comes near. The pump's own "
    f"dimensions would: {DIMENSIONS}."
)
AGAIN = (
    "Read the points with the largest difference again, some of them five times: their scatter tells whether that of "
    "the meter is stated too small."
)
NOTHING_BETTER = "Nothing else that could be fitted explains the readings better."
EVEN, POOR = 0.5, 0.2
"""Chances of a decision below which readings hardly decide, and below which they are not worth a test."""
METERS = (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Of a bench that shows every effect on flows and torque."""
MAP_AXES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO)


def measure_words(diagnosis: Diagnosis) -> str:
    """The measurement that decides between the open explanations, in one to three sentences; or that none is needed."""
    found = diagnosis.next_point
    if found is not None and (found.is_open or diagnosis.status is VerdictStatus.SUSPICION):
        return next_point_text(found)
    failed = next((note for note in diagnosis.notes if note.startswith(NO_NEXT_POINT)), "")
    if found is None and failed:
        return f"{sentence_case(failed).rstrip('.')}."
    if diagnosis.kind is Kind.NO_MISMATCH and diagnosis.status is not VerdictStatus.SUSPICION:
        return NOTHING_MORE
    if not diagnosis.effects:
        return AGAIN
    if any(EffectId.UNKNOWN_PHYSICS in claim.equivalent for claim in diagnosis.effects):
        inputs = listed(map(channel_words, diagnosis.location.inputs))
        where = f" at other values of {inputs}" if inputs else ""
        return f"More points{where} tell a law of the catalogue from a cause outside it."
    if diagnosis.status is VerdictStatus.INCOMPLETE:
        return _again(diagnosis)
    if stated_probability(diagnosis) < diagnosis.thresholds.name.probability:
        return NO_POINT_TELLS
    possible, _ = rivals(diagnosis)
    return NOTHING_AS_LIKELY if possible else NOTHING_ELSE


def _again(diagnosis: Diagnosis) -> str:
    """The part of the map to read again where a claim leaves a mismatch and nothing else fits better."""
    place = next((one.region for one in diagnosis.left if one.region is not None), None)
    if place is None:
        return f"{NOTHING_BETTER} Points beyond the range recorded may tell more."
    where = f"{channel_words(place.channel)} at {region_words(place)}"
    return f"Read points of the part that still differs again: {where}. {NOTHING_BETTER}"


def hidden_words(study: Study, examples: str) -> str:
    """Effects that may be hidden, and meters, axes and dimensions that would show more, if nothing is found and such
    answers have a poor record. examples: the effects, in words.
    """
    moving = axis_values(study.recording)
    meters = [CHANNELS[one] for one in METERS if one not in study.channels]
    axes = [f"other {CHANNELS[axis]}s" for axis in MAP_AXES if axis not in moving]
    parts = [f"{listed(meters)} measured" if meters else "", f"{listed(axes)} recorded" if axes else ""]
    parts += [f"the pump's own dimensions ({DIMENSIONS}) in the pump file" if study.scant else ""]
    known = [part for part in parts if part]
    hides = f"A small effect may hide here{': ' if examples else ''}{examples}."
    return f"{hides} It would show sooner with {listed(known)}." if known else NOTHING_MORE


def next_point_text(found: NextPoint) -> str:
    """The next test with the readings to expect, and the chance that it decides."""
    (one, other), (first, second) = found.expected.texts, if_words(*found.between)
    if not found.settles and not found.repeats and found.chance < POOR:
        return (
            f"No operating point of this bench and no further meter tells whether {first.removeprefix('if ')} or "
            f"{second.removeprefix('if ')}: the best test would with a chance of {100.0 * found.chance:.0f} %. The "
            f"pump's own dimensions may: {DIMENSIONS}."
        )
    reads = f"{_channel(found.expected.channel)} reads {one} {first}, {other} {second}."
    added = f"Add to the bench: {found.meter_words}. " if found.meter else ""
    places = [point_words(found, place) for place in found.places]
    if len(places) == 1:
        asks = f"Record {places[0]}: {reads}"
    else:
        asks = f"Record {'; '.join(places)}: {found.limits.readings} times each. At the first {reads}"
    beyond = " This is outside the range recorded." if found.beyond else ""
    note = f" {found.note}" if found.note else ""
    return f"{added}{asks} {_sure(found)}{beyond}{note}"


def _sure(found: NextPoint) -> str:
    """The chance that the readings decide, or the number that would."""
    if found.settles or found.chance >= EVEN:
        return f"{found.readings} readings decide with a chance of {100.0 * min(found.chance, 0.99):.0f} %."
    if found.repeats:
        each = " of each" if found.others else " there"
        return f"{found.repeats} readings{each} decide."
    return (
        f"The {found.readings} readings will hardly decide, with a chance of {100.0 * found.chance:.0f} %: no other "
        "points of this bench and no further meter are surer."
    )


def point_words(found: NextPoint, place: RankedPoint) -> str:
    """An operating point of a test with both temperatures of the oil, and its inlet pressure where that varies."""
    point = place.point
    inlet, case = (
        f"{reading(ChannelName.T_IN, value):.0f} {channel_unit(ChannelName.T_IN)}"
        for value in (place.inlet_temperature, point.temperature)
    )
    setting = setting_text(point.shaft_speed, point.delivery_pressure, point.displacement_ratio)
    charged = f", {pressure_text(point.inlet_pressure)} at the inlet" if found.varies_inlet else ""
    return f"{setting}{charged}, oil at {inlet} in the inlet and {case} in the case"


def _channel(name: str) -> str:
    channel = next((one for one in ChannelName if one.value == name), None)
    return f"the {channel_words(channel)}" if channel else name
