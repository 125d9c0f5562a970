"""Pump files: what is read, what is refused and in which words, and that nothing is lost on the way back."""

import math
import re
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest
from bench_pump import BENCH
from hypothesis import given, settings, strategies as st

from system import InputFaults, PumpDescription, check_pump, load_pump, operating_point, resolved_toml
from system.inputs.faults import key_lines
from system.inputs.sections.fields import fields_of
from system.inputs.units import STANDARD_ATMOSPHERE
from system.pump_file.check import CheckReport, CheckWarning
from system.pump_file.file import builtin_pumps
from system.pump_file.operating import check_operating_point
from system.pump_file.schema import section_models

REF90 = BENCH.read_text("utf-8")
EXAMPLES = sorted(Path(__file__).parents[3].joinpath("examples", "pumps").glob("*.toml"))
NO_FILM = "at least 0.01 um: oil thinner than 10 nm is no continuum"
WRITTEN_KEYS = [tuple(path.split(".")) for path in key_lines(REF90) if "." in path]


@pytest.fixture
def faults_of(tmp_path):
    """Return the faults, by path, of REF90's file with some of its lines replaced, and the message."""

    def load(**replaced):
        text = REF90
        for path, line in replaced.items():
            text = _with_line(text, path.replace("__", "."), line)
        return _faults(tmp_path, text)

    return load


def _with_line(text, path, line):
    """Return the text with the line of a path replaced (by nothing: left out)."""
    rows = text.splitlines()
    number = key_lines(text)[path] - 1
    return "\n".join(rows[:number] + line.splitlines() + rows[number + 1 :])


