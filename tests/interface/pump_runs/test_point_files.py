"""Measured points in CSV files: profiles of worn parts and impedances of lines."""

from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from gaps.shapes.profiles import PointsAround, measured
from reynolds import InputError
from system import ImpedanceLine, InputFaults, floating_parts, load_pump, lumped_point, operating_point, resolved_toml
from system.pump.lumped import port_lines

HEAD = "place [mm],material taken off [um]\n"
AROUND = "place [mm],angle [deg],material taken off [um]\n"
NET = "material_taken_off [um], place [cm], angle [deg]\n"


@pytest.fixture
def pump_file(tmp_path):
    """A copy of the recordings' pump in a folder of its own, to which lines can be added."""

    def write(lines: str = "") -> Path:
        path = tmp_path / "pump.toml"
        path.write_text(resolved_toml(load_pump(BENCH)) + lines, "utf-8")
        return path

    return write


def test_a_worn_bore_comes_from_a_file_beside_the_pump(pump_file, tmp_path):
    """Comments, empty lines and other units do not matter; the resolved file holds the rows themselves."""
    (tmp_path / "worn.csv").write_text(f"# measured\n{HEAD}0,4\n\n20,1.5\n45,0\n", "utf-8")
    pump = load_pump(pump_file('\n[bore]\nprofile = "worn.csv"\n'))
    assert pump.bore.profile == ((0.0, 4e-6), (20e-3, 1.5e-6), (45e-3, 0.0))
    (tmp_path / "worn.csv").unlink()
    again = tmp_path / "resolved.toml"
    again.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(again) == pump


def test_wear_around_a_part_in_columns_of_any_order(pump_file, tmp_path):
    rows = [f"{place * 1e-1 + turned * 1e-2},{place / 10},{turned}" for place in (26, 46) for turned in (0, 90, 200)]
    (tmp_path / "plate.csv").write_text(NET + "\n".join(rows), "utf-8")
    path = pump_file()
    text = path.read_text("utf-8").replace("land_radius_1", 'profile = "plate.csv"\nland_radius_1', 1)
    path.write_text(text, "utf-8")
    pump = load_pump(path)
    assert pump.valve_plate.profile is not None
    assert pump.valve_plate.profile[1] == pytest.approx((26e-3, np.radians(90.0), 3.5e-6), rel=1e-14)
    face = floating_parts(pump).block.faces
    found = face(np.array([36e-3, 46e-3]), np.radians([45.0, 280.0])).depth
    assert found == pytest.approx([4.05e-6, 5.6e-6], rel=1e-12)  # 280 deg: half the way from 200 round to 0
    path.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(path) == pump


@pytest.mark.parametrize(
    ("text", "found", "expected"),
    [
        (None, "which is no file", "place [mm], material taken off [um]"),
        ("", "which is empty", "a CSV file"),
        ("0,1\n", "the head '0, 1'", "a CSV file with the head"),
        ("place,material taken off [um]\n0,1\n", "the head 'place, material", "place [mm]"),
        (HEAD + "0,1\n45\n", "line 3 of worn.csv: 1 values", "2 values"),
        (HEAD + "0,1\n45,x\n", "line 3 of worn.csv, material taken off: 'x um'", "a number; the head says [um]"),
        ("place [bar],material taken off [um]\n0,1\n", "line 2 of worn.csv, place: '0 bar'", "the head says [bar]"),
        (HEAD + "0,1\n", "worn.csv", "at least 2 rows"),
        (HEAD + "0,1\n44,1\n", "places from 0 mm to 44 mm", "45 mm or more"),
        ("place [mm],angle [deg],material taken off [um]\n0,0,1\n0,9,1\n45,0,1\n", "0 rows at 45 mm, 9 deg", "once"),
        (AROUND + "0,0,1\n0,360,1\n45,0,1\n45,360,1\n", "angles from 0 deg to 360 deg", "less than a turn"),
    ],
)
def test_a_file_that_is_none_is_told_once(text, found, expected, pump_file, tmp_path):
    if text is not None:
        (tmp_path / "worn.csv").write_text(text, "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_pump(pump_file('\n[bore]\nprofile = "worn.csv"\n'))
    (fault,) = raised.value.faults
    assert fault.path == "bore.profile"
    assert found in fault.found
    assert expected in fault.expected


def test_the_nearest_file_and_column_are_offered(pump_file, tmp_path):
    (tmp_path / "wear.csv").write_text("plce [mm],material taken off [um]\n0,1\n", "utf-8")
    for name, offered in (("worn.csv", "wear.csv"), ("wear.csv", "'place'")):
        with pytest.raises(InputFaults) as raised:
            load_pump(pump_file(f'\n[bore]\nprofile = "{name}"\n'))
        assert raised.value.faults[0].nearest.endswith(offered)


def test_measured_nets_have_no_holes():
    net = [(0.0, 0.0, 1e-6), (0.0, 1.0, 2e-6), (1e-2, 0.0, 3e-6), (1e-2, 1.0, 4e-6)]
    assert measured(net[::-1]) == PointsAround((0.0, 1e-2), (0.0, 1.0), ((1e-6, 2e-6), (3e-6, 4e-6)))
    for rows in (net[:3], [*net, net[0]]):
        with pytest.raises(InputError, match="each place with each angle once"):
            measured(rows)


def test_lines_by_impedance_and_orifice_from_the_pump_file(pump_file, tmp_path):
    """A closed volume by its impedance K/(i w V) ripples as that volume behind an orifice, to a few percent.

    The orifice's own slope, q/(2 dp), is what differs: 2 % of w V/K at the first harmonic.
    """
    frequency = np.geomspace(300.0, 7000.0, 400)
    imaginary = -1.6e9 / (2 * np.pi * frequency * 0.9e-3)
    rows = "".join(f"{f!r},0,{x!r}\n" for f, x in zip(frequency.tolist(), imaginary.tolist(), strict=True))
    (tmp_path / "line.csv").write_text(f"frequency [Hz],real [Pa s/m3],imaginary [Pa s/m3]\n{rows}", "utf-8")
    delivery = '\n[delivery_line]\nkind = "impedance"\nvolume = "0.1 L"\nimpedance = "line.csv"\n'
    suction = '\n[suction_line]\nkind = "orifice"\nvolume = "1 L"\ntank_pressure = "27 bar"\n'
    pump = load_pump(pump_file(delivery + suction))
    point = operating_point(pump)
    assert isinstance(port_lines(pump, point).delivery, ImpedanceLine)
    found = lumped_point(pump, point)
    assert found.delivery.mean_pressure == pytest.approx(point.delivery_pressure, rel=1e-5)
    assert found.suction.mean_pressure == pytest.approx(point.inlet_pressure, rel=1e-3)
    assert np.ptp(found.suction.pressure) > 1e4
    orifice = '\n[delivery_line]\nkind = "orifice"\nvolume = "1 L"\n'
    swing = np.ptp(lumped_point(load_pump(pump_file(orifice + suction)), point).delivery.pressure)
    assert np.ptp(found.delivery.pressure) == pytest.approx(swing, rel=0.05)


def test_an_impedance_that_the_ripple_leaves_is_refused(pump_file):
    rows = '[["1 kHz", "0 Pa s/m3", "1e9 Pa s/m3"], ["7 kHz", "0 Pa s/m3", "1e9 Pa s/m3"]]'
    line = f'\n[delivery_line]\nkind = "impedance"\nimpedance = {rows}\n'
    with pytest.raises(InputFaults, match=r"(?s)from 1 kHz to 7 kHz.*315 Hz or less to 6.3 kHz or more"):
        load_pump(pump_file(line))
