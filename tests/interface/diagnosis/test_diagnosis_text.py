"""A diagnosis told: the sentence of every status, the next point, and diagnosis.json."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from made_diagnosis import Q, agreeing, hypothesis, its_answer

from diagnosis import Diagnosis, NoteKind, statement, write_diagnosis
from diagnosis.detect.angle_scan import AngleWindow
from diagnosis.detect.regions import MapRegion
from diagnosis.detect.time_scan import TimeKind, TimeMark
from diagnosis.recording.model import DataNote, RecordedChannel
from diagnosis.report.certainty import certainty
from diagnosis.report.evidence import evidence
from diagnosis.report.format import if_words
from diagnosis.report.json_file import diagnosis_record, read_diagnosis
from diagnosis.report.measure import NOTHING_AS_LIKELY, NOTHING_ELSE, measure_words, next_point_text
from diagnosis.report.text import doubt, headline, paragraphs, rivals_words
from diagnosis.verdict.diagnosis import ClaimedEffect, Estimate, Remainder, VerdictStatus
from diagnosis.verdict.row_numbers import by_table_rows
from system import ChannelName, Component, Dimension, EffectId, Gap, InputFaults, Kind
from system.inputs.units import RPM

E = EffectId


def test_a_named_effect_is_told_with_place_size_and_certainty(named: Diagnosis) -> None:
    """The half-effect mark is told as what it is, and no odds stand alone."""
    text = statement(named)
    for part in (
        "Cause found.",
        "The film at the valve plate opens under pressure, by 22 +- 2 % of its thickness per 100 bar.",
        "It shows in case drain (Q_case), mostly at delivery pressures above 250 bar, where it reaches half of its "
        "largest size or more.",
        "Probability 0.93 (elastic_opening).",
    ):
        assert part in text
    told = " ".join(paragraphs(named))
    for part in (
        "Points not used in the fit are now met to 0.016 L/min in case drain (before 0.06; scatter of the meter "
        "0.015).",
        "Still possible: heating of the oil films.",
        "Record 1000 r/min, 370 bar, 100 % stroke, oil at 70 degC in the inlet and 50 degC in the case: the case drain "
        "(Q_case) reads 2.4 L/min if the cause is elastic opening at the valve plate, 2.1 L/min if the cause is "
        "film heating. 3 readings decide with a chance of 87 %.",
    ):
        assert part in told, told
    assert "1:" not in told


def test_the_next_point_is_told_with_what_it_promises(named: Diagnosis) -> None:
    """A point that decides, one farther out, several, a meter more; nothing more where nothing else is open."""
    found = named.next_point
    assert found is not None
    assert "outside the range recorded" in next_point_text(replace(found, beyond=True))
    poor = replace(found, chance=0.3, gain=0.7, repeats=None)
    assert "The 3 readings will hardly decide, with a chance of 30 %" in next_point_text(poor)
    hopeless = next_point_text(replace(poor, chance=0.1))
    assert "no further meter tells whether the cause is elastic opening at the valve plate or the cause is" in hopeless
    assert "a chance of 10 %" in hopeless
    assert "Record" not in hopeless
    assert next_point_text(replace(poor, repeats=6)).endswith("6 readings there decide.")
    likely = replace(found, chance=0.77, repeats=2)
    assert not likely.settles
    assert next_point_text(likely).endswith("3 readings decide with a chance of 77 %.")
    several = replace(found, others=(replace(found.places[0], inlet_temperature=313.15),))
    told = next_point_text(several)
    assert "oil at 70 degC in the inlet and 50 degC in the case; 1000 r/min" in told
    assert "oil at 40 degC in the inlet and 50 degC in the case: 3 times each. At the first the case drain" in told
    assert told.endswith("6 readings decide with a chance of 87 %.")
    drain = RecordedChannel(ChannelName.Q_SLIPPER, "", "", 1e-7, 0.0, 0.0, 0.0, 0.01, 0.0, ())
    metered = replace(found, meter=drain)
    assert next_point_text(metered).startswith("Add to the bench: a metered drain of the slippers alone. Record 1000")
    decided = replace(named, next_point=replace(poor, before=8.0))
    assert measure_words(decided) == NOTHING_AS_LIKELY
    record = diagnosis_record(replace(named, next_point=poor))["next_test"]
    assert (record["settles"], record["chance"], record["readings"]) == (False, 0.3, 3)
    assert record["log_odds"] == {"now": pytest.approx(np.log(15.5)), "predicted": 4.3}
    assert (record["meter"], record["repeats"], record["points"]) == (None, None, [record["point"]])
    assert record["why"].startswith("there Q_case is 2.4 L/min if the cause is elastic opening")
    record = diagnosis_record(replace(named, next_point=replace(several, meter=drain)))["next_test"]
    assert record["meter"] == {"channel": "Q_slipper", "words": "a metered drain of the slippers alone"}
    assert (len(record["points"]), record["readings"]) == (2, 6)


@pytest.mark.parametrize(
    ("between", "words"),
    [
        (("film heating", "no mismatch"), ("if the cause is film heating", "if nothing is wrong")),
        (("opening at the pistons", "opening at the slippers"), ("if it is the pistons", "if it is the slippers")),
    ],
)
def test_no_explanation_of_a_next_point_is_without_a_name(between: tuple[str, str], words: tuple[str, str]) -> None:
    assert if_words(*between) == words


def test_why_no_point_is_asked_for_is_told(named: Diagnosis) -> None:
    """That none can be proposed, that nothing else fits, or what would make a finding surer."""
    likeliest, *rest = named.hypotheses
    sole = replace(named, hypotheses=(likeliest, *(replace(one, probability=1e-3) for one in rest)), next_point=None)
    assert (measure_words(sole), "Still possible" in rivals_words(sole)) == (NOTHING_ELSE, False)
    alone = replace(named, next_point=None)
    assert (measure_words(alone), "Still possible" in rivals_words(alone)) == (NOTHING_AS_LIKELY, True)
    failed = replace(alone, notes=("no next point can be proposed: fit of the leak: it stalled",))
    assert measure_words(failed) == "No next point can be proposed: fit of the leak: it stalled."
    assert measure_words(agreeing(named)) == "No further measurement is needed."
    first, *others = named.hypotheses
    unsure = replace(alone, hypotheses=(replace(first, probability=0.6), *others))
    assert "clearances, valve plate, ports" in measure_words(unsure)
    assert headline(unsure) == "Likely cause found."


def test_the_statistics_stand_apart(named: Diagnosis) -> None:
    told = " ".join(evidence(named))
    for part in ("chi2 9.1 per reading", "heating of the oil films 1:16", "pressure^(2.1 +- 0.1)", "expected are 1:74"):
        assert part in told
    assert "speed^" not in told


@pytest.mark.parametrize("status", VerdictStatus)
@pytest.mark.parametrize("kind", Kind)
def test_every_kind_and_status_has_a_sentence(named: Diagnosis, kind: Kind, status: VerdictStatus) -> None:
    claims = () if kind in (Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS) else named.effects
    claims = tuple(replace(claim, equivalent=(E.FILM_HEATING,)) for claim in claims)
    text = statement(replace(named, kind=kind, status=status, effects=claims))
    assert text.endswith(".")
    assert "  " not in text
    assert "None" not in text
    if status is VerdictStatus.SUSPICION:
        assert "nothing is claimed" in text
    elif claims and status in (VerdictStatus.CLASS, VerdictStatus.INCOMPLETE):
        assert "Narrowed down to two causes" in text
        assert "Heating of the oil films in place of elastic opening fits this recording as well." in text
        assert ("A part of the mismatch remains that" in text) == (status is VerdictStatus.INCOMPLETE)


def test_an_incomplete_name_is_likely_and_not_sure(named: Diagnosis) -> None:
    one = replace(named, status=VerdictStatus.INCOMPLETE)
    assert "A part of the mismatch remains that it does not explain: the name is likely, not sure." in statement(one)
    two = replace(one, effects=(*one.effects, ClaimedEffect(E.CHURNING, None, 0.99, (), ())))
    assert "A part of the mismatch remains that they do not explain: the names are likely, not sure." in statement(two)
    beside = tuple(replace(claim, equivalent=(E.UNKNOWN_PHYSICS,)) for claim in one.effects)
    assert "A part of the mismatch remains that it does not explain." in statement(replace(one, effects=beside))


def test_a_claim_that_is_less_likely_than_not_is_no_likely_cause(named: Diagnosis) -> None:
    """The headline does not contradict "not sure"; one cause outside the catalogue is told once, of both claims."""
    first, heating, nothing = named.hypotheses
    both = replace(first, hypothesis=hypothesis(E.ELASTIC_OPENING, E.CHURNING), probability=0.19)
    unknown = replace(heating, hypothesis=hypothesis(E.UNKNOWN_PHYSICS, kind=Kind.UNKNOWN_PHYSICS), probability=0.53)
    claims = tuple(ClaimedEffect(one, None, 0.19, (E.UNKNOWN_PHYSICS,), ()) for one in (E.ELASTIC_OPENING, E.CHURNING))
    two = replace(named, effects=claims, hypotheses=(both, unknown, nothing))
    assert headline(two) == "Two possible causes, not sure."
    assert doubt(two) == (
        "A cause outside the catalogue (0.53) is likelier. It may be elastic opening and churning of oil in the case "
        "by another law."
    )
    one = replace(two, effects=(replace(claims[0], equivalent=()),))
    assert headline(one) == "A possible cause, not sure."
    alike = replace(one, effects=(replace(claims[0], equivalent=(E.FILM_HEATING,)),))
    assert headline(alike) == "Two possible causes, not sure."


def test_what_remains_and_what_to_read_again_is_told(named: Diagnosis) -> None:
    """The channel and the part of the map where readings stay off, or what the rest looks like."""
    region = MapRegion(ChannelName.Q_OUT, {}, {"speed": 1200.0 * RPM}, -3.3, "speed below 1200 rpm")
    off = replace(named, status=VerdictStatus.INCOMPLETE, next_point=None, left=(Remainder("..", region=region),))
    assert "Delivery flow (Q_out) still reads too low at speeds below 1200 r/min, by 3.3 sigma" in statement(off)
    assert "differs again: delivery flow (Q_out) at speeds below 1200 r/min." in measure_words(off)
    alike = replace(off, left=(Remainder("..", effect=E.CHURNING, score=4.2),))
    assert "What remains looks like churning of oil in the case (4.2 sigma)." in statement(alike)
    assert "again" not in measure_words(alike)
    grows = replace(off, left=(Remainder("it would have to grow with pressure by a power more of 0.9 +- 0.4"),))
    assert "It would have to grow with pressure by a power more of 0.9 +- 0.4." in statement(grows)


def test_of_which_pair_a_coefficient_is_is_told(named: Diagnosis) -> None:
    """Coefficients of friction have no gap: a rival of the same id at another pair stands beside the claim."""
    own = replace(hypothesis(E.FRICTION_COEFFICIENT), widened=("friction.rear_bearing",))
    other = replace(own, widened=("friction.front_bearing",))
    first, *_ = named.hypotheses
    weighed = (replace(first, hypothesis=own, probability=0.6), replace(first, hypothesis=other, probability=0.4))
    claim = ClaimedEffect(E.FRICTION_COEFFICIENT, None, 0.99, (), ())
    found = replace(named, kind=Kind.WRONG_PARAMETER, effects=(claim,), hypotheses=weighed)
    assert "most likely of rear bearing (0.6), else of front bearing (0.4)" in statement(found)
    assert "another friction coefficient (front bearing) 1:1.5" in " ".join(evidence(found))
    sure = replace(found, hypotheses=weighed[:1])
    assert "most likely" not in statement(sure)


def test_rivals_that_act_together_stand_each_at_its_place(named: Diagnosis) -> None:
    """Of an opening at the slippers beside churning, churning is at no gap."""
    both = replace(hypothesis(E.FILM_THICKNESS, E.CHURNING, pair=Gap.SLIPPER), widened=("film_thickness.slipper",))
    first, second, *_ = named.hypotheses
    found = replace(named, hypotheses=(first, replace(second, hypothesis=both)))
    assert "another film thickness at the slippers and churning of oil in the case 1:16" in " ".join(evidence(found))


def test_unknown_physics_counts_by_all_its_components(named: Diagnosis) -> None:
    first, second, *_ = named.hypotheses
    unknown = [
        replace(second, hypothesis=replace(hypothesis(E.UNKNOWN_PHYSICS), component=one), probability=0.2)
        for one in (Component.PLATE_LEAKAGE, Component.DISPLACEMENT)
    ]
    found = replace(named, status=VerdictStatus.SUSPICION, effects=(), hypotheses=(first, *unknown))
    assert "a cause outside the catalogue (0.4)" in statement(found)


@pytest.mark.parametrize("effect", [effect for effect in E if effect is not E.UNKNOWN_PHYSICS])
def test_every_effect_can_be_said(named: Diagnosis, effect: EffectId) -> None:
    text = statement(replace(named, effects=(ClaimedEffect(effect, None, 0.99, (), ()),)))
    assert f"({effect.value})" in text
    assert "{" not in text


def test_a_gap_that_cannot_be_told_is_told_with_its_rivals(named: Diagnosis) -> None:
    claim = replace(named.effects[0], elsewhere=((Gap.SLIPPER, 0.22),))
    found = replace(named, status=VerdictStatus.CLASS, effects=(claim,))
    text = statement(found)
    assert "Narrowed down to two causes." in text
    assert "This recording cannot tell the valve plate (0.78) from the slippers (0.22)." in text
    assert diagnosis_record(found)["effects"][0]["other_pairs"] == {"slipper": 0.22}


def test_two_causes_together_are_not_told_as_one_of_two(named: Diagnosis) -> None:
    """Both act; what is open is which of two the first is."""
    first = replace(named.effects[0], equivalent=(E.FILM_HEATING,))
    likeliest, *rest = named.hypotheses
    both = replace(likeliest, hypothesis=hypothesis(E.ELASTIC_OPENING, E.CHURNING))
    claims = (first, ClaimedEffect(E.CHURNING, None, 0.99, (), ()))
    found = replace(named, status=VerdictStatus.CLASS, effects=claims, hypotheses=(both, *rest))
    text = statement(found)
    assert "wo causes found, one of which cannot be told from others." in text
    assert "that it is these, or what cannot be told from them" in certainty(found, scant=False)
    assert "Narrowed down" not in text


def test_unknown_physics_is_told_with_what_it_is_most_like(named: Diagnosis) -> None:
    text = statement(replace(named, kind=Kind.UNKNOWN_PHYSICS, effects=()))
    assert text.startswith("A mismatch without a known cause.")
    assert "It lies most likely in the leakage of the valve plate." in text
    location = replace(named.location, inputs=(ChannelName.SPEED, ChannelName.P_CASE))
    text = statement(replace(named, kind=Kind.UNKNOWN_PHYSICS, effects=(), location=location))
    assert "the leakage of the valve plate and changes with speed and case pressure (p_case)." in text


def test_a_cause_outside_the_catalogue_may_be_in_the_class(named: Diagnosis) -> None:
    claim = replace(named.effects[0], equivalent=(E.UNKNOWN_PHYSICS,))
    second = replace(named.hypotheses[1], hypothesis=hypothesis(E.UNKNOWN_PHYSICS, kind=Kind.UNKNOWN_PHYSICS))
    weighed = (named.hypotheses[0], replace(second, probability=0.4))
    found = replace(named, status=VerdictStatus.CLASS, effects=(claim,), hypotheses=weighed, next_point=None)
    text = statement(found)
    assert measure_words(found) == "More points tell a law of the catalogue from a cause outside it."
    there = replace(found, location=replace(found.location, inputs=(ChannelName.SPEED,)))
    assert measure_words(there).startswith("More points at other values of speed tell")
    assert "A cause outside the catalogue (0.4) in place of elastic opening fits this recording as well." in text
    ahead = replace(weighed[1], probability=0.95)
    better = statement(replace(found, hypotheses=(weighed[0], ahead)))
    expected = "A cause outside the catalogue (0.95) is likelier. It may be elastic opening by another law."
    assert expected in better


def test_angles_and_times_are_part_of_where(named: Diagnosis) -> None:
    angle = AngleWindow(0.1, 0.3, 1e-3, ("delivery groove opens",))
    time = TimeMark(TimeKind.ONSET, Q, 39, 1e-4)
    found = replace(named, location=replace(named.location, angle=angle, time=time))
    assert "shaft angle 5.73 to 17.2 deg (delivery groove opens)" in statement(found)
    where = diagnosis_record(found)["where"]
    assert where["shaft_angle_deg"] == pytest.approx([5.7296, 17.1887], rel=1e-4)
    assert where["time"] == {"kind": "onset", "channel": "Q_case", "point": 40}
    assert "The difference in case drain begins at point 40." in statement(found)
    drift = replace(found, location=replace(found.location, time=replace(time, kind=TimeKind.DRIFT)))
    assert "The difference in case drain drifts in the course of the recording." in statement(drift)
    assert diagnosis_record(drift)["where"]["time"] == {"kind": "drift", "channel": "Q_case", "point": None}
    assert "shaft angle" not in statement(agreeing(found))
    lacking = DataNote(NoteKind.REMOVED, None, (1,), "an input of these points is missing")
    recording = SimpleNamespace(notes=(lacking,), steady=SimpleNamespace(values=np.zeros((60, 0)), rows=None))
    assert diagnosis_record(by_table_rows(found, recording))["where"]["time"]["point"] == 41


def test_temperatures_off_are_told_as_differences(named: Diagnosis) -> None:
    """An offset of 2 K is no temperature of -271 degC."""
    off = ClaimedEffect(E.T_CASE_OFFSET, None, 0.95, (), (Estimate("T_case.zero", 2.0, 0.3, Dimension.TEMPERATURE),))
    assert "The case thermometer reads 2.0 +- 0.3 K too high." in statement(
        replace(named, kind=Kind.SENSOR_FAULT, effects=(off,))
    )
    warm = replace(
        named.fit, before={ChannelName.T_OUT: 2.0}, after={ChannelName.T_OUT: 0.5}, noise={ChannelName.T_OUT: 0.4}
    )
    row = diagnosis_record(replace(named, fit=warm))["fit"]["heldout"]["T_out"]
    assert (row["before"], row["unit"]) == (pytest.approx(2.0), "K")


def test_the_file_has_the_form_of_format_1(named: Diagnosis, tmp_path: Path) -> None:
    """Keys, types and units of `diagnosis.json`, as docs/files.md has them."""
    path = tmp_path / "diagnosis.json"
    write_diagnosis(path, named, its_answer(named))
    record = read_diagnosis(path)
    assert record == json.loads(path.read_text("utf-8"))
    assert (record["verdict"], record["status"]) == ("missing_physics", "named")
    assert record["mismatch"]["channels"]["Q_case"] == {"chi2_per_dof": 17.0, "share": 0.97}
    assert record["where"]["pair"] == "valve_plate"
    assert record["effects"] == [
        {
            "id": "elastic_opening", "pair": "valve_plate", "probability": 0.93, "equivalent": [],
            "other_pairs": {}, "parameters": [{"name": "opening", "value": 2.2e-8, "sigma": 2e-9, "unit": "1/Pa"}],
        }
    ]  # fmt: skip
    assert record["hypotheses"][0]["heldout_rmse"] == pytest.approx(0.0156)
    assert record["hypotheses"][0]["bic"] == 40.0
    assert record["fit"]["heldout"]["Q_case"]["unit"] == "L/min"
    assert record["fit"]["heldout"]["Q_case"]["before"] == pytest.approx(0.06)
    assert record["next_test"]["point"]["p_out_bar"] == pytest.approx(370)
    assert record["next_test"]["point"]["speed_rpm"] == pytest.approx(999.8, abs=0.1)
    assert record["scaling"]["exponents"]["pressure"] == 2.1
    assert record["answer"]["headline"] == "Cause found."
    assert record["answer"]["look"][0]["id"] == "elastic_opening"


def test_the_file_has_every_key_of_the_stated_form(named: Diagnosis) -> None:
    """The example of recordings/README.md: its keys at every level, values of its kinds."""
    form = Path(__file__).parents[4] / "shared" / "recordings" / "README.md"
    if not form.is_file():
        pytest.skip(f"no shared reference material at {form.parent}")
    text = form.read_text("utf-8")
    example = json.loads(
        text[text.index("```json") + 7 : text.index("```", text.index("```json") + 7)].replace("...", "")
    )
    record = diagnosis_record(named)
    assert set(example) <= set(record)
    _same_form(example, record)


def _same_form(example: Any, record: Any, where: str = "diagnosis") -> None:
    if isinstance(example, dict):
        assert set(example) <= set(record), where
        for key, value in example.items():
            _same_form(value, record[key], f"{where}.{key}")
    elif isinstance(example, list) and example:
        assert record, where
        _same_form(example[0], record[0], f"{where}[0]")
    elif example is not None:
        kinds = (int, float) if isinstance(example, int | float) else type(example)
        assert isinstance(record, kinds), where


def test_agreement_claims_nothing(named: Diagnosis, tmp_path: Path) -> None:
    found = agreeing(named)
    assert statement(found).startswith("No mismatch. Simulation and recording agree")
    record = diagnosis_record(found)
    assert (record["effects"], record["next_test"], record["where"]["channels"]) == ([], None, [])


@pytest.mark.parametrize(
    ("text", "fault"), [("{}", "format"), ('{"format": 1}', "verdict"), ("[", "file"), ("[]", "list")]
)
def test_a_file_without_a_diagnosis_is_refused(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "diagnosis.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputFaults, match=fault):
        read_diagnosis(path)


@pytest.mark.parametrize(
    ("stated", "told"), [(None, "earlier version"), ({"headline": ""}, "none"), ({"format": 0}, "0")]
)
def test_a_run_of_another_version_is_refused_with_the_remedy(
    named: Diagnosis, tmp_path: Path, stated: dict[str, Any] | None, told: str
) -> None:
    """Found, expected and the command to run again, where the answer in plain words is of another form."""
    path = tmp_path / "diagnosis.json"
    write_diagnosis(path, named, its_answer(named))
    record = json.loads(path.read_text("utf-8"))
    del record["answer"]
    path.write_text(json.dumps(record | ({} if stated is None else {"answer": stated})), encoding="utf-8")
    with pytest.raises(InputFaults) as caught:
        read_diagnosis(path)
    (fault,) = caught.value.faults
    assert told in fault.found
    assert fault.expected == "an answer of format 1"
    assert "swashfilm diagnose PUMP RECORDING" in fault.nearest
