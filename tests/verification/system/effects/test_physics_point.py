"""A lumped point with the effects of [physics]: off is as before, on keeps energy, files tell all."""

from dataclasses import replace

import numpy as np
import pytest

from reynolds import Array, NotConverged
from system import (
    EXTENSIONS,
    SIMULATED,
    BenchPoints,
    EffectId,
    Extension,
    LumpedBench,
    PumpDescription,
    base_parameters,
    check_pump,
    extended_pump,
    load_pump,
    lumped_point,
    operating_point,
    resolved_toml,
    tolerances,
)
from system.description.effects import PhysicsSection
from system.effects.switched import switched_on
from system.inputs.faults import InputFaults
from system.inputs.sections.reader import section_of
from system.pump.lumped import SAMPLES_PER_PITCH

REF90 = load_pump("ref90")
FORMS = [form for one in EXTENSIONS for form in (replace(one, forms=()), *one.forms)]
BY_NAME = [pytest.param(one, id=f"{one.parameters[0].name} {' '.join(one.grid[0])}") for one in FORMS]
POINTS = BenchPoints(
    speed=np.array([2100 * np.pi / 30, 300.0]),
    displacement_ratio=np.array([1.0, 0.6]),
    p_out=np.array([35e6, 35e6]),
    p_in=np.array([2.5e6, 1e5]),
    p_case=np.array([0.15e6, 0.15e6]),
    T_case=np.array([323.15, 333.15]),
    T_in=np.array([318.15, 318.15]),
    hours=np.zeros(2),
    order=np.arange(2.0),
    warming=np.zeros(2),
)
CLOSED = 1e-4
"""Largest error of the power balance with an effect on, of the shaft power."""


def with_effect(extension: Extension, xi: float = 1.0) -> PumpDescription:
    """REF90 with every parameter of an effect `xi` spreads up."""
    values = {one.name.rpartition(".")[2]: one.value(xi) for one in extension.parameters}
    table: dict = {**extension.members[-1].grid[0], **values}
    table = {extension.pair.value: table} if extension.pair else table
    return replace(REF90, physics=section_of(PhysicsSection, {extension.id.value: table}))


@pytest.fixture(scope="module")
def plain():
    return lumped_point(REF90, operating_point(REF90))


@pytest.mark.parametrize("extension", BY_NAME)
def test_effects_of_no_size_leave_every_number(extension, plain):
    off = lumped_point(with_effect(extension, 0.0), operating_point(REF90))
    assert off.bench == plain.bench
    assert off.power == plain.power
    np.testing.assert_array_equal(off.shaft_torque, plain.shaft_torque)


@pytest.mark.parametrize("extension", BY_NAME)
def test_the_balance_of_power_closes_with_each_effect(extension, plain):
    asked = replace(operating_point(REF90), shaft_speed=300.0, temperature=333.15, inlet_pressure=1e5)
    found = lumped_point(with_effect(extension, 1.5), asked)
    assert found.checks.energy_balance_error < CLOSED
    assert found.checks.work_balance_error < CLOSED
    for value in vars(found.bench).values():
        assert np.isfinite(value)


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("port_short_circuit", {"area": "3 mm2"}),
        ("laminar_cross_leak", {"conductance": "1.2e-6 cm3"}),
        ("control_flow", {"area": "2 mm2", "laminar": 0.3}),
    ],
)
def test_oil_that_expands_past_the_chambers_is_in_the_balance(name, size):
    """Slow, so that paths past the chambers pass more power than the shaft: 0.6 % of it is expansion at 20 MPa."""
    stated = {f"physics.{name}.{key}": value for key, value in size.items()}
    asked = {"operating.speed": "150 rpm", "operating.pressure": "22 MPa"}
    pump = load_pump("ref90", stated | asked)
    found = lumped_point(pump, operating_point(pump))
    assert found.power.extended > 0.01 * found.power.shaft
    assert found.checks.energy_balance_error < CLOSED


def test_a_plate_that_gives_way_to_upright_is_told():
    """0.6 deg of droop and 0.17 deg of play at 35 MPa are more than the 0.5 deg of a small displacement."""
    pump = replace(REF90, physics=section_of(PhysicsSection, {"swash_droop": {"rate": 3e-10, "play": 2.9e-3}}))
    with pytest.raises(NotConverged, match=r"swash_droop.*35 MPa and a displacement ratio of 0.03 .* upright"):
        lumped_point(pump, operating_point(pump, displacement_ratio=0.03))
    assert lumped_point(pump, operating_point(pump, displacement_ratio=0.1)).bench.delivery_flow > 0.0


