"""A film's mesh, conditions and state as tuples of arrays for compiled loops."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.hourglass import has_hourglass_mode, signs
from reynolds.fem.space import FilmSpace
from reynolds.problem import FilmProblem, Held
from reynolds.solve.boundary import BoundaryValues

Reals = NDArray[np.float64]
Marks = NDArray[np.bool_]
Numbers = NDArray[np.int32]


class Mesh(NamedTuple):
    """Numbering, pattern and element tensors of a space; `basis` and `points` as in `fem.kernels`.

    rim_*: of each facet of a named boundary the cell beside it, its unknowns (2 | 3, facets), its outward normal times
    its length (2, facets) m.
    """

    dofs: Numbers
    slots: Numbers
    shape: Numbers
    value: Reals
    corner: Reals
    gradient: Reals
    steep: Reals
    pairs: Reals
    parallel: Reals
    signs: Reals
    area: Reals
    steep_area: Reals
    indptr: Numbers
    indices: Numbers
    columns: Numbers
    is_quadrilateral: bool
    rim_cells: NDArray[np.int64]
    rim_unknowns: NDArray[np.int64]
    rim_normal: Reals
    basis: tuple[int, ...]
    points: tuple[int, ...]


def mesh_of(space: FilmSpace) -> Mesh:
    """The tables of a space."""
    tensors, tables, pattern = space.tensors, space.reference, space.pattern
    return Mesh(
        dofs=space.dofs,
        slots=pattern.slots,
        shape=tensors.shape,
        value=tables.value,
        corner=tables.geometry_value,
        gradient=tensors.gradient,
        steep=tensors.steep_gradient,
        pairs=tensors.pairs,
        parallel=tensors.parallel,
        signs=signs(space),
        area=space.area,
        steep_area=space.steep_area,
        indptr=pattern.indptr,
        indices=pattern.indices,
        columns=pattern.columns,
        is_quadrilateral=has_hourglass_mode(space),
        rim_cells=space.rim.cells,
        rim_unknowns=space.rim.dofs,
        rim_normal=space.rim_normal,
        basis=tables.loops[0],
        points=tables.loops[1],
    )


class Conditions(NamedTuple):
    """Boundary conditions and storage of one film.

    held (size,): unknowns at a given pressure; tied (size,): those that `FilmProblem.held_nodes` holds; rim_held
    (facets,): facets of a boundary at a given pressure. conserving: JFO. squeeze (cells, points) m/s; before
    (size,) m3: oil one step ago; step s; pockets (size,) m3: volume at a pocket's unknown.
    """

    held: Marks
    tied: Marks
    rim_held: Marks
    conserving: bool
    squeeze: Reals
    before: Reals
    step: float
    pockets: Reals


def conditions_of(
    problem: FilmProblem, setting: BoundaryValues, before: Reals, step: float, pockets: Reals
) -> Conditions:
    """The conditions of a problem, its storage given apart."""
    space = problem.space
    marks = [
        np.full(nodes.shape[1], isinstance(problem.boundary.get(name), Held))
        for name, nodes in space.facet_dofs.items()
    ]
    tied = np.zeros(space.size, dtype=bool) if problem.held_nodes is None else ~np.isnan(problem.held_nodes)
    return Conditions(
        held=setting.held,
        tied=tied,
        rim_held=np.concatenate([np.zeros(0, dtype=bool), *marks]),
        conserving=problem.cavitation is problem.cavitation.JFO,
        squeeze=problem.film.squeeze,
        before=before,
        step=step,
        pockets=pockets,
    )


class Filling(NamedTuple):
    """State of the oil: at the unknowns (size,) pressure Pa, film fraction, density ratio and its slope (1/Pa).

    by_pressure (cells, points) 1/Pa: relative slope of the conductance by pressure; cavity_ratio: density ratio at
    the cavitation pressure. Oil of constant laws has ratio 1 and slopes 0.
    """

    pressure: Reals
    fraction: Reals
    ratio: Reals
    ratio_slope: Reals
    by_pressure: Reals
    cavity_ratio: float
