"""Film case of a pump gap at one instant: `gap` and `pump` in place of mesh and formulas, position or load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from gaps.films.physics import Physics
from reynolds.numerics.arrays import Array
from swashfilm.case.gap.physics import SwitchesSection, choices
from swashfilm.case.gap.position import LOADS, POSITIONS, Load, Position, pose_of, stated_position, touching, with_arm
from swashfilm.case.gap.pump import CasePump, own_rows, read_case_pump
from swashfilm.case.tables.film import Geometry
from system.description.assumptions import Assumption
from system.description.gap import Gap
from system.films.cycle import GapPhysics
from system.films.parts import FloatingParts, floating_parts
from system.films.problems import RIGID
from system.films.rotor import Rotor, rotor
from system.inputs.sections.fields import Angle, FieldType, Several, Text, fields_of
from system.inputs.sections.reader import Reading, read_entry, read_section, table_section
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, format_quantity
from system.points.film_effects import FilmEffects, film_effects, floating_effects
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.operating import operating_point
from system.pump_file.file import load_pump

FORMAT = 1
HEAT_OF_A_TURN = "none: the temperature of parts depends on the whole turn"
Pressures = Annotated[tuple[float, ...], Several(), Dimension.PRESSURE]


@dataclass(frozen=True, kw_only=True)
class InstantSection:
    """[film]: gap of a pump at one instant."""

    gap: Gap
    pump: Annotated[str, Text.NAME]  # a built-in pump, or a pump file beside the case
    shaft_angle: Angle = 0.0  # of this chamber, of chamber 1 for the valve plate
    chamber_pressure: Pressures | None = None  # for the valve plate one of each chamber; left out: that of the port


@dataclass(frozen=True)
class GapCase:
    """A validated gap case: name, text of the file, resolved text, pump with its assumed values (SI).

    chamber_pressure (1,) Pa, or (z,) by chamber for the valve plate. position (k,) m in the coordinates of the
    gap's film; None: equilibrium position, under `load` or by default under the pump's forces. `finer`: factor on
    the usual number of cells in each direction; `assumptions`: for the values that the pump file leaves out.
    """

    name: str
    text: str
    resolved: str
    gap: Gap
    rotor: Rotor
    parts: FloatingParts
    shaft_angle: float
    chamber_pressure: Array
    physics: Physics
    position: Array | None
    load: Load | None
    assumptions: tuple[Assumption, ...]
    finer: int = 1

    @property
    def geometry(self) -> Geometry:
        """Shape of the faces: of a piston the cylinder around which its film is unrolled."""
        return Geometry.CYLINDER if self.gap is Gap.PISTON else Geometry.PLANE

    def refined(self) -> GapCase:
        """Return the same gap on a mesh twice finer."""
        return replace(self, finer=2 * self.finer)


def read_gap_case(name: str, text: str, top: Table, film: Table, folder: Path) -> GapCase | None:
    """Return the gap case of a file whose [film] table names a gap; None with its faults listed.

    Defaults come from the pump: operating point, chamber pressure of the port that the chamber faces, forces at
    that instant.
    """
    if film is not top and top.get("revolution") is not None:
        top.fault("revolution", "a table beside a single instant", "revolution = true in [film]")
    reading, faults = Reading(folder, faults=top.faults), len(top.faults)
    pump, stated = read_case_pump(top, film, folder), _film(top, film, reading)
    gap: Gap | None = getattr(stated, "gap", None)
    raw_position, raw_load = top.get("position"), top.get("load")
    if raw_position is not None and raw_load is not None:
        top.fault("load", "a load beside a position", "one of the two")
    position: Position | None = _of_gap("position", POSITIONS, gap, raw_position, reading)
    load: Load | None = _of_gap("load", LOADS, gap, raw_load, reading)
    physics = _physics(top)
    # After a fault the built-in pump replaces the stated one, so that all other faults are found too.
    known = pump.rotor if pump else rotor(load_pump("ref90"), operating_point(load_pump("ref90")))
    pressures = _chamber_pressure(film, stated, known, count_pistons=pump is not None)
    if gap is None or pump is None or len(top.faults) > faults:
        return None
    angle, effects = stated.shaft_angle, _effects(known, physics, held=raw_position is not None)
    parts, physics = effects.parts, getattr(effects.physics, gap.value)
    if physics.heat:
        film.fault("pump", "[physics.film_heating]", HEAT_OF_A_TURN)
        return None
    pose = None if position is None else pose_of(position, gap, known, parts, angle, pressures)
    forces = None if load is None else with_arm(load, known, angle)
    case = GapCase(name, text, "", gap, known, parts, angle, pressures, physics, pose, forces, pump.assumptions)
    return replace(case, resolved=_resolved(case, pump)) if _is_possible(top, film, case) else None


def _effects(at: Rotor, physics: Physics, *, held: bool) -> FilmEffects:
    """Return the parts and their physics, with the pump's [physics] of films that are held or float."""
    parts = floating_parts(at.pump)
    if held:
        return film_effects(at, parts, at.pump, GapPhysics.alike(physics))
    return floating_effects(at, parts, at.pump, physics)