def _faults(folder, text):
    file = folder / "pump.toml"
    file.write_text(text, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_pump(file)
    assert str(file) in str(raised.value)
    return {fault.path: fault for fault in raised.value.faults}, str(raised.value)


# What is read


def test_ref90_in_si():
    pump = load_pump(BENCH)
    assert pump.pump.piston_diameter == 0.022
    assert pump.piston.radial_clearance == 15e-6
    assert pump.pump.swash_angle_max == pytest.approx(math.radians(16.2), rel=1e-15)
    assert pump.operating.speed == pytest.approx(2100 * 2 * math.pi / 60, rel=1e-15)
    assert pump.operating.pressure == 35e6
    assert pump.operating.temperature == 323.15
    assert pump.pump.displacement == pytest.approx(89.86e-6, rel=1e-15)
    assert pump.oil.kinematic_viscosity_100C == 6.8e-6


def test_operating_point_has_the_viscosity_of_its_temperature():
    pump = load_pump(BENCH)
    assert operating_point(pump).viscosity == pytest.approx(25.8e-3, abs=0.05e-3)
    warm = operating_point(pump, temperature=353.15, delivery_pressure=5e6)
    assert warm.viscosity == pytest.approx(11.103e-6 * 860, abs=0.5e-9 * 860)
    assert warm.delivery_pressure == 5e6
    assert warm.shaft_speed == pump.operating.speed


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_examples_load(file):
    assert check_pump(load_pump(file)).faults == ()


def test_builtin_pumps_load():
    assert "ref90" in builtin_pumps()
    for name in builtin_pumps():
        assert isinstance(load_pump(name), PumpDescription)


def test_a_description_cannot_be_changed():
    pump = load_pump(BENCH)
    with pytest.raises(FrozenInstanceError):
        pump.piston.radial_clearance = 1.0


@pytest.mark.parametrize("text", ["26 bar", "26 bara", "26 bar abs", "2.6 MPa absolute"])
def test_absolute_pressure_becomes_gauge(tmp_path, text):
    file = tmp_path / "pump.toml"
    file.write_text(_with_line(REF90, "operating.inlet_pressure", f'inlet_pressure_abs = "{text}"'))
    assert load_pump(file).operating.inlet_pressure == 26e5 - STANDARD_ATMOSPHERE


def test_overrides_stand_in_place_of_the_file():
    pump = load_pump(BENCH, {"operating.speed": "1000 rpm", "operating.displacement_ratio": 0.51})
    assert pump.operating.speed == pytest.approx(1000 * 2 * math.pi / 60, rel=1e-15)
    assert pump.operating.displacement_ratio == 0.51
    with pytest.raises(InputFaults, match=r"operating\.speed\n +found: +'1000 bar', which is not"):
        load_pump(BENCH, {"operating.speed": "1000 bar"})


def test_an_override_replaces_what_else_states_the_same(tmp_path):
    """A grade its viscosities, two viscosities the grade, an absolute pressure the gauge one; not each other."""
    thin = {"oil.kinematic_viscosity_40C": "32 mm2/s", "oil.kinematic_viscosity_100C": "5.4 mm2/s"}
    assert load_pump("ref90", thin).oil == load_pump("ref90", {"oil.grade": "ISO VG 32"}).oil
    resolved = tmp_path / "resolved.toml"
    resolved.write_text(resolved_toml(load_pump("ref90", thin)), "utf-8")
    assert load_pump(resolved, {"oil.grade": "ISO VG 68"}).oil == load_pump("ref90").oil
    absolute = load_pump("ref90", {"operating.inlet_pressure_abs": "2 bar"})
    assert absolute.operating.inlet_pressure == 2e5 - STANDARD_ATMOSPHERE
    for both in (
        thin | {"oil.grade": "ISO VG 32"},
        {f"operating.inlet_pressure{end}": "2 bar" for end in ("", "_abs")},
    ):
        with pytest.raises(InputFaults):
            load_pump("ref90", both)


# What is refused


def test_a_share_in_percent_is_told_as_a_bare_number(faults_of):
    faults, _ = faults_of(friction__piston_cylinder='piston_cylinder = "2.6 %"')
    assert faults["friction.piston_cylinder"].nearest == "0.026"
    faults, _ = faults_of(pump__pistons='pistons = "9%"')
    assert faults["pump.pistons"].nearest == ""


def test_unknown_key_names_the_nearest(faults_of):
    faults, message = faults_of(piston__radial_clearance='radial_clearence = "15 um"')
    assert list(faults) == ["piston.radial_clearence"]
    assert faults["piston.radial_clearence"].nearest == "radial_clearance"
    assert f"line {key_lines(REF90)['piston.radial_clearance']}" in message


def test_unknown_table_names_the_nearest(faults_of):
    faults, _ = faults_of(block="[blok]")
    assert list(faults) == ["blok"]
    assert faults["blok"].nearest == "block"


def test_missing_table(faults_of):
    faults, _ = faults_of(block__mass="", block="")
    assert list(faults) == ["block"]
    assert "mass" in faults["block"].expected


@pytest.mark.parametrize(("section", "key"), WRITTEN_KEYS)
def test_every_missing_key_is_told_alone(faults_of, tmp_path, section, key):
    if key in ("displacement", "spin_ratio") or section == "tolerance":  # they may be left out
        file = tmp_path / "pump.toml"
        file.write_text(_with_line(REF90, f"{section}.{key}", ""))
        assert getattr(getattr(load_pump(file), section), key) is None
        return
    faults, _ = faults_of(**{f"{section}__{key}": ""})
    told = [key] if key != "grade" else ["kinematic_viscosity_40C", "kinematic_viscosity_100C"]
    assert list(faults) == [f"{section}.{name}" for name in told]
    assert {fault.found for fault in faults.values()} == {"missing"}


@pytest.mark.parametrize(("section", "key"), [row for row in WRITTEN_KEYS if row[1] != "grade"])
def test_every_key_refuses_what_it_does_not_measure(faults_of, section, key):
    faults, _ = faults_of(**{f"{section}__{key}": f'{key} = "22 lux"'})
    assert list(faults) == [f"{section}.{key}"]
    example = fields_of(dict(section_models())[section])[key].example
    assert (example or "number") in faults[f"{section}.{key}"].expected


@pytest.mark.parametrize(
    ("path", "number", "meant"),
    [
        ("piston.radial_clearance", "14", "'14 um'"),
        ("valve_plate.film_thickness", "8.0", "'8 um'"),
        ("slipper.film_thickness", '"10"', "'10 um'"),
        ("piston.engaged_length", "45", "'45 mm'"),
    ],
)
def test_a_bare_number_has_the_unit_in_which_its_key_is_written(faults_of, path, number, meant):
    faults, _ = faults_of(**{path.replace(".", "__"): f"{path.partition('.')[2]} = {number}"})
    assert faults[path].nearest == meant


@pytest.mark.parametrize(
    ("path", "line", "found", "expected"),
    [
        ("pump.piston_diameter", "piston_diameter = 22", "22", "a length with its unit, such as '22 mm'"),
        ("piston.mass", 'mass = "160 mm"', "'160 mm', which is not a mass", "a mass with its unit"),
        ("piston.radial_clearance", 'radial_clearance = "-15 um"', "-15 um", NO_FILM),
        ("piston.radial_clearance", 'radial_clearance = "0 um"', "0 um", NO_FILM),
        ("slipper.film_thickness", 'film_thickness = "-1 um"', "-1 um", NO_FILM),
        ("piston.eccentricity_ratio", "eccentricity_ratio = 1.0", "1.0", "less than 1"),
        ("piston.eccentricity_ratio", "eccentricity_ratio = true", "True", "a bare number"),
        ("pump.pistons", "pistons = 8.5", "8.5", "a whole number"),
        ("pump.pistons", "pistons = 2", "2", "at least 3"),
        ("pump.swash_angle_max", 'swash_angle_max = "95 deg"', "95 deg", "less than 90 deg"),
        ("operating.displacement_ratio", "displacement_ratio = 1.2", "1.2", "at most 1"),
        ("operating.displacement_ratio", "displacement_ratio = 0.0", "0.0", "more than 0"),
        ("friction.rear_bearing", "rear_bearing = nan", "nan", "a bare number"),
        ("oil.grade", 'grade = "ISO VG 45"', "'ISO VG 45'", "ISO VG 46"),
        ("format", "format = 2", "2", "format = 1"),
        ("name", "name = 5", "5", "one line of text"),
    ],
)
def test_bad_value(faults_of, path, line, found, expected):
    faults, message = faults_of(**{path.replace(".", "__"): line})
    assert list(faults) == [path]
    assert faults[path].found == found
    assert expected in faults[path].expected
    assert f"{path} (line {key_lines(REF90)[path]})" in message


def test_gauge_and_absolute_of_one_pressure(faults_of):
    line = 'case_pressure = "1 bar"\ncase_pressure_abs = "2 bar"'
    faults, _ = faults_of(operating__case_pressure=line)
    assert list(faults) == ["operating.case_pressure_abs"]


def test_absolute_is_for_pressures_only(faults_of):
    faults, _ = faults_of(piston__mass='mass_abs = "160 g"')
    assert faults["piston.mass_abs"].nearest == "mass"


def test_grade_beside_a_viscosity(faults_of):
    faults, _ = faults_of(oil__grade='grade = "ISO VG 46"\nkinematic_viscosity_40C = "46 mm2/s"')
    assert list(faults) == ["oil.grade"]
    assert faults["oil.grade"].nearest == "kinematic_viscosity_100C too, in place of the grade"


def test_toml_that_is_none_names_the_line(tmp_path):
    _, message = _faults(tmp_path, 'name = "x"\nformat = = 1\n')
    assert "line 2" in message


def test_a_file_that_is_not_there(tmp_path):
    (tmp_path / "my_pump.toml").write_text(REF90)
    with pytest.raises(InputFaults, match="no file") as raised:
        load_pump(tmp_path / "my_pmp.toml")
    assert raised.value.faults[0].nearest == str(tmp_path / "my_pump.toml")


def test_an_unknown_builtin_names_them():
    with pytest.raises(InputFaults) as raised:
        load_pump("ref09")
    assert "ref90" in raised.value.faults[0].expected
    assert raised.value.faults[0].nearest == "ref90"


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(InputFaults, match="cannot be read"):
        load_pump(tmp_path)


# Geometry and operating point


@pytest.mark.parametrize(
    ("path", "line", "words"),
    [
        # 2 R sin(pi/z)/(1 + t cos(pi/z)), half of it, for R 45 mm, z 9, t = tan 5 deg tan 16.2 deg
        ("slipper.land_outer_radius", 'land_outer_radius = "15.2 mm"', "less than 15.03 mm"),
        ("pump.displacement", 'displacement = "80 cm3/rev"', "89.86 cm3/rev within 1 %"),
        ("slipper.land_inner_radius", 'land_inner_radius = "14 mm"', "less than land_outer_radius, 14 mm"),
        ("slipper.orifice_diameter", 'orifice_diameter = "17 mm"', "less than the pocket's diameter, 16.4 mm"),
        ("valve_plate.land_radius_2", 'land_radius_2 = "20 mm"', "more than land_radius_1, 26.5 mm"),
        ("valve_plate.kidney_width", 'kidney_width = "9.2 mm"', "between land_radius_2, 31.5 mm"),
        ("valve_plate.kidney_arc", 'kidney_arc = "41 deg"', "less than 40 deg"),
        ("ports.kidney_area", 'kidney_area = "170 mm2"', "at most 169.6 mm2"),
        ("pump.piston_diameter", 'piston_diameter = "27 mm"', "a wall between its bores"),
        ("piston.engaged_length", 'engaged_length = "26 mm"', "more than the stroke"),
        ("pump.bore_cone_angle", 'bore_cone_angle = "74 deg"', "cuts every bore axis"),
        ("ports.groove_end", 'groove_end = "-6 deg"', "more than groove_start, -5 deg"),
        ("ports.groove_end", 'groove_end = "-5 deg"', "more than groove_start, -5 deg"),
        ("ports.kidney_full_end", 'kidney_full_end = "39 deg"', "more than kidney_full_start, 40 deg"),
        ("ports.kidney_end", 'kidney_end = "176 deg"', "less than 175 deg"),
        ("ports.groove_area", 'groove_area = "160 mm2"', "less than kidney_area, 152 mm2"),
        ("bearings.rear_share", "rear_share = 0.48", "sum to 1"),
        ("operating.inlet_pressure", 'inlet_pressure = "-1.01325 bar"', "more than -96.33 kPa gauge"),
        ("operating.case_pressure", 'case_pressure = "-1 bar"', "more than -96.33 kPa gauge"),
        ("operating.pressure", 'pressure = "20 bar"', "more than inlet_pressure, 2.5 MPa gauge"),
        ("operating.temperature", 'temperature = "200 degC"', "-40 .. 150 degC"),
        (
            "oil.kinematic_viscosity_100C",
            'kinematic_viscosity_40C = "46 cSt"\nkinematic_viscosity_100C = "50 cSt"',
            "thins from 40 to 100",
        ),
    ],
)
def test_what_does_not_fit_together(faults_of, path, line, words):
    where = "oil.grade" if path.startswith("oil") else path
    faults, _ = faults_of(**{where.replace(".", "__"): line})
    assert words in faults[path].expected


def test_slipper_limit_is_where_neighbours_touch():
    """The limit of the check is the distance of neighbouring ball centres placed by vectors in the pump."""
    pump = load_pump(BENCH).pump
    cone, swash, half = pump.bore_cone_angle, pump.swash_angle_max, math.pi / pump.pistons
    # The bore axis leaves the pitch circle outwards; cut it with the plane x = -tan(swash) y through the shaft.
    rise = pump.pitch_radius * math.tan(swash) * math.cos(half)
    along = -rise / (math.cos(cone) + math.sin(cone) * math.tan(swash) * math.cos(half))
    touching = (pump.pitch_radius + along * math.sin(cone)) * math.sin(half)
    inside, outside = (f"{touching * 1e3 * factor} mm" for factor in (1 - 1e-6, 1 + 1e-6))
    load_pump(BENCH, {"slipper.land_outer_radius": inside})
    with pytest.raises(InputFaults, match="neighbouring slippers overlap"):
        load_pump(BENCH, {"slipper.land_outer_radius": outside})


@pytest.mark.parametrize(
    ("table", "radius", "film", "tilts"),
    [
        ("valve_plate", 45.7e-3, 8e-6, ("tilt_x", "tilt_y")),
        ("slipper", 14e-3, 10e-6, ("tilt_radial", "tilt_tangential")),
    ],
)
def test_given_tilts_leave_a_film(table, radius, film, tilts):
    def tilted(share: float) -> dict[str, object]:
        """Both tilts alike, together taking this share of the film at the outer edge."""
        return {f"{table}.{key}": f"{share * film / radius / math.sqrt(2)!r} rad" for key in tilts}

    load_pump(BENCH, tilted(0.999))
    with pytest.raises(InputFaults, match=f"{table}.{tilts[0]}"):
        load_pump(BENCH, tilted(1.001))


def test_the_remedies_cure():
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"pump.displacement": "80 cm3/rev"})
    remedy = raised.value.faults[0].nearest
    pitch = re.search(r"pitch_radius = '(.*?)'", remedy)[1]
    cured = {"pump.displacement": "80 cm3/rev", "pump.pitch_radius": pitch}
    with pytest.raises(InputFaults) as raised:  # a smaller pitch has its own price, but no longer this one
        load_pump(BENCH, cured)
    assert "pump.displacement" not in {fault.path for fault in raised.value.faults}


