"""Films of a pump at given positions for ParaView: surfaces in the pump, series over the shaft angle."""

from pathlib import Path

import numpy as np

from gaps.films.over_turn import TURN, PeriodicCurve
from gaps.standing.gap_film import GapFilm
from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.output.gap_names import FIELDS, vtu_name
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.oil_fields import UNITS, oil_state
from swashfilm.runs.pump.scene.blocks import Blocks, ChamberKind, Scene, write_pump
from system.description.gap import Gap
from system.films.places import place_of
from system.points.films import FilmsPoint


def write_fields(folder: Path, films: FilmsPoint) -> tuple[Blocks, ...]:
    """Write fields/*.vtu with piston.pvd, slipper.pvd, valve_plate.pvd, and the whole pump (`write_pump`).

    A gap's PVD follows one piston or slipper, or the valve plate's ring, over the turn (time = shaft angle in
    degrees). Returns the blocks of the pump at each angle.
    """
    place = folder / FIELDS
    place.mkdir()
    viscosity = films.rotor.point.viscosity
    gaps = films.gaps
    series: dict[Gap, tuple[GapFilm, ...]] = {
        Gap.PISTON: gaps.piston, Gap.SLIPPER: gaps.slipper, Gap.VALVE_PLATE: gaps.valve_plate,
    }  # fmt: skip
    for gap, films_of_gap in series.items():
        for k, film in enumerate(films_of_gap):
            at = place_of(gap, films.rotor, films.parts, films.gaps.shaft_angle[k])
            oil = oil_state(films.rotor.pump, getattr(films.physics, gap.value), film.solution, viscosity)
            heads = {name: (values, UNITS[name]) for name, values in oil.items()}
            write_vtu(place / vtu_name(gap.value, k), film.solution, at, heads)
    _write_series(folder, films)
    return write_pump(folder, films_scene(films))


def films_scene(films: FilmsPoint) -> Scene:
    """Return the pump over the turn: all chambers alike, the block's films over a pitch."""
    at = films.gaps
    pressure = PeriodicCurve(at.shaft_angle, at.chamber_pressure)
    pistons = tuple(range(films.rotor.pump.pump.pistons))
    kind = ChamberKind(
        "", pistons, films.rotor, films.parts, at.shaft_angle, at.shaft_angle, lambda a: float(pressure(a))
    )
    return Scene((kind,), at.shaft_angle[: len(at.valve_plate)], TURN / len(pistons))


def _write_series(folder: Path, films: FilmsPoint) -> None:
    count, positions = len(films.gaps.shaft_angle), len(films.gaps.valve_plate)
    degrees = np.degrees(films.gaps.shaft_angle)
    names = {
        gap: [f"{FIELDS}/{vtu_name(gap, k % positions if gap == 'valve_plate' else k)}" for k in range(count)]
        for gap in GAPS
    }
    for gap in GAPS:
        write_pvd(folder / f"{gap}.pvd", [(degrees[k], 0, names[gap][k]) for k in range(count)])
