"""Judgement of the proof: right, wrong and grave verdicts; gates that can fail; a page with its thresholds."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from diagnosis import load_thresholds

ROOT = Path(__file__).resolve().parents[4]


@pytest.fixture
def right(proof: SimpleNamespace) -> object:
    """An opening of the slipper's film at z = 8, named."""
    made = proof.outcome
    return made.Outcome(
        name="opening_slipper", part="graded", campaign="map", seed=1, asked=8.0, score=8.0, sizes={},
        truth="missing_physics", effects=("elastic_opening",), pairs=("slipper",), shares={"Q_case": 0.9},
        verdict="missing_physics", status="named",
        claims=(made.Claimed("elastic_opening", "slipper", 0.97, ()),),
        ranked=(
            made.Ranked(("elastic_opening",), ("slipper",), "missing_physics", 0.97),
            made.Ranked(("film_heating",), (None,), "missing_physics", 0.03),
        ),
        nothing=0.0, channels=("Q_case",), heldout={"Q_case": (2.0, 1.0, 1.0)}, covered={"viscosity": True},
        chi2=(2.0, 1.0), chance=1e-9, reasons=(), rivals={}, seconds=1.0, program="x",
    )  # fmt: skip


def test_a_right_verdict(proof: SimpleNamespace, right: object) -> None:
    """Named with its gap, without one, or in a class that holds it; never by a suspicion."""
    judged, claimed = proof.judged, proof.outcome.Claimed
    assert judged.is_right(right)
    assert judged.is_right(replace(right, claims=(claimed("elastic_opening", None, 0.97, ()),)))
    kin = claimed("film_heating", None, 0.95, ("elastic_opening",))
    assert judged.is_right(replace(right, claims=(kin,), status="class"))
    assert not judged.is_right(replace(right, claims=(), status="suspicion"))
    assert not judged.is_right(replace(right, claims=(*right.claims, kin)))


def test_a_wrong_verdict(proof: SimpleNamespace, right: object) -> None:
    """Another gap or another id is a wrong name, grave where it is sure and unflagged, its class together."""
    judged, claimed = proof.judged, proof.outcome.Claimed
    one_of = replace(right, claims=(claimed("elastic_opening", "piston", 0.97, (), ("slipper",)),), status="class")
    assert judged.is_right(one_of)
    assert not judged.is_wrong_name(one_of)
    gap = replace(right, claims=(claimed("elastic_opening", "piston", 0.97, ()),))
    assert not judged.is_right(gap)
    assert judged.is_right(replace(gap, pairs=(None,)))  # of a plant that has no gaps
    assert judged.is_grave(gap)
    other = replace(right, claims=(claimed("churning", None, 0.97, ()),))
    assert judged.is_grave(other)
    assert not judged.is_grave(replace(other, status="incomplete"))
    ranked = tuple(proof.outcome.Ranked((one,), (None,), "missing_physics", 0.47) for one in ("churning", "seal_drag"))
    of_a_class = replace(
        other, claims=(claimed("churning", None, 0.47, ("seal_drag",)),), status="class", ranked=ranked
    )
    assert judged.is_grave(of_a_class)
    null = replace(other, truth="no_mismatch", effects=(), pairs=())
    assert judged.is_grave(null)


def test_part_of_the_truth_is_not_wrong(proof: SimpleNamespace, right: object) -> None:
    """One of two effects is incomplete: neither right nor wrong."""
    pair = replace(right, effects=("elastic_opening", "churning"), pairs=("slipper", None))
    assert not proof.judged.is_right(pair)
    assert not proof.judged.is_wrong_name(pair)