def test_an_inlet_that_loses_pressure_is_no_line_that_sets_it():
    """The suction port lies 0.15 MPa below the gauge, which reads the stated pressure; no line has an orifice."""
    stated = {"physics.incomplete_filling.inlet_loss": 3.0, "physics.incomplete_filling.laminar": 0.3}
    pump = load_pump("ref90", stated)
    found = lumped_point(pump, operating_point(pump))
    assert found.suction.mean_pressure < pump.operating.inlet_pressure - 1e5
    assert found.bench.inlet_pressure == pytest.approx(pump.operating.inlet_pressure)
    assert found.warnings == ()


def _shift(extension: Extension, plain) -> Array:
    found = lumped_point(with_effect(extension), operating_point(REF90)).bench
    return np.array(
        [
            (found.delivery_flow - plain.bench.delivery_flow) * 6e4,
            (found.drain_flow - plain.bench.drain_flow) * 6e4,
            found.shaft_torque - plain.bench.shaft_torque,
        ]
    )


@pytest.mark.parametrize(
    ("name", "signs"),
    [
        ("film_heating", (-1, 1, -1)),
        ("viscosity_pressure", (1, -1, 1)),
        ("shear_thinning", (0, 0, -1)),
        ("mixed_friction", (0, 0, 1)),
        ("elastic_opening.slipper", (-1, 1, -1)),
        ("squeeze_pumping", (0, 1, 0)),
        ("entrained_air", (-1, 0, -1)),
        ("churning", (0, 0, 1)),
        ("seal_drag", (0, 0, 1)),
        ("charge_pump_drag", (0, 0, 1)),
        ("port_short_circuit", (-1, 0, 0)),
        ("laminar_cross_leak", (-1, 0, 0)),
        ("port_throttling", (0, 0, 1)),
        ("compression_loss", (0, 0, 1)),
        ("control_flow", (-1, 1, 0)),
        ("swash_droop", (-1, 0, -1)),
        ("line_resonance", (1, 0, 0)),
    ],
)  # fmt: skip
def test_effects_move_delivery_drain_and_torque_as_the_catalogue_says(name, signs, plain):
    """Zero: less than a tenth of a good bench's noise, .2 L/min, .1 L/min and .5 N m."""
    extension = next(one for one in EXTENSIONS if one.parameters[0].name.startswith(name + "."))
    shift = _shift(extension, plain) / [0.2, 0.1, 0.5]
    for moved, sign in zip(shift, signs, strict=True):
        assert np.sign(moved) == sign if sign else abs(moved) < 0.1, (name, shift)


def test_effects_are_read_from_a_file_and_written_back(tmp_path):
    text = resolved_toml(REF90)
    for extension in FORMS:
        one = with_effect(extension)
        file = tmp_path / "pump.toml"
        file.write_text(resolved_toml(one), "utf-8")
        assert load_pump(file) == one
        ((found, values),) = switched_on(load_pump(file))
        assert (found.id, found.pair, found.law) == (extension.id, extension.pair, extension.law)
        assert values.keys() == set(extension.grid[0]) | {own.name.rpartition(".")[2] for own in extension.parameters}
    assert "physics" not in text


@pytest.mark.parametrize("extension", BY_NAME)
def test_a_bench_map_reads_the_same_with_an_effect_stated_as_with_its_law(extension):
    """The map's law at its values, the map of a pump that states them, and the point of that pump."""
    member = extension.members[-1]
    values = np.array([one.value(0.0 if one in member.scales else 1.0) for one in member.free])
    law = LumpedBench(REF90, POINTS, SIMULATED, member.free, (member,), samples_per_pitch=SAMPLES_PER_PITCH)
    stated = LumpedBench(with_effect(extension), POINTS, SIMULATED, (), samples_per_pitch=SAMPLES_PER_PITCH)
    read = law.predict(values)
    np.testing.assert_allclose(stated.predict(np.array([])), read, rtol=1e-12)
    asked = operating_point(REF90, displacement_ratio=0.6, temperature=333.15, shaft_speed=300.0, inlet_pressure=1e5)
    bench = lumped_point(with_effect(extension), asked).bench
    one = [bench.delivery_flow, bench.inlet_flow, bench.drain_flow, bench.shaft_torque]
    np.testing.assert_allclose(read[1], one, rtol=3e-5)


