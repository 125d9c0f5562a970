"""The check of planned campaigns: what it keeps comes back, and its page counts what is settled."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest


@pytest.fixture(scope="module")
def check(proof: SimpleNamespace) -> SimpleNamespace:
    """Modules of the check by their names."""
    assert proof is not None
    return SimpleNamespace(
        **{name: import_module(f"proof.planned.{name}") for name in ("kept", "page", "plans", "trial")}
    )


def _kept(check: SimpleNamespace, folder: Path) -> tuple[object, object]:
    """A grid that leaves a rival open, and planned campaigns: one pair settled by points, both with a meter."""
    grid = check.trial.ByGrid(
        "seal", "seal_drag", {"seal_drag": 0.6, "torque_offset": 0.3, "churning": 0.01}, "class", 6.0
    )
    told, open_ = check.trial.Told(5.0, True, 400.0), check.trial.Told(1.0, False, 2.0)
    pairs = (
        check.trial.Pair("torque_offset", 2.0, 0.8, True, 2.0, False, open_, told),
        check.trial.Pair("charge_pump_drag", 3.0, 0.3, False, 7.0, True, told, told),
    )
    trial = check.trial.Trial("seal", "seal_drag", pairs, "torque_uncoupled", ("class", "named"), (20, 36), 54.0)
    check.kept._keep(folder / "grid-000.json", grid)
    check.kept._keep(folder / "planned-000.json", trial)
    return grid, trial


def test_what_is_kept_comes_back(check: SimpleNamespace, tmp_path: Path) -> None:
    grid, trial = _kept(check, tmp_path)
    assert list(check.kept.all_grids(tmp_path)) == [grid]
    assert list(check.kept.all_trials(tmp_path)) == [trial]
    assert trial.settled == (1, 2)
    assert grid.open == ["torque_offset"]


def test_what_is_kept_of_another_cause_is_made_anew(
    check: SimpleNamespace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The list of causes has changed: the number is another cause's now; the same for the pairs of a changed grid."""
    grid, trial = _kept(check, tmp_path)
    seal, other = SimpleNamespace(label="seal"), SimpleNamespace(label="churning")
    settled = replace(trial, pairs=trial.pairs[:1])
    monkeypatch.setattr(check.kept, "by_grid", lambda one, number: replace(grid, name=one.label))
    monkeypatch.setattr(check.kept, "tried", lambda one, number, found: replace(settled, name=one.label))
    assert check.kept.kept_grid(tmp_path, seal, 0) == grid
    assert check.kept.kept_grid(tmp_path, other, 0).name == "churning"
    assert check.kept.kept_trial(tmp_path, seal, 0, grid) == settled
    assert check.kept.kept_trial(tmp_path, other, 0, grid).name == "churning"


def test_the_page_counts_what_is_settled(check: SimpleNamespace, tmp_path: Path) -> None:
    _kept(check, tmp_path)
    told = check.page.write_page(tmp_path, tmp_path / "page.md").read_text("utf-8")
    for part in (
        "in 1 min of process time. 1 of them left 2 pairs open",
        "With one meter more 2 of 2", "By points alone 1 of 2", "no point of this bench tells 1 of them",
        "to tell 1 of the 2", "`torque_uncoupled` 1 times", "2, open", "400, settled",
    ):  # fmt: skip
        assert part in told, told


def test_the_plan_begins_at_the_corners_and_may_reach_the_grid(check: SimpleNamespace) -> None:
    """Eight corners, then the levels of speed, pressure, stroke, temperature and charge, then the grid's own points."""
    asked, count = check.plans._asked()
    assert asked.counts.sum() == 8 == len(asked.planned.speed)
    assert count == 36
    assert asked.most + 8 == count
    assert {round(one / 1e5) for one in set(asked.possible.p_in[:-count])} == {14, 29}
