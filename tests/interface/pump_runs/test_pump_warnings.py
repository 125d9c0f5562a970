"""Warnings of `swashfilm run` about the films of the three gaps."""

from types import SimpleNamespace

import numpy as np
import pytest

from gaps import Effect, PistonDrive, PistonFilm, PistonShape, constant, standing_piston
from gaps.standing.gap_film import standing_piston_film
from reynolds import FilmSolver, held_at
from swashfilm.runs.film.solve.gap import GapStudy, PositionSource, gap_warnings
from swashfilm.runs.pump.summary import few_angles, impossible_pressures, unsupported_loads
from system import SMOOTH
from system.films.cycle import PLAIN, GapPhysics


def film(pressure, load=0.0):
    """A spinning piston at half its clearance with one pressure (Pa) at both ends, pushed along y (N)."""
    drive = PistonDrive(
        shaft_speed=220.0, viscosity=0.03, case_pressure=pressure, cavitation_pressure=-1e5, piston_spin=220.0,
        bore_spin=220.0, chamber_pressure=constant(pressure), reach=constant(40e-3), velocity=constant(0.0),
        outer=constant(0.0, 0.5 * load, 0.0, 0.5 * load),
    )  # fmt: skip
    posed = PistonFilm(PistonShape(22e-3, 15e-6, 40e-3), drive, cells=(24, 6))
    position = np.array([7.5e-6, 0.0, 7.5e-6, 0.0])
    return standing_piston_film(posed, held_at(FilmSolver(posed.space_at(0.0)), standing_piston(posed), 0.0, position))


def films(piston, other, physics=PLAIN):
    """The part of a FilmsPoint that is looked at: `piston` in the piston gap, `other` in the two others."""
    gaps = SimpleNamespace(piston=(piston,), slipper=(other,), valve_plate=(other,))
    return SimpleNamespace(kinds=(SimpleNamespace(chambers=(0,), gaps=gaps),), physics=physics)


@pytest.mark.parametrize(
    ("share", "words"),
    [
        (0.4, ("2.5 times the load", "push the part away")),
        (0.8, ("125.0% of the load", "push the part away")),
        (2.0, ("50.0% of the load", "a thinner film bears the rest")),
    ],
)
def test_a_load_that_is_not_the_films_is_told_whether_larger_or_smaller(share, words):
    held = film(100e6, 1.0).carried_load
    told = unsupported_loads(films(film(100e6, share * held), film(100e6)))
    assert len(told) == 1
    assert all(word in told[0] for word in words)


def test_a_load_that_is_the_films_is_not_told():
    held = film(100e6, 1.0).carried_load
    assert unsupported_loads(films(film(100e6, held), film(100e6))) == []


@pytest.mark.parametrize(
    ("share", "follows"), [(0.02, "50 times the load"), (2.0, "50.0% of the load"), (2.0, "bears the rest")]
)
def test_a_single_film_at_a_given_position_says_the_same(share, follows):
    held = film(100e6, 1.0).carried_load
    (told,) = gap_warnings(GapStudy(film(100e6, share * held), PositionSource.GIVEN, ()))
    assert follows in told["text"]
    assert told["text"].endswith("leave [position] out, and the part comes to rest")


def test_pressures_that_no_wall_would_stand_are_told():
    told = impossible_pressures(films(film(150e6), film(50e6)))
    assert len(told) == 1
    assert told[0].startswith("film_pressure_beyond_rigid: piston: film pressure up to 1")
    assert "limit 100 MPa" in told[0]


@pytest.mark.parametrize(
    ("effects", "count"),
    [
        ((Effect.ELASTIC_WALLS, Effect.PRESSURE_VISCOSITY), 0),
        ((Effect.ELASTIC_WALLS,), 1),
        ((Effect.PRESSURE_VISCOSITY,), 1),
    ],
)
def test_walls_that_give_way_and_oil_that_thickens_may_bear_such_pressures(effects, count):
    physics = GapPhysics.alike(SMOOTH.without(Effect.PRESSURE_VISCOSITY).including(*effects))
    assert len(impossible_pressures(films(film(150e6), film(50e6), physics))) == count


@pytest.mark.parametrize(("error", "count"), [(0.005, 0), (0.3, 1)])
def test_too_few_film_angles_are_told(error, count):
    told = few_angles(SimpleNamespace(sampling_error=error))
    assert len(told) == count
    assert all("30.0%" in text for text in told)
