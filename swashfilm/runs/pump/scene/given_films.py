"""Films of a pump at given positions for ParaView: surfaces in the pump, series over the shaft angle."""

from pathlib import Path

import numpy as np

from gaps.films.over_turn import TURN, PeriodicCurve
from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.output.data.gap_names import FIELDS, kind_folder, vtu_name
from swashfilm.runs.pump.data import GAPS, PARTS
from swashfilm.runs.pump.scene.blocks import Blocks, ChamberKind, Scene, write_pump
from system.description.gap import Gap
from system.films.oil_state import UNITS, oil_state
from system.films.places import place_of
from system.points.films import FilmsKind, FilmsPoint


def write_fields(folder: Path, films: FilmsPoint) -> tuple[Blocks, ...]:
    """Write fields/*.vtu with piston.pvd, slipper.pvd, valve_plate.pvd, and the whole pump (`write_pump`).

    A gap's PVD follows one piston or slipper, or the valve plate's ring, over the turn (time = shaft angle in
    degrees). Pistons and slippers of the less common kinds have the same files in chamber_N. Returns the blocks of the
    pump at each angle.
    """
    for number, kind in enumerate(films.kinds):
        place = folder / _place(number, kind)
        (place / FIELDS).mkdir(parents=True)
        for gap in PARTS if number else GAPS:
            _write_gap(place, films, kind, Gap(gap))
    return write_pump(folder, films_scene(films))


def films_scene(films: FilmsPoint) -> Scene:
    """Return the pump over the turn: its kinds of chambers, the block's films over a pitch, or the turn."""
    most = films.gaps
    angles, known = most.shaft_angle, len(most.valve_plate)
    pistons = films.rotor.pump.pump.pistons
    kinds = tuple(
        _chambers(_place(number, kind), kind, kind.chambers if len(films.kinds) > 1 else tuple(range(pistons)))
        for number, kind in enumerate(films.kinds)
    )
    return Scene(kinds, angles[:known], TURN * known / len(angles))


def _chambers(place: str, kind: FilmsKind, chambers: tuple[int, ...]) -> ChamberKind:
    at = kind.gaps
    pressure = PeriodicCurve(at.shaft_angle, at.chamber_pressure)
    return ChamberKind(
        place, chambers, kind.rotor, kind.parts, at.shaft_angle, at.shaft_angle, lambda angle: float(pressure(angle))
    )


def _place(number: int, kind: FilmsKind) -> str:
    return kind_folder(kind.chambers) if number else ""


def _write_gap(place: Path, films: FilmsPoint, kind: FilmsKind, gap: Gap) -> None:
    """Write the films of a gap and their series; the ring's repeat after the known ones."""
    series, angles, rotor = getattr(kind.gaps, gap.value), kind.gaps.shaft_angle, kind.rotor
    for k, film in enumerate(series):
        at = place_of(gap, rotor, kind.parts, angles[k])
        oil = oil_state(rotor.pump, getattr(films.physics, gap.value), film.solution, rotor.point.viscosity)
        heads = {name: (values, UNITS[name]) for name, values in oil.items()}
        write_vtu(place / FIELDS / vtu_name(gap.value, k), film.solution, at, heads)
    names = [f"{FIELDS}/{vtu_name(gap.value, k % len(series))}" for k in range(len(angles))]
    degrees = np.degrees(angles)
    write_pvd(place / f"{gap.value}.pvd", [(float(degrees[k]), 0, names[k]) for k in range(len(angles))])
