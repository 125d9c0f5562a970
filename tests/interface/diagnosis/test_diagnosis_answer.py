"""The parts of an answer in plain words: what to look at, how sure, what it costs, what is missing, contradictions."""

from __future__ import annotations

from dataclasses import replace
from string import Formatter

import numpy as np
import pytest
from made_diagnosis import PRESSURE, agreeing, hypothesis, its_answer, its_study

from diagnosis import Diagnosis, NoteKind, Study
from diagnosis.explain.explained import ExplainedMismatch
from diagnosis.procedure.compared import NO_COMPARISON, WITH, Change, PumpComparison
from diagnosis.procedure.cost import cost_words
from diagnosis.report import course
from diagnosis.report.answer import inspections, plain_answer
from diagnosis.report.certainty import (
    AnswerKind,
    Record,
    certainty,
    record_of,
    record_text,
    stated_probability,
    sure_words,
)
from diagnosis.report.measure import NOTHING_MORE
from diagnosis.report.sizes import FORMS, finding_sentence
from diagnosis.report.text import headline
from diagnosis.study.acceptance import contradictions
from diagnosis.study.scaled.far import far_levels
from diagnosis.verdict.diagnosis import ClaimedEffect, Estimate, VerdictStatus
from system import ChannelName, Dimension, EffectId, Gap, Kind, load_pump
from system.bench.parameters import base_parameters, pump_with
from system.description.tolerances import tolerances
from system.effects.catalogue.bench_words import BENCH_WORDS, PARTS
from system.effects.catalogue.entries import CATALOGUE, entry_of
from system.pump_file.file import load_known_pump

E = EffectId
FIELDS = {"place", "part", "stated", "size"}


def test_every_effect_and_meter_has_words_for_the_bench() -> None:
    assert set(BENCH_WORDS) == set(EffectId)
    names = [words.name for words in BENCH_WORDS.values()]
    assert len(set(names)) == len(names)
    assert all(3 < len(name) < 42 and name[0].islower() and " at " not in name and "_" not in name for name in names)
    assert set(PARTS) == set(Gap)


@pytest.mark.parametrize("effect", EffectId)
def test_words_ask_for_sizes_that_the_effect_has(effect: EffectId) -> None:
    """Fields of the finding are parameters of the effect's laws in a known form; what to look at is whole sentences."""
    words = BENCH_WORDS[effect]
    law = {one.name.rpartition(".")[2] for entry in CATALOGUE if entry.id is effect for extension in entry.extensions
           for one in extension.free}  # fmt: skip
    of_meter = {"zero", "gain", "drift", "lag"} if entry_is(effect, Kind.SENSOR_FAULT) else set()
    for _, name, form, _ in Formatter().parse(words.finding):
        assert name is None or name in law | of_meter | FIELDS
        assert (form or "") in FORMS
    assert not words.finding.endswith(".")
    assert {name for _, name, _, _ in Formatter().parse(words.look) if name} <= {"parts"}
    assert words.look.endswith(".")
    assert 60 <= len(words.look) <= 220


def entry_is(effect: EffectId, kind: Kind) -> bool:
    return effect is not E.UNKNOWN_PHYSICS and entry_of(effect).verdict is kind


def _claim(effect: EffectId, size: Estimate, pair: Gap | None = None) -> ClaimedEffect:
    return ClaimedEffect(effect, pair, 0.99, (), (size,))


def test_a_droop_has_its_size_and_its_play(named: Diagnosis) -> None:
    rate = Estimate("rate", 1.72e-10, 0.16e-10, Dimension.ANGLE_COMPLIANCE)
    play = Estimate("play", 1e-4, 9.5e-4, Dimension.ANGLE)
    claim = ClaimedEffect(E.SWASH_DROOP, None, 0.99, (), (rate, play))
    assert finding_sentence(claim, named) == (
        "The swash plate gives way under load, by 0.099 +- 0.009 deg per 100 bar with 0.01 +- 0.05 deg of play, and "
        "the stroke falls"
    )


