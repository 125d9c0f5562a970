"""Spins of ref90's pistons and slippers, stated and free."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps.loads.ball_joint import Spins
from system import FloatingOptions, drives, floating_parts, load_pump, no_rubbing, operating_point, resolved_toml, rotor
from system.films.spins import SpinTorques, SpunFilms, spins, torques_of_films
from system.points.floating import _spins_change
from system.points.floating_kinds import RoundDrives
from system.pump.operating import OperatingPoint


@pytest.fixture
def free(tmp_path):
    """ref90 without its spin ratios."""
    rows = [row for row in resolved_toml(load_pump(BENCH)).splitlines() if not row.startswith("spin_ratio")]
    path = tmp_path / "pump.toml"
    path.write_text("\n".join(rows), "utf-8")
    return load_pump(path)


def test_free_parts_turn_with_what_rubs_more(free):
    """A joint under pressure drags the piston back against the block; unloaded, both stand with their films.

    Bores of a cone swing about the shaft, and a joint that nearly sticks feels it: the piston follows a little.
    """
    point = operating_point(free)
    assert rotor(load_pump(BENCH), point).spins.piston == 0.0
    straight = replace(free, pump=replace(free.pump, bore_cone_angle=0.0))
    pressed = rotor(straight, point).spins
    assert pressed.piston / point.shaft_speed == pytest.approx(-1.0, abs=0.06)
    assert abs(pressed.slipper) < 0.06 * point.shaft_speed
    assert -0.9 < rotor(free, point).spins.piston / point.shaft_speed < -0.7
    idle = replace(point, delivery_pressure=0.15e6, inlet_pressure=0.15e6)
    rest = rotor(free, idle).spins
    assert (rest.piston, rest.slipper) == pytest.approx((0.0, 0.0), abs=1e-9)


def _films(piston, slipper, *torques):
    return SpunFilms(Spins(piston, slipper), torques)


def test_torques_of_films_are_parted_into_drag_and_drive():
    """The very torques come back at the spins at which they were: -(drag) spin + drive."""
    estimated, friction = SpinTorques(np.array([0.1]), (1e-3, 1e-4)), np.array([0.2])
    for torques in ((0.3, -4e-3), (0.1, 2e-3), (-0.2, 0.0)):
        found = torques_of_films(estimated, friction, _films(-150.0, 20.0, *torques))
        back = [t - d * s for t, d, s in zip(found.driven, found.drags, (-150.0, 20.0), strict=True)]
        assert back == pytest.approx(torques)
        assert all(drag >= least for drag, least in zip(found.drags, estimated.drags, strict=True))
    held = torques_of_films(estimated, friction, _films(-150.0, 20.0, 0.3, -4e-3))
    assert held.driven == pytest.approx((0.0, 0.0), abs=1e-15)
    still = torques_of_films(estimated, friction, _films(0.0, 0.0, 0.3, -4e-3))
    assert (still.drags, still.driven) == (estimated.drags, (0.3, -4e-3))


def test_drag_is_the_change_of_torque_with_spin():
    """Two spins of a film that drags less than in proportion; noise, a flat film or equal spins stay within bounds."""
    estimated, friction = SpinTorques(np.array([0.1]), (1e-3, 1e-4)), np.array([0.2])
    first = (_films(-150.0, 20.0, 0.45, -4e-3),)
    second = torques_of_films(estimated, friction, _films(-100.0, 20.0, 0.37, -4e-3), first)
    assert second.drags == pytest.approx((0.08 / 50.0, 2e-4))
    assert second.driven[0] - second.drags[0] * -100.0 == pytest.approx(0.37)
    assert second.driven[0] - second.drags[0] * -150.0 == pytest.approx(0.45)
    flat = torques_of_films(estimated, friction, _films(-100.0, 20.0, 0.45, -4e-3), first)
    assert flat.drags[0] == pytest.approx(0.1 * estimated.drags[0])
    steep = torques_of_films(estimated, friction, _films(-149.9, 20.0, 0.1, -4e-3), first)
    assert steep.drags[0] == pytest.approx(max(1e-3, 0.1 / 149.9))


def test_a_peak_of_torque_over_spin_is_no_trap():
    """A film that drags most where it turns slowly: the spin of balance lies below the peak, and rounds end there.

    One film's torque over spin, T = k s/(1 + (s/s0)^2), beside a joint that gives c - s: found by bisection.
    """
    estimated, friction = SpinTorques(np.array([0.1]), (1e-3, 1e-4)), np.array([0.2])

    def drag(spin):
        return -12.0e-3 * spin / (1.0 + (spin / 20.0) ** 2) - 2e-4 * spin

    def joint(spin):
        return -(0.1 + 6e-4 * spin)

    spin, tried, seen = -75.0, (), []
    for _ in range(20):
        found = torques_of_films(estimated, friction, _films(spin, 20.0, drag(spin), 0.0), tried)
        tried = found.tried
        # joint(s) + driven - drags s = 0
        spin, last = (found.driven[0] - 0.1) / (found.drags[0] + 6e-4), spin
        seen.append(abs(spin - last))
        if seen[-1] < 0.4:
            break
    assert seen[-1] < 0.4
    assert drag(spin) + joint(spin) == pytest.approx(0.0, abs=2e-3)
    assert -20.0 < spin < 0.0


def test_nearly_equal_spins_show_no_steep_film():
    """Torques of six rounds of a piston whose chambers still settle: spins by them would stand still off their balance.

    The line of the last two spins is 80 times as steep as that through rest, by what else changed between the rounds.
    """
    estimated, friction = SpinTorques(np.array([0.1]), (1.25e-3, 1e-4)), np.array([0.2])
    rounds = ((-57.6, 95.2e-3), (-43.3, 77.9e-3), (-36.16, 69.1e-3), (-36.80, 74.3e-3), (-36.29, 74.2e-3))
    tried = tuple(_films(spin, 20.0, torque, -4e-3) for spin, torque in rounds)
    found = torques_of_films(estimated, friction, _films(-36.19, 20.0, 74.1e-3, -4e-3), tried)
    through_rest = 74.1e-3 / 36.19
    assert found.drags[0] == pytest.approx(3.0 * through_rest)
    assert found.careful.drags[0] == pytest.approx(through_rest)


def test_spins_are_settled_by_lines_through_rest_too():
    """A round changes a spin by no less than the line through rest says, however steep that of two spins is."""

    @dataclass(frozen=True)
    class At:
        spins: Spins
        point: OperatingPoint

    class Kinds:
        def rotors(self, asked):
            return tuple(At(Spins(-own.driven[0] / own.drags[0], 20.0), point) for own in asked.spin_torques)

    point = operating_point(load_pump("ref90"))
    careful = SpinTorques(np.array([0.1]), (2e-3, 1e-4), (0.08, 0.0))
    steep = SpinTorques(np.array([0.1]), (0.2, 1e-4), (7.9, 0.0), careful=careful)
    following = RoundDrives(None, np.zeros(1), (), (), (steep,), FloatingOptions())
    before = (At(Spins(-39.6, 20.0), point),)
    assert _spins_change(before, Kinds(), following) == pytest.approx((40.0 - 39.6) / point.shaft_speed)
    alone = replace(following, spin_torques=(replace(steep, careful=None),))
    assert _spins_change(before, Kinds(), alone) == pytest.approx((39.6 - 39.5) / point.shaft_speed)


def test_spins_do_not_leap_past_rest(free):
    """A film that drags more the slower it turns: its line says that the spin turns round, not that to rest."""
    point = operating_point(free)
    drive, speed = rotor(free, point).drive, point.shaft_speed
    estimated, friction = SpinTorques(np.array([0.1]), (1e-4, 1e-4)), np.array([0.05])
    first = (_films(-0.1 * speed, 0.9 * speed, 0.04, -0.01),)
    found = torques_of_films(estimated, friction, _films(-0.05 * speed, 0.95 * speed, 0.08, -0.01), first)
    assert found.careful is not None
    far = spins(free, point, drive, replace(found, careful=None))
    assert far.piston > 0.0
    assert spins(free, point, drive, found) == spins(free, point, drive, found.careful)
    assert -0.05 * speed < spins(free, point, drive, found).piston < 0.0


def test_a_film_that_drives_turns_what_no_joint_holds(free):
    """Without friction in the joint: spin = torque/drag."""
    point = operating_point(free)
    group = rotor(free, point)
    found = spins(free, point, group.drive, SpinTorques(np.zeros(1), (1e-3, 1e-4), (0.02, -0.003)))
    assert (found.piston, found.slipper) == pytest.approx((20.0, -30.0))


def test_free_spins_reach_every_gap_and_are_told(free):
    group, parts = rotor(free, operating_point(free)), floating_parts(free)
    told = {taken.path for taken in parts.taken}
    assert {"piston.spin_ratio", "slipper.spin_ratio"} <= told
    speed, free_to = group.point.shaft_speed, group.spins
    angles = 2.0 * np.pi * np.arange(18) / 18
    found = drives(group, parts, angles, np.full(18, 20e6), no_rubbing(18))
    assert found.piston.piston_spin == speed + free_to.piston
    assert found.slipper.spin == free_to.slipper
    still = drives(rotor(load_pump(BENCH), group.point), parts, angles, np.full(18, 20e6), no_rubbing(18))
    # A slipper that the piston follows is hardly turned by its joint: free, the moment falls.
    assert np.linalg.norm(found.group.ball_moment[0]) < np.linalg.norm(still.group.ball_moment[0])
