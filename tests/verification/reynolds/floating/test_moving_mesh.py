"""Piston film on a stretching mesh: storage against the walls' displacement.

Steps are of implicit Euler from a full film one step before, at given positions, so that pressures have closed
forms.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gaps import DepthPoints, Effect, Physics, PistonDrive, PistonFilm, PistonShape, Profile, Waviness, constant
from reynolds import FilmInputError, FilmSolution, FilmSolver, Held, Storage, boundary_flows
from reynolds.solve.transient import oil_held

DIAMETER, CLEARANCE, GUIDE, VISCOSITY = 22e-3, 15e-6, 45e-3, 0.0258
FLOOD, OUTWARDS, SHAFT = 10e6, 2.89, 220.0
FULL = Physics().without(Effect.CAVITATION)
SCALE = 12.0 * VISCOSITY * OUTWARDS * GUIDE / CLEARANCE**2  # pressure of a film that would store nothing


def _drive(**changed) -> PistonDrive:
    """A piston that leaves its flooded bore at a constant speed; its end 40 mm deep at time 0."""
    drive = PistonDrive(
        shaft_speed=1.0,  # angles are seconds
        viscosity=VISCOSITY,
        case_pressure=FLOOD,
        cavitation_pressure=-1e5,
        piston_spin=0.0,
        bore_spin=0.0,
        chamber_pressure=constant(FLOOD),
        reach=lambda time: np.asarray(40e-3 - OUTWARDS * time),
        velocity=constant(OUTWARDS),
        outer=constant(0.0, 0.0, 0.0, 0.0),
    )
    return replace(drive, **changed)


def _stepped(film: PistonFilm, position: np.ndarray, step: float, time: float = 0.0) -> FilmSolution:
    """The film at a time, a step after it stood full at the same position."""

    def at(moment: float):
        problem = film.problem_at(moment)
        opened = problem.space.sample_vertices(film.modes_at(moment) @ position)
        oil = replace(problem.film, thickness=problem.film.thickness + opened, thickness_at_vertices=None)
        return replace(problem, film=oil)

    before, now = oil_held(at(time - step)), at(time)
    return FilmSolver(now.space).solve(replace(now, storage=Storage(before, step)))


@pytest.mark.parametrize("step", [1e-4, 1e-3])
@pytest.mark.parametrize("eccentricity", [0.0, 0.6])
def test_uniform_pressure_in_a_stretching_film(step, eccentricity, validation):
    """A parallel piston that leaves a flooded bore changes no pressure, however long the step."""
    film = PistonFilm(PistonShape(DIAMETER, CLEARANCE, GUIDE), _drive(), physics=FULL, cells=(24, 8))
    position = eccentricity * CLEARANCE * np.array([0.6, 0.8, 0.6, 0.8])
    found = _stepped(film, position, step)
    validation(
        case="Piston gap that shortens, parallel piston",
        source="closed form: pressure stays as it was",
        quantity=f"change of pressure over 12 mu v L/c^2, eccentricity {eccentricity:g}, step {step:g} s",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(found.pressure - FLOOD).max()) / SCALE,
        tolerance=1e-11,
        note="round-off",
    )
    dragged = 0.5 * np.pi * DIAMETER * CLEARANCE * OUTWARDS
    assert boundary_flows(found)["case"] == pytest.approx(dragged, rel=1e-9)


def test_piston_that_passes_its_guide(validation):
    """Beyond the guide the film ends with the guide: nothing stretches, and the pressure stays the same too."""
    film = PistonFilm(
        PistonShape(DIAMETER, CLEARANCE, GUIDE),
        _drive(reach=lambda time: np.asarray(50e-3 - OUTWARDS * time)),
        physics=FULL,
        cells=(24, 8),
    )
    found = _stepped(film, np.zeros(4), 1e-4)
    assert found.problem.space.vertices[:, 1].min() == 0.0
    validation(
        case="Piston gap of the guide's length",
        source="closed form: pressure stays as it was",
        quantity="change of pressure over 12 mu v L/c^2",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(found.pressure - FLOOD).max()) / SCALE,
        tolerance=1e-11,
        note="round-off",
    )


def test_tapered_piston_carries_its_profile(validation, refine):
    """Seen from the piston the film is steady and the bore slides: q' = -v/2 int h^-2/int h^-3, p' from it."""
    fall, length = 6e-6, 40e-3  # from the chamber's end to the case edge
    taper = Profile((DepthPoints((0.0, 50e-3), (fall, fall - fall * 50e-3 / length)),))
    shape = PistonShape(DIAMETER, CLEARANCE, GUIDE, piston=taper)
    one, two = CLEARANCE + fall, CLEARANCE
    gathered = 0.5 * OUTWARDS * 2.0 * one * two / (one + two)  # int h^-2 = L/(h1 h2), int h^-3 by its mean square

    def pressure(at: float) -> float:
        """p at a share of the length from the chamber's end: int 6 mu v/h^2 - 12 mu q/h^3, h linear."""
        h, slope = one + (two - one) * at, (two - one) / length
        wedge = (1.0 / one - 1.0 / h) / slope
        flow = 0.5 * (1.0 / one**2 - 1.0 / h**2) / slope
        return -6.0 * VISCOSITY * OUTWARDS * wedge + 12.0 * VISCOSITY * gathered * flow

    def solve(along: int) -> tuple[float, float]:
        film = PistonFilm(shape, _drive(), physics=FULL, cells=(4, along))
        found = _stepped(film, np.zeros(4), 1e-9)
        middle = np.isclose(found.problem.space.vertices[:, 1], GUIDE - 0.5 * length)
        at = found.problem.space.vertex_dofs[middle]
        return float(found.pressure[at].mean()) - FLOOD, boundary_flows(found)["case"]

    peak, flow = refine(solve, (8, 16, 32))
    edge = np.pi * DIAMETER * (OUTWARDS * two - gathered)  # out of the bore: what the piston takes along less q'
    for quantity, unit, expected, obtained in (
        ("pressure at half length over the flood", "Pa", pressure(0.5), peak),
        ("flow over the case edge", "m3/s", edge, flow),
    ):
        validation(
            case="Tapered piston that leaves its bore",
            source="closed form in the piston's frame",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=obtained.finest,
            tolerance=obtained.tolerance() + 1e-4 * abs(expected),
            order=obtained.order,
            note="and 1e-4 of round-off in what a step of 1 ns stores",
        )