AREA = Estimate("area", 0.2074e-6, 0.0076e-6, Dimension.AREA)
GAIN, FACTOR = Estimate("torque.gain", -0.0212, 0.0014, None), Estimate("viscosity", 1.31, 0.02, None)
ZERO = Estimate("Q_case.zero", 6.7e-6, 2e-7, Dimension.VOLUME_FLOW)
COEFFICIENT = Estimate("coefficient", 2.1e-8, 2e-9, Dimension.PRESSURE_COEFFICIENT)
SHARE = Estimate("compliance", 0.8, 0.1, None)


@pytest.mark.parametrize(
    ("claim", "told"),
    [
        (_claim(E.PORT_SHORT_CIRCUIT, AREA), "an opening of 0.207 +- 0.008 mm2 (a hole of 0.51 mm)"),
        (_claim(E.TORQUE_GAIN, GAIN), "reads 2.12 +- 0.14 % too low: its gain is off"),
        (_claim(E.Q_CASE_OFFSET, ZERO), "reads 402 +- 12 mL/min too high"),
        (_claim(E.VISCOSITY_GRADE, FACTOR), "viscosity is 31 +- 2 % more than stated"),
        (_claim(E.VISCOSITY_PRESSURE, COEFFICIENT), "by 21 +- 2 % per 100 bar"),
        (_claim(E.ELASTIC_OPENING, SHARE, Gap.SLIPPER), "the slippers: compliance 0.80 +- 0.10"),
    ],
)
def test_a_finding_is_told_with_its_size(named: Diagnosis, claim: ClaimedEffect, told: str) -> None:
    """In the form of the sentence; behind a colon where the fit has another size than the sentence asks for."""
    assert told in finding_sentence(claim, named)


def test_a_wrong_value_is_told_beside_the_stated_one(named: Diagnosis) -> None:
    claim = ClaimedEffect(E.DEAD_VOLUME, None, 0.99, (), (Estimate("film", 1.2, 0.03, None),))
    assert "The dead volume of a chamber is 1.20 +- 0.03, not 1 as stated" in finding_sentence(claim, named)


def test_what_to_look_at_names_all_that_may_be_the_cause(named: Diagnosis) -> None:
    claim = replace(named.effects[0], elsewhere=((Gap.SLIPPER, 0.3),), equivalent=(E.FILM_HEATING,))
    found = replace(named, status=VerdictStatus.CLASS, effects=(claim,))
    first, second = its_answer(found).look
    assert first.name == "Elastic opening at the valve plate or the slippers"
    assert PARTS[Gap.VALVE_PLATE] in first.text
    assert PARTS[Gap.SLIPPER] in first.text
    assert second.id == "film_heating"
    suspicion = replace(named, status=VerdictStatus.SUSPICION, effects=())
    assert [one.id for one in its_answer(suspicion).look] == ["elastic_opening", "film_heating"]


def test_certainty_stands_beside_its_record(named: Diagnosis) -> None:
    """By probability where trials of a band are enough, else of all; each with its interval."""
    sure = record_of(AnswerKind.NAME, False, 0.999)
    assert sure is not None
    assert sure.banded
    few = record_of(AnswerKind.NAME, False, 0.95)
    assert few is not None
    assert not few.banded
    assert few.cases > sure.cases
    low, high = Record(9, 10, True).interval
    assert (low, high) == (pytest.approx(0.596, abs=1e-3), pytest.approx(0.982, abs=1e-3))  # Wilson 1927
    text = record_text(Record(9, 10, True), AnswerKind.NAME, True)
    assert (
        "known by their type plate, 9 of 10 names given with such certainty proved right (95 % interval 60 to 98 %)"
        in text
    )
    assert stated_probability(named) == pytest.approx(0.93)
    assert certainty(named, False).startswith("Very sure (stated probability 0.93). In trials on other simulators, ")


