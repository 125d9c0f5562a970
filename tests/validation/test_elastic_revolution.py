"""A floating gap between elastic walls, over the revolution: it closes, and opens under the pressure."""

from dataclasses import replace

import numpy as np
import pytest

from gaps import Accuracy, Effect, GapRevolution, Physics, SlipperReport
from gaps.revolution.march import Leg
from system import (
    RIGID,
    Drives,
    FloatingOptions,
    FloatingParts,
    Rotor,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    rotor,
    slipper_revolution,
)
from system.points.floating_gaps import block_revolution, piston_revolution

COARSE = FloatingOptions(RIGID, steps=24, accuracy=Accuracy(step=0.1), finer=0.5, keep=8)
SOFT = Physics().without(Effect.PRESSURE_VISCOSITY, Effect.HEAT)


def driven_at(pressure: str) -> tuple[Rotor, FloatingParts, Drives]:
    """ref90 at a delivery pressure and what drives its gaps."""
    pump = load_pump("ref90", {"operating.pressure": pressure})
    at, parts = rotor(pump, operating_point(pump)), floating_parts(pump)
    cycle = lumped_point(pump, at.point).cycle
    return at, parts, drives(at, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(len(cycle.shaft_angle)))


@pytest.fixture(scope="module")
def slippers() -> tuple[GapRevolution[SlipperReport], GapRevolution[SlipperReport]]:
    """That of ref90 at 10 MPa between rigid and between elastic walls."""
    at, parts, driven = driven_at("10 MPa")
    rigid, soft = (
        slipper_revolution(at, parts, driven.slipper, replace(COARSE, physics=physics)) for physics in (RIGID, SOFT)
    )
    return rigid, soft


@pytest.mark.long
def test_elastic_slipper_closes(slippers):
    soft = slippers[1]
    turn = soft.turn
    assert turn.repeats
    assert np.abs(turn.end - turn.start).max() <= turn.allowed
    assert soft.closing.largest_multiplier < 1.0
    for instant in turn.instants:
        outer = instant.outer_force
        rest = instant.film_force + instant.contact_force + outer + instant.inertia_force
        assert np.abs(rest).max() < 1e-3 * np.abs(outer).max()


@pytest.mark.long
def test_walls_give_way_to_the_pressure(slippers):
    """They open on the whole, and add nothing to the pressure. The film follows: it is not thicker on the whole."""
    rigid, soft = slippers
    for film in soft.turn.films.values():
        assert film.deformation is not None
        assert film.deformation.mean() > 0.0
    highest, there = (max(instant.pressure_max for instant in found.turn.instants) for found in (rigid, soft))
    assert there < 1.01 * highest


@pytest.mark.long
def test_elastic_piston_closes():
    """At rated pressure, on its edges in contact; between rigid walls these bear three times as much."""
    at, parts, driven = driven_at("35 MPa")
    accuracy = Accuracy(step=0.1, closed=0.02)
    soft, rigid = (
        piston_revolution(at, parts, driven.piston, FloatingOptions(physics, 24, accuracy, finer=0.25, keep=8))
        for physics in (Physics().without(Effect.HEAT), RIGID)
    )
    turn = soft.turn
    assert turn.repeats
    assert np.abs(turn.end - turn.start).max() <= turn.allowed
    assert soft.closing.largest_multiplier < 1.0
    for instant in turn.instants:
        missing = instant.film_force + instant.contact_force + instant.outer_force
        assert np.abs(missing).max() < 1e-3 * np.abs(instant.outer_force).max()
    pressed, hard = (np.mean([each.passed.contact_load for each in one.turn.instants]) for one in (soft, rigid))
    assert 0.0 < pressed < 0.5 * hard


@pytest.mark.slow
def test_elastic_block_closes():
    """With contact and oil that stiffens, at rated pressure; begun between rigid walls, it says what both took."""
    at, parts, driven = driven_at("35 MPa")
    options = FloatingOptions(
        Physics().without(Effect.HEAT), steps=27, accuracy=Accuracy(step=0.1, closed=3e-3), finer=0.25, keep=3
    )
    found = block_revolution(at, parts, driven.block, options)
    turn = found.turn
    assert turn.repeats
    assert np.abs(turn.end - turn.start).max() <= turn.allowed
    assert found.closing.largest_multiplier < 1.0
    assert list(found.spent) == [Leg.RIGID, Leg.ELASTIC]
    for instant in turn.instants:
        missing = instant.film_force + instant.contact_force + instant.outer_force
        assert np.abs(missing).max() < 1e-3 * np.abs(instant.outer_force).max()
        assert instant.pressure_max < 100e6
