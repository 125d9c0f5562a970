"""diagnosis.json, format 1: a diagnosis for other programs, every number with its unit."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from math import degrees, isfinite
from pathlib import Path
from typing import Any

from diagnosis.detect.time_scan import TimeKind, TimeMark
from diagnosis.explain.ranked import Explanation, HeldOut
from diagnosis.next_point.choose import NextPoint, RankedPoint
from diagnosis.recording.units import difference, difference_unit, reading
from diagnosis.report.answer import PlainAnswer
from diagnosis.report.format import if_words, last_word
from diagnosis.report.text import paragraphs, statement
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis, Estimate
from reynolds.numerics.files import read_json
from system.effects.effect import Kind
from system.inputs.channels import ChannelName
from system.inputs.faults import Fault, InputFaults
from system.inputs.versions import version_fault

FORMAT = 1
ANSWER_FORMAT = 1
"""Version of the answer in plain words in the file, which changes with its parts and the page that shows them."""
KEYS = (
    "format", "verdict", "status", "statement", "details", "mismatch", "where", "effects", "hypotheses", "fit",
    "scaling", "next_test", "not_identifiable", "notes",
)  # fmt: skip

AGAIN = "diagnose the recording again: swashfilm diagnose PUMP RECORDING"


def write_diagnosis(path: Path, diagnosis: Diagnosis, answer: PlainAnswer) -> None:
    """Write a diagnosis and its answer in plain words as JSON (docs/files.md). Raises ValueError for nan or inf."""
    told = {"answer": {"format": ANSWER_FORMAT, **asdict(answer)}}
    text = json.dumps(diagnosis_record(diagnosis) | told, indent=1, allow_nan=False)
    path.write_text(text + "\n", encoding="utf-8")


def read_diagnosis(path: Path) -> dict[str, Any]:
    """Read a diagnosis.json of format 1 with an answer of this version; raises InputFaults for another file."""
    try:
        record = read_json(path)
    except (OSError, ValueError) as reason:
        raise InputFaults(str(path), [Fault("file", str(reason), "a diagnosis.json of a finished run")]) from None
    found = record.get("format") if isinstance(record, dict) else type(record).__name__
    if fault := version_fault("format", found, FORMAT, "diagnosis"):
        raise InputFaults(str(path), [fault])
    faults = [Fault(key, "nothing", "a key of every diagnosis.json", AGAIN) for key in KEYS if key not in record]
    if faults := faults or list(_answer_faults(record.get("answer"))):
        raise InputFaults(str(path), faults)
    return record


def _answer_faults(answer: Any) -> Iterator[Fault]:
    """The fault of an answer that another version of the program wrote, or of a run older than such answers."""
    found = answer.get("format", "none") if isinstance(answer, dict) else None
    if found != ANSWER_FORMAT:
        told = "no answer in plain words: the run is of an earlier version" if found is None else f"format {found}"
        yield Fault("answer", told, f"an answer of format {ANSWER_FORMAT}", AGAIN)


def diagnosis_record(diagnosis: Diagnosis) -> dict[str, Any]:
    """Content of diagnosis.json without the answer, as plain values."""
    return {
        "format": FORMAT,
        "verdict": diagnosis.kind.value,
        "status": diagnosis.status.value,
        "statement": statement(diagnosis),
        "details": list(paragraphs(diagnosis)[1:]),
        "mismatch": _mismatch(diagnosis),
        "where": _where(diagnosis),
        "effects": [_claim(claim) for claim in diagnosis.effects],
        "hypotheses": [_hypothesis(one, diagnosis) for one in diagnosis.hypotheses],
        "fit": {"heldout": _held_out(diagnosis.fit), "held_out": diagnosis.fit.how},
        "scaling": _scaling(diagnosis),
        "next_test": _next_test(diagnosis.next_point) if diagnosis.next_point else None,
        "not_identifiable": list(diagnosis.not_identifiable),
        "notes": list(diagnosis.notes),
    }


def _mismatch(diagnosis: Diagnosis) -> dict[str, Any]:
    found = diagnosis.detection
    return {
        "p_value": found.p_value,
        "chi2_per_dof": found.chi2_per_dof,
        "channels": {
            channel.value: {"chi2_per_dof": misfit.chi2_per_dof, "share": misfit.share}
            for channel, misfit in found.channels.items()
        },
    }


def _where(diagnosis: Diagnosis) -> dict[str, Any]:
    location, agrees = diagnosis.location, diagnosis.kind is Kind.NO_MISMATCH
    pair = diagnosis.effects[0].pair if diagnosis.effects else None
    angle = location.angle
    return {
        "channels": [] if agrees else [one.value for one in location.channels],
        "pair": pair.value if pair else None,
        "region": location.region.text if location.region and not agrees else None,
        "shaft_angle_deg": [degrees(angle.start), degrees(angle.end)] if angle else None,
        "components": [] if agrees else [one.value for one in location.tie],
        "time": _time(location.time) if location.time else None,
    }


def _time(mark: TimeMark) -> dict[str, Any]:
    point = mark.at + 1 if mark.kind is TimeKind.ONSET else None
    return {"kind": mark.kind.value, "channel": mark.channel.value, "point": point}


def _claim(claim: ClaimedEffect) -> dict[str, Any]:
    return {
        "id": claim.effect.value,
        "pair": claim.pair.value if claim.pair else None,
        "probability": claim.probability,
        "equivalent": [one.value for one in claim.equivalent],
        "other_pairs": {gap.value: part for gap, part in claim.elsewhere},
        "parameters": [_estimate(one) for one in claim.parameters],
    }


def _estimate(estimate: Estimate) -> dict[str, Any]:
    unit = estimate.dimension.si_unit if estimate.dimension else "1"
    name = last_word(estimate.name).replace(" ", "_")
    return {"name": name, "value": estimate.value, "sigma": estimate.sigma, "unit": unit}


def _hypothesis(one: Explanation, diagnosis: Diagnosis) -> dict[str, Any]:
    """heldout_rmse: of the channel named first in `where`, in its unit of `fit`; bic: -2 ln evidence (Schwarz)."""
    first = diagnosis.location.channels[:1]
    after = one.heldout.after if one.heldout else {}
    return {
        "effects": [effect.value for effect in one.hypothesis.effects],
        "pair": one.hypothesis.pair.value if one.hypothesis.pair else None,
        "probability": one.probability,
        "heldout_rmse": next((_number(channel, after) for channel in first), None),
        "bic": -2.0 * one.log_evidence,
        "refitted": not one.linear,
        "z": one.z,
    }


def _held_out(fit: HeldOut) -> dict[str, Any]:
    return {
        channel.value: {
            "before": _number(channel, fit.before),
            "after": _number(channel, fit.after),
            "noise": _number(channel, fit.noise),
            "unit": difference_unit(channel),
        }
        for channel in fit.after
    }


def _number(channel: ChannelName, values: Mapping[ChannelName, float]) -> float | None:
    """A residual in its unit, or None."""
    value = values.get(channel)
    return None if value is None or not isfinite(value) else difference(channel, value)


def _scaling(diagnosis: Diagnosis) -> dict[str, Any] | None:
    scaling = diagnosis.scaling
    if scaling is None:
        return None
    return {
        "channel": scaling.channel.value,
        "above": scaling.above,
        "exponents": dict(scaling.exponents),
        "sigma": dict(scaling.sigma),
    }


def _next_test(found: NextPoint) -> dict[str, Any]:
    return {
        "point": _point(found.places[0]),
        "points": [_point(place) for place in found.places],
        "meter": None if found.meter is None else {"channel": found.meter.name.value, "words": found.meter_words},
        "separates": [effect.value for effect in found.separates],
        "between": list(found.between),
        "settles": found.settles,
        "chance": found.chance,
        "readings": found.readings,
        "gain_nats": found.gain,
        "log_odds": {"now": found.before, "predicted": found.after},
        "beyond_recorded": found.beyond,
        "repeats": found.repeats,
        "why": _why(found),
        "note": found.note,
    }


def _point(place: RankedPoint) -> dict[str, float]:
    point = place.point
    return {
        "speed_rpm": reading(ChannelName.SPEED, point.shaft_speed),
        "p_out_bar": point.delivery_pressure * 1e-5,
        "p_in_bar": point.inlet_pressure * 1e-5,
        "displacement_ratio": point.displacement_ratio,
        "T_in_degC": reading(ChannelName.T_IN, place.inlet_temperature),
        "T_case_degC": reading(ChannelName.T_CASE, point.temperature),
    }


def _why(found: NextPoint) -> str:
    """The reading in which the two differ most at the point."""
    expected = found.expected
    reads = zip(expected.texts, if_words(*found.between), strict=True)
    one, other = (f"{value} {cause}" for value, cause in reads)
    return f"there {expected.channel} is {one} and {other}, {expected.apart:.1f} sigma of one reading apart"
