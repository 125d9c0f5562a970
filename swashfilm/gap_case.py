"""A pump gap as a film case: `gap` and `pump` in place of mesh and formulas, with a position or a load."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

import numpy as np

from gaps.piston import PistonLoad, PistonState, eccentric
from gaps.slipper import SlipperLoad, SlipperPosition, SlipperState
from gaps.valve_plate import ValvePlatePosition, ValvePlateState
from reynolds.mesh import Array
from swashfilm.case_pump import CasePump, operating_rows, own_rows, read_case_pump
from swashfilm.case_table import Table, quoted
from system.instants import (
    Rotor,
    piston_geometry,
    piston_instant,
    rotor,
    slipper_instant,
    valve_plate_geometry,
    valve_plate_instant,
)
from system.operating import operating_point
from system.pump_file import load_pump
from system.units import Dimension, format_quantity

FORMAT = 1


class Gap(Enum):
    """The three gaps of a pump."""

    PISTON = "piston"
    SLIPPER = "slipper"
    VALVE_PLATE = "valve_plate"


@dataclass(frozen=True)
class PistonInstant:
    """A piston's film at one instant; balanced against the load, or at the position where that is stated."""

    state: PistonState
    load: PistonLoad
    position: Array
    balance: bool


@dataclass(frozen=True)
class SlipperInstant:
    """A slipper's film at one instant; balanced against the load, or at the position where that is stated."""

    state: SlipperState
    load: SlipperLoad
    position: SlipperPosition
    balance: bool


@dataclass(frozen=True)
class ValvePlateInstant:
    """The ring's film at one shaft angle and a position; `pressing_force` (N) is what it ought to hold."""

    state: ValvePlateState
    pressing_force: float
    position: ValvePlatePosition


Instant = PistonInstant | SlipperInstant | ValvePlateInstant


@dataclass(frozen=True)
class GapCase:
    """A gap case, validated: its name, the file's text, the same resolved, the rotor and the instant (SI).

    `load_is_stated`: the file itself gives the load, rather than the pump's motion; `finer`: how many times more
    cells than usual in each direction its mesh has.
    """

    name: str
    text: str
    resolved: str
    gap: Gap
    rotor: Rotor
    shaft_angle: float
    chamber_pressure: Array
    instant: Instant
    load_is_stated: bool
    finer: int = 1

    def refined(self) -> GapCase:
        """The same gap on a mesh twice finer."""
        return replace(self, finer=2 * self.finer)


def read_gap_case(name: str, text: str, top: Table, film: Table, folder: Path) -> GapCase | None:
    """The gap case of a file whose [film] table names a gap; None with its faults told in the tables' list.

    What the file leaves out comes from the pump: operating point, chamber pressure of the port that the chamber
    is at, load from the pump's motion, position from the balance with that load (piston and slipper) or as the
    description gives it (valve plate).
    """
    gap = film.choice("gap", Gap)
    film.get("revolution")
    if film is not top and top.get("revolution") is not None:
        top.fault("revolution", "a table beside a single instant", "revolution = true in [film]")
    pump = read_case_pump(top, film, folder)
    parts = pump.rotor if pump else None
    shaft_angle = film.quantity("shaft_angle", Dimension.ANGLE, 0.0)
    position, load = top.table("position"), top.table("load")
    if position and load:
        top.fault("load", "a load beside a position", "one of the two")
        load = None
    if gap is None:
        film.get("chamber_pressure")
        film.close()
        return None
    # After a fault the built-in pump stands in, so that the rest of the file is read for its faults too.
    known = parts or rotor(load_pump("ref90"), operating_point(load_pump("ref90")))
    angle = shaft_angle or 0.0
    pressures = _chamber_pressure(film, gap, known, angle, count_pistons=parts is not None)
    read = {Gap.PISTON: _piston, Gap.SLIPPER: _slipper, Gap.VALVE_PLATE: _valve_plate}[gap]
    instant = read(known, angle, pressures, position, load)
    for table in (film, position, load):
        if table and table is not top:
            table.close()
    if pump is None or instant is None or not _is_possible(top, film, pump.rotor, pressures, instant):
        return None
    case = GapCase(name, text, "", gap, pump.rotor, angle, pressures, instant, load is not None)
    return replace(case, resolved=_resolved(case, pump))