def test_a_class_that_includes_an_unknown_cause_is_no_surer_for_it(named: Diagnosis) -> None:
    """No reading contradicts a cause outside the catalogue: the certainty is that of the effects with a law."""
    claim = replace(named.effects[0], equivalent=(E.UNKNOWN_PHYSICS,))
    unknown = replace(named.hypotheses[1], hypothesis=hypothesis(E.UNKNOWN_PHYSICS, kind=Kind.UNKNOWN_PHYSICS))
    weighed = (replace(named.hypotheses[0], probability=0.6), replace(unknown, probability=0.4))
    found = replace(named, status=VerdictStatus.CLASS, effects=(claim,), hypotheses=weighed)
    assert stated_probability(found) == pytest.approx(0.6)
    assert "that it is this and no cause outside the catalogue (stated probability 0.6" in certainty(found, False)
    assert headline(found) == "Likely cause found."
    both = replace(found, effects=(replace(claim, equivalent=(E.FILM_HEATING, E.UNKNOWN_PHYSICS)),))
    assert "that it is one of these and no cause outside the catalogue" in certainty(both, False)
    assert headline(both) == "Narrowed down to two causes."


def test_a_leak_outside_looks_like_one_to_the_inlet(study: Study, named: Diagnosis) -> None:
    """Without an inlet flow a leak of the line behind the pump is not told from one inside: the bench is looked at."""
    claim = replace(named.effects[0], effect=E.PORT_SHORT_CIRCUIT, pair=None, equivalent=(), elsewhere=())
    own = its_study(named)
    for channels, told in ((own.channels, True), ((*own.channels, ChannelName.Q_IN), False)):
        (look,) = inspections(replace(named, effects=(claim,)), channels)
        assert ("relief valve and fittings, too" in look.text) is told


def test_agreement_that_is_not_sure_asks_for_what_would_show_more(named: Diagnosis) -> None:
    """Meters, axes and dimensions that are missing, where half of such answers missed an effect; else nothing."""
    found = agreeing(named)
    nothing = replace(named.hypotheses[0], hypothesis=hypothesis(kind=Kind.NO_MISMATCH), probability=0.85)
    found = replace(found, hypotheses=(nothing,))
    study = its_study(named)
    assert certainty(found, False).startswith("Fairly sure that nothing is wrong")
    assert plain_answer(study, found, "").measure == NOTHING_MORE
    told = plain_answer(replace(study, scant=True), found, "").measure
    assert told.startswith("A small effect may hide here")
    assert "delivery flow and inlet flow measured" in told
    assert "shaft torque" not in told
    assert "the pump's own dimensions" in told


@pytest.mark.parametrize(
    ("right", "cases", "words"), [(1, 3, "not sure"), (1, 1, "likely"), (5, 5, "fairly sure"), (40, 41, "very sure")]
)
def test_words_of_certainty_go_by_the_record_too(
    named: Diagnosis, monkeypatch: pytest.MonkeyPatch, right: int, cases: int, words: str
) -> None:
    """An answer that is stated to be sure, of a kind that often failed or was seldom tried, is not sure."""
    row = {"answer": "unknown", "pump": "stated", "from": 0.99, "to": 1.0, "right": right, "cases": cases}
    monkeypatch.setattr("diagnosis.report.certainty._rows", lambda: (row,))
    first, *others = named.hypotheses
    unknown = replace(first, hypothesis=hypothesis(E.UNKNOWN_PHYSICS, kind=Kind.UNKNOWN_PHYSICS), probability=0.995)
    found = replace(named, kind=Kind.UNKNOWN_PHYSICS, effects=(), hypotheses=(unknown, *others))
    assert sure_words(found, False) == words


