"""Outer bearing pads of the valve plate: lands beyond the sealing lands, with case oil all around them.

They are fixed to the plate while the block turns over them; the pads of a ring are equal and evenly spaced, the first
about pump angle 0.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
import skfem
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.fem.mesh import FilmMesh
from reynolds.numerics.arrays import Array

EDGE = "pads"
"""Name of the pads' edges in a mesh."""
LONG = 10.0  # cells around over across: pressure turns over a pad's width, not along it
CLOSED = 1e-9  # rad; remainder of a turn between the ends of a pad that is a whole ring


@dataclass(frozen=True)
class BearingPads:
    """A ring of pads: inner and outer radius (m), arc of one (rad; a turn: one whole ring), and number of pads.

    Raises FilmInputError for radii that do not rise from above zero and for pads that overlap.
    """

    inner_radius: float
    outer_radius: float
    arc: float
    number: int

    def __post_init__(self) -> None:
        if not 0.0 < self.inner_radius < self.outer_radius:
            found = f"radii {self.inner_radius:g} and {self.outer_radius:g} m"
            raise FilmInputError("bearing pads", found, "an outer one above the inner one, above zero")
        whole = self.number == 1 and abs(self.arc - 2.0 * np.pi) < CLOSED
        if self.number < 1 or (not 0.0 < self.arc * self.number < 2.0 * np.pi and not whole):
            found = f"{self.number} of {np.degrees(self.arc):g} deg"
            raise FilmInputError("bearing pads", found, "one or more with gaps between them, or one of a turn")

    @property
    def is_ring(self) -> bool:
        """True for a single pad without ends."""
        return self.arc > 2.0 * np.pi - CLOSED

    @property
    def area(self) -> float:
        """Area of all pads together, m2."""
        return 0.5 * self.number * self.arc * (self.outer_radius**2 - self.inner_radius**2)

    @property
    def mean_radius(self) -> float:
        """Width between inner and outer radius, m."""
        return 0.5 * (self.inner_radius + self.outer_radius)

    def cells(self, across: int) -> tuple[Array, NDArray[np.int64]]:
        """Vertices (2, n) m and quadrilaterals (4, m) of the pads, `across` cells wide, as many long or more."""
        radii = np.linspace(self.inner_radius, self.outer_radius, across + 1)
        length = self.arc * self.mean_radius
        around = max(int(np.ceil(length / (LONG * (radii[1] - radii[0])))), 24 if self.is_ring else across)
        columns = around if self.is_ring else around + 1
        angle = self.arc * (np.arange(columns) / around - 0.5)
        i, j = (part.ravel() for part in np.meshgrid(np.arange(across), np.arange(around), indexing="ij"))
        after = (j + 1) % columns
        one = np.vstack([i * columns + j, (i + 1) * columns + j, (i + 1) * columns + after, i * columns + after])
        places, quads = [], []
        for pad in range(self.number):
            turned = angle + 2.0 * np.pi * pad / self.number
            places.append(np.vstack([np.outer(radii, np.cos(turned)).ravel(), np.outer(radii, np.sin(turned)).ravel()]))
            quads.append(one + pad * len(radii) * columns)
        return np.hstack(places), np.hstack(quads)


def with_pads(film_mesh: FilmMesh, runs: Iterable[BearingPads], across: int, turned: float = 0.0) -> FilmMesh:
    """A mesh of quadrilaterals with the cells of all pads after its own, their edges named EDGE.

    `turned`: angle (rad) about which the first pad of a ring lies. Own vertices, cells and names are unchanged.
    """
    mesh = film_mesh.mesh
    places, quads, count = [mesh.p], [mesh.t], mesh.p.shape[1]
    for run in runs:
        own, cells = run.cells(across)
        c, s = np.cos(turned), np.sin(turned)
        own = np.array([[c, -s], [s, c]]) @ own
        places.append(own)
        quads.append(cells + count)
        count += own.shape[1]
    whole = skfem.MeshQuad(np.ascontiguousarray(np.hstack(places)), np.ascontiguousarray(np.hstack(quads)))
    number = {ends: facet for facet, ends in enumerate(map(tuple, np.sort(whole.facets.T, axis=1).tolist()))}
    names = {
        name: np.array([number[ends] for ends in map(tuple, np.sort(mesh.facets[:, facets].T, axis=1).tolist())])
        for name, facets in mesh.boundaries.items()
    }
    edge = whole.boundary_facets()
    names[EDGE] = edge[whole.facets[0, edge] >= mesh.p.shape[1]]
    return replace(film_mesh, mesh=replace(whole, _boundaries=names))
