"""Meshes of quadrilaterals on sections of gaps, finest at the edges.

Boundaries have names: "inlet" at the left, "outlet" at the right end, "axis" where y = 0 is one, "wall" elsewhere.
"""

from collections.abc import Callable

import numpy as np
import skfem

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

GROWTH = 1.25
"""Length of a cell over that of its neighbour nearer to an edge, at most."""
EDGE = 0.25
"""Length of the cell at an edge over the even cells of a mesh: the flow there is steep (Moffatt 1964)."""


def graded(start: float, end: float, at_start: float, at_end: float, largest: float = np.inf) -> Array:
    """Places from start to end in m, cells of given lengths at the ends that grow inwards by GROWTH at most."""
    whole = end - start
    left, right = [0.0], [0.0]
    a, b = at_start, at_end
    while left[-1] + right[-1] < whole:
        if a <= b:
            left.append(left[-1] + a)
            a = min(GROWTH * a, largest)
        else:
            right.append(right[-1] + b)
            b = min(GROWTH * b, largest)
    sizes = np.concatenate([np.diff(left), np.diff(right)[::-1]])
    return start + np.concatenate([[0.0], np.cumsum(sizes)]) * (whole / sizes.sum())


def joined(*parts: Array) -> Array:
    """Places of stretches that lie end to end, those between two of them once."""
    return np.concatenate([parts[0], *(part[1:] for part in parts[1:])])


def channel_mesh(length: float, height: float, along: int, across: int, *, even: bool = False) -> skfem.MeshQuad:
    """A straight channel, 0 to length along x, even cells; even: half of one, or a pipe of radius `height`."""
    mesh = skfem.MeshQuad.init_tensor(np.linspace(0.0, length, along + 1), np.linspace(0.0, height, across + 1))
    return _named(mesh, even)


def step_mesh(heights: tuple[float, float], lengths: tuple[float, float], cells: int) -> skfem.MeshQuad:
    """Two films end to end on a plane wall y = 0, of other heights before and behind x = 0; (before, behind) in m.

    `cells` even ones lie across the thinner film, finer near the edge at (0, the thinner height). Raises
    FilmInputError for films of one height.
    """
    before, behind = heights
    low, high = sorted(heights)
    if not 0.0 < low < high:
        raise FilmInputError("step", f"found heights {before:g} and {behind:g} m", "two that differ, above zero")
    size = low / cells
    x = joined(
        graded(-lengths[0], 0.0, size * before / low, EDGE * size, size * before / low),
        graded(0.0, lengths[1], EDGE * size, size * behind / low, size * behind / low),
    )
    y = joined(graded(0.0, low, size, EDGE * size, size), graded(low, high, EDGE * size, EDGE * size, high / cells))
    solid_side = -1.0 if before < behind else 1.0
    return _cut(x, y, lambda c: (solid_side * c[0] > 0.0) & (c[1] > low))


def groove_mesh(height: float, depth: float, width: float, lengths: tuple[float, float], cells: int) -> skfem.MeshQuad:
    """A film 0 < y < height with a groove of given depth above it, |x| < width/2; films (before, behind) it in m.

    `cells` even ones lie across the film, finer near the groove's edges.
    """
    size = height / cells
    edge, half = EDGE * size, 0.5 * width
    x = joined(
        graded(-half - lengths[0], -half, size, edge, size),
        graded(-half, half, edge, edge, max(width, height) / cells),
        graded(half, half + lengths[1], edge, size, size),
    )
    y = joined(
        graded(0.0, height, size, edge, size), graded(height, height + depth, edge, edge, (depth + height) / cells)
    )
    return _cut(x, y, lambda c: (np.abs(c[0]) > half) & (c[1] > height))


def orifice_mesh(
    radius: float, length: float, outer: float, reaches: tuple[float, float], cells: int
) -> skfem.MeshQuad:
    """A bore or slot of given radius or half height through a wall, |x| < length/2, between two wide pipes.

    `outer` is the pipes' radius or half height, `reaches` their lengths before and behind the wall. The flow is
    even about y = 0. `cells` even ones lie across the bore, finer near its two edges.
    """
    size = radius / cells
    edge, half, largest = EDGE * size, 0.5 * length, outer / cells
    x = joined(
        graded(-half - reaches[0], -half, largest, edge, largest),
        graded(-half, half, edge, edge, size),
        graded(half, half + reaches[1], edge, largest, largest),
    )
    y = joined(graded(0.0, radius, size, edge, size), graded(radius, outer, edge, edge, largest))
    return _cut(x, y, lambda c: (np.abs(c[0]) < half) & (c[1] > radius), even=True)


def _cut(x: Array, y: Array, solid: Callable[[Array], Array], *, even: bool = False) -> skfem.MeshQuad:
    """The grid of x and y less the cells whose middle (2, ..) is solid, boundaries named."""
    mesh = skfem.MeshQuad.init_tensor(x, y)
    middles = mesh.p[:, mesh.t].mean(axis=1)
    return _named(mesh.remove_elements(np.nonzero(solid(middles))[0]), even)


def _named(mesh: skfem.MeshQuad, even: bool) -> skfem.MeshQuad:
    """The mesh with its boundaries named; even: y = 0 is no wall but an axis."""
    start, end = mesh.p[0].min(), mesh.p[0].max()
    facets = mesh.boundary_facets()
    x, y = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    inlet, outlet, axis = x == start, x == end, (y == 0.0) & even
    parts = {"inlet": inlet, "outlet": outlet, "axis": axis, "wall": ~(inlet | outlet | axis)}
    return mesh.with_boundaries({name: facets[part] for name, part in parts.items() if part.any()})
