"""Volumetric efficiency of a hydrostatic transmission: the band that a drawing leaves open, beside 399 units.

recordings/hst196: end-of-line tests of two like machines of 196 mL/r (examples/hst196/band.py, which names what is
not given and how far it may be off). One operating point, motor over pump speed. The data's author has the piston
clearance explain the whole of it, 84.8 .. 93.6 %; he sums one piston's leakage over the pistons z times: counted
once, his formulas give 96.0 .. 97.0 %.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

BAND = Path(__file__).resolve().parents[2] / "examples" / "hst196" / "band.py"
SOURCE = "recordings/hst196, 399 units"


@pytest.fixture(scope="module")
def band() -> ModuleType:
    spec = importlib.util.spec_from_file_location("hst196_band", BAND)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where its dataclasses look for their module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def measured(band, shared) -> np.ndarray:
    return band.measured(shared / "recordings" / "hst196" / "hst196_production_tests.csv")


def test_measured_speeds(measured):
    """As the recording's own sheet has them."""
    assert measured.size == 399
    assert 1780.0 * measured.mean() == pytest.approx(1574.0, abs=0.5)
    assert 100.0 * measured.std(ddof=1) == pytest.approx(0.64, abs=0.01)


def test_spread_by_clearance_alone(band, measured, validation):
    """All pistons at one end of the tolerance or the other: the most that the drawing's clearance can do."""
    spread = np.ptp(band.by_clearance())
    validation(
        case="Hydrostatic transmission HST 196, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity="spread by the whole piston clearance, 22.9 .. 34.3 um",
        unit="%",
        expected=100.0 * 4.0 * measured.std(ddof=1),
        obtained=100.0 * spread,
        tolerance=0.3,
        note="expected: 95 % of the units measured",
        missed="clearance accounts for a third of the spread that is measured; the rest is other gaps, oil, speed",
    )


def test_band(band, measured, validation):
    values, found = band.sample(count=96)
    low, high = 100.0 * np.quantile(found, (0.05, 0.95))
    validation(
        case="Hydrostatic transmission HST 196, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity="volumetric efficiency",
        unit="%",
        expected=100.0 * measured.mean(),
        obtained=0.5 * (low + high),
        tolerance=0.5 * (high - low),
        note=f"tolerance: half the predicted 90 % band, {low:.1f} .. {high:.1f} %",
        missed="leakage and compression as far as they are known account for half the loss; films of 22 um in "
        "place of 8 to 15 um on slippers and valve plates would meet it, or what the circuit loses (not given)",
    )
    parts = band.shares(values, found)
    assert 0.8 < parts.sum() <= 1.0 + 1e-9
    assert found.max() < 1.0
