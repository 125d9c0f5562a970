"""Measured profiles that a mesh does not resolve."""

from collections.abc import Iterator

import numpy as np

from gaps.shapes.profiles import missed_rise
from reynolds.problem import FilmSolution
from system.films.parts import FloatingParts
from system.films.rotor import Rotor

LARGEST_MISSED_RISE = 0.02  # of the radial clearance


def unresolved_profiles(rotor: Rotor, parts: FloatingParts, film: FilmSolution) -> Iterator[tuple[str, str]]:
    """Yield name and text of a warning of each profile of piston and bore with waves shorter than the film's cells."""
    rows = np.unique(film.problem.space.vertices[:, 1])
    clearance = rotor.pump.piston.radial_clearance
    limit = LARGEST_MISSED_RISE * clearance
    for part, profile in (("piston", parts.piston.piston), ("bore", parts.piston.bore)):
        if (missed := missed_rise(profile, rows - rows[0])) > limit:
            yield (
                "profile_not_resolved",
                f"over a cell of {1e3 * np.diff(rows).max():.2g} mm the film misses {1e6 * missed:.2g} um of the rise "
                f"of the {part}'s profile (limit {1e6 * limit:.2g} um, {LARGEST_MISSED_RISE:.0%} of the radial "
                "clearance); use a longer cutoff, points farther apart, or a finer mesh",
            )