def test_all_faults_at_once(faults_of):
    faults, message = faults_of(
        piston__radial_clearance='radial_clearance = "-15 um"',
        piston__mass="mass = 160",
        slipper__land_outer_radius='land_outer_radius = "16 mm"',
        slipper__orifice_length="",
        pump__displacement='displacement = "80 cm3/rev"',
        block="[blok]",
        oil__grade='grade = "VG 46"',
        operating__inlet_pressure='inlet_pressure = "-2 bar"',
    )
    assert set(faults) == {
        "piston.radial_clearance",
        "piston.mass",
        "slipper.land_outer_radius",
        "slipper.orifice_length",
        "pump.displacement",
        "blok",
        "oil.grade",
        "operating.inlet_pressure",
    }
    assert "8 faults" in message


def test_a_check_waits_for_values_it_can_trust(faults_of):
    faults, _ = faults_of(
        pump__pitch_radius='pitch_radius = "45 bar"', slipper__land_outer_radius='land_outer_radius = "44 mm"'
    )
    assert set(faults) == {"pump.pitch_radius"}


@pytest.mark.parametrize(
    ("override", "path"),
    [
        ({"piston.radial_clearance": "1 mm"}, "piston.radial_clearance"),
        ({"piston.radial_clearance": "0.07 mm"}, "piston.radial_clearance"),
        ({"slipper.film_thickness": "0.1 mm"}, "slipper.film_thickness"),
        ({"valve_plate.film_thickness": "0.1 mm"}, "valve_plate.film_thickness"),
        ({"operating.inlet_pressure": "-0.3 bar"}, "operating.inlet_pressure"),
        ({"operating.pressure": "400 bar"}, "operating.pressure"),
        ({"operating.speed": "2500 rpm"}, "operating.speed"),
        ({"operating.temperature": "0 degC"}, "operating.temperature"),
        ({"operating.temperature": "90 degC"}, "operating.temperature"),
        ({"oil.bulk_modulus": "1.6 MPa"}, "oil.bulk_modulus"),
        ({"operating.case_pressure": "400 bar"}, "ball_guide.spring_preload"),
        ({"operating.case_pressure": "400 bar"}, "operating.case_pressure"),
        ({"operating.case_pressure_abs": "6.1 bar"}, "operating.case_pressure"),
        ({"piston.mass": "160 kg"}, "piston.mass"),
        ({"slipper.mass": "50 kg"}, "slipper.mass"),
        ({"friction.piston_cylinder": 2.6}, "friction.piston_cylinder"),
        ({"slipper.land_inner_radius": "8.6 mm"}, "slipper.land_outer_radius"),
    ],
)
def test_doubtful_values_warn_and_load(override, path):
    found = {warning.path: warning for warning in check_pump(load_pump(BENCH, override)).warnings}
    assert path in found
    assert isinstance(found[path], CheckWarning)
    assert found[path].limit
    assert found[path].remedy


