"""Time of the derivatives of a film by its thickness, beside the film itself and beside differences.

    python benchmarks/film_gradient.py          about a minute

The finite journal bearing (L/D 1, eccentricity ratio 0.6), full, with rupture, with an oil-conserving cavity (JFO), and
a pad between elastic walls. One thread; each time is the least of the repeats. `film`: a cold solve with all outputs.
`first output`: its gradient by the solver's last factor, a transposed factor included where the balance is not
symmetric; `further output`: each one more. A difference for one parameter takes one more film; a gradient holds those
by the thickness at every place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from film import journal, journal_mesh
from journal_case import least, one_thread
from rich.console import Console
from rich.table import Table

from reynolds import (
    ZERO,
    Axis,
    Cavitation,
    Cell,
    DissipationOutput,
    Elastic,
    FilmProblem,
    FilmSolver,
    FlowOutput,
    FrictionOutput,
    Held,
    LoadOutput,
    Output,
    film,
    film_gradients,
    film_space,
    half_space,
    loads,
    rectangle,
)

CELLS = (80, 250, 790)  # round the bearing
PAD = ((24, 12), (48, 24), (72, 36))
REPEATS = 3


@dataclass(frozen=True)
class Timing:
    """Seconds of a film, of its first gradient and of each further one."""

    name: str
    unknowns: int
    film: float
    first: float
    further: float


def time_gradients(name: str, problem: FilmProblem, boundary: str) -> Timing:
    """The film solved cold, then one and four gradients after it."""
    solver = FilmSolver(problem.space)
    solution = solver.solve(problem)
    outputs: list[Output] = [LoadOutput(), DissipationOutput(), FrictionOutput(Axis.X), FlowOutput(boundary)]

    def gradients(count: int) -> Callable[[], object]:
        return lambda: film_gradients(solver, solution, outputs[:count])

    for made in (gradients(4), gradients(1)):  # compiled, and the factor available
        made()
    first, all_four = least(gradients(1), REPEATS), least(gradients(4), REPEATS)
    cold = least(lambda: loads(FilmSolver(problem.space).solve(problem)), REPEATS)
    return Timing(name, problem.space.size, cold, first, (all_four - first) / 3.0)


def soft_pad(cells: tuple[int, int]) -> FilmProblem:
    """A steel pad on a plastic runner, whose film opens by about a third of its thickness."""
    space = film_space(rectangle((0.02, 0.02), cells, cell=Cell.QUADRILATERAL))
    thickness = space.sample(lambda x, y: 1e-5 * (2.0 - x / 0.02))
    posed = film(thickness, 0.03, velocity_moving=(np.ones((1, 1)), ZERO))
    held = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    return FilmProblem(space, posed, held, walls=half_space(space, Elastic(3e9, 0.35)))


def table(timings: list[Timing]) -> Table:
    """One line per film and mesh."""
    shown = Table(title="Gradients of a film by its thickness, one thread")
    shown.add_column("film")
    for name in ("unknowns", "film s", "first output s", "further output s", "first/film", "further/film"):
        shown.add_column(name, justify="right")
    for row in timings:
        shown.add_row(
            row.name, f"{row.unknowns}", f"{row.film:.4f}", f"{row.first:.4f}", f"{row.further:.4f}",
            f"{row.first / row.film:.2f}", f"{row.further / row.film:.2f}",
        )  # fmt: skip
    return shown


def main() -> None:
    """Run it anew with one thread, which the numerical libraries read as they are loaded; print the table."""
    one_thread()
    timings = []
    for n in CELLS:
        space = film_space(journal_mesh(n))
        for cavitation in (Cavitation.NONE, Cavitation.REYNOLDS, Cavitation.JFO):
            name = f"journal bearing, cavitation {cavitation.value}"
            timings.append(time_gradients(name, journal(space, cavitation), "top"))
    timings += [time_gradients("soft pad, cavitation jfo", soft_pad(cells), "right") for cells in PAD]
    Console(width=140).print(table(timings))


if __name__ == "__main__":
    main()
