"""What a reader must doubt about the films of an operating point: each with its number, limit and remedy."""

from __future__ import annotations

import numpy as np

from gaps.slipper import hagen_poiseuille_conductance
from swashfilm.pump_data import gap_films
from swashfilm.pump_summary import gap_statement
from system.films import FilmsPoint

LARGEST_RIGID_PRESSURE = 100e6
"""Pa. There the viscosity of mineral oil is several times that of the film, and steel gives by micrometres."""
LARGEST_SAMPLING_ERROR = 0.02
LARGEST_ORIFICE_ERROR = 0.02
ENTRY_AND_EXIT = 1.5
"""Velocity heads lost at a sharp entry and a free exit (Idelchik 1960)."""


def films_warnings(films: FilmsPoint) -> list[str]:
    """All warnings of a films point, `name: text` each."""
    return [
        *uncarried_loads(films),
        *impossible_pressures(films),
        *turbulent_orifice(films),
        *coarse_angles(films),
    ]


def uncarried_loads(films: FilmsPoint) -> list[str]:
    """A warning for each gap whose film, at some angle, does not hold its load at the position given."""
    return [
        f"load_not_carried: {gap.replace('_', ' ')}: {gap_statement(series)}; contact or what this model leaves "
        "out (squeeze, elasticity, shape of wear) makes up the difference"
        for gap, series in gap_films(films).items()
        if not all(film.holds_its_load for film in series)
    ]


def impossible_pressures(films: FilmsPoint) -> list[str]:
    """A warning for each gap whose film pressure lies beyond what a rigid isoviscous film may claim."""
    found = []
    for gap, series in gap_films(films).items():
        peak = max(film.loads.pressure_max for film in series)
        if peak > LARGEST_RIGID_PRESSURE:
            found.append(
                f"film_pressure_beyond_rigid: {gap.replace('_', ' ')}: film pressure up to {peak * 1e-6:.0f} MPa "
                f"(limit {LARGEST_RIGID_PRESSURE * 1e-6:.0f} MPa: walls give way and oil thickens before); give a "
                "smaller eccentricity or tilt, or a larger clearance"
            )
    return found


def turbulent_orifice(films: FilmsPoint) -> list[str]:
    """A warning where the slipper's orifice, taken as a capillary, passes too much for lack of its entry loss.

    Entry and exit cost 1.5 rho/2 (q/A)^2 beside the capillary's drop q/G. To first order the flow is too large by
    that loss over the whole pressure difference.
    """
    pump, point = films.rotor.pump, films.rotor.point
    part = pump.slipper
    area = 0.25 * np.pi * part.orifice_diameter**2
    flows = np.array([film.chamber_flow for film in films.gaps.slipper])
    drops = np.maximum(np.abs(films.gaps.chamber_pressure - point.case_pressure), 1e5)
    error = ENTRY_AND_EXIT * 0.5 * pump.oil.density * (flows / area) ** 2 / drops
    k = int(np.argmax(error))
    if error[k] <= LARGEST_ORIFICE_ERROR:
        return []
    conductance = hagen_poiseuille_conductance(part.orifice_diameter, part.orifice_length, point.viscosity)
    share = flows[k] / conductance / drops[k]
    return [
        f"orifice_not_a_capillary: slipper: the orifice passes {flows[k] * 6e4:.3g} L/min at "
        f"{flows[k] / area:.0f} m/s and takes {share:.0%} of the pressure as a capillary; entry and exit would "
        f"take {error[k]:.0%} of it more (limit {LARGEST_ORIFICE_ERROR:.0%}), so flow and film are too large; "
        "a smaller or longer orifice"
    ]


def coarse_angles(films: FilmsPoint) -> list[str]:
    """A warning where the leakage still depends on the number of film angles."""
    if films.sampling_error <= LARGEST_SAMPLING_ERROR:
        return []
    return [
        f"film_angles_too_few: leakage changes by {films.sampling_error:.1%} when every second film angle is left "
        f"out (limit {LARGEST_SAMPLING_ERROR:.0%}); from Python, films_point(pump, point, positions_per_pitch=8)"
    ]
