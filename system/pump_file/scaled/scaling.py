"""REF90's tables at another displacement and number of pistons."""

from __future__ import annotations

import math
import tomllib
from functools import reduce
from operator import attrgetter, getitem
from typing import Any

from system.description.pump import PumpDescription
from system.inputs.units import Dimension, format_quantity
from system.pump.laws.kinematics import SwashDrive, stroke
from system.pump_file.scaled.facts import Facts
from system.pump_file.tables import BUILT_IN, pump_of_tables

MODEL = "ref90"
ENDS = ("inner", "outer")
NARROWER = 0.999  # kidneys, so that rounded values still lie between their lands
POWERS = {
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
"""Powers of the scales of the pistons (diameter) and of the group (pitch radius) with which a value scales."""
SIZED = frozenset({
    *POWERS, "pump.piston_diameter", "pump.dead_volume", "piston.engaged_length",
    *(f"slipper.land_{end}_radius" for end in ENDS), *(f"valve_plate.land_radius_{k}" for k in (1, 2, 3, 4)),
    "valve_plate.kidney_width", "valve_plate.kidney_arc", "ports.kidney_full_start", "ports.kidney_full_end",
})  # fmt: skip
"""Values that scale with displacement or pistons; all others are REF90's own."""


def scaled_tables(facts: Facts) -> dict[str, dict[str, Any]]:
    """REF90's tables at the size of the facts, values as text.

    Pistons keep their share of the pitch circle, and slippers are no wider than their distance allows: with the scale s
    of diameters and r of radii, r = s z/9 and s^2 r = V/(z area stroke) of REF90 at the swash angle. Films, clearances,
    depths of reliefs, angles and friction are REF90's, sliding speeds on the pitch circle at rated speed too; ports are
    divided by z.
    """
    given = tomllib.loads(BUILT_IN.joinpath(f"{MODEL}.toml").read_text("utf-8"))
    model = pump_of_tables(MODEL, given)
    tables = {name: table for name, table in given.items() if isinstance(table, dict)}
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

    for path, (of_piston, of_group) in POWERS.items():
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


def _scales(facts: Facts, model: PumpDescription, size: float, share: float) -> tuple[float, float]:
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
