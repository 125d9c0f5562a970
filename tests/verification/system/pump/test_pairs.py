"""Friction pairs against quadrature, statics and brute-force sums."""

import numpy as np
import pytest

from system.pump.laws import friction_pairs as pairs

MU = 25.8e-3
N = 360
ANGLE = 2 * np.pi * np.arange(N) / N


@pytest.mark.parametrize("pistons", [5, 9])
def test_sum_over_chambers_by_brute_force(pistons):
    def law(phi: np.ndarray) -> np.ndarray:
        return np.where(np.sin(phi) < 0, 3.0, 1.0) + np.cos(3 * phi + 0.2)

    total = sum(law(ANGLE + 1e-9 + 2 * np.pi * k / pistons) for k in range(pistons))
    np.testing.assert_allclose(pairs.over_chambers([law(ANGLE + 1e-9)], pistons), total, atol=1e-7)


def test_equation_22_counts_the_pistons_and_not_the_single_pairs():
    coulomb, viscous = 2.0 + np.sin(ANGLE), np.sin(ANGLE) ** 2
    nine, one = pairs.PairLoss(9, coulomb, viscous), pairs.PairLoss(1, coulomb, viscous)
    assert nine.mean_coulomb == pytest.approx(18.0, rel=1e-14)
    assert nine.mean_viscous == pytest.approx(4.5, rel=1e-14)
    assert nine.mean == pytest.approx(9 * one.mean, rel=1e-14)
    assert nine.quadrature_error < 1e-12


@pytest.mark.parametrize("eccentricity", [0.0, 0.6, 0.9])
def test_piston_shear_against_quadrature_round_the_gap(eccentricity):
    diameter, clearance, length, speed = 22e-3, 15e-6, np.array([30e-3]), np.array([2.5])
    theta = 2 * np.pi * np.arange(256) / 256
    film = clearance * (1 + eccentricity * np.cos(theta))
    force = MU * speed * length * diameter / 2 * np.mean(1 / film) * 2 * np.pi
    found = pairs.piston_cylinder_shear(MU, diameter, length, speed, clearance, eccentricity)
    np.testing.assert_allclose(found, force * speed, rtol=1e-12)


def test_piston_reactions_balance_force_and_moment():
    # Reactions at both ends of the engaged length l hold a side force F at c outside the bore's edge.
    length, overhang, force = 35e-3, 25e-3, 1000.0
    statics = np.array([[1.0, -1.0], [0.0, length]])  # edge - inner = F; inner x l = F x c
    edge, inner = np.linalg.solve(statics, [force, force * overhang])
    loss = pairs.piston_cylinder_coulomb(
        0.026, np.array([force]), np.array([length]), np.array([overhang]), np.array([-2.0])
    )
    assert loss[0] == pytest.approx(0.026 * (edge + inner) * 2.0, rel=1e-13)


def test_swash_plate_force_closes_the_triangle():
    # Axial force Fa, side force and the plate's normal force N = Fa/cos(gamma) of a frictionless plate.
    gamma, axial = np.radians(16.2), np.array([-12e3, 12e3])
    normal = pairs.slipper_swash_plate_coulomb(1.0, axial, gamma, np.ones(2))
    np.testing.assert_allclose(normal**2, axial**2 + pairs.side_force(axial, gamma) ** 2, rtol=1e-13)
    socket = pairs.piston_slipper_socket_coulomb(1.0, axial, gamma, 8e-3, 200.0)
    np.testing.assert_allclose(socket, normal * 8e-3 * 200.0 * np.sin(gamma), rtol=1e-13)


def test_axial_force_of_newtons_law():
    force = pairs.axial_force(np.array([20e6, 0.0]), 0.1e6, 3.8e-4, 0.21, np.array([600.0, -600.0]))
    np.testing.assert_allclose(force, [3.8e-4 * 19.9e6 - 126.0, -38.0 + 126.0])


def test_slipper_shear_against_quadrature_over_the_land():
    r = np.linspace(8.2e-3, 14e-3, 2001)
    force = np.trapezoid(MU * 9.9 / 10e-6 * 2 * np.pi * r, r)
    found = pairs.slipper_swash_plate_shear(MU, np.pi * (14e-3**2 - 8.2e-3**2), np.array([9.9]), 10e-6)
    assert found[0] == pytest.approx(force * 9.9, rel=1e-6)


def test_valve_plate_shear_at_the_mean_radius_is_13_percent_short_of_the_integral():
    radii, speed = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3), 220.0
    nominal = pairs.valve_plate_shear(MU, radii, speed, 36e-3, 8e-6)
    exact = MU * speed**2 / 8e-6 * np.pi / 2 * (radii[1] ** 4 - radii[0] ** 4 + radii[3] ** 4 - radii[2] ** 4)
    assert exact / nominal == pytest.approx(1.13, abs=0.005)


def test_single_pairs_are_force_times_speed():
    clamping = pairs.clamping_force(np.array([60e3]), 0.15, 1080.0)
    assert clamping[0] == pytest.approx(10080.0)
    assert pairs.valve_plate_coulomb(0.01, clamping, 200.0, 36e-3)[0] == pytest.approx(725.76)
    assert pairs.ball_guide_coulomb(0.12, 1080.0, np.radians(30.0), 1.0) == pytest.approx(259.2)
    assert pairs.bearing_coulomb(1e-3, 0.62, np.array([10e3]), 200.0, 60e-3)[0] == pytest.approx(37.2)