@pytest.mark.parametrize(("nothing", "words"), [(0.05, "very sure"), (0.2, "fairly sure"), (0.4, "likely")])
def test_a_suspicion_is_sure_of_a_cause_as_far_as_nothing_is_ruled_out(
    named: Diagnosis, monkeypatch: pytest.MonkeyPatch, nothing: float, words: str
) -> None:
    row = {"answer": "suspicion", "pump": "stated", "from": 0.0, "to": 1.0, "right": 40, "cases": 41}
    monkeypatch.setattr("diagnosis.report.certainty._rows", lambda: (row,))
    none = replace(named.hypotheses[0], hypothesis=hypothesis(kind=Kind.NO_MISMATCH), probability=nothing)
    found = replace(named, status=VerdictStatus.SUSPICION, effects=(), hypotheses=(none, *named.hypotheses[1:]))
    assert certainty(found, False).startswith(f"{words[0].upper()}{words[1:]} that there is a cause (stated prob")


def test_of_a_pump_known_by_its_type_plate_the_certainty_is_that_of_the_whole_cause(named: Diagnosis) -> None:
    """The record beside it counts names, which are right more often."""
    assert " that this is the whole cause (stated probability" in certainty(named, True)
    assert "whole cause" not in certainty(named, False)


@pytest.mark.parametrize("kind", AnswerKind)
@pytest.mark.parametrize("scant", [False, True])
def test_every_kind_of_answer_has_a_record(kind: AnswerKind, scant: bool) -> None:
    """But of unknown physics, which trials may have told in the class of a name or as a suspicion alone."""
    record = record_of(kind, scant, 0.95)
    if record is None:
        assert kind is AnswerKind.UNKNOWN
        return
    assert 0 <= record.right <= record.cases
    assert record_text(record, kind, scant).endswith(" %).")


def test_cost_is_told_where_a_finding_shows_most() -> None:
    """Losses and gains, without changes that cannot be seen."""
    pump = load_pump("ref90")
    changes = (
        Change("delivery flow", "L/min", 100.0, 97.5), Change("shaft torque", "N m", 200.0, 200.1),
        Change("efficiency, overall (ISO 4409)", "%", 80.0, 77.9), Change("case drain", "L/min", 1.0, 0.5),
    )  # fmt: skip
    text = cost_words(PumpComparison({WITH: pump}, {}, changes, "Point 7."))
    assert text.startswith(
        "It costs 2.1 points of efficiency and 2.5 L/min of delivery and brings 0.5 L/min less case drain"
    )
    assert text.endswith("where it shows most (2100 r/min, 350 bar, 100 % stroke).")
    gained = cost_words(PumpComparison({WITH: pump}, {}, changes[3:], ""))
    assert "brings 0.5 L/min less case drain" in gained
    assert gained.endswith("above all friction and clearances.")
    assert "better than described" not in text
    assert "less than can be seen" in cost_words(PumpComparison({WITH: pump}, {}, changes[1:2], ""))
    assert cost_words(NO_COMPARISON) == ""
    reason = "A meter's fault costs the pump nothing: only the readings are wrong."
    assert cost_words(replace(NO_COMPARISON, text=reason)) == reason


def test_what_is_missing_is_told_at_both_ends(study: Study, named: Diagnosis, monkeypatch: pytest.MonkeyPatch) -> None:
    """Along the input that matters most, with the inputs that do not matter."""
    added = np.stack([1e-9 * PRESSURE / 60.0, 0.0 * PRESSURE], axis=1)
    monkeypatch.setattr(course, "explained_mismatch", lambda *given: ExplainedMismatch(added, added))
    text = course.course_words(study, named)
    assert text == (
        "The case drains more oil than simulated: 5 L/min more at 50 bar, 35 L/min more at 350 bar, at any speed and "
        "stroke alike. Fitted without the finding, other values of pump and meters make up for it to 0.06 L/min (rms)."
    )
    slight = ExplainedMismatch(4e-3 * added, 4e-3 * added)
    monkeypatch.setattr(course, "explained_mismatch", lambda *given: slight)
    assert course.course_words(study, named).endswith("at any speed and stroke alike.")


