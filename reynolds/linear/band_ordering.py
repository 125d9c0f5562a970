"""An order of unknowns in which each is near those that it couples to: line after line across a film.

Cuthill and McKee (1969) walk from neighbours to neighbours of neighbours. From one unknown the front is
curved and twice as long as necessary; from a whole line across the film it stays a line. Around a ring two
fronts go both ways round.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, dijkstra

from reynolds.numerics.arrays import Array

Numbers = NDArray[np.intp]


def line_order(graph: csr_array) -> Numbers:
    """The unknowns (n,) of a symmetric graph in an order of narrow band, piece after piece."""
    count, piece = connected_components(graph, directed=False)
    walks = []
    for number in range(count):
        own = np.flatnonzero(piece == number)
        part = csr_array(graph[own][:, own])
        walks.append(own[_walk(part, _line(part))])
    return np.concatenate(walks)


def _line(graph: csr_array) -> Numbers:
    """A line of unknowns across a connected graph, at an end if it has one, in order.

    Half-way between two unknowns far apart the graph is cut across; the unknowns farthest from a cut are a line too.
    """
    one = int(np.argmax(_steps(graph, [0])))
    steps = _steps(graph, [one])
    apart = np.abs(steps - _steps(graph, [int(np.argmax(steps))]))
    away = _steps(graph, _joined(graph, apart == apart.min()))
    line = _joined(graph, away == away.max())
    part = csr_array(graph[line][:, line])
    return np.asarray(line[_walk(part, np.array([np.argmin(np.diff(part.indptr))]))])


def _steps(graph: csr_array, sources: Numbers | list[int]) -> Array:
    """Couplings from the nearest of the sources to each unknown, (n,)."""
    return np.asarray(dijkstra(graph, unweighted=True, indices=sources, min_only=True))


def _joined(graph: csr_array, among: NDArray[np.bool_]) -> Numbers:
    """Those of one connected piece of some unknowns."""
    found = np.flatnonzero(among)
    piece = connected_components(graph[found][:, found], directed=False)[1]
    return found[piece == piece[0]]


def _walk(graph: csr_array, first: Numbers) -> Numbers:
    """All unknowns of a connected graph, neighbours of the first ones first, and so on."""
    seen = np.zeros(graph.shape[0], dtype=bool)
    seen[first] = True
    walk = first.tolist()
    for at in walk:  # grows meanwhile
        beside = graph.indices[graph.indptr[at] : graph.indptr[at + 1]]
        new = beside[~seen[beside]]
        seen[new] = True
        walk.extend(new.tolist())
    return np.array(walk, dtype=np.intp)
