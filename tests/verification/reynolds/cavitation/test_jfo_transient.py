"""Film equation: mass-conserving cavitation in time.

Each step stores what the film holds (implicit Euler). A cavity opens at once over half a film, grows, is
overtaken by the film that reforms, and closes: Ausas, Jai and Buscaglia 2009.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from reynolds import (
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Storage,
    film,
    film_space,
    rectangle,
)

SUPPLY = 0.025  # pressure at the ends
UNIT = 1.0 / 6.0  # viscosity with which the equation reads d/dx(h^3 dp/dx) = 2 d(theta h)/dt


def _thickness(t: float) -> float:
    return 0.125 * np.cos(4.0 * np.pi * t) + 0.375


def _rate(t: float) -> float:
    return -0.5 * np.pi * np.sin(4.0 * np.pi * t)


@dataclass(frozen=True)
class Moment:
    """One time: the film, and the oil (m3) that the step lost."""

    time: float
    solution: FilmSolution
    lost: float


def _march(space: FilmSpace, step: float, until: float, cavitation: Cavitation = Cavitation.JFO) -> Iterator[Moment]:
    """The oscillating film from rest and full; one implicit step after the other."""
    solver, before = FilmSolver(space), None
    held = space.lumped(np.full((1, 1), _thickness(0.0)))
    for k in range(1, round(until / step) + 1):
        posed = film(_thickness(k * step), UNIT)
        ends = {"right": Held(SUPPLY)}  # the left side, the middle of the film, is closed
        problem = FilmProblem(space, posed, ends, cavitation, storage=Storage(held, step))
        before = solver.solve(problem, before)
        lost = before.outflow[before.held].sum() * step + (before.holds - held).sum()
        held = before.holds
        yield Moment(k * step, before, float(lost))


def _half(lines: np.ndarray) -> FilmSpace:
    """Half of the film with nodes at these x, 0.5 .. 1."""
    n = len(lines) - 1
    space = film_space(rectangle((0.5, 0.01), (n, 1), cell=Cell.QUADRILATERAL))
    place = np.interp(space.vertices[:, 0], np.linspace(0.0, 0.5, n + 1), lines)
    return space.moved(np.column_stack([place, space.vertices[:, 1]]))


SOURCE = "Ausas, Jai and Buscaglia 2009, as ordinary differential equation"
PRESSURES = ((0.1, 5.302633), (0.125, 7.471738), (0.2, 11.261512))


def test_full_film_under_squeeze(validation, refine):
    """Before it ruptures: p_mid = p0 - h'/(4 h^3), to the first order of the implicit step."""

    def solve(steps: int) -> tuple[float, ...]:
        film_space_ = _half(np.linspace(0.5, 1.0, 33))
        at = {round(m.time, 9): float(m.solution.pressure.max()) for m in _march(film_space_, 0.2 / steps, 0.2)}
        return tuple(at[time] for time, _ in PRESSURES)

    found = refine(solve, (80, 160, 320), 1.0)
    for (time, printed), column in zip(PRESSURES, found, strict=True):
        assert SUPPLY - _rate(time) / (4.0 * _thickness(time) ** 3) == pytest.approx(printed, abs=0.6e-6)
        space_error = printed / 32**2  # of linear elements on a parabola
        validation(
            case="Oscillating squeeze film with cavitation",
            source=SOURCE,
            quantity=f"pressure in the middle at t = {time:g}",
            unit="1",
            expected=printed,
            obtained=column.finest,
            tolerance=column.tolerance(rounding=0.5e-6) + space_error,
            order=column.order,
        )


FINE = 0.955, 0.98  # where the edge of the cavity stays for long
EDGES = ((0.3, 0.976416), (0.35, 0.976317), (0.4, 0.973219), (0.45, 0.967990), (0.5, 0.960913))


def test_cavity_opens_and_closes(validation):
    """The edge Sigma of the cavity lies half a cell behind its last node; cells of 3.1e-4 where it stays."""
    step = 5e-4
    left, right = FINE
    parts = np.linspace(0.5, left, 121), np.linspace(left, right, 81)[1:], np.linspace(right, 1.0, 25)[1:]
    cell = (right - left) / 80
    space = _half(np.concatenate(parts))
    x = np.zeros(space.size)
    x[space.vertex_dofs] = space.vertices[:, 0]
    oil, ends = float(space.lumped(np.full((1, 1), _thickness(0.0))).sum()), {}
    for moment in _march(space, step, 0.74):
        assert abs(moment.lost) < 1e-13 * oil
        assert moment.solution.pressure.min() >= 0.0
        assert 0.0 < moment.solution.film_fraction.min() <= moment.solution.film_fraction.max() <= 1.0
        if moment.solution.cavity.any():
            ends[round(moment.time, 9)] = float(x[moment.solution.cavity].max()) + 0.5 * cell
    largest = max(ends.values())
    longest = [t for t, end in ends.items() if end == largest]
    rows = [
        ("time of rupture", 0.250079157, min(ends) - 0.5 * step, step, "half a step before the first cavity"),
        ("largest edge of the cavity", 0.976992295, largest, cell, "tolerance one cell"),
        (
            "time of the largest edge", 0.314825861, 0.5 * (longest[0] + longest[-1]),
            0.5 * (longest[-1] - longest[0]) + step, "while one node more is cavitated than before and after",
        ),
        *((f"edge of the cavity at t = {t:g}", end, ends[t], cell, "tolerance one cell") for t, end in EDGES),
        ("time when the cavity is gone", 0.732390, max(ends) + 0.5 * step, step, "half a step after the last one"),
    ]  # fmt: skip
    for quantity, expected, obtained, tolerance, note in rows:
        validation(
            case="Oscillating squeeze film with cavitation",
            source=SOURCE,
            quantity=quantity,
            unit="1",
            expected=expected,
            obtained=obtained,
            tolerance=tolerance,
            note=note,
        )
