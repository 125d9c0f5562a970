"""A pump of which little is known: the rest is that of REF90, scaled to its displacement and number of pistons."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from operator import attrgetter, getitem
from pathlib import Path
from typing import Annotated, Any

from system.description.assumptions import Assumption
from system.description.pump import FORMAT, PumpDescription, PumpSection
from system.inputs.faults import InputFaults, nearest_choice
from system.inputs.sections.fields import AcuteAngle, Displacement, Length, Limits, fields_of
from system.inputs.sections.reader import Reading, read_entry, read_section
from system.inputs.toml_table import Table, fault_lines, read_toml
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity
from system.pump.laws.kinematics import SwashDrive, stroke
from system.pump_file.file import builtin_pumps, load_pump, pump_of_tables, resolved_toml

MODEL = "ref90"
NEEDED = ("slipper", "valve_plate", "ports")
"""Tables without which a pump file is a scant one."""
FEWEST, MOST = 5, 15  # pistons for which REF90's ports can be parted anew
ENDS = ("inner", "outer")
NARROWER = 0.999  # kidneys, so that rounded values still lie between their lands
_POWERS = {
    "pump.piston_diameter": (1, 0),
    "pump.pitch_radius": (0, 1),
    "pump.rated_speed": (0, -1),
    "piston.overhang": (1, 0),
    "piston.edge_relief.width": (1, 0),
    "bore.edge_relief.width": (1, 0),
    "piston.mass": (2, 1),
    "slipper.orifice_diameter": (1, 0),
    "slipper.orifice_length": (1, 0),
    "slipper.mass": (3, 0),
    "slipper.centre_of_mass_to_ball": (1, 0),
    "slipper.ball_joint_radius": (1, 0),
    "slipper.flange_thickness": (1, 0),
    "slipper.rim_relief.width": (1, 0),
    "valve_plate.kidney_pitch_radius": (0, 1),
    "ports.groove_area": (2, 0),
    "ports.kidney_area": (2, 0),
    "ball_guide.radius": (0, 1),
    "ball_guide.spring_preload": (2, 0),
    "block.mass": (0, 3),
    "bearings.front_diameter": (0, 1),
    "bearings.rear_diameter": (0, 1),
    "operating.speed": (0, -1),
}
"""Powers of the scales of the pistons (diameter) and of the group (pitch radius) with which a value goes."""

_WIDE: dict[str, float | str] = {
    "film_thickness": 0.5,
    "eccentricity_ratio": 0.2,
    "bulk_modulus": 0.1,
    "friction": 0.6,
    "guide_friction": 0.6,
    "bearing_friction": 0.6,
    "displacement": 0.005,
    "dead_volume": 0.3,
    "flow_coefficient": 0.3,
    "viscosity_slope": "0.0015 1/K",  # a grade leaves the viscosity index open: 95 to 150 is .007 1/K
    "inlet_share": 0.5,
}
"""[tolerance] of what is scaled, which a recording decides: the films of HST 196 are 1.5 to 1.9 times REF90's."""


@dataclass(frozen=True)
class KnownPump:
    """A pump with the `stated` paths of its file, and the `assumptions` for the others.

    scant: most of it is scaled; its [tolerance] is then wide where the file does not state it.
    """

    pump: PumpDescription
    scant: bool
    stated: frozenset[str]
    assumptions: tuple[Assumption, ...]


def known_pump(pump: PumpDescription | KnownPump) -> KnownPump:
    """The pump itself if it is partly known, else a pump that is stated in full."""
    return pump if isinstance(pump, KnownPump) else KnownPump(pump, False, frozenset(), ())


def load_known_pump(source: str | Path) -> KnownPump:
    """Return a built-in pump or that of a file, which may be scant: state little more than displacement and oil.

    A file is scant if it lacks one of the tables `NEEDED`; the rest is then REF90's, scaled. Raises InputFaults as
    `load_pump`; for a scant file also if pump.displacement, pump.pistons or the oil's viscosity is not stated.
    """
    if str(source) not in builtin_pumps() and Path(source).is_file():
        text, tables = read_toml(Path(source))
        if any(name not in tables for name in NEEDED):
            return _scaled(str(source), text, tables, Path(source).parent)
    return known_pump(load_pump(source))


