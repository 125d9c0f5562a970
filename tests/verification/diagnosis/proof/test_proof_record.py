"""The track record that the package carries is that of the proof's outcomes."""

from __future__ import annotations

import json
import tarfile
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

from diagnosis.thresholds import load_thresholds

ROOT = Path(__file__).resolve().parents[4]
RECORD = ROOT / "diagnosis" / "report" / "track_record.json"


def test_the_record_is_that_of_the_kept_outcomes(proof: SimpleNamespace, tmp_path: Path) -> None:
    with tarfile.open(ROOT / "benchmarks" / "proof" / "outcomes.tar.xz") as archive:
        archive.extractall(tmp_path / "outcomes", filter="data")
    planned = [case for part in proof.parts.Part for case in proof.cases.cases(part, load_thresholds().seeds.proof)]
    proof.record.write_record(proof.store.outcomes(tmp_path / "outcomes", planned), tmp_path / "record.json")
    assert (tmp_path / "record.json").read_text("utf-8") == RECORD.read_text("utf-8"), (
        "python benchmarks/proof.py --record"
    )


def test_outcomes_of_other_draws_do_not_count(proof: SimpleNamespace, tmp_path: Path) -> None:
    """A folder that the development set has been tried in: only the cases that are asked for."""
    own, other = (proof.cases.cases(proof.parts.Part.NULL, seed)[0] for seed in (52, 53))
    blank = proof.outcome.Outcome("a", "null", "map", 1, 0.0, 0.0, {}, "no_mismatch", (), (), {})
    for case in (own, other):
        proof.store.keep(tmp_path, proof.store.name_of(case), replace(blank, seed=case.seed))
    assert [one.seed for one in proof.store.outcomes(tmp_path, [own])] == [own.seed]


def test_answers_are_counted_by_kind_pump_and_probability(proof: SimpleNamespace, tmp_path: Path) -> None:
    made = proof.outcome
    name = made.Outcome(
        name="leak", part="graded", campaign="map", seed=1, asked=8.0, score=8.0, sizes={}, truth="missing_physics",
        effects=("churning",), pairs=(None,), shares={}, verdict="missing_physics", status="named",
        claims=(made.Claimed("churning", None, 0.97, ()),),
        ranked=(made.Ranked(("churning",), (None,), "missing_physics", 0.97),),
    )  # fmt: skip
    wrong = replace(name, truth="no_mismatch", effects=(), pairs=(), part="rough-null")
    quiet = replace(name, verdict="no_mismatch", claims=(), nothing=0.85, part="null", truth="no_mismatch", effects=())
    given = replace(name, part="bench")
    proof.record.write_record([name, name, wrong, quiet, given, replace(name, failed="no fit")], tmp_path / "r.json")
    found = json.loads((tmp_path / "r.json").read_text("utf-8"))
    assert found["cases"] == 4
    rows = {(row["answer"], row["pump"], row["from"]): (row["right"], row["cases"]) for row in found["rows"]}
    assert rows == {
        ("name", "stated", 0.9): (2, 2),
        ("name", "type_plate", 0.9): (0, 1),
        ("nothing", "stated", 0.8): (1, 1),
    }