@pytest.mark.parametrize("part", ["piston", "bore"])
def test_waves_turn_with_their_part(part, validation):
    """A wavy part that spins: steady in its own frame, in which the other wall turns backwards."""
    waves = Profile((Waviness(2, 0.3 * CLEARANCE),))
    spin, other, step = 150.0, 40.0, 1e-7
    spins = {"piston_spin": spin, "bore_spin": other} if part == "piston" else {"piston_spin": other, "bore_spin": spin}
    shape = replace(PistonShape(DIAMETER, CLEARANCE, GUIDE), **{part: waves})
    at_rest = {"reach": constant(40e-3), "velocity": constant(0.0)}
    moving = PistonFilm(shape, _drive(**at_rest, **spins), physics=FULL, cells=(48, 6))
    stored = _stepped(moving, np.zeros(4), step)
    apart = {"piston_spin": 0.0, "bore_spin": 0.0} | {"bore_spin" if part == "piston" else "piston_spin": other - spin}
    problem = PistonFilm(shape, _drive(**at_rest, **apart), physics=FULL, cells=(48, 6)).problem_at(0.0)
    steady = FilmSolver(problem.space).solve(problem)
    size = float(np.abs(steady.pressure - FLOOD).max())
    validation(
        case="Wavy piston or bore that spins",
        source="the same film in the part's own frame",
        quantity=f"largest difference of pressure over the largest pressure, wavy {part}",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(stored.pressure - steady.pressure).max()) / size,
        # Implicit Euler: step/2 h'' over the rate (spin - mean spin) h' that makes the pressure, and safety 2.
        tolerance=step * 2 * spin * spin / (0.5 * (spin - other)),
    )


def test_boundaries_and_sides():
    """The chamber's pressure stands at the film's inner end, wherever the piston is."""
    drive = _drive(chamber_pressure=lambda time: np.asarray(20e6 + time), case_pressure=1e6)
    film = PistonFilm(PistonShape(DIAMETER, CLEARANCE, GUIDE), drive, physics=FULL, cells=(12, 4))
    problem = film.problem_at(1e-3)
    assert problem.boundary == {"chamber": Held(20e6 + 1e-3), "case": Held(1e6)}
    found = FilmSolver(problem.space).solve(problem)
    y = problem.space.vertices[:, 1]
    assert y.min() == pytest.approx(GUIDE - 40e-3 + OUTWARDS * 1e-3)
    assert y.max() == GUIDE
    assert found.pressure[problem.space.vertex_dofs[y == y.min()]] == pytest.approx(20e6 + 1e-3)


def test_piston_out_of_its_bore_is_refused():
    film = PistonFilm(PistonShape(DIAMETER, CLEARANCE, GUIDE), _drive(), cells=(12, 4))
    with pytest.raises(FilmInputError, match=r"piston at .* deg: its end -17.8 mm inside the bore"):
        film.problem_at(20e-3)
