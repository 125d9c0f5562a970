"""Leakage laws against quadrature, series resistances and control volumes."""

import numpy as np
import pytest

from system import piston_conductance, slipper_conductance, valve_plate_conductance
from system.pump.laws.leakage import piston_drag_flow

MU = 25.8e-3


@pytest.mark.parametrize("eccentricity", [0.0, 0.3, 0.6, 0.99])
def test_eccentric_piston_against_quadrature_round_the_gap(eccentricity):
    diameter, clearance, length = 22e-3, 15e-6, np.array([18e-3, 45e-3])
    theta = 2 * np.pi * np.arange(64) / 64
    film = clearance * (1 + eccentricity * np.cos(theta))
    expected = np.mean(film**3) * np.pi * diameter / (12 * MU * length)
    found = piston_conductance(diameter, clearance, length, eccentricity, MU)
    np.testing.assert_allclose(found, expected, rtol=1e-13)


def test_drag_flow_belongs_to_a_chamber_bounded_in_the_bore():
    # Seen from a plane that moves with the piston's end, the chamber is (bore area) S and the flow has the print's
    # sign; both views must take the same oil from the chamber's total dV/dt + q.
    diameter, clearance, velocity = 22e-3, 15e-6, 2.0
    piston_area = np.pi / 4 * diameter**2
    bore_area = piston_area + np.pi * diameter * clearance
    fixed = piston_area * velocity + piston_drag_flow(diameter, clearance, velocity)
    moving = bore_area * velocity - np.pi * diameter * clearance * velocity / 2
    assert fixed == pytest.approx(moving, rel=1e-12)


def test_slipper_is_orifice_and_land_in_series():
    r1, r2, h, d, length = 8.2e-3, 14e-3, 10e-6, 0.9e-3, 5e-3
    capillary = 128 * MU * length / (np.pi * d**4)
    land = 6 * MU * np.log(r2 / r1) / (np.pi * h**3)
    log = np.log(r2 / r1)
    assert slipper_conductance(log, h, d, length, MU) == pytest.approx(1 / (capillary + land), rel=1e-13, abs=0.0)
    # "With d_o = 1 mm the orifice takes 0.02 % of the drop at 10 um" (seed)
    share = 128 * MU * 5e-3 / (np.pi * 1e-3**4) * slipper_conductance(log, h, 1e-3, 5e-3, MU)
    assert share == pytest.approx(2e-4, rel=0.3)


def test_valve_plate_pitches_add_up_to_two_whole_discs():
    radii, h, z = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3), 8e-6, 9
    discs = sum(np.pi * h**3 / (6 * MU * np.log(b / a)) for a, b in (radii[:2], radii[2:]))
    assert z * valve_plate_conductance(radii, h, z, MU) == pytest.approx(discs, rel=1e-13, abs=0.0)