@pytest.mark.parametrize(
    ("temperature", "words"),
    [
        ("-40 degC", ("at -40 degC the oil has", "400 mm2/s", "cold start", "1600 mm2/s", "no pump starts so")),
        ("0 degC", ("at 0 degC the oil has", "400 mm2/s", "a higher temperature or a thinner oil")),
        ("100 degC", ("has 6.8 mm2/s", "10 mm2/s, least", "a lower temperature or a thicker oil")),
    ],
)
def test_oil_too_thick_or_too_thin_for_a_pump_is_told_with_its_limit(temperature, words):
    report = check_pump(load_pump(BENCH, {"operating.temperature": temperature}))
    (told,) = (str(one) for one in report.warnings if one.path == "operating.temperature")
    assert all(word in told for word in words)


@pytest.mark.parametrize(("over", "held"), [(-1.0, True), (1.0, False)])
def test_a_slipper_is_held_while_its_spring_outweighs_inertia_and_case(over, held):
    speed, cylindrical = (
        2100.0 * math.pi / 30.0,
        {"pump.bore_cone_angle": "0 deg", "pump.displacement": "89.46 cm3/rev"},
    )
    inertia = 0.21 * 0.045 * math.tan(math.radians(16.2)) * speed**2  # of 210 g, the plate's fall R tan(g) w^2
    even = 2.5e6 + (1080.0 / 9.0 - inertia) / (0.25 * math.pi * 0.022**2)
    override = {**cylindrical, "operating.case_pressure": f"{even + 1e3 * over:.6f} Pa"}
    found = {warning.path for warning in check_pump(load_pump(BENCH, override)).warnings}
    assert ("ball_guide.spring_preload" in found) is not held
    clearance = load_pump(BENCH, {**override, "retainer.kind": "clearance"})
    assert "ball_guide.spring_preload" not in {warning.path for warning in check_pump(clearance).warnings}


