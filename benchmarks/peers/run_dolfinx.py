"""dolfinx with PETSc, for Debian's own Python: matrix, vectors and solver kept from film to film.

`direct` is PETSc's Cholesky factorisation with its symbolic part kept: on this case up to 1e4 unknowns faster than the
LU of PETSc, MUMPS, SuperLU and UMFPACK and than CHOLMOD (which is 15 % faster at 1e5). `multigrid` is conjugate
gradients with GAMG, PETSc's own algebraic multigrid, to 1e-8; hypre's BoomerAMG takes about as long.
"""

from __future__ import annotations

import dolfinx
import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from journal_case import ROUND
from mpi4py import MPI
from peer import asked, least, report
from petsc4py import PETSc

METHODS: dict[str, dict[str, str | float]] = {
    "direct": {"ksp_type": "preonly", "pc_type": "cholesky"},
    "multigrid": {"ksp_type": "cg", "ksp_rtol": 1e-8, "pc_type": "gamg"},
}

case = asked()
plane = mesh.create_rectangle(
    MPI.COMM_WORLD, [[0.0, 0.0], [ROUND, 1.0]], [case.cells, case.rows], mesh.CellType.quadrilateral
)
space = fem.functionspace(plane, ("Lagrange", case.degree))
x = ufl.SpatialCoordinate(plane)
thickness = 1.0 + case.eccentricity * ufl.cos(x[0])
# By default UFL uses 49 points in a Q1 cell (degree 13, for the cosines) instead of four.
area = ufl.dx(metadata={"quadrature_degree": 2 * case.degree + 1})
p, f = ufl.TrialFunction(space), ufl.TestFunction(space)
conductance = fem.form(thickness**3 / 12.0 * ufl.dot(ufl.grad(p), ufl.grad(f)) * area)
couette = fem.form(0.5 * thickness * f.dx(0) * area)
held = mesh.locate_entities_boundary(
    plane, 1, lambda x: np.isclose(x[0], 0.0) | np.isclose(x[0], ROUND) | np.isclose(x[1], 1.0)
)
zero = fem.dirichletbc(PETSc.ScalarType(0.0), fem.locate_dofs_topological(space, 1, held), space)
matrix, load = petsc.create_matrix(conductance), petsc.create_vector(couette)
pressure = fem.Function(space)
for key, value in METHODS[case.method].items():
    PETSc.Options()[key] = value
krylov = PETSc.KSP().create(plane.comm)
krylov.setOperators(matrix)
krylov.setFromOptions()


def solve() -> None:
    """One film: assembly and solution, into `pressure`."""
    matrix.zeroEntries()
    petsc.assemble_matrix(matrix, conductance, bcs=[zero])
    matrix.assemble()
    with load.localForm() as local:
        local.set(0.0)
    petsc.assemble_vector(load, couette)
    petsc.apply_lifting(load, [conductance], bcs=[[zero]])
    petsc.set_bc(load, [zero])
    krylov.solve(load, pressure.x.petsc_vec)
    if krylov.getConvergedReason() < 0:
        raise RuntimeError(f"PETSc did not converge: reason {krylov.getConvergedReason()}")


def force(direction: ufl.core.expr.Expr) -> float:
    """Component of the force of the whole bearing's positive pressures."""
    return float(fem.assemble_scalar(fem.form(2.0 * ufl.max_value(pressure, 0.0) * direction * area)))


solve()
seconds = least(solve, case.repeats)
unknowns = space.dofmap.index_map.size_global
report(dolfinx.__version__, unknowns, seconds, force(ufl.cos(x[0])), force(ufl.sin(x[0])))
