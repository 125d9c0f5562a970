"""Cascaded tanks: missing physics identified in one measured record and verified on another.

recordings/cascaded_tanks by examples/cascaded_tanks: the engine of the pump's diagnosis with another model.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

SOURCE = "Cascaded Tanks benchmark (nonlinearbenchmark.org), test record"
OVERFLOW = "overflow of both tanks"


@pytest.fixture(scope="module")
def overflow(example: Callable[[str], ModuleType]) -> ModuleType:
    return example("cascaded_tanks/overflow.py")


def test_a_tank_drains(overflow: ModuleType) -> None:
    """Without inflow Torricelli's law is solved outright: sqrt(x) falls linearly."""
    tanks = overflow.Tanks(np.zeros(10))
    values = np.array([1e-9, 0.0, 0.05, 0.05, 0.0, 9.0])
    time = 4.0 * np.arange(10)
    assert tanks.predict(values)[:, 0] == pytest.approx((3.0 - 0.025 * time) ** 2, rel=1e-6)


def test_slopes_are_those_of_the_predictions(overflow: ModuleType) -> None:
    """A step twice as far as the differences that make the slopes."""
    pump = 3.0 + np.sin(np.arange(40.0))
    tanks = overflow.Tanks(pump)
    values = np.array([0.05, 0.05, 0.05, 0.04, 5.0, 5.0])
    slopes = tanks.slopes(values, tuple(parameter.name for parameter in tanks.parameters))
    for at, size in enumerate(values):
        step = 1e-5 * size * np.eye(6)[at]
        secant = (tanks.predict(values + step) - tanks.predict(values - step)) / (2e-5 * size)
        assert slopes[..., at] == pytest.approx(secant, rel=1e-5, abs=1e-6 * np.abs(secant).max())


@pytest.mark.long
def test_what_the_tanks_lack_is_found(overflow: ModuleType, shared: Path, validation) -> None:
    """By evidence with the memory of what is left over; sizes and errors by simulating all of the record."""
    record = overflow.read_record(shared / "recordings" / "cascaded_tanks" / "dataBenchmark.csv")
    found = overflow.found(record)
    first, second, *others = found.rungs[0].tried
    assert {first.name, second.name} == {"overflow of tank 1", OVERFLOW}
    assert min(first.gain, second.gain) > 3.0 + max(other.gain for other in others)
    assert "outflow exponent of tank 2" in found.kept
    assert OVERFLOW in found.kept or {"overflow of tank 1", "overflow of tank 2"} <= set(found.kept)
    steps = {step.name: step for step in overflow.steps(record, found)}
    likely = list(steps.values())[-1]
    assert likely.note == "likely, not sure"
    rows = (
        ("Torricelli's law", 0.67, steps["nothing"]),
        ("with overflow and outflow exponent", 0.29, steps["outflow exponent of tank 2"]),
        ("with the likeliest addition beside them", 0.26, likely),
    )
    for model, expected, step in rows:
        validation(
            case="Cascaded tanks",
            source=SOURCE,
            quantity=f"RMS error on the test record, {model}",
            unit="V",
            expected=expected,
            obtained=step.test_error,
            tolerance=0.025,
        )