@dataclass(frozen=True, kw_only=True)
class _Facts:
    """[pump]: size of a pump."""

    displacement: Displacement  # also as a volume, "60 cm3"
    pistons: Annotated[int, Limits(least=FEWEST, most=MOST)]
    swash_angle_max: AcuteAngle | None = None
    piston_diameter: Length | None = None
    pitch_radius: Length | None = None


def _scaled(source: str, text: str, stated: Mapping[str, Any], folder: Path) -> KnownPump:
    """The pump of a scant file."""
    top = Table("", stated, [])
    facts = _facts(top)
    oil = stated.get("oil")
    if not (isinstance(oil, dict) and ("grade" in oil or "kinematic_viscosity_40C" in oil)):
        top.fault("oil.grade", "missing", "the oil's grade, such as 'ISO VG 46', or its two viscosities")
    if facts is None or top.faults:
        raise InputFaults(source, top.faults, fault_lines(text, top.faults))
    tables: dict[str, Any] = {"name": Path(source).stem, "format": FORMAT, **_tables(facts), "tolerance": dict(_WIDE)}
    paths = set()
    for name, table in stated.items():
        if isinstance(table, dict) and isinstance(tables.get(name, {}), dict):
            if name == "oil" and "grade" in table:
                tables["oil"] = {k: v for k, v in tables["oil"].items() if not k.startswith("kinematic")}
            tables[name] = {**tables.get(name, {}), **table}
            paths |= {f"{name}.{key}" for key in table}
        else:
            tables[name] = table
    tables["pump"]["displacement"] = format_quantity(facts.displacement, Dimension.DISPLACEMENT)
    pump = pump_of_tables(source, tables, folder)
    return KnownPump(pump, True, frozenset(paths), _assumptions(tables, paths))


def _facts(top: Table) -> _Facts | None:
    """The size that a scant file states; None with its faults added."""
    table = top.table("pump", needed="with displacement and pistons")
    if table is None:
        return None
    own = {key: raw for key, raw in table.values.items() if key in fields_of(_Facts)}
    facts = read_section("pump", _Facts, own, Reading(special={"pump.displacement": _displacement}, faults=top.faults))
    known = [*fields_of(PumpSection)]
    for key in table.values:
        if key not in known:
            table.fault(key, "no key of this table", f"one of {', '.join(known)}", nearest_choice(key, known))
    return None if top.faults else facts


def _displacement(raw: object, _: Mapping[str, object], reading: Reading) -> Mapping[str, object]:
    """A displacement per revolution, also written "60 cm3"; none with its fault added."""
    try:
        return {"displacement": parse_quantity(raw, Dimension.VOLUME)}
    except QuantityError:
        return {"displacement": read_entry("pump.displacement", fields_of(_Facts)["displacement"], raw, reading)}


