"""A pump file on parts that float: points, choices, tables in tables, single parts, what is taken."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from system import InputFaults, check_pump, floating_parts, load_pump, operating_point, resolved_toml, rotor
from system.description.lines import LineKind
from system.description.parts import RetainerKind
from system.films.parts import BRASS, STEEL, ball_plane_height
from system.films.places import guide_frame
from system.films.rotor import travel
from system.inputs.sections.fields import fields_of
from system.inputs.sections.values import units_shown
from system.pump_file.check import CheckReport
from system.pump_file.floating import check_floating
from system.pump_file.schema import section_models

REF90 = BENCH.read_text("utf-8")
PROFILE = [["0 mm", "3 um"], ["3 mm", "0 um"], ["45 mm", "0.5 um"]]
EVERY = {
    "pump.cross_angle": "1 deg",
    "piston.stand_out_share": 0.5,
    "piston.guide_length": "40 mm",
    "piston.centre_of_mass": "30 mm",
    "piston.profile": PROFILE,
    "piston.barrel": "2 um",
    "piston.edge_relief": {"width": "3 mm", "depth": "3 um"},
    "piston.grooves": [["10 mm", "0.5 mm", "0.3 mm"], ["12 mm", "0.5 mm", "0.3 mm"]],
    "slipper.ball_height": "12 mm",
    "slipper.orifice_flow_coefficient": 0.7,
    "slipper.profile": [["8 mm", "0 um"], ["14 mm", "-1 um"]],
    "slipper.crown": "-2 um",
    "slipper.rim_relief": {"width": "3 mm", "depth": "2 um"},
    "slipper.grooves": [["9 mm", "9.5 mm"]],
    "slipper.vented_grooves": [["12 mm", "12.5 mm"]],
    "piston.bore_diameter": "8 mm",
    "slipper.flange_thickness": "5 mm",
    "slipper.socket_radius": "8 mm",
    "valve_plate.thickness": "8 mm",
    "block.end_thickness": "10 mm",
    "bore.wall": "4 mm",
    "swash_plate.thickness": "20 mm",
    "swash_plate.inertia": "0.01 kg m2",
    "swash_plate.pivot_offset": "2 mm",
    "swash_plate.angle_min": "-1 deg",
    "swash_plate.damping": "2 N m s/rad",
    "swash_plate.trunnion_friction": "5 N m",
    "actuator.strokes": "down",
    "actuator.area": "1200 mm2",
    "actuator.arm": "60 mm",
    "actuator.dead_volume": "30 cm3",
    "actuator.orifice_area": "9 mm2",
    "actuator.leakage": "0.05 L/(min MPa)",
    "actuator.spring_rate": "50 N/mm",
    "actuator.spring_preload": "800 N",
    "valve_plate.waviness": {"waves": 3, "amplitude": "1 um"},
    "valve_plate.profile": [["26 mm", "0 um"], ["46 mm", "1 um"]],
    "block.profile": [["26 mm", "0.5 um"], ["46 mm", "0 um"]],
    "ports.webs": [["60 deg", "4 deg"], ["100 deg", "5 deg"]],
    "block.spline_position": "80 mm",
    "bearings.front_position": "150 mm",
    "bearings.rear_position": "-10 mm",
    "oil.pressure_viscosity": "18 1/GPa",
    "oil.thermal_conductivity": "0.13 W/(m K)",
    "oil.thermal_expansion": "7e-4 1/K",
    "tolerance.viscosity_slope": "5e-4 1/K",
    "tolerance.displacement": 0.001,
    "tolerance.dead_volume": 0.02,
    "tolerance.flow_coefficient": 0.05,
    "tolerance.stand_out_share": 0.5,
    "tolerance.inlet_share": 0.25,
    "bore.profile": [["0 mm", "0.1 um"], ["41 mm", "0 um"]],
    "bore.edge_relief": {"width": "2 mm", "depth": "1 um"},
    "retainer.kind": "clearance",
    "retainer.clearance": "30 um",
    "retainer.stiffness": "100 kN/mm",
    "delivery_line.kind": "orifice",
    "delivery_line.volume": "1 L",
    "delivery_line.orifice_area": "20 mm2",
    "delivery_line.tank_pressure": "0 bar",
    "valve_plate.sphere_radius": "120 mm",
    "suction_line.kind": "impedance",
    "suction_line.volume": "1 L",
    "suction_line.impedance": [["300 Hz", "0 Pa s/m3", "-1e9 Pa s/m3"], ["7 kHz", "0 Pa s/m3", "-1e7 Pa s/m3"]],
    **{
        f"materials.{part}": {
            "youngs_modulus": "200 GPa",
            "poissons_ratio": 0.29,
            "density": "7800 kg/m3",
            "thermal_conductivity": "45 W/(m K)",
            "thermal_expansion": "1.2e-5 1/K",
        }
        for part in ("piston", "bushing", "slipper", "swash_plate", "block", "valve_plate")
    },
    **{
        f"surfaces.{pair}": {
            "composite_roughness": "0.4 um",
            "asperity_density": "2e9 1/m2",
            "asperity_radius": "40 um",
            "friction_coefficient": 0.12,
        }
        for pair in ("piston_cylinder", "slipper_swash_plate", "valve_plate_cylinder")
    },
}


NOT_OF_ITS_KIND = {"delivery_line": {"impedance"}, "suction_line": {"orifice_area", "tank_pressure"}}


def faults_of(overrides):
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, overrides)
    return {fault.path: fault for fault in raised.value.faults}


# What is read


def test_every_key_of_the_floating_parts_is_read_and_written_back(tmp_path):
    """All optional keys at once come back from `resolved_toml`, and nothing is then left to be taken."""
    pump = load_pump(BENCH, EVERY)
    for name, model in section_models():
        own = name in ("ports.grooves", "valve_plate.pads") or name.startswith(("physics", "ports.delivery"))
        if own or name.endswith((".body", ".profile")):
            continue  # lists; grooves are in place of ref90's groove_start and groove_area; bodies, traces are files
        section = pump
        for step in name.split("."):
            section = getattr(section, step)
        if isinstance(section, tuple):
            continue  # lists of tables, which may be empty
        absent = {key for key in fields_of(model) if getattr(section, key) is None}
        left_out = {key for key in absent - {"body", "delivery"} if not key.endswith("_file")}
        assert left_out == NOT_OF_ITS_KIND.get(name, set()), name
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump
    assert floating_parts(pump).taken == ()


def test_points_and_choices_in_si():
    pump = load_pump(BENCH, EVERY)
    assert pump.piston.profile == ((0.0, 3e-6), (3e-3, 0.0), (45e-3, 0.5e-6))
    assert pump.retainer.kind is RetainerKind.CLEARANCE
    assert pump.delivery_line.kind is LineKind.ORIFICE
    assert pump.piston.edge_relief is not None
    assert pump.piston.edge_relief.depth == 3e-6


def test_a_file_without_them_has_none_of_them():
    pump = load_pump(BENCH)
    assert pump.piston.profile is None
    assert pump.materials.piston is None
    assert resolved_toml(pump).count("[") == REF90.count("\n[")


def test_units_shown_of_columns():
    models = dict(section_models())
    assert units_shown(fields_of(models["piston"])["profile"]) == "mm, um"
    assert units_shown(fields_of(models["piston"])["mass"]) == "g"
    assert units_shown(fields_of(models["piston"])["radial_clearance"]) == "um"
    assert units_shown(fields_of(models["surfaces.slipper_swash_plate"])["composite_roughness"]) == "um"
    assert units_shown(fields_of(models["retainer"])["kind"]) == "-"


def _rows(pump):
    return [row for row in resolved_toml(pump).splitlines() if row]


# What is refused


@pytest.mark.parametrize(
    ("key", "raw", "found", "expected"),
    [
        ("piston.profile", "3 um", "3 um', which is no file", "place [mm], material taken off [um]"),
        ("piston.profile", [["0 mm", "3 um"], ["3 mm"]], "1 values in row 2", "rows of place"),
        ("piston.profile", [["0 mm", "3 um"], ["3 mm", "3 lux"]], "as material taken off of row 2", "a length"),
        ("piston.profile", [["0 mm", 3], ["45 mm", "0 um"]], "3 as material taken off of row 1", "a length"),
        ("piston.profile", [["0 mm", "3 um"]], "[['0 mm', '3 um']]", "at least 2 rows"),
        ("piston.profile", [["0 mm", "0 um"], ["0 mm", "1 um"], ["45 mm", "0 um"]], "0 mm after 0 mm", "grow"),
        ("piston.profile", [["0 mm", "0 um"], ["40 mm", "0 um"]], "places from 0 mm to 40 mm", "45 mm or more"),
        ("piston.profile", [["0 mm", "-15 um"], ["45 mm", "0 um"]], "protrudes by more", "more than -15 um"),
        ("piston.grooves", [["10 mm", "2 mm", "0 mm"]], "0 mm deep", "both more than 0"),
        ("piston.grooves", [["1 mm", "2 mm", "1 mm"]], "a groove 2 mm wide at 1 mm", "between 0 and engaged_length"),
        (
            "piston.grooves",
            [["10 mm", "2 mm", "1 mm"], ["11 mm", "2 mm", "1 mm"]],
            "grooves at 10 mm and 11 mm",
            "more than 2 mm apart",
        ),
        ("piston.guide_length", "70 mm", "70 mm", "at most 60.78 mm, the bore's depth"),
        ("piston.centre_of_mass", "64 mm", "64 mm", "at most 63 mm"),
        ("slipper.profile", [["9 mm", "0 um"], ["14 mm", "0 um"]], "places from 9 mm", "from 8.2 mm or less"),
        ("slipper.grooves", [["9 mm", "9 mm"]], "from radius 9 mm to 9 mm", "an inner radius below"),
        ("slipper.grooves", [["8.2 mm", "9 mm"]], "radius 8.2 mm to 9 mm", "between 8.2 mm and 14 mm"),
        ("slipper.vented_grooves", [["9 mm", "10 mm"], ["10 mm", "11 mm"]], "10 mm to 11 mm", "10 mm and 14 mm"),
        ("slipper.rim_relief", 3, "3", "a table [slipper.rim_relief] with width, depth"),
        ("bore.profile", [["0 mm", "0 um"], ["44 mm", "0 um"]], "places from 0 mm to 44 mm", "45 mm or more"),
        ("retainer.kind", "sprong", "'sprong'", "one of 'spring', 'clearance'"),
        ("bore", 3, "3", "a table [bore] with profile, edge_relief"),
        ("piston.3", "20 um", "'20 um'", "a table [piston.3]"),
    ],
)
def test_bad_value(key, raw, found, expected):
    faults = faults_of({key: raw})
    assert list(faults) == [key]
    assert found in faults[key].found
    assert expected in faults[key].expected


@pytest.mark.parametrize(
    ("overrides", "path", "expected"),
    [
        ({"piston.edge_relief.width": "3 mm"}, "piston.edge_relief.depth", "a length"),
        (
            {"piston.edge_relief": {"width": "23 mm", "depth": "1 um"}},
            "piston.edge_relief.width",
            "half of engaged_length, 22.5 mm",
        ),
        (
            {"slipper.rim_relief": {"width": "6 mm", "depth": "1 um"}},
            "slipper.rim_relief.width",
            "the land's width, 5.8 mm",
        ),
        ({"materials.piston.youngs_modulus": "210 GPa"}, "materials.piston.poissons_ratio", "a bare number"),
        ({"materials.pston.poissons_ratio": 0.3}, "materials.pston", "piston"),
        (
            {"materials.block": {"youngs_modulus": "1 GPa", "poissons_ratio": 0.5}},
            "materials.block.poissons_ratio",
            "0.5",
        ),
        ({"valve_plate.waviness": {"waves": 2.5, "amplitude": "1 um"}}, "valve_plate.waviness.waves", "whole number"),
        ({"retainer.kind": "spring", "ball_guide.spring_preload": "0 N"}, "retainer.kind", "kind = 'clearance'"),
        ({"delivery_line.kind": "orifice"}, "delivery_line.volume", "such as '1 L'"),
        ({"delivery_line.volume": "1 L"}, "delivery_line.volume", "kind = 'orifice' or 'impedance'"),
        ({"suction_line": {"kind": "orifice", "volume": "1 L"}}, "suction_line.orifice_area", "such as '200 mm2'"),
        (
            {"suction_line": {"kind": "orifice", "volume": "1 L", "tank_pressure": "1 bar"}},
            "suction_line.tank_pressure",
            "more than inlet_pressure, 2.5 MPa",
        ),
        ({"suction_line.kind": "impedance"}, "suction_line.impedance", "or a CSV file"),
        (
            {"delivery_line": {"kind": "impedance", "impedance": [["1 Hz", "1 Pa s/m3", "0 Pa s/m3"]] * 2}},
            "delivery_line.impedance",
            "frequencies that rise",
        ),
        ({"delivery_line.kind": "held", "delivery_line.volume": "1 L"}, "delivery_line.volume", "kind = 'orifice'"),
    ],
)
def test_what_does_not_fit_together(overrides, path, expected):
    faults = faults_of(overrides)
    assert list(faults) == [path]
    assert expected in faults[path].expected


def test_shapes_too_deep_for_a_film_warn():
    pump = load_pump(
        "ref90",
        {
            "piston.barrel": "2 mm",
            "slipper.crown": "-1 mm",
            "piston.edge_relief": {"width": "3 mm", "depth": "3 mm"},
            "valve_plate.waviness": {"waves": 9, "amplitude": "1 mm"},
            "piston.guide_length": "20 mm",
        },
    )
    told = {warning.path for warning in check_pump(pump).warnings}
    assert told >= {
        "piston.barrel", "slipper.crown", "piston.edge_relief.depth", "valve_plate.waviness.amplitude",
        "piston.guide_length",
    }  # fmt: skip


def test_a_line_of_a_table_in_a_table_is_found(tmp_path):
    file = tmp_path / "pump.toml"
    file.write_text(REF90 + '\n[piston.edge_relief]\nwidth = "3 mm"\ndepth = "3 bar"\n')
    with pytest.raises(InputFaults, match=rf"piston.edge_relief.depth \(line {len(REF90.splitlines()) + 4}\)"):
        load_pump(file)


# Single parts


def test_a_single_part_has_the_rest_from_the_table(tmp_path):
    pump = load_pump(BENCH, {"piston.3.radial_clearance": "20 um", "slipper.9.crown": "2 um"})
    assert [chamber for chamber, _ in pump.single_pistons] == [3]
    third, fourth, ninth = (pump.of_chamber(chamber) for chamber in (3, 4, 9))
    assert third.piston == replace(pump.piston, radial_clearance=20e-6)
    assert fourth == load_pump(BENCH)
    assert ninth.slipper.crown == 2e-6
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert "[piston.3]\nradial_clearance" in file.read_text()
    assert load_pump(file) == pump


def test_single_parts_are_told_where_all_are_taken_alike():
    pump = load_pump(BENCH, {"piston.3.radial_clearance": "20 um"})
    assert "piston.3" in {warning.path for warning in check_pump(pump).warnings}


@pytest.mark.parametrize(
    ("overrides", "path"),
    [
        ({"piston.3.radial_clearance": "20 bar"}, "piston.3.radial_clearance"),
        ({"piston.3.radial_clearance": "-20 um"}, "piston.3.radial_clearance"),
        ({"piston.3.radial_clearence": "20 um"}, "piston.3.radial_clearence"),
        ({"piston.10.mass": "160 g"}, "piston.10"),
        ({"piston.0.mass": "160 g"}, "piston.0"),
        ({"piston.03.mass": "160 g"}, "piston.03"),
        ({"piston.4.engaged_length": "26 mm"}, "piston.4.engaged_length"),
        ({"slipper.4.land_inner_radius": "14 mm"}, "slipper.4.land_inner_radius"),
        ({"valve_plate.3.kidney_width": "8 mm"}, "valve_plate.3"),
    ],
)
def test_single_parts_are_refused_as_all_would_be(overrides, path):
    assert list(faults_of(overrides)) == [path]


# What is taken


def test_everything_taken_is_told_with_value_and_reason():
    """One assumption for each optional quantity that a gap needs, by its path, none twice."""
    pump = load_pump(BENCH)
    parts = floating_parts(pump)
    told = {taken.path: taken for taken in parts.taken}
    assert len(told) == len(parts.taken)
    assert all(taken.value and taken.reason for taken in parts.taken)
    assert told["piston.guide_length"].value == "45 mm"
    assert str(told["piston.centre_of_mass"]).startswith("piston.centre_of_mass: taken 31.5 mm (")
    assert told["surfaces.piston_cylinder.composite_roughness"].value == "0.5 um"
    assert told["retainer.kind"].value == "spring"
    assert parts.materials["piston"] == STEEL
    assert parts.materials["slipper"] == BRASS


def test_a_stated_value_is_not_taken():
    stated = {"piston.guide_length": "40 mm", "surfaces.piston_cylinder.composite_roughness": "0.8 um"}
    parts = floating_parts(load_pump(BENCH, stated))
    assert not stated.keys() & {taken.path for taken in parts.taken}
    assert parts.piston.guide_length == 40e-3
    laws = parts.piston.laws
    assert laws.surface is not None
    assert laws.asperities is not None
    assert laws.surface.composite_roughness == pytest.approx(0.8e-6)
    assert laws.asperities.roughness_product == pytest.approx(0.04)


def test_material_left_out_in_part_is_the_usual_one():
    stated = {"materials.slipper": {"youngs_modulus": "120 GPa", "poissons_ratio": 0.35}}
    parts = floating_parts(load_pump(BENCH, stated))
    assert parts.materials["slipper"].youngs_modulus == 120e9
    assert parts.materials["slipper"].density == BRASS.density
    told = {taken.path for taken in parts.taken if taken.path.startswith("materials.slipper")}
    assert told == {f"materials.slipper.{key}" for key in ("density", "thermal_conductivity", "thermal_expansion")}


def test_shapes_add_up():
    parts = floating_parts(load_pump(BENCH, EVERY))
    place = np.array([0.0, 1e-3])
    barrel = 2e-6 * (2.0 * place / 45e-3 - 1.0) ** 2
    edge = 3e-6 * (1.0 - place / 3e-3) ** 2
    measured = 3e-6 * (1.0 - place / 3e-3)
    assert parts.piston.piston(place, np.zeros(2)).depth == pytest.approx(barrel + edge + measured, rel=1e-12)
    rim = np.array([14e-3])
    assert parts.slipper.face(rim, np.zeros(1)).depth == pytest.approx(-1e-6 - 2e-6 + 2e-6, rel=1e-12)


def test_ball_plane_height_is_where_the_places_of_the_pump_have_it():
    """The bore's case edge lies an overhang and the piston's way below the ball; at 90 deg on the shaft."""
    pump = load_pump(BENCH)
    group = rotor(pump, operating_point(pump))
    frame = guide_frame(group, 0.0, 0.5 * np.pi)
    ball = frame.origin + (pump.piston.overhang + travel(group, 0.5 * np.pi)) * frame.z
    assert ball_plane_height(pump) == pytest.approx(ball[2], rel=1e-12)


# Can it float?


def _told(report: CheckReport) -> dict[str, str]:
    return {warning.path: str(warning) for warning in report.warnings}


def test_ref90_tips_and_lies_flat():
    told = _told(check_floating(load_pump(BENCH)))
    assert set(told) == {"valve_plate.land_radius_4", "slipper.profile"}
    assert "block tips: at 35 MPa the film's lift is 0.933" in told["valve_plate.land_radius_4"]
    assert "limit 45.7 mm" in told["valve_plate.land_radius_4"]


def test_ref90_does_not():
    assert check_floating(load_pump("ref90")) == CheckReport((), ())


def test_wide_lands_lift_the_block_off():
    wide = {"valve_plate.land_radius_1": "24 mm", "valve_plate.land_radius_4": "49 mm"}
    told = _told(check_floating(load_pump(BENCH, wide)))
    assert "block lifts off" in told["valve_plate.land_radius_4"]


KINDS = ("dimension", "layouts", "choices", "table", "tables", "text")


def test_every_kind_of_field_is_one_kind():
    """A key is a quantity, rows, a choice, a table or a number, and no two of these."""
    for name, model in section_models():
        for key, field in fields_of(model).items():
            kinds = [getattr(field, kind) for kind in KINDS]
            assert sum(kind not in (None, ()) for kind in kinds) <= 1, f"{name}.{key}"