def _of_gap(path: str, forms: Mapping[Gap, FieldType], gap: Gap | None, raw: object, reading: Reading) -> Any:
    """Return a table in the form of the gap; None if it is absent, and for an unknown gap."""
    return None if gap is None or raw is None else read_entry(path, forms[gap], raw, reading)


def _film(top: Table, film: Table, reading: Reading) -> InstantSection:
    """Return the keys of the gap, in [film] or at the top of the file; with faults only the valid ones."""
    own = {key: raw for key in (*fields_of(InstantSection), "revolution") if (raw := film.get(key)) is not None}
    values = own if film is top else dict(film.values)
    values.pop("revolution", None)
    reading.special = {film.name("pump"): lambda raw, *_: {"pump": raw}}
    reading.faulty.add(film.name("pump"))
    return read_section(film.path, InstantSection, values, reading)


def _physics(top: Table) -> Physics:
    physics = (table_section(top, "physics", SwitchesSection, left_out=True) or SwitchesSection()).physics(RIGID)
    if physics.heat:
        top.fault("physics.heat", '"solved"', HEAT_OF_A_TURN, '"none"')
    return physics


def _chamber_pressure(film: Table, stated: InstantSection, parts: Rotor, *, count_pistons: bool) -> Array:
    """Return chamber pressures (Pa): one, or one per chamber for the valve plate; by default those of the ports.

    Faults are listed; the pressures are then those of the ports. `count_pistons`: the number of pistons is known.
    """
    pistons = parts.pump.pump.pistons
    count = pistons if getattr(stated, "gap", None) is Gap.VALVE_PLATE else 1
    angles = (stated.shaft_angle + 2.0 * np.pi / pistons * np.arange(count)) % (2.0 * np.pi)
    given = stated.chamber_pressure
    if given is not None and len(given) == count:
        return np.array(given)
    if given is not None and count_pistons:
        film.fault("chamber_pressure", f"{len(given)} pressures", f"{count}, one of each chamber")
    return np.where(angles < np.pi, parts.point.inlet_pressure, parts.point.delivery_pressure)


def _is_possible(top: Table, film: Table, case: GapCase) -> bool:
    """Return False, with the faults listed, where parts touch or a chamber is below the cavity's pressure."""
    least = touching(case.gap, case.rotor, case.parts, case.shaft_angle, case.position)
    if least is not None:
        found = f"a least film thickness of {least:.4g} m"
        top.fault("position", found, "positive everywhere: parts that do not touch")
    if below := bool(case.chamber_pressure.min() < CAVITY_PRESSURE):
        found = format_quantity(float(case.chamber_pressure.min()), Dimension.PRESSURE)
        lowest = format_quantity(CAVITY_PRESSURE, Dimension.PRESSURE)
        film.fault("chamber_pressure", found, f"at least {lowest}, at which a cavity opens")
    return least is None and not below


def _resolved(case: GapCase, pump: CasePump) -> str:
    """Return the text of this case: operating point, pressures, physics, and the position or the load."""
    angle = format_quantity(case.shaft_angle, Dimension.ANGLE)
    pressures = [quoted(format_quantity(value, Dimension.PRESSURE)) for value in case.chamber_pressure]
    stated = pressures[0] if len(pressures) == 1 else f"[{', '.join(pressures)}]"
    rows = [
        f"format = {FORMAT}", "", "[film]", f'gap = "{case.gap.value}"', f"pump = {quoted(pump.source)}",
        f'shaft_angle = "{angle}"', f"chamber_pressure = {stated}", *own_rows(pump.stated),
        *section_rows("operating", pump.rotor.pump.operating),
        *section_rows("physics", SwitchesSection(**choices(case.physics))),
    ]  # fmt: skip
    if case.position is not None:
        rows += section_rows("position", stated_position(case.gap, case.rotor, case.position))
    elif case.load is not None:
        rows += section_rows("load", case.load)
    else:
        rows += ["", "# at rest under the pump's own forces"]
    return "\n".join(rows) + "\n"
