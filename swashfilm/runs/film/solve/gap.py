"""Solution of a pump gap's film at one instant: at a given position or at equilibrium."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

import numpy as np

from gaps.films.over_turn import constant
from gaps.films.slipper import face_force
from gaps.loads.ball_joint import lateral_force
from gaps.standing.gap_film import GapFilm, rest_from
from reynolds.errors import FilmInputError, FilmNotConverged, WallsOverlap
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.position import FaceLoad, PistonLoad, rim
from swashfilm.runs.film.solve.profiles import unresolved_profiles
from system.description.gap import Gap
from system.films.drives import Drives
from system.films.places import place_of
from system.films.positions import NO_RUBBING, instant_drives
from system.films.standing import StandingGap, standing_gap
from system.inputs.shown import quantity_text
from system.inputs.units import Dimension
from system.points.floating_gaps import BLOCK_START, SLIPPER_START

START = {
    Gap.PISTON: np.zeros(4),
    Gap.SLIPPER: np.array([SLIPPER_START, 0.0, 0.0]),
    Gap.VALVE_PLATE: np.array([BLOCK_START, 0.0, 0.0]),
}
THIN = np.array([1e-7, 0.0, 0.0])
"""m. Between flat faces a parallel film as thin as this supports the limit load of the hydrostatic balance."""

SEVERAL = 2.0
"""Ratio of supported to required load above which it is written as a multiple."""


class PositionSource(Enum):
    """Origin of a part's position: given by the case, or found as equilibrium."""

    GIVEN = "given"
    REST = "rest"


@dataclass(frozen=True)
class GapStudy:
    """A gap's film and the origin of its position.

    assumptions: neglected forces and assumed values; doubts: name and text of warnings of the solution.
    """

    film: GapFilm
    source: PositionSource
    assumptions: tuple[str, ...]
    doubts: tuple[tuple[str, str], ...] = ()


def solve_gap(case: GapCase) -> GapStudy:
    """Solve the gap's film at its position, or at equilibrium.

    Raises FilmNotConverged where the film does not converge, and where the part has no equilibrium: pulled off, or
    pressed on walls that do not support it.
    """
    gap = case_gap(case)
    stage = _at_rest(gap, case) if case.position is None else _held(gap, case)
    found = gap.report(stage)
    source = PositionSource.REST if case.position is None else PositionSource.GIVEN
    doubts = unresolved_profiles(case.rotor, case.parts, found.solution) if case.gap is Gap.PISTON else ()
    taken = map(str, (*case.parts.taken, *case.assumptions))
    return GapStudy(found, source, (NO_RUBBING, *taken), tuple(doubts))


def case_gap(case: GapCase) -> StandingGap[Any, Any]:
    """Return the gap of a case under its load, with its given or sought equilibrium position."""
    drives = _loaded(case, instant_drives(case.rotor, case.parts, case.shaft_angle, case.chamber_pressure))
    return standing_gap(case.gap, case.rotor, case.parts, drives, case.physics, case.finer)


def _held(gap: StandingGap[Any, Any], case: GapCase) -> FloatingStage:
    """Return the part at its position; raise FilmInputError, by the keys of the case, where it overlaps its wall."""
    try:
        return gap.held_at(case.shaft_angle, case.position)
    except WallsOverlap as reason:
        key = "eccentricity" if case.gap is Gap.PISTON else "film_thickness"
        expected = (
            "walls apart: nearer to the middle" if case.gap is Gap.PISTON else "walls apart: more film, less slope"
        )
        raise FilmInputError(f"position.{key}", f"{reason.found} between the shapes of the faces", expected) from None


def _at_rest(gap: StandingGap[Any, Any], case: GapCase) -> FloatingStage:
    """Return the part at rest; raise FilmNotConverged, between smooth faces with their limit load."""
    try:
        return rest_from(gap.solver, gap.floating, gap.time(case.shaft_angle), START[case.gap])
    except FilmNotConverged as reason:
        if case.gap is Gap.PISTON or case.physics.roughness:
            raise
        film = gap.report(gap.held_at(case.shaft_angle, THIN))
        limit = f"{film.carried_load:.5g} N"
        raise FilmNotConverged(
            f"{reason.what}; a parallel film of {1e6 * THIN[0]:g} um supports {limit} of {film.required_load:.5g} N",
            f"a load below {limit} near the middle of the film, or rough walls, whose contact supports the rest",
        ) from reason


def _loaded(case: GapCase, drives: Drives) -> Drives:
    """Return the drives, with the load of the case, if stated, in place of the pump's."""
    load = case.load
    if isinstance(load, PistonLoad):
        assert load.arm is not None
        force = lateral_force(case.parts.piston.guide_length, -load.arm, np.array(load.force))
        return replace(drives, piston=replace(drives.piston, outer=constant(*force)))
    if not isinstance(load, FaceLoad):
        return drives
    if case.gap is Gap.SLIPPER:
        outer = face_force(rim(case.gap, case.rotor), load.force, np.array([-load.moment_y, load.moment_x]))
        return replace(drives, slipper=replace(drives.slipper, outer=constant(*outer)))
    press = constant(-load.force, -load.moment_x, -load.moment_y)
    return replace(drives, block=replace(drives.block, press=press))


def true_place(case: GapCase) -> Callable[[Array], Array]:
    """Return the map of the gap's film plane (n, 2) m to its position in the pump (n, 3) m."""
    return place_of(case.gap, case.rotor, case.parts, case.shaft_angle)


def gap_summary(study: GapStudy) -> dict[str, Any]:
    """Return the gap's entries in a film's summary, SI with units in keys; position in the film's coordinates."""
    film = study.film
    return {
        "position_source": study.source.value,
        "position_m": [float(value) + 0.0 for value in film.position],
        "held_by": ", ".join(kind.value for kind in film.active),
        "required_load_N": film.required_load,
        "carried_load_N": film.carried_load,
        "contact_load_N": film.contact_load,
        "film_thickness_mean_m": film.film_thickness_mean,
        "chamber_flow_m3_per_s": film.chamber_flow,
        "leakage_flow_m3_per_s": film.leakage_flow,
        "friction_power_W": film.friction_power,
        "assumptions": list(study.assumptions),
    }


def gap_warnings(study: GapStudy) -> list[dict[str, str]]:
    """Return the study's doubts, and a warning where the film does not support its load at the given position."""
    film, found = study.film, [{"name": name, "text": text} for name, text in study.doubts]
    if study.source is PositionSource.REST or film.holds_its_load:
        return found
    remedy = "leave [position] out, and the part comes to rest"
    text = f"at the given position the film bears {borne(film)}: {imbalance(film)}; {remedy}"
    return [*found, {"name": "load_not_carried", "text": text}]


def borne(film: GapFilm) -> str:
    """Return the supported and the required load, in words."""
    share = film.carried_fraction
    times = f"{share:.2g} times" if share >= SEVERAL else f"{share:.1%} of"
    carried, required = (
        quantity_text(load, Dimension.FORCE, digits=3) for load in (film.carried_load, film.required_load)
    )
    return f"{carried}, {times} the load of {required}"


def imbalance(film: GapFilm) -> str:
    """Return the consequence for a part whose supported load differs from the required one."""
    if film.carried_load > film.required_load:
        return "the film would push the part away, to a thicker film"
    return "contact, squeeze or a thinner film bears the rest"
