"""Films and pumps drawn at random: each ends in balance, or says in words why not"""

from __future__ import annotations

import importlib
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[4]
LIVE = {"film": 12, "pump, lumped": 12}
DISCUSSION = (
    "Geometry, oil, effects and operating points are drawn by `benchmarks/drawn.py`, which solves them as a user does "
    "and keeps each outcome; the tests solve the first of them again. Free films (four of five) have any of: cavities, "
    "steps, squeeze, time, heat, laws of the oil, elastic and rough walls, contact, a stated load; the others are gaps "
    "of REF90. Pumps have 5 to 300 mL/r, 5 to 13 pistons and any of fifteen effects of [physics]. Refused or not "
    "converged in words are a load that no position bears, oil beyond the range of its law, walls that overlap, and a "
    "pump that leaks more than it displaces, behind an orifice. Errors of energy are of films whose balance counts all "
    "work: it leaves out by its theory that on the flanks of rough walls and that of compression."
)


@pytest.fixture(scope="module")
def drawn() -> Iterator[SimpleNamespace]:
    """The benchmark's modules."""
    place = str(ROOT / "benchmarks")
    sys.path.insert(0, place)
    yield SimpleNamespace(**{name: importlib.import_module(f"drawn.{name}") for name in ("kept", "trial")})
    sys.path.remove(place)


@pytest.mark.parametrize("kind", ["film", "pump, lumped", "pump, fixed"])
def test_kept_outcomes(drawn, validation, kind):
    own = [one for one in drawn.kept.read_outcomes(drawn.kept.KEPT) if one.kind == kind]
    assert sorted(one.number for one in own) == list(range(drawn.trial.KINDS[kind].count))
    counted = {fate: sum(one.fate is fate for one in own) for fate in drawn.trial.Fate}
    note = ", ".join(f"{count} {fate}" for fate, count in counted.items() if count)
    validation(
        case="Drawn at random: converged in balance, or ended in words",
        source="benchmarks/drawn.py",
        quantity=f"cases, {kind}",
        unit="-",
        expected=len(own),
        obtained=sum(one.fate.good for one in own),
        tolerance=0.0,
        note=note,
    )
    balanced = [one for one in own if one.fate is drawn.trial.Fate.BALANCED]
    for what in ("mass", "energy"):
        errors = [getattr(one, what) for one in balanced if not math.isnan(getattr(one, what))]
        validation(
            case="Drawn at random: largest error of a balance",
            source="benchmarks/drawn.py",
            quantity=f"{what}, {kind}",
            unit="1",
            expected=0.0,
            obtained=max(errors),
            tolerance=getattr(drawn.trial.KINDS[kind], what),
            note=f"of {len(errors)} cases",
        )


@pytest.mark.parametrize("kind", LIVE)
def test_the_first_end_as_they_did(drawn, kind):
    known = {one.number: one for one in drawn.kept.read_outcomes(drawn.kept.KEPT) if one.kind == kind}
    for number in range(LIVE[kind]):
        found = drawn.trial.tried(kind, number)
        assert found.fate is known[number].fate, (number, found.told)
        assert math.isnan(found.mass) == math.isnan(known[number].mass)
