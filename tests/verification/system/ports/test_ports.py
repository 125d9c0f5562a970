"""Port opening and orifice law: sections, continuity, limits, slope."""

import numpy as np
import pytest

from system import PortOpening, ReliefGroove, break_angles, opening_area, orifice_flow
from system.pump.ports.areas import critical_pressure_drop, orifice, orifice_coefficients

DEGREES = np.pi / 180.0
GROOVE, KIDNEY = 4e-6, 152e-6
ANGLES = np.array([-5.0, 10.0, 40.0, 140.0, 170.0]) * DEGREES
PAPER = ReliefGroove(ANGLES[0], ANGLES[1], GROOVE)
DELIVERY = PortOpening(np.pi, *ANGLES[1:], KIDNEY, (PAPER,))
SUCTION = PortOpening(0.0, *ANGLES[1:], KIDNEY, (PAPER,))
LAW = (0.7, 860.0, 30e-6, 150.0)


@pytest.mark.parametrize(
    ("degrees", "area"),
    [
        (-5.0, 0.0),
        (2.5, GROOVE / 4),
        (10.0, GROOVE),
        (25.0, (GROOVE + KIDNEY) / 2),
        (40.0, KIDNEY),
        (100.0, KIDNEY),
        (155.0, KIDNEY / 2),
        (170.0, 0.0),
        (250.0, 0.0),
    ],
)
def test_sections_of_both_ports(degrees, area):
    assert opening_area(SUCTION, degrees * DEGREES) == pytest.approx(area, abs=1e-18)
    assert opening_area(DELIVERY, (degrees + 180.0) * DEGREES) == pytest.approx(area, abs=1e-18)
    assert opening_area(DELIVERY, (degrees - 540.0) * DEGREES) == pytest.approx(area, abs=1e-18)


def test_the_area_is_continuous_and_bends_only_at_the_breaks():
    breaks = break_angles(DELIVERY)
    assert np.all(np.diff(breaks) > 0)
    assert np.all((breaks >= 0) & (breaks < 2 * np.pi))
    h = 1e-6
    jump = np.abs(opening_area(DELIVERY, breaks + h) - opening_area(DELIVERY, breaks - h))
    assert jump.max() < 2 * h * KIDNEY / (30 * DEGREES)
    third = np.diff(opening_area(DELIVERY, np.linspace(0, 2 * np.pi, 3601)), 3)
    bends = np.flatnonzero(np.abs(third) > 1e-16) / 10 * DEGREES
    distance = np.abs(np.angle(np.exp(1j * (bends[:, None] - breaks)))).min(axis=1)
    assert distance.max() < 0.31 * DEGREES


def test_turbulent_and_laminar_limits():
    critical = critical_pressure_drop(KIDNEY, *LAW)
    assert 10 < critical < 1000
    high = 1e4 * critical
    turbulent = 0.7 * KIDNEY * np.sqrt(2 * high / 860.0)
    # (1 + (dp_cr/dp)^2)^(-1/4) = 1 - 2.5e-9 there, and the same number of dp/dp_cr at the laminar end
    assert orifice_flow(high, KIDNEY, *LAW) == pytest.approx(turbulent, rel=3e-9)
    low = 1e-4 * critical
    laminar = 0.7 * KIDNEY * np.sqrt(2 / 860.0) * low / np.sqrt(critical)
    assert orifice_flow(low, KIDNEY, *LAW) == pytest.approx(laminar, rel=3e-9)
    assert orifice_flow(10 * critical, KIDNEY, *LAW) == pytest.approx(
        0.7 * KIDNEY * np.sqrt(20 * critical / 860.0), rel=3e-3
    )
    assert orifice_flow(-high, KIDNEY, *LAW) == -orifice_flow(high, KIDNEY, *LAW)
    assert orifice_flow(high, 0.0, *LAW) == 0.0


def test_critical_reynolds_number_is_met_at_the_critical_drop():
    # With the turbulent flow of the critical drop, u d_h/nu = Re_cr where u = Cd sqrt(2 dp/rho).
    critical = critical_pressure_drop(KIDNEY, *LAW)
    velocity = 0.7 * np.sqrt(2 * critical / 860.0)
    assert velocity * np.sqrt(4 * KIDNEY / np.pi) / 30e-6 == pytest.approx(150.0, rel=1e-12)


@pytest.mark.parametrize("drop", [-1e7, -100.0, 0.0, 1.0, 50.0, 300.0, 2e6])
def test_compiled_flow_and_slope(drop):
    conductance, square = orifice_coefficients(KIDNEY, *LAW)
    flow, slope = orifice(drop, conductance, square)
    assert flow == pytest.approx(float(orifice_flow(drop, KIDNEY, *LAW)), rel=1e-13, abs=1e-30)
    h = 1e-4 * max(1.0, abs(drop))
    ahead, behind = orifice(drop + h, conductance, square)[0], orifice(drop - h, conductance, square)[0]
    assert slope == pytest.approx((ahead - behind) / (2 * h), rel=1e-6)
