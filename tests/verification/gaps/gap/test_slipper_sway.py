"""Hydrostatic slipper under an oscillating load: amplitude, phase and memory of its motion."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import (
    Accuracy,
    Effect,
    GapRevolution,
    Physics,
    PocketOrifice,
    SlipperDrive,
    SlipperFilm,
    SlipperLands,
    SlipperShape,
    constant,
    evenly,
    face_force,
    floating_slipper,
    run_revolution,
)
from reynolds import FilmSolver, FloatingStage

INNER, OUTER, VISCOSITY, PRESSURE, LOAD = 5e-3, 10e-3, 0.03, 20e6, 2800.0
ORIFICE, SWAY = PocketOrifice(0.4e-3, 20e-3), 1e-3

LOG, RATIO = np.log(OUTER / INNER), INNER / OUTER
AREA = np.pi * (OUTER**2 - INNER**2) / (2.0 * LOG)
CAPILLARY = np.pi * ORIFICE.diameter**4 / (128.0 * VISCOSITY * ORIFICE.length)
POCKET = LOAD / AREA
FILM = np.cbrt(6.0 * VISCOSITY * LOG * CAPILLARY * (PRESSURE - POCKET) / (np.pi * POCKET))
STIFFNESS = 3.0 * LOAD / FILM * (1.0 - POCKET / PRESSURE)
SQUEEZE = 1.5 * np.pi * VISCOSITY * OUTER**4 / FILM**3 * (1.0 - RATIO**4 + (1.0 - RATIO**2) ** 2 / np.log(RATIO))
DAMPING = SQUEEZE + AREA**2 / (CAPILLARY + np.pi * FILM**3 / (6.0 * VISCOSITY * LOG))


def swayed(share: float, n: int) -> GapRevolution[float]:
    """Its turn at a speed for which k/(c w) = share; reports the film force's power on it, W."""
    drive = SlipperDrive(
        shaft_speed=STIFFNESS / (DAMPING * share),
        viscosity=VISCOSITY,
        density=870.0,
        case_pressure=0.0,
        cavitation_pressure=-1e5,
        spin=0.0,
        chamber_pressure=constant(PRESSURE),
        sliding=constant(0.0, 0.0),
        outer=lambda angle: face_force(OUTER, LOAD * (1.0 + SWAY * np.cos(angle)), np.zeros(2)),
    )
    shape = SlipperShape(SlipperLands(((INNER, OUTER),)), ORIFICE)
    film = SlipperFilm(shape, drive, physics=Physics().without(Effect.CAVITATION), cells=(n, 4 * n))

    def power(stage: FloatingStage) -> float:
        return float(stage.film_force @ stage.trial.rate)

    return run_revolution(
        FilmSolver(film.space),
        floating_slipper(film),
        evenly(drive.shaft_speed, 8 * n, keep=1),
        np.array([1.02 * FILM, 0.0, 0.0]),
        power,
        accuracy=Accuracy(step=1.0, closed=1e-7),
    )


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.2, 1.0])
def test_sway(share, validation, refine):
    """c h' + k h = -W1 cos wt by orifice, land and pocket; mesh and steps refined together."""
    exact = -SWAY * LOAD / (STIFFNESS + 1j * STIFFNESS / share)

    def solve(n: int) -> tuple[float, ...]:
        found = swayed(share, n)
        wave = 2.0 * np.mean((found.positions[:, 0] - FILM) * np.exp(-1j * found.angles)) / exact
        assert found.closing.turns <= 4
        assert np.abs(found.positions[:, 1:]).max() < 1e-6 * FILM
        return float(np.abs(wave)), float(np.angle(wave)), float(found.turn.slopes[0, 0])

    expected = 1.0, 0.0, np.exp(-2.0 * np.pi * share)
    names = ("amplitude over that of c h' + k h = W", "phase beside it", "left of a disturbance")
    for quantity, unit, value, column in zip(
        names, ("1", "rad", "1"), expected, refine(solve, (4, 8, 16)), strict=True
    ):
        validation(
            case="Hydrostatic slipper under an oscillating load",
            source="closed form: hydrostatic stiffness, squeeze of film and pocket",
            quantity=f"{quantity}, k/(c w) = {share:g}",
            unit=unit,
            expected=value,
            obtained=column.finest,
            tolerance=column.tolerance() + SWAY,
            order=column.order,
            note="load wavers by a thousandth",
        )


def test_orifice_takes_the_work_of_the_load():
    """Over the turn what the load does is what film and orifice take: the motion lags."""
    found = swayed(1.0, 6)
    work = np.array([instant.report for instant in found.turn.instants])
    load = [SWAY * LOAD * np.cos(i.angle) * i.rate[0] for i in found.turn.instants]
    assert -np.sum(load) == pytest.approx(-np.sum(work), rel=1e-2)
    assert np.sum(load) < 0.0
