"""ZeMA rig: a concealed leak identified from measured cycles, with its size.

recordings/uci_hydraulic by examples/uci_hydraulic: the engine of the pump's diagnosis, a model of the rig.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from measured import Measured, Uncertainty, at_least, within

SOURCE = "UCI, condition monitoring of hydraulic systems; orifices by Helwig, Pignanelli and Schuetze 2015"
COEFFICIENTS = 0.61, 0.70  # of flow, between which a small bore lies: its diameter goes with the root
ODDS = 3.0  # nats
LICENCE = "CC BY 4.0 (UCI Machine Learning Repository 447)"


@pytest.fixture(scope="module")
def leak(example: Callable[[str], ModuleType]) -> ModuleType:
    return example("uci_hydraulic/leak.py")


def test_slopes_are_those_of_the_readings(leak: ModuleType) -> None:
    """A step a thousand times as far as the differences that make the slopes; the model is quadratic at most."""
    parameters = (*leak.BASE, *leak.EXTENSIONS["leak through an orifice"])
    rig = leak.Rig(np.array([0.8, 1.0, 1.4]), np.full(3, 155e5), np.array([0.0, 1.0, 1.0]), parameters)
    values = np.array([one.centre + 0.5 * one.spread for one in parameters])
    slopes = rig.slopes(values, tuple(one.name for one in parameters))
    for at, one in enumerate(parameters):
        step = 0.1 * one.spread * np.eye(len(parameters))[at]
        secant = (rig.predict(values + step) - rig.predict(values - step)) / (0.2 * one.spread)
        assert slopes[..., at] == pytest.approx(secant, rel=1e-6, abs=1e-9 * np.abs(secant).max())


@pytest.mark.slow
@pytest.mark.parametrize(("switched", "bore"), [(1, 0.20e-3), (2, 0.25e-3)])
def test_the_concealed_leak_is_named(leak: ModuleType, shared: Path, validation, switched: int, bore: float) -> None:
    """An orifice, not a viscous gap, a smaller pump or a meter; its bore within what its flow coefficient leaves.

    Viscosity hardly matters; the power of pressure stays as open as its prior: 152 to 158 bar do not tell.
    """
    data = shared / "recordings" / "uci_hydraulic"
    first, second, *_ = leak.explanations(data, switched)
    assert first.name == "leak through an orifice"
    assert first.gain - second.gain > ODDS
    area, sigma = first.size("area")
    found, tolerance = 1e3 * leak.diameter(area), 1e3 * bore * (np.sqrt(COEFFICIENTS[1] / COEFFICIENTS[0]) - 1.0)
    validation(
        case="ZeMA rig, concealed leak", source=SOURCE, quantity=f"bore of orifice {switched}", unit="mm",
        expected=1e3 * bore, obtained=found, tolerance=tolerance,
        measured=Measured(
            "rig", LICENCE, at_least(within(0.005, "no tolerance of the bore is stated; 0.01 mm, the last digit")),
            within(0.5 * tolerance, "flow coefficient of a small bore, 0.61 .. 0.70"),
            Uncertainty(0.5 * found * sigma / area, "one sigma of the fit, half of the area's"),
        ),
    )  # fmt: skip
    law = leak.free_law(data, switched)
    exponent, sigma = law.size("viscosity_exponent")
    assert exponent - 4.0 * sigma > -1.0
    assert law.size("pressure_exponent")[1] > 0.9 * leak.FREE_LAW[1].spread
