"""A pump gap's film solved: its balance or its given position, and its true place in the pump."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature
from typing import Any

from gaps.piston import PistonGap
from gaps.result import GapFilm, PositionSource
from gaps.slipper import SlipperGap
from gaps.valve_plate import ValvePlateGap
from reynolds.errors import FilmNotConverged
from reynolds.mesh import Array
from swashfilm.gap_case import Gap, GapCase, PistonInstant, SlipperInstant, ValvePlateInstant
from system.instants import piston_geometry, slipper_geometry, valve_plate_geometry
from system.places import bore_frame, slipper_frame


def solve_gap(case: GapCase) -> GapFilm:
    """The gap's film; where none balances the pump's own load it stands at the pump's position and says so.

    Raises FilmNotConverged where the case itself states the load and no film balances it: that is no film.
    """
    film = _solved(case)
    if case.load_is_stated and film.source is PositionSource.GIVEN:
        raise FilmNotConverged(film.verdict, "a smaller load, or a [position] in place of [load]")
    return film


def _solved(case: GapCase) -> GapFilm:
    pump = case.rotor.pump
    cells = gap_cells(case)
    match case.instant:
        case PistonInstant(state, load, position, balance):
            piston = PistonGap(piston_geometry(pump), cells)
            return piston.balanced(state, load, position) if balance else piston.at(state, load, position)
        case SlipperInstant(state, load, position, balance):
            slipper = SlipperGap(slipper_geometry(pump), cells)
            return slipper.balanced(state, load, position) if balance else slipper.at(state, load, position)
        case ValvePlateInstant(state, pressing_force, position):
            plate = valve_plate_geometry(pump, case.rotor.drive.dead_centre_shift)
            return ValvePlateGap(plate, cells).at(state, position, pressing_force).gap


def gap_cells(case: GapCase) -> tuple[int, int]:
    """The counts of cells that the gap's mesh is made of: the usual ones, times `case.finer`."""
    gap = {Gap.PISTON: PistonGap, Gap.SLIPPER: SlipperGap, Gap.VALVE_PLATE: ValvePlateGap}[case.gap]
    first, second = signature(gap).parameters["cells"].default
    return first * case.finer, second * case.finer


def true_place(case: GapCase) -> Callable[[Array], Array]:
    """Map of the gap's film plane (n, 2) m to its place in the pump (n, 3) m."""
    if case.gap is Gap.PISTON:
        frame = bore_frame(case.rotor, case.shaft_angle)
        radius = 0.5 * case.rotor.pump.pump.piston_diameter
        return lambda points: frame.cylinder(points, radius)
    if case.gap is Gap.SLIPPER:
        return slipper_frame(case.rotor, case.shaft_angle).plane
    return case.rotor.pump.valve_plate.sphere.in_space


def gap_summary(film: GapFilm) -> dict[str, Any]:
    """What a gap adds to a film's summary, SI with the unit in the key; position as `gaps` orders it."""
    return {
        "position_source": film.source.value,
        "position_verdict": film.verdict,
        "position_m_or_rad": [float(value) + 0.0 for value in film.position],
        "required_load_N": film.required_load,
        "carried_load_N": film.carried_load,
        "film_thickness_mean_m": film.film_thickness_mean,
        "chamber_flow_m3_per_s": film.chamber_flow,
        "leakage_flow_m3_per_s": film.leakage_flow,
        "friction_power_W": film.friction_power,
    }


def gap_warnings(film: GapFilm) -> list[dict[str, str]]:
    """A load that the film at the given position does not carry: name and text."""
    if film.holds_its_load:
        return []
    text = f"the film carries {film.carried_load:.0f} N of {film.required_load:.0f} N ({film.verdict})"
    return [{"name": "load_not_carried", "text": text}]