def test_a_fit_makes_a_pump_file_that_runs_to_its_readings(tmp_path):
    """Base parameters, two effects of gaps and one of a grid; what a sensor reads wrong stays out of the pump."""
    by_name = {one.parameters[0].name: one for one in EXTENSIONS}
    names = ("elastic_opening.slipper.opening", "churning.factor", "control_flow.area")
    found = [by_name[name].members[-1] for name in names]
    values = {
        "film_thickness.slipper": 11e-6, "friction.piston_cylinder": 0.03, "displacement": 1.002,
        "viscosity": 1.03, "viscosity_slope": 1e-3, "stand_out_share": 0.4, "bulk_modulus": 1.5e9,
        "torque.gain": 0.01,
        "elastic_opening.slipper.opening": 1e-8, "churning.factor": 0.8, "control_flow.area": 1e-7,
        "control_flow.laminar": 0.7,
    }  # fmt: skip
    told = {one.name: one for one in base_parameters(REF90, tolerances(REF90)[0])}
    parameters = tuple(told[name] for name in values if name in told)
    fitted = LumpedBench(REF90, POINTS, SIMULATED, parameters, tuple(found), samples_per_pitch=SAMPLES_PER_PITCH)
    read = fitted.predict(np.array([values[one.name] for one in fitted.parameters]))
    file = tmp_path / "extended.toml"
    file.write_text(resolved_toml(extended_pump(REF90, values, found)), "utf-8")
    pump = load_pump(file)
    bench = lumped_point(pump, operating_point(pump)).bench
    one = [bench.delivery_flow, bench.inlet_flow, bench.drain_flow, bench.shaft_torque]
    np.testing.assert_allclose(read[0], one, rtol=3e-5)


@pytest.mark.parametrize(
    ("table", "keys"),
    [
        ({"incomplete_filling": {"inlet_loss": 1.0, "laminar": 0.0, "growth": 2.0}}, "laminar or growth"),
        (
            {"slipper_lift": {"ride_height": "20 um", "retainer_force": "77 N", "sharpness": 4, "wedge_exponent": 0.5}},
            "sharpness or wedge_exponent",
        ),
    ],
)
def test_a_table_states_one_form_of_a_law(table, keys):
    stated = {f"physics.{name}.{key}": value for name, own in table.items() for key, value in own.items()}
    with pytest.raises(InputFaults, match=f"one of the two, {keys}"):
        load_pump("ref90", stated)


@pytest.mark.parametrize(
    ("name", "off"),
    [
        ("churning.factor", 1e-9),
        ("port_short_circuit.area", 1e-9),
        ("viscosity_pressure.coefficient", 0.1),
        ("elastic_opening.slipper.opening", 0.2),
    ],
)
def test_a_size_found_beside_a_stated_one_adds_to_it(name, off):
    """A fit has the pump's own law and a second one: its pump runs to its readings, to first order in the sizes."""
    extension = next(one for one in EXTENSIONS if one.parameters[0].name == name)
    pump, law = with_effect(extension, 0.5), extension.members[-1]
    bench = LumpedBench(pump, POINTS, SIMULATED, (), (law,))
    found = {one.name: one.value(0.0) for one in bench.parameters}
    none, both = (bench.predict(np.array([*{**found, name: size}.values()])) for size in (0.0, found_size(extension)))
    file = LumpedBench(extended_pump(pump, {**found, name: found_size(extension)}, [law]), POINTS, SIMULATED, ())
    missed = np.abs(file.predict(np.zeros(0)) - both)
    assert np.all(missed <= 1e-12 + off * np.abs(both - none).max(axis=0))


def found_size(extension: Extension) -> float:
    """A quarter of the spread of an effect's first size."""
    return extension.parameters[0].value(0.25)


def test_a_pump_has_one_coefficient_of_barus():
    stated = {"oil.pressure_viscosity": "20 1/GPa"}
    thick = next(one for one in EXTENSIONS if one.id is EffectId.VISCOSITY_PRESSURE)
    found = extended_pump(load_pump("ref90", stated), {"viscosity_pressure.coefficient": 1.5e-8}, [thick])
    assert found.oil.pressure_viscosity == 1.5e-8
    assert not check_pump(found).faults
    (fault,) = check_pump(replace(found, oil=load_pump("ref90", stated).oil)).faults
    assert fault.path == "physics.viscosity_pressure.coefficient"
    assert "20 1/GPa" in fault.expected


@pytest.mark.parametrize(
    "stated",
    [
        {"delivery_line.kind": "orifice", "delivery_line.volume": "1 L", "delivery_line.orifice_area": "20 mm2"},
        {"piston.3.radial_clearance": "25 um"},
    ],
)
def test_effects_beside_lines_and_single_parts(stated):
    """The power balance closes where a line sets the pressure and where chambers differ."""
    effects = {"elastic_opening": {"slipper": {"opening": 2e-8}}, "control_flow": {"area": 1e-7, "laminar": 0}}
    pump = replace(load_pump("ref90", stated), physics=section_of(PhysicsSection, effects))
    plain = replace(pump, physics=PhysicsSection())
    found, before = (lumped_point(one, operating_point(one)) for one in (pump, plain))
    assert found.checks.energy_balance_error < CLOSED
    assert found.bench.drain_flow > before.bench.drain_flow
