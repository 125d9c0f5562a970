"""Validity of the films of an operating point: warnings, each with its number, limit and remedy."""

from swashfilm.output.gap_names import LARGEST_RIGID_PRESSURE
from swashfilm.runs.pump.data import gap_films
from swashfilm.runs.pump.summary import gap_statement
from system.points.films import FilmsPoint

LARGEST_SAMPLING_ERROR = 0.02


def films_warnings(films: FilmsPoint) -> list[str]:
    """Return all warnings of a films point, `name: text` each."""
    return [*unsupported_loads(films), *impossible_pressures(films), *few_angles(films)]


def unsupported_loads(films: FilmsPoint) -> list[str]:
    """Return a warning for each gap whose film, at some angle, does not support its load at the given position."""
    return [
        f"load_not_carried: {gap.replace('_', ' ')}: {gap_statement(series)}; contact, squeeze or another "
        "position supplies the difference: --fidelity floating computes it"
        for gap, series in gap_films(films).items()
        if not all(film.holds_its_load for film in series)
    ]


def impossible_pressures(films: FilmsPoint) -> list[str]:
    """Return a warning for each gap whose film pressure exceeds the limit of rigid walls and isoviscous oil."""
    found = []
    for gap, series in gap_films(films).items():
        physics = getattr(films.physics, gap)
        if physics.elastic_walls and physics.pressure_viscosity:
            continue
        peak = max(film.loads.pressure_max for film in series)
        if peak > LARGEST_RIGID_PRESSURE:
            found.append(
                f"film_pressure_beyond_rigid: {gap.replace('_', ' ')}: film pressure up to {peak * 1e-6:.0f} MPa "
                f"(limit {LARGEST_RIGID_PRESSURE * 1e-6:.0f} MPa: walls deform and viscosity rises before); state "
                "a smaller eccentricity or tilt, a larger clearance, or both effects in [physics]: "
                f"compliance in [physics.elastic_opening.{gap}] and [physics.viscosity_pressure]"
            )
    return found


def few_angles(films: FilmsPoint) -> list[str]:
    """Return a warning where the leakage depends on the number of film angles."""
    if films.sampling_error <= LARGEST_SAMPLING_ERROR:
        return []
    return [
        f"film_angles_too_few: leakage changes by {films.sampling_error:.1%} when every second film angle is left "
        f"out (limit {LARGEST_SAMPLING_ERROR:.0%}); from Python, films_point(pump, point, positions_per_pitch=8)"
    ]