def test_the_case_of_a_pump_at_a_cold_start_is_not_doubtful():
    cold = load_pump("ref90", {"operating.case_pressure_abs": "6 bar", "operating.inlet_pressure": "30 bar"})
    assert "operating.case_pressure" not in {warning.path for warning in check_pump(cold).warnings}


def test_ref90_is_not_doubtful():
    assert check_pump(load_pump("ref90")) == CheckReport((), ())


def test_the_pump_of_the_recordings_is_doubtful_in_its_engaged_length_only():
    report = check_pump(load_pump(BENCH))
    assert report.faults == ()
    assert [warning.path for warning in report.warnings] == ["piston.engaged_length"]
    assert report.warnings[0].value.startswith("18.74 mm")  # 45 mm less the stroke of 26.264 mm


def test_operating_point_is_checked_all_at_once():
    pump = load_pump(BENCH)
    point = operating_point(pump, displacement_ratio=1.5, inlet_pressure=-2e5, shaft_speed=0.0, delivery_pressure=-3e5)
    paths = [fault.path for fault in check_operating_point(pump, point).faults]
    assert paths == [
        "operating.pressure",
        "operating.inlet_pressure",
        "operating.pressure",
        "operating.speed",
        "operating.displacement_ratio",
    ]
    assert check_operating_point(pump, operating_point(pump)).faults == ()


# The way back


@pytest.mark.parametrize("source", ["ref90", *EXAMPLES], ids=lambda source: Path(source).stem)
def test_resolved_toml_loads_to_the_same(tmp_path, source):
    pump = load_pump(source)
    file = tmp_path / "resolved.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump


@settings(deadline=None)
@given(clearance=st.floats(1e-6, 1e-4), speed=st.floats(10.0, 400.0), tilt=st.floats(1e-9, 7e-4))
def test_resolved_toml_loads_to_the_same_for_any_numbers(tmp_path_factory, clearance, speed, tilt):
    pump = load_pump(
        BENCH,
        {
            "piston.radial_clearance": f"{clearance!r} m",
            "operating.speed": f"{speed!r} rad/s",
            "slipper.tilt_radial": f"{tilt!r} rad",
            "piston.spin_ratio": tilt,
        },
    )
    assert pump.piston.radial_clearance == clearance
    file = tmp_path_factory.mktemp("resolved") / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump
