"""Warnings of a film whose thickness does not go with its extent: most often a unit mistaken."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from swashfilm.case.tables.film import extent_of, mean_over
from swashfilm.runs.film.checks.seam import seam_warnings

if TYPE_CHECKING:
    from swashfilm.case.file import FilmCase

LARGEST_THICKNESS_RATIO = 0.05  # of the film's extent; beyond, flow across the film is not negligible
LEAST_THICKNESS_RATIO = 1e-6  # of the film's extent; 10 nm, the least film that is oil, on 10 mm
LARGEST_EXTENT = 2.0  # m; the bearings of the largest machines are smaller

Warned = tuple[str, str]
"""Name and text of a warning."""


def extent_warnings(space: FilmSpace, thickness: Array | None) -> Iterator[Warned]:
    """Yield warnings of a film that is not thin, or is very wide or too thin for its extent.

    thickness: (cells | 1, points | 1) m, None where it is not known yet.
    """
    ratio = None if thickness is None else mean_over(space, thickness) / extent_of(space)
    if ratio is not None and ratio > LARGEST_THICKNESS_RATIO:
        yield (
            "film_not_thin",
            f"the mean film is {ratio:.2g} of the film's extent (limit {LARGEST_THICKNESS_RATIO:.2g} "
            "for Reynolds' equation): check the unit (um, not mm?) and the mesh (in metres?)",
        )
    width = float(np.ptp(space.vertices, axis=0).max())
    reasons = [f"the film is {width:.3g} m wide (limit {LARGEST_EXTENT:g} m)"] if width > LARGEST_EXTENT else []
    if ratio is not None and ratio < LEAST_THICKNESS_RATIO:
        reasons.append(f"the mean film is {ratio:.2g} of its extent (limit {LEAST_THICKNESS_RATIO:g})")
    if reasons:
        yield (
            "film_extent_unlikely",
            f'{" and ".join(reasons)}; is the mesh file in mm? mesh = {{ file = "PATH", unit = "mm" }} states it; '
            "else check the units of mesh and film thickness",
        )


def case_warnings(case: FilmCase) -> list[str]:
    """Return the warnings of a case before it is solved, `name: text` each."""
    thickness = None if case.stated.film.load else case.problem.film.thickness
    found = (*extent_warnings(case.problem.space, thickness), *seam_warnings(case.problem, case.stated.film.geometry))
    return [f"{name}: {text}" for name, text in found]
