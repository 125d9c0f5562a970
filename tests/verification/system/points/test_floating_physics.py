"""[physics] in floating films: what films solve, what the balance of forces has, what acts by its law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gaps import Effect
from reynolds import FilmNotConverged
from system import (
    RIGID,
    EffectId,
    FloatingOptions,
    FloatingPoint,
    Gap,
    floating_parts,
    floating_point,
    load_pump,
    operating_point,
    rotor,
)
from system.description.effects import PhysicsSection
from system.films.drives import drives, no_rubbing
from system.inputs.sections.reader import section_of
from system.multibody.floating_group import floating_joint_forces
from system.points import floating_gaps
from system.points.film_effects import closed_laws, effects_in_films, floating_effects
from system.points.lumped import lumped_point
from system.pump.laws.directions import plate_axes

STILL = {f"{part}.spin_ratio": 0.0 for part in ("piston", "slipper")}  # free spins take more rounds
PUMP = load_pump("ref90", {"operating.pressure": "10 MPa", **STILL})
COARSE = FloatingOptions(RIGID, steps=36, finer=0.35)
BALANCED = 5e-3
"""Largest error of the power balance at 36 angles a turn, of the shaft power."""


def extended(tables):
    return replace(PUMP, physics=section_of(PhysicsSection, tables))


def floating(tables) -> FloatingPoint:
    pump = extended(tables)
    return floating_point(pump, operating_point(pump), COARSE)


def test_what_floating_films_solve_is_more_than_films_at_given_positions():
    pump = extended(
        {
            "shear_thinning": {"drop": 0.3, "rate": 1e6},
            "elastic_opening": {"slipper": {"opening": 1e-8}},
            "block_tipping": {"wedge": 5e-6},
            "swash_droop": {"rate": 1e-10, "play": 0.0},
        }
    )
    solved, laws = effects_in_films(pump)
    assert set(laws) == {EffectId.BLOCK_TIPPING, EffectId.SWASH_DROOP}
    afloat, left = effects_in_films(pump, floating=True)
    assert (set(afloat) - set(solved), left) == ({EffectId.BLOCK_TIPPING}, (EffectId.SWASH_DROOP,))
    assert closed_laws(pump, floating=True) == extended({"swash_droop": {"rate": 1e-10, "play": 0.0}})
    at = rotor(pump, operating_point(pump))
    films = floating_effects(at, floating_parts(pump), pump, RIGID)
    assert [getattr(films.physics, gap.value).elastic_walls for gap in Gap] == [False, True, False]
    thins = films.parts.piston.laws.thinning
    assert float(thins(np.array(1e6), np.array(0.02))) == pytest.approx(0.85 * 0.02)
    told = [str(one) for one in films.parts.taken if one.path == "physics.block_tipping"]
    assert len(told) == 1
    assert "the block tips as the forces on it balance" in told[0]


def test_rigid_walls_that_stiff_oil_breaks_are_told_with_the_remedy(monkeypatch):
    def broken(*given, **more):
        raise FilmNotConverged("piston: Roelands, pressure: 4e9 MPa", "a shorter step")

    monkeypatch.setattr(floating_gaps, "run_revolution", broken)
    point = operating_point(PUMP)
    at, parts, cycle = rotor(PUMP, point), floating_parts(PUMP), lumped_point(PUMP, point).cycle
    driven = drives(at, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size))
    stiff = RIGID.including(Effect.PRESSURE_VISCOSITY)
    with pytest.raises(FilmNotConverged, match=r"Roelands.*Try: elastic walls, or oil of one viscosity.*shorter step"):
        floating_gaps.piston_revolution(at, parts, driven.piston, FloatingOptions(stiff))
    with pytest.raises(FilmNotConverged, match=r"Try: a shorter step$"):
        floating_gaps.piston_revolution(at, parts, driven.piston, FloatingOptions(RIGID))


def mean_film(point: FloatingPoint, gap: str) -> float:
    """Film over area and turn, m."""
    return float(np.mean([at.mean_film for at in getattr(point.kinds[0].gaps, gap).turn.instants]))


@pytest.fixture(scope="module")
def plain() -> FloatingPoint:
    return floating({})


OUTSIDE = {
    "control_flow": {"area": 2e-7, "laminar": 0.5},
    "laminar_cross_leak": {"conductance": 1.2e-14},
    "churning": {"factor": 1.0},
}
OF_FORCES = {
    "slipper_lift": {"ride_height": 1e-4, "retainer_force": 0.0},
    "mixed_friction": {"slipper": 0.08, "hersey_scale": 1e-6},
}


IN_FILMS = {**OF_FORCES, "shear_thinning": {"drop": 0.3, "rate": 1e3}}
"""Of the balance of forces, and oil that thins by 30 % in any film of a pump."""


@pytest.fixture(scope="module")
def inside() -> FloatingPoint:
    return floating(IN_FILMS)


@pytest.fixture(scope="module")
def found() -> FloatingPoint:
    return floating({**OUTSIDE, **IN_FILMS})


@pytest.mark.slow
def test_what_acts_outside_the_films_adds_what_it_adds_at_the_lumped_fidelity(inside, found):
    """Drain, cross leak and drag: flows and torque of both fidelities grow alike."""
    lumped = [lumped_point(one, operating_point(one)).bench for one in (PUMP, extended(OUTSIDE))]
    before, after = inside.pump_point, found.pump_point
    for name in ("delivery_flow", "inlet_flow", "drain_flow", "shaft_torque"):
        own = getattr(after.bench, name) - getattr(before.bench, name)
        if name == "shaft_torque":
            own -= (after.pairs.power - before.pairs.power) / before.point.shaft_speed
        expected = getattr(lumped[1], name) - getattr(lumped[0], name)
        assert own == pytest.approx(expected, rel=0.02, abs=1e-4 * abs(getattr(lumped[0], name))), name
    assert after.checks.energy_balance_error < BALANCED


@pytest.mark.slow
def test_oil_that_thins_shears_more_easily_at_the_films_own_rates(plain, inside):
    """Every film runs at rates far beyond 1e3 1/s: shear at one film thickness falls by the whole drop.

    Films of thinner oil tilt by other angles too, which shear at one mean thickness notices by some percent.
    """
    for pair, gap in (("slipper_swash_plate", "slipper"), ("valve_plate_cylinder", "block")):
        before, after = (
            getattr(one.pump_point.pairs, pair).mean_viscous * mean_film(one, gap) for one in (plain, inside)
        )
        assert after == pytest.approx(0.7 * before, rel=0.04), pair


@pytest.mark.slow
def test_what_the_forces_place_is_told_and_not_doubled(plain, inside):
    """A lift by its law would multiply the slippers' film; floating, the film itself says how they ride."""
    before, after = (mean_film(one, "slipper") for one in (plain, inside))
    assert after == pytest.approx(before, rel=0.05)
    told = [str(one) for one in inside.kinds[0].parts.taken if one.path.startswith("physics.")]
    assert len(told) == len(OF_FORCES)
    assert "slippers ride and tilt as the forces" in told[0]