def test_a_difference_that_is_none_is_no_number(
    study: Study, named: Diagnosis, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Round-off at one end: nothing, not 1e-12 L/min."""
    added = np.stack([1e-9 * (PRESSURE - PRESSURE.min()) / 60.0 + 1e-19, 0.0 * PRESSURE], axis=1)
    monkeypatch.setattr(course, "explained_mismatch", lambda *given: ExplainedMismatch(added, added))
    assert ": nothing at 50 bar, 30 L/min more at 350 bar" in course.course_words(study, named)


@pytest.mark.parametrize(("mixed", "told"), [(False, True), (True, False)])
def test_a_difference_in_the_order_of_the_points_may_be_a_drift(
    study: Study, named: Diagnosis, monkeypatch: pytest.MonkeyPatch, mixed: bool, told: bool
) -> None:
    """Of the torque, whose drift no hypothesis is, where the points were driven by rising speed; in no mixed order."""
    rise = np.arange(len(PRESSURE)) * 0.1
    rise = rise[np.random.default_rng(1).permutation(len(rise))] if mixed else rise
    added = np.stack([0.0 * rise, rise], axis=1)
    monkeypatch.setattr(course, "explained_mismatch", lambda *given: ExplainedMismatch(added, added))
    of_torque = replace(named, location=replace(named.location, channels=(ChannelName.TORQUE,)))
    words = course.drift_words(study, of_torque)
    assert ("drift of the torque meter" in words) is told
    assert course.drift_words(study, named) == ""


def test_one_point_of_efficiency_is_one() -> None:
    one = (Change("efficiency, overall (ISO 4409)", "%", 80.0, 79.0),)
    assert cost_words(PumpComparison({}, {}, one, "")).startswith("It costs 1 point of efficiency where")


def test_levels_far_from_those_of_the_type_plate_are_told() -> None:
    """Displacement beyond its rounding, films and friction beyond two sigma of pumps of one size; else nothing."""
    pump = load_pump("ref90")
    allowed, _ = tolerances(pump)
    own = {one.name: one.centre for one in base_parameters(pump, allowed)}
    assert list(far_levels(pump, pump_with(pump, own | {"displacement": 1.02}), allowed)) == []
    friction = {name: 5.0 * value for name, value in own.items() if name.startswith("friction.")}
    films = [name for name in own if name.startswith("film_thickness.")]
    one_thin = {films[0]: own[films[0]] / 8.0}
    assert list(far_levels(pump, pump_with(pump, own | one_thin), allowed)) == []
    thin = {name: own[name] / 8.0 for name in films}
    told = list(far_levels(pump, pump_with(pump, own | {"displacement": 0.9} | friction | thin), allowed))
    assert all(note.kind is NoteKind.WARNED for note in told)
    plate, film, torque = (note.text for note in told)
    assert "the pump file states 89.9 cm3/rev, the recording is of 80.9 cm3/rev" in plate
    assert "1/8 of those of a pump of this size" in film
    assert "asks for 5 times the friction" in torque


def test_another_pump_and_another_oil_are_told(study: Study) -> None:
    """By the ISO grade in the oil's name; an oil without one, or of the pump's own grade, says nothing."""
    recording, known = replace(study.recording, oil="ISO VG 68"), load_known_pump("ref90")
    assert list(contradictions(recording, known)) == []
    (pump,) = contradictions(replace(recording, pump="A10VSO 45"), known)
    assert pump.text == "the recording is of A10VSO 45; it is compared with ref90"
    (oil,) = contradictions(replace(recording, oil="HLP, iso vg 32"), known)
    assert "the pump's file has an oil of 68 mm2/s at 40 degC" in oil.text
    assert list(contradictions(replace(recording, oil="Tellus"), known)) == []
    assert list(contradictions(replace(recording, oil="ISO VG 32"), None)) == []