def _tables(facts: _Facts) -> dict[str, dict[str, Any]]:
    """REF90's tables at the size of the facts, values as text.

    Pistons keep their share of the pitch circle, and slippers are no wider than their distance allows: with the scale
    s of diameters and r of radii, r = s z/9 and s^2 r = V/(z area stroke) of REF90 at the swash angle. Films,
    clearances, depths of reliefs, angles and friction are REF90's, sliding speeds on the pitch circle at rated speed
    too; ports are parted by z.
    """
    model = load_pump(MODEL)
    tables = {k: dict(v) for k, v in tomllib.loads(resolved_toml(model)).items() if isinstance(v, dict)}
    swash = model.pump.swash_angle_max if facts.swash_angle_max is None else facts.swash_angle_max
    drive = SwashDrive(model.pump.pitch_radius, model.pump.bore_cone_angle, swash)
    area = math.pi / 4.0 * model.pump.piston_diameter**2
    size = facts.displacement / (facts.pistons * area * stroke(drive))  # = s^2 r
    share = facts.pistons / model.pump.pistons
    piston, group = _scales(facts, model, size, share)

    def put(path: str, value: float, dimension: Dimension) -> None:
        *sections, key = path.split(".")
        table: Any = reduce(getitem, sections, tables)
        table[key] = format_quantity(float(value), dimension, digits=5)

    for path, (of_piston, of_group) in _POWERS.items():
        put(path, attrgetter(path)(model) * piston**of_piston * group**of_group, _dimension(path))
    apart = group * math.sin(math.pi / facts.pistons) / math.sin(math.pi / model.pump.pistons)
    narrow = min(piston, apart)  # neighbours stay clear of each other
    for end in ENDS:
        path = f"slipper.land_{end}_radius"
        put(path, attrgetter(path)(model) * narrow, Dimension.LENGTH)
    plate, ports = model.valve_plate, model.ports
    for key in ("land_radius_1", "land_radius_2", "land_radius_3", "land_radius_4"):
        beside = getattr(plate, key) - plate.kidney_pitch_radius
        put(f"valve_plate.{key}", plate.kidney_pitch_radius * group + beside * piston, Dimension.LENGTH)
    put("valve_plate.kidney_arc", plate.kidney_arc / share, Dimension.ANGLE)
    put("ports.kidney_full_start", ports.groove_end + plate.kidney_arc / share, Dimension.ANGLE)
    put("ports.kidney_full_end", ports.kidney_end - plate.kidney_arc / share, Dimension.ANGLE)
    lift, old_lift = stroke(drive) * group, _stroke(model)
    put("pump.dead_volume", model.pump.dead_volume * piston**2 * lift / old_lift, Dimension.VOLUME)
    left = (model.piston.engaged_length - old_lift) * narrow  # in the bore at the outer dead centre
    put("piston.engaged_length", left + lift, Dimension.LENGTH)
    put("valve_plate.kidney_width", NARROWER * plate.kidney_width * piston, Dimension.LENGTH)
    put("pump.displacement", facts.displacement, Dimension.DISPLACEMENT)
    tables["pump"]["pistons"] = facts.pistons
    put("pump.swash_angle_max", swash, Dimension.ANGLE)
    return tables


def _scales(facts: _Facts, model: PumpDescription, size: float, share: float) -> tuple[float, float]:
    """Scales s of the pistons and r of the group with s^2 r = size; by stated values, else r = s z/9."""
    piston = None if facts.piston_diameter is None else facts.piston_diameter / model.pump.piston_diameter
    group = None if facts.pitch_radius is None else facts.pitch_radius / model.pump.pitch_radius
    if piston is None and group is None:
        piston = (size / share) ** (1.0 / 3.0)
    if piston is None:
        assert group is not None
        piston = math.sqrt(size / group)
    return piston, size / piston**2 if group is None else group


def _stroke(model: PumpDescription) -> float:
    return stroke(SwashDrive(model.pump.pitch_radius, model.pump.bore_cone_angle, model.pump.swash_angle_max))


def _dimension(path: str) -> Dimension:
    """Dimension of a scaled value."""
    if path.endswith("speed"):
        return Dimension.ANGULAR_SPEED
    if path.endswith("mass"):
        return Dimension.MASS
    if path.endswith("area"):
        return Dimension.AREA
    return Dimension.FORCE if path.endswith("preload") else Dimension.LENGTH


def _assumptions(tables: Mapping[str, Any], stated: set[str]) -> tuple[Assumption, ...]:
    """Values that the file does not state, with their reasons."""
    scaled = {*_POWERS, "pump.dead_volume", "piston.engaged_length", *(f"slipper.land_{one}_radius" for one in ENDS)}
    taken = []
    for name, table in tables.items():
        for key, value in table.items() if isinstance(table, dict) else ():
            path = f"{name}.{key}"
            if path in stated:
                continue
            if name == "tolerance":
                reason = "wide, since the pump is scaled from another"
            elif path in scaled or name in ("valve_plate", "ports"):
                reason = "REF90's, scaled to displacement and pistons"
            else:
                reason = "REF90's"
            taken.append(Assumption(path, str(value), reason))
    return tuple(taken)