@pytest.mark.long
def test_clearance_and_stroke_are_those_that_effects_leave(plain):
    pump = extended({"thermal_clearance": {"piston": {"rate": 0.01}}, "swash_droop": {"rate": 3e-10, "play": 0.0}})
    warm = replace(operating_point(pump), temperature=pump.operating.temperature + 10.0)
    found = floating_point(pump, warm, COARSE)
    assert found.rotor.pump.piston.radial_clearance == pytest.approx(1.1 * PUMP.piston.radial_clearance)
    less = 1.0 - found.rotor.point.displacement_ratio
    assert 0.0 < less < 0.05
    falls = 1.0 - found.pump_point.bench.delivery_flow / plain.pump_point.bench.delivery_flow
    assert falls == pytest.approx(less, rel=0.3)


@pytest.mark.slow
def test_forces_between_the_parts_are_those_under_the_plate_that_gives_way():
    """The plate's normal is that under which the films float: what it has across is the friction of the slippers."""
    pump = extended({"swash_droop": {"rate": 3e-10, "play": 2.9e-3}})
    found = floating_point(pump, operating_point(pump), replace(COARSE, finer=0.25))
    forces = floating_joint_forces(found)
    assert forces.group.drive.swash_angle == found.rotor.drive.swash_angle
    group = found.kinds[0].drives.group
    lift = group.forces.lift + group.held
    friction = group.plate + lift[:, None] * plate_axes(found.rotor.drive)[2]
    np.testing.assert_allclose(forces.loads[0].known.rubbing.T, friction, atol=1e-6)


@pytest.mark.long
def test_springs_soften_the_film_that_states_them_alone():
    """And oil of another coefficient stands in all three films for the pump's own, by Roelands' law."""
    pump = extended({"elastic_opening": {"slipper": {"opening": 1e-8}}, "viscosity_pressure": {"coefficient": 1e-8}})
    found = floating_point(pump, operating_point(pump), COARSE)
    physics = found.kinds[0].physics
    assert [getattr(physics, gap.value).elastic_walls for gap in Gap] == [False, True, False]
    assert all(getattr(physics, gap.value).pressure_viscosity for gap in Gap)
    growth = np.array([one.mean_film for one in found.kinds[0].gaps.slipper.turn.instants])
    assert growth.min() > 0.0
    assert found.pump_point.checks.energy_balance_error < BALANCED
