"""Walking over quadrilaterals that lie in rows and columns, compiled once by numba.

A cell is given by its number, the local number p of its south-west corner and the step s (1 or 3) from there to
the south-east one: corners SW, SE, NE, NW are p, p + s, p + 2 s, p - s, all modulo 4.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

_FAST = {"cache": True, "error_model": "numpy"}

# numpy's integers: numba would compile a function anew for each constant of Python
EAST, NORTH, WEST, SOUTH = np.int64(0), np.int64(1), np.int64(2), np.int64(3)
FIRST, SOUTH_WEST, ONWARD = np.int64(0), np.int64(0), np.int64(1)


@njit(**_FAST)
def _owners(cells, size):
    """Cells at each unknown: those of unknown k are owner[first[k]:first[k + 1]]."""
    first = np.zeros(size + 1, np.int64)
    for e in range(cells.shape[0]):
        for k in range(4):
            first[cells[e, k] + 1] += 1
    for k in range(size):
        first[k + 1] += first[k]
    place = first[:-1].copy()
    owner = np.empty(4 * cells.shape[0], np.int32)
    for e in range(cells.shape[0]):
        for k in range(4):
            owner[place[cells[e, k]]] = e
            place[cells[e, k]] += 1
    return first, owner


@njit(**_FAST)
def _cross(cells, first, owner, cell, a, b):
    """The cell on the other side of the edge a, b, with the local numbers of a and b there.

    Cell -1 outside the mesh, -2 where it is not one cell with a and b side by side.
    """
    found, at_a, at_b = -1, 0, 0
    if a == b or first[a + 1] - first[a] > 4:
        return -2, 0, 0
    for k in range(first[a], first[a + 1]):
        other = owner[k]
        if other == cell:
            continue
        for la in range(4):
            for lb in range(4):
                if cells[other, la] == a and cells[other, lb] == b:
                    if found != -1 or (la - lb) % 2 == 0:
                        return -2, 0, 0
                    found, at_a, at_b = other, la, lb
    return found, at_a, at_b


@njit(**_FAST)
def _step(cells, first, owner, cell, p, s, way):
    """The next cell in a direction, with its corner and step; its number is negative as in `_cross`."""
    sw, se = cells[cell, p], cells[cell, (p + s) % 4]
    ne, nw = cells[cell, (p + 2 * s) % 4], cells[cell, (p - s) % 4]
    if way == EAST:
        other, a, b = _cross(cells, first, owner, cell, se, ne)
        return other, a, (a - b) % 4
    if way == NORTH:
        other, a, b = _cross(cells, first, owner, cell, nw, ne)
        return other, a, (b - a) % 4
    if way == WEST:
        other, a, b = _cross(cells, first, owner, cell, sw, nw)
        return other, (a - (b - a)) % 4, (b - a) % 4
    other, a, b = _cross(cells, first, owner, cell, sw, se)
    return other, (a + (a - b)) % 4, (a - b) % 4


@njit(**_FAST)
def _to_the_end(cells, first, owner, cell, p, s, way):
    """The last cell in a direction, the number on the way, and True if the way leads back to the start."""
    start, count = cell, 1
    while True:
        other, q, t = _step(cells, first, owner, cell, p, s, way)
        if other == start or other < 0 or count > cells.shape[0]:
            return cell, p, s, (count if other != -2 and count <= cells.shape[0] else -1), other == start
        cell, p, s = other, q, t
        count += 1


@njit(**_FAST)
def walk(cells, size):
    """Corners (rows, columns, 4) in the order SW, SE, NE, NW of cells in rows, and the closed directions.

    The rows are empty where the cells do not lie in rows and columns: every cell is reached once, or none is.
    """
    first, owner = _owners(cells, size)
    nothing = np.empty((0, 0, 4), np.int32)
    cell, p, s, _, around_x = _to_the_end(cells, first, owner, FIRST, SOUTH_WEST, ONWARD, WEST)
    cell, p, s, _, around_y = _to_the_end(cells, first, owner, cell, p, s, SOUTH)
    _, _, _, columns, _ = _to_the_end(cells, first, owner, cell, p, s, EAST)
    _, _, _, rows, _ = _to_the_end(cells, first, owner, cell, p, s, NORTH)
    if columns * rows != cells.shape[0] or columns < 0:
        return nothing, around_x, around_y
    corners = np.empty((rows, columns, 4), np.int32)
    for i in range(columns):
        up, q, t = cell, p, s
        for j in range(rows):
            for k in range(4):
                corners[j, i, k] = cells[up, (q + k * t) % 4]
            if j + 1 < rows:
                up, q, t = _step(cells, first, owner, up, q, t, NORTH)
                if up < 0:
                    return nothing, around_x, around_y
        if i + 1 < columns:
            cell, p, s = _step(cells, first, owner, cell, p, s, EAST)
            if cell < 0:
                return nothing, around_x, around_y
    return corners, around_x, around_y


@njit(**_FAST)
def find_places(indptr, indices, along, line_of, place_of, lines, around, total, places):
    """Index of each entry of the upper triangle in stencils (5, total), flat; unknown k at place_of[k].

    Stencil 0 is the centre, 1 to 4 the couplings east, north, north-east, north-west. False where an entry
    couples unknowns that are not neighbours.
    """
    for j in range(indptr.shape[0] - 1):
        for k in range(indptr[j], indptr[j + 1]):
            i = indices[k]
            dx, dy = along[j] - along[i], line_of[j] - line_of[i]
            if around and abs(dy) == lines - 1:
                dy = -1 if dy > 0 else 1
            if abs(dx) > 1 or abs(dy) > 1:
                return False
            at = i
            if dy < 0 or (dy == 0 and dx < 0):
                at, dx, dy = j, -dx, -dy
            which = (2 + (dx if dx >= 0 else 2)) if dy else dx
            places[k] = which * total + place_of[at]
    return True
