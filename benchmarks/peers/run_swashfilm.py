"""This solver: its default for the mesh, chosen by itself."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
from film import journal, journal_mesh
from peer import asked, least, report

from reynolds.fem.space import film_space
from reynolds.problem import Cavitation
from reynolds.solve.loads import point_fields
from reynolds.solve.solver import FilmSolver

case = asked()
space = film_space(journal_mesh(case.cells), degree=case.degree)
solver = FilmSolver(space)
solution = solver.solve(journal(space, Cavitation.NONE))
solve = least(lambda: solver.solve(journal(space, Cavitation.NONE)), case.repeats)

carried = 2.0 * np.maximum(point_fields(solution).pressure, 0.0) * space.area
angle = space.points[0]
report(
    version("swashfilm"),
    space.size,
    solve,
    float(np.sum(carried * np.cos(angle))),
    float(np.sum(carried * np.sin(angle))),
)
