"""Cases of the proof's second and third plant: what is true of them, how they are kept, scored, judged and shown."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest


@pytest.fixture(scope="module")
def wide(proof: SimpleNamespace) -> SimpleNamespace:
    """Modules that both plants share."""
    assert proof is not None
    return SimpleNamespace(
        **{name: import_module(f"proof.wide.{name}") for name in ("case", "gates", "page", "scoring")}
    )


@pytest.fixture
def right(proof: SimpleNamespace) -> object:
    """Churning beside a drain meter that drifts, z = 8, named with it."""
    made = proof.outcome
    return made.Outcome(
        name="churning", part="other-graded", campaign="map", seed=1, asked=8.0, score=8.0, sizes={},
        truth="missing_physics", effects=("churning",), pairs=(None,), shares={"torque": 1.0},
        beside=("Q_case_drift",), verdict="missing_physics", status="named",
        claims=(made.Claimed("churning", None, 0.97, ()), made.Claimed("Q_case_drift", None, 0.97, ())),
        ranked=(made.Ranked(("churning", "Q_case_drift"), (None, None), "missing_physics", 0.97),),
        heldout={"torque": (2.0, 1.0, 1.0)},
    )  # fmt: skip


def _secret(wide: SimpleNamespace, what: str, id: str) -> object:
    return wide.case.Secret(wide.case.What[what], f"{id or 'strange'}", id, None, 1.0, 1.0)


def test_the_truth_follows_from_the_secrets(proof: SimpleNamespace, wide: SimpleNamespace) -> None:
    """Physics before faults, which are then beside it; faults alone; nothing; what is in no catalogue."""
    physics, fault = _secret(wide, "EFFECT", "churning"), _secret(wide, "FAULT", "Q_case_drift")
    strange, part = _secret(wide, "EFFECT", ""), _secret(wide, "PART", "bulk_modulus")

    def of(*secrets: object) -> tuple[object, ...]:
        case = wide.case.WideCase(proof.parts.Part.OTHER_SENSOR, "map", 1, secrets)
        return case.truth, tuple(one.id for one in case.main), case.beside

    assert of() == ("no_mismatch", (), ())
    assert of(physics, fault) == ("missing_physics", ("churning",), ("Q_case_drift",))
    assert of(fault) == ("sensor_fault", ("Q_case_drift",), ())
    assert of(part) == ("wrong_parameter", ("bulk_modulus",), ())
    assert of(strange) == ("unknown_physics", (), ())


def test_every_part_has_its_cases(proof: SimpleNamespace) -> None:
    """Over 100 nulls, effects at five scores, pairs, triples, faults alone and beside: no seed, no file twice."""
    part = proof.parts.Part
    listed = {one: proof.cases.cases(one, 52) for one in part if one.plant is not proof.parts.Plant.FIRST}
    for nulls, graded in ((part.OTHER_NULL, part.OTHER_GRADED), (part.ROUGH_NULL, part.ROUGH_EFFECT)):
        assert len(listed[nulls]) >= 100
        own = [case for case in listed[graded] if case.score]
        assert {case.score for case in own} == {3.0, 5.0, 8.0, 15.0, 30.0}
        assert len({(case.secrets[0].label, case.score) for case in own}) == len(own)
    for pair, triple in ((part.OTHER_PAIR, part.OTHER_TRIPLE), (part.ROUGH_PAIR, part.ROUGH_TRIPLE)):
        assert all(len({one.id for one in case.secrets}) == 2 for case in listed[pair])
        assert all(len({one.id for one in case.secrets}) == 3 for case in listed[triple])
    every = [case for cases in listed.values() for case in cases]
    assert len({(case.part.plant, case.seed) for case in every}) == len(every)
    assert len({proof.store.name_of(case) for case in every}) == len(every)
    assert any(case.beside for case in listed[part.OTHER_SENSOR])
    assert any(case.beside for case in listed[part.ROUGH_SENSOR])


def test_a_file_is_named_by_the_case_and_the_version(proof: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another seed, another size, another version: another file; no source counts."""
    case = proof.cases.cases(proof.parts.Part.ROUGH_EFFECT, 52)[0]
    name = proof.store.name_of(case)
    assert name.startswith(f"rough-effect-{case.seed}-")
    assert proof.store.name_of(replace(case, seed=case.seed)) == name
    larger = replace(case.secrets[0], size=2.0 * case.secrets[0].size)
    assert proof.store.name_of(replace(case, secrets=(larger,))) != name
    monkeypatch.setitem(proof.store.VERSIONS, proof.parts.Plant.ROUGH, 99)
    assert proof.store.name_of(case) != name


def test_a_score_is_what_nuisances_leave(wide: SimpleNamespace) -> None:
    """Against the formula on a random case; without nuisances the length in sigma."""
    rng = np.random.default_rng(3)
    sigma, shared, own = rng.uniform(0.5, 2.0, (6, 2)), rng.normal(size=(3, 6, 2)), rng.normal(size=(2, 6, 2))
    moved = rng.normal(size=(6, 2))
    covariance = np.diag(sigma.ravel() ** 2)
    for column in shared:
        covariance += np.outer(column.ravel(), column.ravel())
    for column in own:
        for k in range(6):
            alone = np.zeros((6, 2))
            alone[k] = column[k]
            covariance += np.outer(alone.ravel(), alone.ravel())
    expected = float(np.sqrt(moved.ravel() @ np.linalg.solve(covariance, moved.ravel())))
    assert wide.scoring.whitening(sigma, shared, own).z(moved) == pytest.approx(expected)
    alone = wide.scoring.whitening(sigma, 0.0 * shared).z(moved)
    assert alone == pytest.approx(float(np.linalg.norm(moved / sigma)))


