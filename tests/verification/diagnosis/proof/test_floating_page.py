"""Page of the proof with floating films: what it says of outcomes that another state of the program made."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace


def test_outcomes_of_another_state_are_told(proof: SimpleNamespace) -> None:
    page, trial, films = (import_module(f"proof.floating.{name}") for name in ("page", "trial", "films"))
    models = {films.off_text(off): SimpleNamespace(error={"a.leakage": 0.1, "a.friction": 0.1}) for off in films.OFF}
    own = [
        trial.Outcome(case.name, case.concealed, "missing_physics", "named", [], 9.0, (1.0, 1.0), {"Q": (1.0, 1.0)},
                      1.0, proof.store.program())
        for case in trial.all_cases()
    ]  # fmt: skip
    text = page.page(own, models)
    assert "another state" not in text
    kept = (Path(__file__).parents[4] / "docs" / "proof_floating.md").read_text("utf-8")
    assert text.partition("|")[0] == kept.partition("|")[0]
    assert "1 of the 45 cases are by another state" in page.page([replace(own[0], program="earlier"), *own[1:]], models)
