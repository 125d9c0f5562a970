"""Ball guide and retainer against rotation matrices and the seed's numbers."""

import numpy as np
import pytest
from scipy.optimize import linprog

from system.pump.laws.retainer import (
    BallGuide,
    RetainerMotion,
    azimuth_rate_ratio,
    contact_point,
    mean_sliding_speed,
    relative_locus,
    relative_velocity,
    spring_force,
    tipping_share,
    uniform_normal_force,
)

SPEED = 220.0
SWASH = np.radians(16.2)
GUIDE = BallGuide(22e-3, np.radians(30.0))
PSI = np.linspace(0.0, 2.0 * np.pi, 97)


def tilt(angle: float) -> np.ndarray:
    """Rotation about z that tilts the retainer's axis x by the swash angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def circle(psi: np.ndarray) -> np.ndarray:
    """The contact circle in the retainer's own frame."""
    latitude = GUIDE.contact_latitude
    ones = np.ones_like(psi)
    return GUIDE.radius * np.stack(
        [np.sin(latitude) * ones, np.cos(latitude) * np.cos(psi), np.cos(latitude) * np.sin(psi)]
    )


def test_contact_point_is_the_tilted_circle():
    np.testing.assert_allclose(contact_point(GUIDE, SWASH, PSI), tilt(SWASH) @ circle(PSI), atol=1e-17)


def test_rigid_slip_is_that_of_two_rigid_rotations():
    spin_retainer = SPEED * (tilt(SWASH) @ np.array([1.0, 0.0, 0.0]))
    spin_guide = SPEED * np.array([1.0, 0.0, 0.0])
    point = tilt(SWASH) @ circle(PSI)
    expected = np.cross(spin_retainer - spin_guide, point, axisb=0, axisc=0)
    np.testing.assert_allclose(relative_velocity(GUIDE, SWASH, PSI, SPEED), expected, atol=1e-15)


def test_rigid_slip_has_the_seeds_magnitude():
    latitude, radius = GUIDE.contact_latitude, GUIDE.radius
    lift = np.sin(latitude) * (1 - np.cos(SWASH)) - np.cos(latitude) * np.cos(PSI) * np.sin(SWASH)
    size = radius * SPEED * np.sqrt(2 * (1 - np.cos(SWASH)) - lift**2)
    np.testing.assert_allclose(np.linalg.norm(relative_velocity(GUIDE, SWASH, PSI, SPEED), axis=0), size, rtol=1e-12)


@pytest.mark.parametrize("motion", list(RetainerMotion))
def test_slip_is_the_rate_of_the_locus_seen_from_the_shaft(motion):
    # In the frame that turns with the guide, p' moves with dpsi = k w dt and p stands still.
    h = 1e-6
    k = np.ones_like(PSI) if motion is RetainerMotion.RIGID else azimuth_rate_ratio(GUIDE, SWASH, PSI)
    fixed = SPEED * k * (contact_point(GUIDE, SWASH, PSI + h) - contact_point(GUIDE, SWASH, PSI - h)) / (2 * h)
    carried = np.cross(np.array([SPEED, 0.0, 0.0]), contact_point(GUIDE, SWASH, PSI), axisb=0, axisc=0)
    np.testing.assert_allclose(relative_velocity(GUIDE, SWASH, PSI, SPEED, motion), fixed - carried, atol=1e-8)


def test_the_printed_k_keeps_the_azimuth_of_the_contact_point():
    h = 1e-6
    before, after = contact_point(GUIDE, SWASH, PSI - h), contact_point(GUIDE, SWASH, PSI + h)
    azimuth = np.arctan2(after[2], after[1]) - np.arctan2(before[2], before[1])
    turned = np.angle(np.exp(1j * azimuth))
    np.testing.assert_allclose(azimuth_rate_ratio(GUIDE, SWASH, PSI), 2 * h / turned, rtol=1e-8)


@pytest.mark.parametrize(("degrees", "percent"), [(20.0, 10.0), (30.0, 18.0), (40.0, 25.0)])
def test_rigid_mean_slip_exceeds_the_printed_one(degrees, percent):
    # The seed's "10 / 18 / 25 % smaller" is (rigid - printed)/printed with the mean over psi.
    guide = BallGuide(22e-3, np.radians(degrees))
    rigid = mean_sliding_speed(guide, SWASH, SPEED)
    printed = mean_sliding_speed(guide, SWASH, SPEED, RetainerMotion.PRINTED)
    assert 100 * (rigid / printed - 1) == pytest.approx(percent, abs=0.5)


def test_no_tilt_no_slip():
    assert np.abs(relative_locus(GUIDE, 0.0, PSI)).max() == 0.0
    assert mean_sliding_speed(GUIDE, 0.0, SPEED) == 0.0


def test_uniform_normal_force_balances_the_spring():
    spring = spring_force(1080.0, 20e3, 0.5e-3)
    assert spring == pytest.approx(1090.0)
    count = 360
    psi = 2 * np.pi * np.arange(count) / count
    inward = -contact_point(GUIDE, SWASH, psi) / GUIDE.radius
    each = uniform_normal_force(spring, GUIDE, np.cos(SWASH)) / count
    assert -(each * inward[0]).sum() == pytest.approx(spring, rel=1e-12)


@pytest.mark.parametrize("pistons", [3, 7, 9, 8, 10])
def test_what_tips_a_retainer(pistons):
    """A plate free to tilt, pressed at its middle: the most that one of z supports around it can bear, no other
    pulling, by linear programming."""
    around = 2.0 * np.pi * np.arange(pistons) / pistons
    balance = np.stack([np.ones(pistons), np.cos(around), np.sin(around)])
    most = linprog(-np.eye(pistons)[0], A_eq=balance, b_eq=[1.0, 0.0, 0.0], bounds=(0.0, None))
    assert tipping_share(pistons) == pytest.approx(most.x[0], rel=1e-9)
