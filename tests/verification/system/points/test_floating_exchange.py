"""Outputs of floating gaps for chambers and shaft: places of the block's flows, small motion, periodic resampling."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from system import floating_parts, load_pump, operating_point, piston_area, plate_axes, rotor, valve_plate_geometry
from system.points.floating_exchange import FloatingGaps, around, ball_shift, chamber_draws, growth, of_each, resampled

PUMP = load_pump("ref90")
ROTOR, PARTS = rotor(PUMP, operating_point(PUMP)), floating_parts(PUMP)
PISTONS, STEPS = PUMP.pump.pistons, 36
TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Told:
    """A revolution that is told: positions (n, k) m after each step, and what is seen there."""

    positions: np.ndarray
    seen: tuple = ()

    @property
    def turn(self):
        return SimpleNamespace(instants=[SimpleNamespace(report=seen, passed=seen) for seen in self.seen])


def still(*position: float, steps: int = STEPS) -> Told:
    return Told(np.tile(np.array(position), (steps, 1)), (SimpleNamespace(chamber_growth=0.0),) * steps)


def gaps(piston=(0.0, 0.0, 0.0, 0.0), slipper=(0.0, 0.0, 0.0), block=(0.0, 0.0, 0.0)) -> FloatingGaps:
    return FloatingGaps(still(*piston), still(*slipper), still(*block, steps=STEPS // PISTONS))


def test_the_last_reported_angle_is_the_first_of_the_next_turn():
    told = Told(np.zeros((4, 1)), tuple(range(4)))
    assert np.array_equal(of_each(told, float), [3.0, 0.0, 1.0, 2.0])


def test_resampling_keeps_what_it_knows_and_the_mean():
    values = np.random.default_rng(3).normal(size=(12, 2))
    fine = resampled(values, 60)
    assert fine[::5] == pytest.approx(values, rel=1e-13)
    assert fine.mean(axis=0) == pytest.approx(values.mean(axis=0), rel=1e-12)
    assert np.array_equal(resampled(values, 12), values)


def test_a_burst_between_two_angles_keeps_all_that_passes():
    burst = np.zeros(STEPS)
    burst[7] = 3.0  # in the step that ends at angle 7
    told = around(burst)
    assert told[6] == told[7] == 1.5
    assert told.sum() == burst.sum()


def test_a_chamber_draws_what_its_kidney_does_where_it_stands():
    """A flow by the kidney's place alone comes back as that function of the chamber's angle, around it."""
    per_pitch = STEPS // PISTONS
    shaft = TURN / STEPS * np.arange(1, per_pitch + 1)
    places = shaft[:, None] + TURN / PISTONS * np.arange(PISTONS)
    seen = tuple(SimpleNamespace(flow=np.cos(row) + 0.3 * np.sin(2.0 * row)) for row in places)
    own = TURN * np.arange(STEPS) / STEPS
    expected = around(np.cos(own) + 0.3 * np.sin(2.0 * own))
    assert chamber_draws(Told(np.zeros((per_pitch, 3)), seen), 0, STEPS) == pytest.approx(expected, abs=1e-12)


def test_of_a_whole_turn_each_chamber_draws_its_own():
    shaft = TURN / STEPS * np.arange(1, STEPS + 1)
    seen = tuple(SimpleNamespace(flow=np.cos(angle) * np.arange(PISTONS)) for angle in shaft)
    own = TURN * np.arange(STEPS) / STEPS
    found = chamber_draws(Told(np.zeros((STEPS, 3)), seen), 4, STEPS)
    assert found == pytest.approx(around(4.0 * np.cos(own - 4.0 * TURN / PISTONS)), abs=1e-12)


def test_a_block_that_rises_once_a_turn_is_met_by_each_chamber_at_its_own_angle():
    plate, lift = valve_plate_geometry(PUMP), 5e-6
    shaft = TURN / STEPS * np.arange(1, STEPS + 1)
    block = Told(lift * np.stack([np.cos(shaft), 0.0 * shaft, 0.0 * shaft], axis=1))
    one = replace(gaps(), block=block, chamber=4)
    own = TURN * np.arange(STEPS) / STEPS
    expected = -(piston_area(PUMP) - plate.kidney_area) * lift * np.cos(own - 4.0 * TURN / PISTONS)
    assert growth(one, ROTOR, PARTS) == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())


def test_a_thicker_film_under_the_slipper_takes_from_the_chamber():
    """The piston goes in by h/(n . a)."""
    found = growth(gaps(slipper=(10e-6, 0.0, 0.0)), ROTOR, PARTS)
    facing = -found / (piston_area(PUMP) * 10e-6)
    swash, cone = ROTOR.drive.swash_angle, ROTOR.drive.bore_cone_angle
    # At the inner dead centre the bore leans over by the cone towards the plate's normal.
    assert facing[0] == pytest.approx(1.0 / np.cos(swash - cone), rel=1e-9)
    assert facing[STEPS // 2] == pytest.approx(1.0 / np.cos(swash + cone), rel=1e-9)


def test_the_ball_stays_on_the_plate():
    """Whatever the piston does across its bore, the ball moves along the swash plate alone."""
    normal = plate_axes(ROTOR.drive)[2]
    shift = ball_shift(gaps(piston=(9e-6, -4e-6, -12e-6, 3e-6)), ROTOR, PARTS)
    assert shift @ normal == pytest.approx(np.zeros(STEPS), abs=1e-18)
    assert np.abs(shift).max() > 1e-5
    lifted = ball_shift(gaps(slipper=(7e-6, 0.0, 0.0)), ROTOR, PARTS)
    assert lifted @ normal == pytest.approx(np.full(STEPS, -7e-6), rel=1e-12)


def test_a_block_that_rises_takes_the_bore_less_the_kidney():
    plate, lift = valve_plate_geometry(PUMP), 5e-6
    found = growth(gaps(block=(lift, 0.0, 0.0)), ROTOR, PARTS)
    assert found == pytest.approx(np.full(STEPS, -(piston_area(PUMP) - plate.kidney_area) * lift), rel=1e-12)
    tilted = growth(gaps(block=(0.0, lift, 0.0)), ROTOR, PARTS)
    assert tilted.sum() == pytest.approx(0.0, abs=1e-12 * np.abs(tilted).max() * STEPS)
