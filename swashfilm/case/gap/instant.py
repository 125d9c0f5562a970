"""Film case of a pump gap at one instant: `gap` and `pump` in place of mesh and formulas, position or load."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from gaps.films.physics import Physics
from reynolds.numerics.arrays import Array
from swashfilm.case.gap.physics import PhysicsSection, choices
from swashfilm.case.gap.position import Load, load_rows, position_rows, read_load, read_position, touching
from swashfilm.case.gap.pump import CasePump, own_rows, read_case_pump
from system.description.gap import Gap
from system.films.parts import FloatingParts, floating_parts
from system.films.problems import RIGID
from system.films.rotor import Rotor, rotor
from system.inputs.sections.reader import Reading, read_section
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, format_quantity
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.operating import operating_point
from system.pump_file.file import load_pump

FORMAT = 1


@dataclass(frozen=True)
class GapCase:
    """A validated gap case: name, text of the file, resolved text, pump with its assumed values (SI).

    chamber_pressure (1,) Pa, or (z,) by chamber for the valve plate. position (k,) m in the coordinates of the
    gap's film; None: equilibrium position, under `load` or by default under the pump's forces. `finer`: factor on
    the usual number of cells in each direction.
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
    finer: int = 1

    def refined(self) -> GapCase:
        """Return the same gap on a mesh twice finer."""
        return replace(self, finer=2 * self.finer)


def read_gap_case(name: str, text: str, top: Table, film: Table, folder: Path) -> GapCase | None:
    """Return the gap case of a file whose [film] table names a gap; None with its faults listed.

    Defaults come from the pump: operating point, chamber pressure of the port that the chamber faces, forces at
    that instant.
    """
    gap = film.choice("gap", Gap)
    film.get("revolution")
    if film is not top and top.get("revolution") is not None:
        top.fault("revolution", "a table beside a single instant", "revolution = true in [film]")
    pump = read_case_pump(top, film, folder)
    angle = film.quantity("shaft_angle", Dimension.ANGLE, 0.0) or 0.0
    position, load = top.table("position"), top.table("load")
    if position and load:
        top.fault("load", "a load beside a position", "one of the two")
        load = None
    switches = top.table("physics") or Table("physics", {}, top.faults)
    chosen = read_section("physics", PhysicsSection, switches.values, Reading(faults=top.faults))
    physics = chosen.physics(RIGID)
    if physics.heat:
        switches.fault("heat", '"solved"', "none: the temperature of parts depends on the whole turn", '"none"')
    if gap is None:
        film.get("chamber_pressure")
        film.close()
        return None
    # After a fault the built-in pump replaces the stated one, so that all other faults are found too.
    known = pump.rotor if pump else rotor(load_pump("ref90"), operating_point(load_pump("ref90")))
    pressures = _chamber_pressure(film, gap, known, angle, count_pistons=pump is not None)
    case = GapCase(name, text, "", gap, known, floating_parts(known.pump), angle, pressures, physics, None, None)
    faults = len(top.faults)
    if position:
        case = replace(case, position=read_position(position, case.gap, known, case.parts, angle, pressures))
    if load:
        case = replace(case, load=read_load(load, gap, known, angle))
    for table in (film, position, load):
        if table and table is not top:
            table.close()
    if pump is None or len(top.faults) > faults or not _is_possible(top, film, case):
        return None
    return replace(case, resolved=_resolved(case, pump))


def _chamber_pressure(film: Table, gap: Gap, parts: Rotor, angle: float, *, count_pistons: bool) -> Array:
    """Return chamber pressures (Pa): one, or one per chamber for the valve plate; by default those of the ports.

    Faults are listed; the pressures are then those of the ports. `count_pistons`: the number of pistons is known.
    """
    count = parts.pump.pump.pistons if gap is Gap.VALVE_PLATE else 1
    angles = (angle + 2.0 * np.pi / parts.pump.pump.pistons * np.arange(count)) % (2.0 * np.pi)
    of_ports = np.where(angles < np.pi, parts.point.inlet_pressure, parts.point.delivery_pressure)
    raw = film.get("chamber_pressure")
    if raw is None:
        return of_ports
    listed = raw if isinstance(raw, list) else [raw]
    if len(listed) != count and count_pistons:
        film.fault("chamber_pressure", f"{len(listed)} pressures", f"{count}, one of each chamber")
        return of_ports
    many = len(listed) > 1
    names = [f"chamber_pressure[{k}]" if many else "chamber_pressure" for k in range(len(listed))]
    reader = Table(film.path, dict(zip(names, listed, strict=True)), film.faults)
    values = [reader.quantity(name, Dimension.PRESSURE) for name in names]
    return of_ports if None in values or len(values) != count else np.array(values, dtype=float)


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
        *section_rows("physics", PhysicsSection(**choices(case.physics))), "", *_stated_rows(case),
    ]  # fmt: skip
    return "\n".join(rows) + "\n"


def _stated_rows(case: GapCase) -> list[str]:
    if case.position is not None:
        return position_rows(case.gap, case.rotor, case.position)
    return load_rows(case.load) if case.load else ["# at rest under the pump's own forces"]
