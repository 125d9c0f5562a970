"""The whole pump over the turn for ParaView: named blocks of films and solids at each of its shaft angles.

Chambers of one kind share one piston and one slipper over the turn: the part of each chamber is that of the kind at
the chamber's own shaft angle, so that all of them share its files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath
from xml.sax.saxutils import quoteattr

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.solve.export import write_pvd
from swashfilm.output.data.gap_names import FIELDS, vtu_name
from swashfilm.runs.pump.scene.solids import Solids
from swashfilm.runs.pump.scene.surfaces import TURN, Surface, joined
from system.films.parts import FloatingParts
from system.films.rotor import Rotor

PUMP = "pump"
"""Folder of the solids, and of the list of blocks of each angle."""
OIL = "oil in the chambers"
Blocks = tuple[tuple[str, str], ...]
"""Name of each block and its file in the run folder."""


@dataclass(frozen=True)
class ChamberKind:
    """Chambers with equal pistons and slippers: their numbers from 0, and shaft angles (rad) of the kept films.

    place: folder of their files in the run folder; chamber_pressure: shaft angle (rad) -> Pa.
    """

    place: str
    chambers: tuple[int, ...]
    rotor: Rotor
    parts: FloatingParts
    piston_angles: Array
    slipper_angles: Array
    chamber_pressure: Callable[[float], float]

    @cached_property
    def solids(self) -> Solids:
        """The solids of the pump with these chambers."""
        return Solids(self.rotor, self.parts)


@dataclass(frozen=True)
class Scene:
    """A pump over the turn: its kinds of chambers, and the angles (rad) of the block's kept films with their period."""

    kinds: tuple[ChamberKind, ...]
    block_angles: Array
    block_period: float

    @property
    def times(self) -> Array:
        """Shaft angles (n,) rad at which the whole pump is shown: those of the first kind's pistons."""
        return self.kinds[0].piston_angles

    @property
    def pitch(self) -> float:
        """Angle between two chambers, rad."""
        return TURN / self.kinds[0].rotor.pump.pump.pistons

    @cached_property
    def looks(self) -> Array:
        """Angles (n,) rad of the pictures within a pitch, after which the block repeats."""
        return self.pitch * np.unique(np.round(self.times / self.pitch, 6) % 1.0)


def write_pump(folder: Path, scene: Scene) -> tuple[Blocks, ...]:
    """Write pump/ and pump.pvd (time = shaft angle in degrees); return the blocks of each time.

    The films must exist in fields/. pump/ has the solids, and pump_NNN.vtm with the blocks of each time: `piston 1`,
    `piston 1 film`, `slipper 1`, .. by the numbers of the chambers, `block`, `block film`, `valve plate`,
    `swash plate`, `shaft`, and the oil in the chambers with chamber number and pressure.
    """
    for kind in scene.kinds:
        own = folder / kind.place / PUMP
        own.mkdir(exist_ok=True)
        for k, angle in enumerate(kind.piston_angles):
            write_surface(own / vtu_name("piston", k), kind.solids.piston(angle))
        for k, angle in enumerate(kind.slipper_angles):
            write_surface(own / vtu_name("slipper", k), kind.solids.slipper(angle))
    solids = scene.kinds[0].solids
    for name, of in (("valve_plate", solids.valve_plate), ("swash_plate", solids.swash_plate), ("shaft", solids.shaft)):
        write_surface(folder / PUMP / f"{name}.vtu", of())
    for k, angle in enumerate(scene.looks):
        write_surface(folder / PUMP / vtu_name("block", k), solids.block(angle))
    for k, angle in enumerate(scene.times):
        _write_oil(folder / PUMP / vtu_name("oil", k), scene, float(angle))
    found = tuple(blocks_at(scene, k) for k in range(len(scene.times)))
    for k, (angle, blocks) in enumerate(zip(scene.times, found, strict=True)):
        _write_blocks(folder / _list_of(k), blocks, float(np.degrees(angle)))
    write_pvd(folder / "pump.pvd", [(float(np.degrees(at)), 0, _list_of(k)) for k, at in enumerate(scene.times)])
    return found


