"""Breaks in the order of a recording: a unit that changes, another pump; neither in sound maps, drifts and ramps."""

import numpy as np
import pytest

from diagnosis.recording.breaks.refused import refuse_breaks
from diagnosis.recording.breaks.sampled_rows import rows_are_samples
from diagnosis.recording.breaks.two_pumps import pump_changes, pumps_named
from diagnosis.recording.breaks.unit_changes import unit_changes
from diagnosis.recording.channel_form import PressureReference, channel_form, channel_section
from diagnosis.recording.tables.columns import ColumnReader
from diagnosis.recording.tables.table import TableColumns
from system import ChannelName
from system.inputs.units import unit_scale

UNITS = {"speed": "rpm", "p_out": "bar", "T_case": "degC", "Q_out": "L/min", "Q_case": "L/min", "torque": "N m"}
NAMES = [ChannelName.named(name) for name in UNITS]
FORMS = [
    channel_form(name, channel_section(name)(column=name.value, unit=unit), PressureReference.GAUGE)
    for name, unit in zip(NAMES, UNITS.values(), strict=True)
]
ROW = 71


def table(seed=1, displacement=90e-6, in_order=False, count=120):
    """A map of a pump (N, 6) in SI in random order, or by rising speed and pressure."""
    rng = np.random.default_rng(seed)
    speed, pressure = rng.uniform(50.0, 260.0, count), rng.uniform(30e5, 400e5, count)
    if in_order:
        speed, pressure = (each.ravel() for each in np.meshgrid([80.0, 150.0, 250.0], np.linspace(4e6, 4e7, 40)))
        speed, pressure = np.sort(speed), pressure[np.argsort(speed, kind="stable")]
    warm = rng.uniform(310.0, 345.0, count)
    leakage = 3e-5 * pressure / 400e5 * np.exp((warm - 320.0) / 30.0)
    flow = displacement / (2.0 * np.pi) * speed - leakage
    torque = displacement / (2.0 * np.pi) * pressure + 4.0 + 0.02 * speed
    sound = np.column_stack([speed, pressure, warm, flow, leakage, torque])
    return sound * (1.0 + 3e-3 * rng.standard_normal(sound.shape) * (np.arange(6) != 2))


BARE = TableColumns({})


def faults(readings, columns=BARE):
    reader = ColumnReader([])
    refuse_breaks("steady", FORMS, readings, columns, reader)
    return reader.faults


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("in_order", [False, True])
def test_sound_maps_have_no_break(seed, in_order):
    assert faults(table(seed, in_order=in_order)) == []


def test_drift_and_a_step_of_a_flow_meter_are_no_break():
    readings = table()
    readings[:, 3] *= np.linspace(1.0, 1.1, len(readings))
    assert faults(readings) == []
    readings[ROW:, 3] *= 1.3
    assert list(pump_changes(readings, NAMES)) == []


@pytest.mark.parametrize(
    ("channel", "unit"),
    [("p_out", "MPa"), ("p_out", "psi"), ("Q_out", "m3/h"), ("Q_case", "L/s"), ("torque", "lbf ft"),
     ("T_case", "degF"), ("T_case", "K"), ("speed", "rad/s"), ("speed", "rev/s")],
)  # fmt: skip
@pytest.mark.parametrize("behind", [True, False])
def test_a_unit_that_changes_is_found_with_its_row_and_both_units(channel, unit, behind):
    readings, k = table(), list(UNITS).index(channel)
    own, other = FORMS[k], unit_scale(unit, NAMES[k].dimension)
    part = (np.arange(len(readings)) >= ROW) == behind
    numbers = (readings[part, k] - other[1]) / other[0]
    readings[part, k] = own.si(numbers)
    (change,) = unit_changes(readings, FORMS)
    assert (change.channel.name.value, change.row) == (channel, ROW)
    (fault,) = faults(readings)
    assert fault.path == f"channel.{channel}.unit"
    assert f"row {ROW}" in fault.found or f"row {ROW + 1}" in fault.found
    assert unit in fault.found or not behind  # of an early part the same ratio may be another unit behind


@pytest.mark.parametrize("held", [1.0, 0.5])
def test_a_channel_that_is_held_at_one_value_has_no_break(held):
    """Full stroke at all points is exactly 1, whose logarithm leaves nothing beside any law."""
    ratio = ChannelName.DISPLACEMENT_RATIO
    form = channel_form(ratio, channel_section(ratio)(column="ratio", unit="1"), PressureReference.GAUGE)
    assert list(unit_changes(np.column_stack([table(), np.full(120, held)]), [*FORMS, form])) == []


@pytest.mark.parametrize("rest", [slice(0, 12), slice(60, 72), slice(108, 120)])
@pytest.mark.parametrize("seed", range(4))
def test_a_pump_at_rest_is_no_change_of_unit(rest, seed):
    """Flows and torque about zero, of either sign, while the pump stands."""
    readings = table(seed)
    readings[rest, 0] = 0.0
    readings[rest, 3:] *= 1e-3 * np.random.default_rng(seed).uniform(-0.1, 1.0, (12, 3))
    assert faults(readings) == []


def test_another_pump_is_found_by_its_flow_and_torque():
    readings = table()
    readings[ROW:] = table(2, displacement=63e-6)[ROW:]
    (fault,) = faults(readings)
    assert f"from row {ROW + 1} on" in fault.found
    assert "split" in fault.expected


@pytest.mark.parametrize("head", ["Pump", "serial number", "S/N", "pump_id", "Prüfling", "Serial No."])
def test_a_column_that_names_two_pumps_is_a_fault(head):
    cells = ("A1",) * 60 + ("B2",) * 60
    (fault,) = faults(table(), TableColumns({}, words={head: cells}))
    assert "A1 (rows 1 to 60), B2 (rows 61 to 120)" in fault.found


@pytest.mark.parametrize("head", ["pump speed", "pump temperature", "test", "sn rpm"])
def test_other_columns_name_no_pump(head):
    assert list(pumps_named(TableColumns({head: np.arange(9.0) // 3}), ())) == []


@pytest.mark.parametrize(("course", "samples"), [
    (np.linspace(40e5, 380e5, 900), True), (np.repeat(np.linspace(40e5, 380e5, 9), 100), True),
    (np.tile(np.linspace(40e5, 380e5, 9), 100), False),
    (np.repeat(np.linspace(40e5, 380e5, 45)[np.arange(45) * 7 % 45], 20), False),
    (np.full(900, 200e5), False), (np.linspace(40e5, 380e5, 90), False),
], ids=["ramp", "stairs", "map", "repeats", "one pressure", "few"])  # fmt: skip
def test_samples_of_a_series_are_told_from_points(course, samples):
    """Ramps and stairs, with noise; neither a map of many points, nor one of which each is repeated twenty times."""
    rng = np.random.default_rng(1)
    readings = np.column_stack([150.0 + 0.01 * rng.standard_normal(len(course)), course])
    readings[:, 1] += 2e4 * rng.standard_normal(len(course))
    assert rows_are_samples(readings, [ChannelName.SPEED, ChannelName.P_OUT]) is samples
