"""Films of a bench between case and inlet in temperature: T_film = T_case + s (T_in + x dp/(rho c) - T_case)."""

from __future__ import annotations

import numpy as np
import pytest

from system import BenchPoints, load_pump
from system.bench.setting import setting

PUMP = load_pump("ref90")
ONE = np.ones(1)
POINTS = BenchPoints(
    200.0 * ONE, ONE, 2e7 * ONE, 2e6 * ONE, 1e5 * ONE, 330.0 * ONE, 320.0 * ONE, np.zeros(1), np.zeros(1), np.zeros(1)
)


@pytest.mark.parametrize(("share", "throttle", "warmth"), [(0.0, 0.8, 330.0), (1.0, 0.0, 320.0), (0.5, 0.0, 325.0)])
def test_films_lie_between_case_and_inlet(share: float, throttle: float, warmth: float) -> None:
    found = setting(PUMP, POINTS, {"inlet_share": share, "throttle_share": throttle}, 10)
    assert found.point.temperature.item() == pytest.approx(warmth)


def test_oil_of_the_inlet_is_warmed_by_throttling() -> None:
    found = setting(PUMP, POINTS, {"inlet_share": 1.0, "throttle_share": 0.8}, 10)
    rise = 0.8 * (2e7 - 1e5) / (PUMP.oil.density * PUMP.oil.specific_heat)
    assert found.point.temperature.item() == pytest.approx(320.0 + rise)


def test_films_are_as_warm_as_the_case_where_nothing_else_is_stated() -> None:
    assert setting(PUMP, POINTS, {}, 10).point.temperature.item() == pytest.approx(330.0)