def test_a_wrong_gap_of_a_pair_is_wrong(proof: SimpleNamespace, right: object) -> None:
    """At a gap of neither effect; one id at two gaps is right at both."""
    claimed = proof.outcome.Claimed
    pair = replace(right, effects=("elastic_opening", "churning"), pairs=("slipper", None))
    told = (claimed("elastic_opening", "piston", 0.97, ()), claimed("churning", None, 0.97, ()))
    assert proof.judged.is_grave(replace(pair, claims=told))
    twice = replace(right, effects=("elastic_opening", "elastic_opening"), pairs=("slipper", "piston"))
    both = tuple(claimed("elastic_opening", gap, 0.97, ()) for gap in ("piston", "slipper"))
    assert not proof.judged.is_wrong_name(replace(twice, claims=both))


def test_only_a_wrong_claim_is_wrong_and_sure(proof: SimpleNamespace, right: object) -> None:
    """A doubtful wrong claim beside a certain right one is wrong, and not sure."""
    doubted = proof.outcome.Claimed("churning", None, 0.3, ())
    told = replace(right, claims=(*right.claims, doubted))
    assert proof.judged.is_wrong_name(told)
    assert not proof.judged.is_sure_and_wrong(told)
    assert proof.judged.is_sure_and_wrong(replace(told, claims=(*right.claims, replace(doubted, probability=0.9))))


def test_the_truth_has_a_place(proof: SimpleNamespace, right: object) -> None:
    """First where it is named; in the 95 % set by its probability; nowhere where it was not weighed."""
    second = replace(right, effects=("film_heating",), pairs=(None,))
    assert [proof.judged.rank(right), proof.judged.rank(second)] == [1, 2]
    assert proof.judged.in_set(right)
    assert not proof.judged.in_set(second)
    assert proof.judged.rank(replace(right, effects=("churning",), pairs=(None,))) is None
    elsewhere = replace(right, pairs=("piston",))
    assert proof.judged.rank(elsewhere) == 2
    assert not proof.judged.in_set(elsewhere)


def test_gates_hold_and_fail(proof: SimpleNamespace, right: object) -> None:
    """One right case holds what it can; the same case wrong misses top-1 and the grave error, failed first."""
    held = {gate.name: gate.passed for gate in proof.gates.gates([right])}
    assert held["top-1 at z >= 8"]
    assert held["wrong, P >= 0.9 and unflagged, all cases"]
    assert held["false alarm on nulls: something is claimed"] is None
    claim = proof.outcome.Claimed("churning", None, 0.97, ())
    first = proof.outcome.Ranked(("churning",), (None,), "missing_physics", 0.97)
    found = proof.gates.gates([replace(right, claims=(claim,), ranked=(first,))])
    missed = {gate.name for gate in found if gate.passed is False}
    assert {"top-1 at z >= 8", "wrong, P >= 0.9 and unflagged, all cases"} <= missed
    assert found[0].passed is False


def test_wilson_interval(proof: SimpleNamespace) -> None:
    """Wilson (1927), 3 of 100: 1.0 % to 8.5 %; none of 200: 0 to 1.9 %."""
    assert proof.calibration.wilson(3, 100) == pytest.approx((0.0103, 0.0845), abs=1e-4)
    assert proof.calibration.wilson(0, 200) == pytest.approx((0.0, 0.0188), abs=1e-4)


def test_calibration_of_one_case(proof: SimpleNamespace, right: object) -> None:
    """Told .97 and true: Brier .03^2, error .03."""
    assert proof.calibration.brier([right]) == pytest.approx(0.0009)
    assert proof.calibration.calibration_error([right]) == pytest.approx(0.03)


def test_cases_of_unlike_weight_tell_less(proof: SimpleNamespace, right: object) -> None:
    """Nine of a kind and one of another: less than ten (Kish 1965); of one kind all."""
    rare = replace(right, truth="sensor_fault")
    (found,) = proof.calibration.bins([*[right] * 9, rare])
    shares = proof.calibration.MIX["missing_physics"], proof.calibration.MIX["sensor_fault"]
    assert found.cases == 10
    assert found.alike == pytest.approx(sum(shares) ** 2 / (shares[0] ** 2 / 9 + shares[1] ** 2))
    (alone,) = proof.calibration.bins([right] * 9)
    assert alone.alike == pytest.approx(9.0)


