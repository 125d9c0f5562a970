"""Cases of an earlier program that are tried again: a random draw, what counts as the same, the page's sentence."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest


@pytest.fixture
def named(proof: SimpleNamespace) -> object:
    """A named churning of an earlier program."""
    made = proof.outcome
    return made.Outcome(
        name="churning", part="graded", campaign="map", seed=1, asked=8.0, score=8.0, sizes={},
        truth="missing_physics", effects=("churning",), pairs=(None,), shares={}, verdict="missing_physics",
        status="named", claims=(made.Claimed("churning", None, 0.97, ()),), program="earlier",
    )  # fmt: skip


def test_cases_of_the_present_program_are_not_drawn(proof: SimpleNamespace, named: object) -> None:
    """The draw holds earlier cases alone, each once, and is the same for the same program."""
    known = {f"{at}.json": replace(named, seed=at) for at in range(30)}
    known["new.json"] = replace(named, program=proof.store.program())
    drawn = list(proof.again.draw(known, 20))
    assert len(set(drawn)) == 20
    assert "new.json" not in drawn
    assert drawn == list(proof.again.draw(known, 20))
    assert drawn != sorted(drawn)


def test_a_finding_is_the_same_by_verdict_status_and_claims(proof: SimpleNamespace, named: object) -> None:
    """Probabilities may differ; another gap, status or verdict is another finding."""
    claimed = proof.outcome.Claimed
    assert proof.again.told_alike(named, replace(named, claims=(claimed("churning", None, 0.95, ()),)))
    for other in (
        replace(named, status="class"),
        replace(named, verdict="unknown_physics"),
        replace(named, claims=()),
        replace(named, claims=(claimed("churning", "piston", 0.97, ()),)),
    ):
        assert not proof.again.told_alike(named, other)


def test_the_page_says_how_many_are_the_same(proof: SimpleNamespace, tmp_path: Path) -> None:
    """Nothing without a case; then the share with Wilson's interval: 3 of 4 is 30 % to 95 %."""
    assert proof.again.sentence(tmp_path) == ""
    for at in range(4):
        proof.again.keep_again(tmp_path, f"{at}.json", at > 0)
    said = proof.again.sentence(tmp_path)
    assert "4 were drawn at random" in said
    assert "3 with the same verdict, status and names (30% to 95%)" in said
    proof.page.write_page(tmp_path, tmp_path / "proof.md", 52)
    assert said in (tmp_path / "proof.md").read_text("utf-8")
    (tmp_path / proof.again.FILE).write_text('{"program": "earlier", "same": {"0.json": true}}', encoding="utf-8")
    assert proof.again.sentence(tmp_path) == ""
