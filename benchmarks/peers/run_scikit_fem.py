"""Plain scikit-fem: two forms and scipy's spsolve, as its examples do."""

from __future__ import annotations

import numpy as np
import skfem
from film import couette, journal_mesh, poiseuille
from peer import asked, least, report
from scipy.sparse.linalg import spsolve

ELEMENT = {1: (skfem.ElementQuad1(), 3), 2: (skfem.ElementQuad2(), 5)}  # quadrature that keeps the order

case = asked()
element, order = ELEMENT[case.degree]
basis = skfem.Basis(journal_mesh(case.cells).mesh, element, intorder=order)
held = basis.get_dofs(["left", "right", "top"])


def solve() -> np.ndarray:
    """One film: assembly and solution."""
    matrix, load = poiseuille.assemble(basis), couette.assemble(basis)
    return skfem.solve(*skfem.condense(matrix, load, D=held), solver=spsolve)


pressure = basis.interpolate(solve()).value
angle = basis.global_coordinates().value[0]
carried = 2.0 * np.maximum(pressure, 0.0) * basis.dx
report(
    skfem.__version__,
    basis.N,
    least(solve, case.repeats),
    float(np.sum(carried * np.cos(angle))),
    float(np.sum(carried * np.sin(angle))),
)