@pytest.mark.parametrize(("effects", "true"), [(("elastic_opening",), True), (("churning",), False)])
def test_a_claim_is_scored_as_it_is_told(
    proof: SimpleNamespace, right: object, effects: tuple[str, ...], true: bool
) -> None:
    """A claimed where A with B is likelier: all explanations that hold A count, and A has to be concealed."""
    ranked = tuple(
        proof.outcome.Ranked(ids, (None,) * len(ids), "missing_physics", share)
        for ids, share in ((("elastic_opening", "squeeze_pumping"), 0.6), (("elastic_opening",), 0.3), (("air",), 0.1))
    )
    told = replace(right, ranked=ranked, effects=effects, pairs=(None,))
    assert proof.judged.confidence(told) == (pytest.approx(0.9), true)
    both = replace(told, claims=(*told.claims, proof.outcome.Claimed("squeeze_pumping", None, 0.6, ())))
    assert proof.judged.confidence(both) == (0.6, False)


def test_outcomes_outlast_a_break(proof: SimpleNamespace, right: object, tmp_path: Path) -> None:
    """A kept outcome is loaded under the case's own key; another seed has none."""
    case = proof.cases.cases(proof.cases.Part.NULL, 52)[0]
    proof.store.keep(tmp_path, proof.store.name_of(case), right)
    assert proof.store.load(tmp_path, proof.store.name_of(case)) == right
    assert proof.store.load(tmp_path, proof.store.name_of(replace(case, seed=1))) is None
    assert not list(tmp_path.glob("*.tmp"))


def test_the_page_tells_its_thresholds(proof: SimpleNamespace, tmp_path: Path) -> None:
    """Without a case too: the hash of the thresholds; docs/proof.md tells that of the file as it is."""
    proof.page.write_page(tmp_path, tmp_path / "proof.md", 52)
    digest = load_thresholds().digest
    assert digest in (tmp_path / "proof.md").read_text("utf-8")
    assert digest in (ROOT / "docs" / "proof.md").read_text("utf-8"), "python benchmarks/proof.py --cases 0"


def test_a_region_is_as_good_as_its_points(proof: SimpleNamespace, right: object) -> None:
    """Six points moved by more than half of the most, four of them told and two beside: 4/8."""
    moved = {"Q_case": (0.0, 0.0, 0.4, 0.4, 1.0, 1.0, -1.0, 0.8, 0.8, 0.6)}
    told = replace(right, shift=moved, region=(2, 3, 4, 5, 6, 7))
    assert proof.located.region_overlap(told) == pytest.approx(4.0 / 8.0)
    assert proof.located.region_overlap(replace(told, region=tuple(range(4, 10)))) == 1.0
    assert math.isnan(proof.located.region_overlap(replace(told, region=None)))


def test_an_angle_is_off_across_the_dead_centre(proof: SimpleNamespace, right: object) -> None:
    """358 to 2 deg against 6 to 10 deg: 8 deg."""
    turns = [tuple(math.radians(angle) for angle in ends) for ends in ((358.0, 2.0), (6.0, 10.0))]
    found = replace(right, turn=turns[0], true_turn=turns[1])
    assert proof.located.turn_error(found) == pytest.approx(8.0)
    assert proof.located.turn_error(replace(found, turn=turns[1])) == pytest.approx(0.0)
    both = tuple(math.radians(angle) for angle in (181.0, 2.0))  # two transitions: either is right
    assert proof.located.turn_error(replace(found, true_turn=both, turn=turns[1])) == pytest.approx(6.0)


