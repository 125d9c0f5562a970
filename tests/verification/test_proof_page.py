"""How the proof judges: right, wrong and grave verdicts; gates that can fail; a page with its thresholds."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from diagnosis.thresholds import load_thresholds

ROOT = Path(__file__).resolve().parents[2]


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
    """Another gap or another id is a wrong name, grave where it is sure and unflagged; a null's name always is."""
    judged, claimed = proof.judged, proof.outcome.Claimed
    one_of = replace(right, claims=(claimed("elastic_opening", "piston", 0.97, (), ("slipper",)),), status="class")
    assert judged.is_right(one_of)
    assert not judged.is_wrong_name(one_of)
    gap = replace(right, claims=(claimed("elastic_opening", "piston", 0.97, ()),))
    assert not judged.is_right(gap)
    assert judged.is_grave(gap)
    other = replace(right, claims=(claimed("churning", None, 0.97, ()),))
    assert judged.is_grave(other)
    assert not judged.is_grave(replace(other, status="incomplete"))
    assert not judged.is_grave(replace(other, claims=(claimed("churning", None, 0.6, ()),)))
    null = replace(other, truth="no_mismatch", effects=(), pairs=())
    assert judged.is_grave(null)


def test_part_of_the_truth_is_not_wrong(proof: SimpleNamespace, right: object) -> None:
    """One of two effects is incomplete: neither right nor wrong."""
    pair = replace(right, effects=("elastic_opening", "churning"), pairs=("slipper", None))
    assert not proof.judged.is_right(pair)
    assert not proof.judged.is_wrong_name(pair)


def test_the_truth_has_a_place(proof: SimpleNamespace, right: object) -> None:
    """First where it is named; in the 95 % set by its probability; nowhere where it was not weighed."""
    second = replace(right, effects=("film_heating",), pairs=(None,))
    assert [proof.judged.rank(right), proof.judged.rank(second)] == [1, 2]
    assert proof.judged.in_set(right)
    assert not proof.judged.in_set(second)
    assert proof.judged.rank(replace(right, effects=("churning",), pairs=(None,))) is None


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
    assert proof.gates.wilson(3, 100) == pytest.approx((0.0103, 0.0845), abs=1e-4)
    assert proof.gates.wilson(0, 200) == pytest.approx((0.0, 0.0188), abs=1e-4)


def test_calibration_of_one_case(proof: SimpleNamespace, right: object) -> None:
    """Told .97 and true: Brier .03^2, error .03."""
    assert proof.calibration.brier([right]) == pytest.approx(0.0009)
    assert proof.calibration.calibration_error([right]) == pytest.approx(0.03)


def test_outcomes_outlast_a_break(proof: SimpleNamespace, right: object, tmp_path: Path) -> None:
    """What was kept is what is loaded, under the case's own key; another seed has none."""
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

    One of which the verdict says that no point settles it is counted beside; where a promise fails the gate does.
    """
    left_open = replace(right, worth=proof.outcome.Worth(1.0, 4.0, 0.5, 0.9))
    settled = replace(right, worth=proof.outcome.Worth(6.0, 0.0, 0.0, 0.9))
    beyond = replace(right, worth=proof.outcome.Worth(1.0, 0.1, 0.0, 0.02))
    found = {gate.name: gate for gate in proof.gates.gates([left_open, settled, beyond])}
    by_asked = found["pairs settled by the point asked for, 3 readings"]
    by_other = found["the same by a point drawn at random"]
    assert (by_asked.passed, by_asked.cases) == (True, 1)
    assert by_asked.found.endswith("; 1 more told to be settled by no point")
    assert (by_other.passed, by_other.cases) == (True, 1)
    broken = replace(right, worth=proof.outcome.Worth(1.0, 0.5, 0.5, 0.9))
    assert next(one for one in proof.gates.gates([broken]) if one.name == by_asked.name).passed is False


def test_a_fit_is_held_against_the_truths_own(proof: SimpleNamespace, right: object) -> None:
    """Left 1.2 of the noise where the truth's own fit leaves 1: 20 % more, missed."""
    found = replace(right, heldout={"Q_case": (2.0, 1.2, 1.0)}, oracle={"Q_case": 1.0})
    gate = next(one for one in proof.gates.gates([found]) if "truth's own fit" in one.name)
    assert gate.passed is False
    assert gate.found.startswith("1.20")
