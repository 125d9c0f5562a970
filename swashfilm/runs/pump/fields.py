"""Films of a pump for ParaView: surfaces in their position in the pump, series over the shaft angle."""

from pathlib import Path

import numpy as np

from gaps.standing.gap_film import GapFilm
from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.output.gap_names import FIELDS, vtu_name
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.oil_fields import oil_state
from system.description.gap import Gap
from system.films.places import place_of
from system.points.films import FilmsPoint


def write_fields(folder: Path, films: FilmsPoint) -> None:
    """Write fields/*.vtu and, beside them, piston.pvd, slipper.pvd, valve_plate.pvd and pump.pvd.

    A gap's PVD follows one piston or slipper, or the valve plate's ring, over the turn (time = shaft angle in
    degrees); pump.pvd shows all of them. All pistons repeat one piston at shifted angles and share its files.
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
            write_vtu(place / vtu_name(gap.value, k), film.solution, at, oil)
    _write_series(folder, films)


def _write_series(folder: Path, films: FilmsPoint) -> None:
    count, positions = len(films.gaps.shaft_angle), len(films.gaps.valve_plate)
    degrees = np.degrees(films.gaps.shaft_angle)
    names = {
        gap: [f"{FIELDS}/{vtu_name(gap, k % positions if gap == 'valve_plate' else k)}" for k in range(count)]
        for gap in GAPS
    }
    for gap in GAPS:
        write_pvd(folder / f"{gap}.pvd", [(degrees[k], 0, names[gap][k]) for k in range(count)])
    whole = []
    for k in range(count):
        chambers = [(k + shift) % count for shift in range(0, count, positions)]
        parts = [names["valve_plate"][k], *(names[gap][j] for gap in ("piston", "slipper") for j in chambers)]
        whole += [(degrees[k], part, name) for part, name in enumerate(parts)]
    write_pvd(folder / "pump.pvd", whole)