def test_a_point_is_worth_what_it_settles(proof: SimpleNamespace, right: object) -> None:
    """Left open at 1 nat: the point asked for brings 4, a random one .5; one settled before is not counted.

    One of which the verdict says that no point settles it is, but not among those that it promises to settle.
    """
    left_open = replace(right, worth=proof.outcome.Worth(1.0, 4.0, 0.5, 0.9))
    settled = replace(right, worth=proof.outcome.Worth(6.0, 0.0, 0.0, 0.9))
    beyond = replace(right, worth=proof.outcome.Worth(1.0, 0.1, 0.0, 0.02))
    found = {gate.name: gate for gate in proof.gates.gates([left_open, settled, beyond])}
    by_asked = found["open pairs settled by what is asked for"]
    promised = found["open pairs settled where the verdict says so"]
    by_other = found["open pairs settled by random points"]
    assert (by_asked.passed, by_asked.cases) == (False, 2)
    assert (promised.passed, promised.cases) == (True, 1)
    assert (by_other.passed, by_other.cases) == (True, 2)
    broken = replace(right, worth=proof.outcome.Worth(1.0, 0.5, 0.5, 0.9))
    assert next(one for one in proof.gates.gates([broken]) if one.name == promised.name).passed is False


def test_a_fit_is_held_against_the_truths_own(proof: SimpleNamespace, right: object) -> None:
    """Left 1.2 of the noise where the truth's own fit leaves 1: 20 % more, missed."""
    found = replace(right, heldout={"Q_case": (2.0, 1.2, 1.0)}, oracle={"Q_case": 1.0})
    gate = next(one for one in proof.gates.gates([found]) if "truth's own fit" in one.name)
    assert gate.passed is False
    assert gate.found.startswith("1.20")


def test_a_fit_without_the_truths_own_is_missed(proof: SimpleNamespace, right: object) -> None:
    """A case for which the truth's law could not be fitted counts as missed, and is told."""
    found = replace(right, oracle={})
    gate = next(one for one in proof.gates.gates([found]) if "truth's own fit" in one.name)
    assert gate.passed is False


def test_gates_of_small_sizes_and_gaps(proof: SimpleNamespace, right: object) -> None:
    """At z = 3 no mismatch is no suspicion; a gap claimed wrong is missed though the name is not right."""
    small = replace(right, score=3.0, claims=(), effects=("elastic_opening",), verdict="no_mismatch")
    doubted = replace(small, verdict="missing_physics", status="suspicion")
    gate = next(one for one in proof.gates.gates([small, doubted]) if "at z = 3" in one.name and "class" in one.name)
    assert gate.found.startswith("50.0% (1 of 2")
    assert gate.found.endswith("1 more with the verdict no mismatch")
    elsewhere = replace(right, claims=(proof.outcome.Claimed("elastic_opening", "piston", 0.97, ()),))
    gap = next(one for one in proof.gates.gates([right, elsewhere]) if one.name.startswith("gap claimed"))
    assert gap.found.startswith("50.0% (1 of 2")


def test_gates_of_kinds(proof: SimpleNamespace, right: object) -> None:
    """A sensor's fault called physics, named or unknown; a recording that came to no diagnosis."""
    fault = replace(right, part="sensor", truth="sensor_fault", effects=("Q_case_gain",), pairs=(None,))
    strange = replace(fault, verdict="unknown_physics", claims=())
    gates = {gate.name: gate for gate in proof.gates.gates([fault, strange, replace(fault, verdict="none")])}
    assert gates["sensor called physics"].found.startswith("100.0% (2 of 2")
    assert gates["no diagnosis, all cases"].passed is False


def test_unknown_physics_is_recognised_in_the_class_of_every_claim(proof: SimpleNamespace, right: object) -> None:
    """A verdict of its own, a class that holds it, a name without it, one of two names without it."""
    claimed = proof.outcome.Claimed
    strange = replace(right, part="unknown", truth="unknown_physics", effects=(), pairs=())
    told = replace(strange, verdict="unknown_physics", claims=())
    inside, closed = claimed("churning", None, 0.6, ("unknown_physics",)), claimed("seal_drag", None, 0.6, ())
    classes = ((inside,), (closed,), (inside, closed))
    cases = [told, *(replace(strange, status="class", claims=each) for each in classes)]
    assert [proof.judged.is_right(one) for one in cases] == [True, True, False, False]
    assert [proof.judged.is_wrong_name(one) for one in cases] == [False, False, True, True]
    gates = {gate.name: gate for gate in proof.gates.gates(cases)}
    assert gates["unknown physics recognised at z >= 8"].found.startswith("50.0% (2 of 4")
    assert gates["unknown physics recognised at z >= 8"].found.endswith("1 of them in the class of a name")
    assert gates["unknown physics given a name at z >= 8"].found.startswith("50.0% (2 of 4")