def _chamber_pressure(film: Table, gap: Gap, parts: Rotor, angle: float, *, count_pistons: bool) -> Array:
    """Chamber pressures (Pa): one, or one of each chamber for the valve plate; by port where none is stated.

    Faults are told; then the pressures are those of the ports. `count_pistons`: the number of pistons is known.
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


def _piston(
    parts: Rotor, angle: float, pressure: Array, position: Table | None, load: Table | None
) -> PistonInstant | None:
    state, pressed, given = piston_instant(parts, angle, float(pressure[0]))
    if load:
        force = load.pair("force", Dimension.FORCE)
        arm = load.quantity("arm", Dimension.LENGTH, pressed.arm)
        if force is None or arm is None:
            return None
        pressed = PistonLoad(force, arm)
    if position and "eccentricity_ratio" in position.values:
        ratio = position.number("eccentricity_ratio")
        if ratio is None:
            return None
        given = eccentric(piston_geometry(parts.pump), ratio, pressed.force)
    elif position:
        ends = [position.pair(f"eccentricity_{end}", Dimension.LENGTH) for end in ("chamber", "case")]
        if None in ends:
            return None
        given = np.array(ends, dtype=float).ravel()
    return PistonInstant(state, pressed, given, balance=position is None)


def _slipper(
    parts: Rotor, angle: float, pressure: Array, position: Table | None, load: Table | None
) -> SlipperInstant | None:
    state, pressed, given = slipper_instant(parts, angle, float(pressure[0]))
    if load:
        force = load.quantity("force", Dimension.FORCE)
        moment_x = load.quantity("moment_x", Dimension.TORQUE, 0.0)
        moment_y = load.quantity("moment_y", Dimension.TORQUE, 0.0)
        if force is None or moment_x is None or moment_y is None:
            return None
        pressed = SlipperLoad(force, moment_x, moment_y)
    if position:
        stated = _tilted(position)
        if stated is None:
            return None
        given = SlipperPosition(*stated)
    return SlipperInstant(state, pressed, given, balance=position is None)


def _valve_plate(
    parts: Rotor, angle: float, pressure: Array, position: Table | None, load: Table | None
) -> ValvePlateInstant | None:
    state, given, pressing_force = valve_plate_instant(parts, angle, pressure)
    if load:
        for key in load.values:
            load.get(key)
        load.fault("force", "a load on the valve plate", "a [position]: this version does not balance the block")
        return None
    if position:
        stated = _tilted(position)
        if stated is None:
            return None
        given = ValvePlatePosition(*stated)
    return ValvePlateInstant(state, pressing_force, given)


def _tilted(position: Table) -> tuple[float, float, float] | None:
    """Film thickness (m) at the origin and the slopes dh/dx, dh/dy (rad)."""
    thickness = position.positive("film_thickness", Dimension.LENGTH)
    slope_x = position.quantity("slope_x", Dimension.ANGLE, 0.0)
    slope_y = position.quantity("slope_y", Dimension.ANGLE, 0.0)
    if thickness is None or slope_x is None or slope_y is None:
        return None
    return thickness, float(np.tan(slope_x)), float(np.tan(slope_y))


def _is_possible(top: Table, film: Table, parts: Rotor, pressures: Array, instant: Instant) -> bool:
    """False, with the faults told, where the parts touch or a chamber is below the pressure of a cavity."""
    least, lowest = _least_film(parts, instant), instant.state.cavitation_pressure
    if touching := not least > 0.0:
        found = f"a least film thickness of {least:.4g} m"
        top.fault("position", found, "positive everywhere: parts that do not touch")
    if below := bool(pressures.min() < lowest):
        found = format_quantity(float(pressures.min()), Dimension.PRESSURE)
        least_pressure = format_quantity(lowest, Dimension.PRESSURE)
        film.fault("chamber_pressure", found, f"at least {least_pressure}, at which a cavity opens")
    return not touching and not below


def _least_film(parts: Rotor, instant: Instant) -> float:
    """Least film thickness (m) at the position: of a tilted plane at the outer edge, of a piston at an end."""
    match instant:
        case PistonInstant(position=ends):
            clearance = piston_geometry(parts.pump).radial_clearance
            return float(clearance - max(np.hypot(*ends[:2]), np.hypot(*ends[2:])))
        case SlipperInstant(position=at):
            radius = parts.pump.slipper.land_outer_radius
        case ValvePlateInstant(position=at):
            radius = valve_plate_geometry(parts.pump).land_radii[3]
    return float(at.film_thickness - radius * np.hypot(at.slope_x, at.slope_y))


def _resolved(case: GapCase, pump: CasePump) -> str:
    """A case file that gives this very case: operating point, pressures, and the position or the load."""
    angle = format_quantity(case.shaft_angle, Dimension.ANGLE)
    pressures = [quoted(format_quantity(value, Dimension.PRESSURE)) for value in case.chamber_pressure]
    stated = pressures[0] if len(pressures) == 1 else f"[{', '.join(pressures)}]"
    rows = [
        f"format = {FORMAT}", "", "[film]", f'gap = "{case.gap.value}"', f"pump = {quoted(pump.source)}",
        f'shaft_angle = "{angle}"', f"chamber_pressure = {stated}", *own_rows(pump.stated), "",
        *operating_rows(case.rotor.point), "", *_stated_rows(case),
    ]  # fmt: skip
    return "\n".join(rows) + "\n"


def _stated_rows(case: GapCase) -> list[str]:
    """Position or load; the pump's own load as a remark, since stating it would demand that a film carries it."""
    rows = _instant_rows(case.instant)
    if case.load_is_stated or rows[0] == "[position]":
        return rows
    return ["# balanced against the pump's own load:", *(f"# {row}" for row in rows)]