def blocks_at(scene: Scene, k: int) -> Blocks:
    """Return the blocks of the k-th time; a film is that of the kept angle nearest to its own."""
    angle = float(scene.times[k])
    found = [
        ("shaft", f"{PUMP}/shaft.vtu"),
        ("swash plate", f"{PUMP}/swash_plate.vtu"),
        ("valve plate", f"{PUMP}/valve_plate.vtu"),
        ("block", f"{PUMP}/{vtu_name('block', nearest(scene.looks, scene.pitch, angle))}"),
        ("block film", f"{FIELDS}/{vtu_name('valve_plate', nearest(scene.block_angles, scene.block_period, angle))}"),
        (OIL, f"{PUMP}/{vtu_name('oil', k)}"),
    ]
    of_chamber = {chamber: kind for kind in scene.kinds for chamber in kind.chambers}
    for gap in ("piston", "slipper"):
        for chamber, kind in sorted(of_chamber.items()):
            angles = kind.piston_angles if gap == "piston" else kind.slipper_angles
            file = vtu_name(gap, nearest(angles, TURN, angle + scene.pitch * chamber))
            name = f"{gap} {chamber + 1}"
            found += [(name, _in(kind, PUMP, file)), (f"{name} film", _in(kind, FIELDS, file))]
    return tuple(found)


def nearest(angles: Array, period: float, angle: float) -> int:
    """Return the number of the angle (rad) nearest to another one, both within a period."""
    away = (angles - angle + 0.5 * period) % period - 0.5 * period
    return int(np.argmin(np.abs(away)))


def write_surface(path: Path, surface: Surface, cells: Mapping[str, Array] | None = None) -> None:
    """Write a surface as VTU with fields on its cells by their heads."""
    import meshio

    fields = {head: [values] for head, values in (cells or {}).items()}
    meshio.write_points_cells(path, surface.points.astype(np.float32), [("quad", surface.cells)], cell_data=fields)


def _write_oil(path: Path, scene: Scene, shaft_angle: float) -> None:
    """Write the oil in all chambers with number and pressure of the chamber on each cell."""
    bodies, numbers, pressures = [], [], []
    for kind in scene.kinds:
        for chamber in kind.chambers:
            angle = shaft_angle + scene.pitch * chamber
            bodies.append(kind.solids.oil(angle))
            numbers.append(chamber + 1)
            pressures.append(kind.chamber_pressure(angle % TURN))
    sizes = [len(body.cells) for body in bodies]
    heads = {"chamber": np.repeat(numbers, sizes), "chamber_pressure [Pa]": np.repeat(pressures, sizes)}
    write_surface(path, joined(bodies), heads)


def _list_of(k: int) -> str:
    return f"{PUMP}/pump_{k:03d}.vtm"


def _in(kind: ChamberKind, folder: str, file: str) -> str:
    return (PurePosixPath(kind.place) / folder / file).as_posix()


def _write_blocks(path: Path, blocks: Sequence[tuple[str, str]], degrees: float) -> None:
    """Write a list of named blocks; their files are beside the folder of the list."""
    rows = "\n".join(
        f'    <DataSet index="{k}" name={quoteattr(name)} file={quoteattr("../" + file)}/>'
        for k, (name, file) in enumerate(blocks)
    )
    path.write_text(
        '<?xml version="1.0"?>\n'
        '<VTKFile type="vtkMultiBlockDataSet" version="1.0" byte_order="LittleEndian">\n'
        f"  <vtkMultiBlockDataSet>\n{rows}\n  </vtkMultiBlockDataSet>\n"
        '  <FieldData>\n    <DataArray type="Float64" Name="shaft_angle [deg]" NumberOfTuples="1" format="ascii">'
        f"{degrees:.9g}</DataArray>\n  </FieldData>\n"
        "</VTKFile>\n",
        encoding="utf-8",
    )