def test_what_nulls_leave_is_no_ones_to_remove(proof: SimpleNamespace, right: object) -> None:
    """Nulls leave 1.1 of the noise's square; of 4 a fit leaves 1.39: nine tenths of 2.9 with it, .87 without."""
    null = replace(right, part="null", truth="no_mismatch", effects=(), pairs=(), claims=(), score=0.0,
                   verdict="no_mismatch", heldout={"Q_case": (1.1**0.5, 1.1**0.5, 1.0)})  # fmt: skip
    found = replace(right, heldout={"Q_case": (2.0, 1.39**0.5, 1.0)})
    gates = {gate.name: gate for gate in proof.gates.gates([null, found])}
    assert gates["removed share of the residual beyond the stated noise"].found.startswith("0.87")
    pooled = gates["removed share, all right names together, of the residual beyond that of nulls"]
    assert pooled.found == "0.90 of 1 (0.90 to 0.90)"
    assert proof.removed.removed_of_all([found], proof.removed.left_by_nothing([null]))[0] == pytest.approx(0.9)


def test_coverage_tells_its_parts(proof: SimpleNamespace, right: object) -> None:
    """Nine of ten intervals of nulls, none of one of a graded case: 82 %, missed."""
    null = replace(right, part="null", covered={str(k): k > 0 for k in range(10)})
    gate = next(one for one in proof.gates.gates([null, replace(right, covered={"viscosity": False})])
                if one.name.startswith("90 % intervals"))  # fmt: skip
    assert gate.passed is False
    assert gate.found == "81.8% of 11: null 90% of 10, graded 0% of 1"


def test_the_page_tells_every_case(proof: SimpleNamespace, right: object, tmp_path: Path) -> None:
    """A null and a graded case kept under their names: gates, sizes, rivals, the case's verdict with its gaps."""
    null, graded = (proof.cases.cases(part, 52)[0] for part in (proof.cases.Part.NULL, proof.cases.Part.GRADED))
    seen = {"largest residual": proof.outcome.Rival(True, ("elastic_opening",))}
    claim = proof.outcome.Claimed("elastic_opening", "slipper", 0.97, (), ("valve_plate",))
    nothing = replace(right, part="null", truth="no_mismatch", effects=(), pairs=(), claims=(), score=0.0,
                      verdict="no_mismatch", rivals=seen)  # fmt: skip
    proof.store.keep(tmp_path, proof.store.name_of(null), nothing)
    proof.store.keep(
        tmp_path, proof.store.name_of(graded), replace(right, claims=(claim,), status="class", rivals=seen)
    )
    proof.page.write_page(tmp_path, tmp_path / "proof.md", 52)
    text = (tmp_path / "proof.md").read_text("utf-8")
    planned = sum(len(proof.cases.cases(part, 52)) for part in proof.cases.Part)
    assert f"2 of {planned} cases have been run" in text
    assert "| right | missing_physics, class: elastic_opening (slipper) 0.97 or at valve_plate |" in text
    assert "| largest residual, usual suspect | 1 of 1 | 1 of 1 | 1 of 1 | - |" in text
    assert "| graded | 8 | 1 | 1 | 0 | 1 | 0 | 0 |" in text


def test_the_mix_is_the_one_of_the_thresholds(proof: SimpleNamespace) -> None:
    """Shares of the kinds of truth are the priors that a diagnosis has."""
    prior = load_thresholds().prior
    kinds = (prior.none, prior.missing_physics, prior.sensor_fault, prior.wrong_parameter, prior.unknown_physics)
    assert tuple(proof.calibration.MIX.values()) == pytest.approx(kinds)