def test_sizes_count_what_others_cannot_make(wide: SimpleNamespace) -> None:
    """Two columns at 30 deg: each needs twice the size that it needs alone; one bounded stays below what is asked."""
    columns = np.array([[1.0, 0.0, 0.0], [np.cos(np.pi / 6.0), np.sin(np.pi / 6.0), 0.0]])

    def white(k: int, factor: float) -> np.ndarray:
        return factor * columns[k]

    assert wide.scoring.apart(list(columns)) == pytest.approx([0.5, 0.5])
    factors, scores = wide.scoring.sizes(8.0, white, [np.inf, np.inf])
    assert factors == pytest.approx([16.0, 16.0], rel=0.04)
    assert scores == pytest.approx([8.0, 8.0], rel=0.04)
    factors, scores = wide.scoring.sizes(8.0, white, [10.0, np.inf])
    assert (factors[0], scores[0]) == pytest.approx((10.0, 5.0))
    assert wide.scoring.sizes(0.0, white, [1.0]) == ([1.0], [1.0])


def test_a_fault_beside_physics_may_be_named(proof: SimpleNamespace, right: object) -> None:
    """With it or without it the verdict is right, and the truth the first; the fault alone is not right."""
    judged = proof.judged
    assert judged.is_right(right)
    assert judged.rank(right) == 1
    assert judged.in_set(right)
    assert judged.confidence(right) == (0.97, True)
    alone = replace(right, claims=right.claims[:1])
    assert judged.is_right(alone)
    fault = replace(right, claims=right.claims[1:])
    assert not judged.is_right(fault)
    assert not judged.is_wrong_name(fault)


def test_wrong_and_sure_counts_flagged_or_not(proof: SimpleNamespace, right: object) -> None:
    """A wrong name of .95 is sure though it is flagged as incomplete; one of .6 is not, a suspicion claims nothing."""
    claimed, sure = proof.outcome.Claimed, proof.judged.is_sure_and_wrong
    flagged = replace(right, status="incomplete", claims=(claimed("seal_drag", None, 0.95, ()),))
    assert sure(flagged)
    assert not proof.judged.is_grave(flagged)
    assert not sure(replace(flagged, claims=(claimed("seal_drag", None, 0.6, ()),)))
    assert not sure(replace(right, status="suspicion", claims=()))
    assert not sure(right)
    ranked = tuple(
        proof.outcome.Ranked(("unknown_physics",), (None,), "unknown_physics", share) for share in (0.5, 0.45)
    )
    unknown = replace(right, verdict="unknown_physics", claims=(), ranked=ranked)
    assert sure(unknown)
    assert not sure(replace(unknown, ranked=ranked[:1]))  # as of a pump known by its type plate: named, not sure


def test_gates_on_three_plants(wide: SimpleNamespace, proof: SimpleNamespace, right: object) -> None:
    """One right case holds what it can on its own plant alone; one wrong misses."""
    single = replace(right, beside=(), claims=right.claims[:1], ranked=(
        proof.outcome.Ranked(("churning",), (None,), "missing_physics", 0.97),))  # fmt: skip
    found = wide.gates.by_plant([single])
    passed = {plant.value: {gate.name: gate.passed for gate in own} for plant, own in found.items()}
    assert passed["other"]["top-1 at z >= 8"]
    assert passed["other"]["truth in the 95 % set, at the worst size"]
    assert passed["rough"]["top-1 at z >= 8"] is None
    wrong = replace(single, claims=(proof.outcome.Claimed("seal_drag", None, 0.97, ()),), part="rough-effect",
                    ranked=(proof.outcome.Ranked(("seal_drag",), (None,), "missing_physics", 1.0),))  # fmt: skip
    missed = {gate.name for gate in wide.gates.by_plant([wrong])[proof.parts.Plant.ROUGH] if gate.passed is False}
    assert {"top-1 at z >= 8", "wrong and P >= 0.9, flagged or not", "calibration error (ECE)"} <= missed
    null = replace(single, part="other-null", truth="no_mismatch", effects=(), pairs=(), claims=(), score=0.0,
                   asked=0.0, verdict="missing_physics", status="suspicion")  # fmt: skip
    gates = {gate.name: gate.passed for gate in wide.gates.wide_gates([null])}
    assert gates["nulls without a claim"]
    assert gates["nulls without a suspicion"] is False


def test_the_page_has_a_column_a_plant(proof: SimpleNamespace, right: object, tmp_path: Path) -> None:
    """An outcome of the second plant: its gates, its case; outcomes of the first alone need no such section."""
    case = proof.cases.cases(proof.parts.Part.OTHER_GRADED, 52)[0]
    proof.store.keep(tmp_path, proof.store.name_of(case), right)
    kept = proof.store.load(tmp_path, proof.store.name_of(case))
    assert kept == right
    proof.page.write_page(tmp_path, tmp_path / "proof.md", 52)
    text = (tmp_path / "proof.md").read_text("utf-8")
    assert "| gate | required | first plant | other laws | rough |" in text
    row = next(line for line in text.splitlines() if line.startswith("| nulls without a claim"))
    assert row.count("no case yet") == 3
    assert "| other-graded | 8 | 1 | 1 | 0 | 1 | 0 | 0 |" in text
