"""The face of a slipper: sealing lands, grooves between them, and a mesh of the lands with the edges named.

A groove is closed, at the pressure at which inflow and outflow balance, or vented: open to the case. A land beyond the
first vented groove is a support land without sealing.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from gaps.shapes.round_mesh import round_scale
from reynolds.errors import FilmInputError
from reynolds.fem.mesh import FilmMesh, ring

Land = tuple[float, float]
"""Inner and outer radius, m."""


@dataclass(frozen=True)
class SlipperLands:
    """Lands (inner, outer radius) m from the pocket outwards; `vented`: numbers of the grooves open to the case.

    Groove k, from 1, lies beyond land k. Raises FilmInputError for lands out of order and for vented grooves that do
    not exist.
    """

    radii: tuple[Land, ...]
    vented: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        radii = np.array(self.radii).ravel()
        if not (len(radii) and radii[0] > 0.0 and np.all(np.diff(radii) > 0.0)):
            raise FilmInputError("slipper, lands", f"radii {radii.tolist()} m", "rising from above zero")
        if not set(self.vented) <= set(range(1, len(self.radii))):
            expected = f"numbers of grooves, 1 to {len(self.radii) - 1}"
            raise FilmInputError("slipper, vented grooves", f"{list(self.vented)}", expected)

    @property
    def inner_radius(self) -> float:
        """Radius of the pocket (m)."""
        return self.radii[0][0]

    @property
    def outer_radius(self) -> float:
        """Outer radius of the last land (m)."""
        return self.radii[-1][1]

    @property
    def sealing(self) -> tuple[Land, ...]:
        """The lands between pocket and case: up to the first vented groove."""
        return self.radii[: min(self.vented, default=len(self.radii))]

    @property
    def log_ratio(self) -> float:
        """Sum of ln(outer/inner) of the sealing lands: their resistance is 6 mu/(pi h^3) times this."""
        return float(sum(np.log(outer / inner) for inner, outer in self.sealing))

    @property
    def effective_area(self) -> float:
        """Lift of a parallel film over the pocket's pressure, pi sum(r2^2 - r1^2)/(2 sum ln(r2/r1)), m2.

        Exact without motion: pi int r^2 (-dp/dr) dr, the pressure falling with the logarithm over each land.
        """
        squares = sum(outer**2 - inner**2 for inner, outer in self.sealing)
        return float(0.5 * np.pi * squares / self.log_ratio)

    @property
    def land_area(self) -> float:
        """Area of all lands, m2: where the film is sheared."""
        return float(np.pi * sum(outer**2 - inner**2 for inner, outer in self.radii))

    @property
    def closed_grooves(self) -> tuple[tuple[str, Land], ...]:
        """Names of the closed grooves with their radii (m)."""
        between = enumerate(pairwise(self.radii), start=1)
        return tuple((f"groove_{n}", (one[1], two[0])) for n, (one, two) in between if n not in self.vented)

    @property
    def closed(self) -> tuple[str, ...]:
        """Names of the mesh's edges with one unknown pressure: the pocket and the closed grooves."""
        return ("pocket", *(name for name, _ in self.closed_grooves))

    @property
    def open(self) -> tuple[str, ...]:
        """Names of the mesh's edges at case pressure: the vented grooves and the rim."""
        return (*(f"groove_{n}" for n in self.vented), "case")

    @property
    def closed_areas(self) -> dict[str, float]:
        """Area (m2) of pocket and closed grooves."""
        radii = [0.0, *(radius for land in self.radii for radius in land)]
        areas = [np.pi * (end**2 - start**2) for start, end in zip(radii[::2], radii[1::2], strict=False)]
        names = ["pocket", *(f"groove_{n}" for n in range(1, len(self.radii)))]
        return {name: float(area) for name, area in zip(names, areas, strict=True) if name in self.closed}


def lands_between(
    inner_radius: float, outer_radius: float, grooves: Iterable[Land] = (), vented: Iterable[Land] = ()
) -> SlipperLands:
    """The lands between pocket and rim (m) with closed and vented grooves (inner, outer radius) m cut into it.

    Raises as `SlipperLands`.
    """
    cut = sorted([(*groove, False) for groove in grooves] + [(*groove, True) for groove in vented])
    radii = [inner_radius, *(radius for start, end, _ in cut for radius in (start, end)), outer_radius]
    lands = tuple(zip(radii[::2], radii[1::2], strict=True))
    return SlipperLands(lands, tuple(n for n, (*_, is_vented) in enumerate(cut, start=1) if is_vented))


def slipper_mesh(lands: tuple[Land, ...], cells: tuple[int, int]) -> FilmMesh:
    """Rings of quadrilaterals, one a land, `cells` (across each, around), with boundaries pocket, groove_k, case.

    Radii of each land rise by one ratio, as the pressure falls with the logarithm; polygons have the areas of the
    circles that they replace. A groove is one boundary: both its edges. Raises FilmInputError as
    `reynolds.fem.mesh.hollow_cylinder`.
    """
    radii = np.concatenate([np.geomspace(*land, cells[0] + 1) for land in lands])
    keep = np.ones((len(radii) - 1, cells[1]), dtype=bool)
    keep[cells[0] :: cells[0] + 1] = False
    whole = ring(radii * round_scale(np.full(cells[1], 2.0 * np.pi / cells[1])), cells[1], keep=keep)
    mesh, middle = whole.mesh, [0.5 * (one[1] + two[0]) for one, two in pairwise(lands)]
    facets = mesh.boundary_facets()
    distance = np.hypot(*mesh.p[:, mesh.facets[0, facets]])
    # Land k's inner edge and the land before's outer one lie on either side of the middle of groove k.
    number = np.searchsorted([0.5 * sum(land) for land in lands], distance)
    names = ["pocket", *(f"groove_{n + 1}" for n in range(len(middle))), "case"]
    edges = {name: facets[number == n] for n, name in enumerate(names)}
    return replace(whole, mesh=replace(mesh, _boundaries=edges))