def _instant_rows(instant: Instant) -> list[str]:
    def shown(value: float, dimension: Dimension) -> str:
        return quoted(format_quantity(float(value), dimension))

    def both(x: float, y: float, dimension: Dimension) -> str:
        return f"[{shown(x, dimension)}, {shown(y, dimension)}]"

    match instant:
        case PistonInstant(_, load, _, True):
            force = both(*load.force, Dimension.FORCE)
            return ["[load]", f"force = {force}", f"arm = {shown(load.arm, Dimension.LENGTH)}"]
        case PistonInstant(_, _, at, False):
            ends = (("chamber", at[:2]), ("case", at[2:]))
            return [
                "[position]",
                *(f"eccentricity_{end} = {both(x, y, Dimension.LENGTH)}" for end, (x, y) in ends),
            ]
        case SlipperInstant(_, load, _, True):
            moments = (("moment_x", load.moment_x), ("moment_y", load.moment_y))
            return [
                "[load]",
                f"force = {shown(load.force, Dimension.FORCE)}",
                *(f"{key} = {shown(value, Dimension.TORQUE)}" for key, value in moments),
            ]
        case SlipperInstant(position=at) | ValvePlateInstant(position=at):
            slopes = (("slope_x", at.slope_x), ("slope_y", at.slope_y))
            return [
                "[position]",
                f"film_thickness = {shown(at.film_thickness, Dimension.LENGTH)}",
                *(f"{key} = {shown(np.arctan(slope), Dimension.ANGLE)}" for key, slope in slopes),
            ]
    raise AssertionError(instant)
