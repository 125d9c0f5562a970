"""The front door: commands as functions of `swashfilm`."""

import json
import subprocess
import sys
from inspect import signature
from pathlib import Path

import numpy as np
import pytest

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.cli.app import parse

ROOT = Path(__file__).parents[3]
PAD = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["10 mm", "10 mm"], cells = [8, 4] }
thickness = "10e-6*(2 - x/0.01)"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
cavitation = "none"
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""
LUMPED = {"fidelity": "lumped"}


@pytest.fixture(scope="module")
def point():
    return sf.run("ref90", speed="2100 rpm", pressure="350 bar", **LUMPED)


def files(folder):
    return {path.name for path in Path(folder).iterdir()}


def test_importing_it_is_light():
    code = "import swashfilm, sys; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
    assert set(sf.__all__) <= set(dir(sf))
    assert all(getattr(sf, name) is not None for name in sf.__all__)
    assert sf.__version__.count(".") == 2


def test_a_point_has_numbers_tables_and_data(point):
    assert point.flow_delivery == point.flow.delivery == point.summary["flow"]["delivery_m3_per_s"]
    assert 0.8 < point.efficiency.overall < point.efficiency.volumetric < 1.0
    data = point.to_xarray().sel(pair="piston_cylinder")
    of_one = float((data.loss_coulomb + data.loss_viscous).mean())
    assert point.losses.piston_cylinder.total == pytest.approx(9.0 * of_one, rel=1e-6)
    assert point.films.slipper.leakage_flow > 0.0
    assert "flow, delivery" in repr(point)
    assert "<table>" in point._repr_html_()
    assert "chamber_pressure [Pa]" in point.to_pandas().columns
    assert "flow_delivery" in dir(point)
    with pytest.raises(AttributeError, match="torque"):
        point.flow_deliverd  # noqa: B018


@pytest.mark.parametrize("name", ["run", "map"])
def test_a_function_has_the_fidelity_of_its_command_unless_told(name):
    assert signature(getattr(sf, name)).parameters["fidelity"].default == parse([name]).fidelity


def test_numbers_are_in_si_or_text_with_a_unit(point):
    same = sf.run("ref90", speed=2100.0 * np.pi / 30.0, pressure=35e6, **LUMPED)
    assert same.flow_delivery == pytest.approx(point.flow_delivery, rel=1e-12)
    of_description = sf.run(sf.load_pump("ref90"), speed="2100 rpm", pressure="350 bar", **LUMPED)
    assert of_description.flow_delivery == point.flow_delivery


def test_a_saved_run_is_the_commands_and_opens_again(point, tmp_path):
    command = ["run", "ref90", "--speed", "2100rpm", "--pressure", "350bar", "--fidelity", "lumped"]
    assert main([*command, "-o", str(tmp_path / "by_command")]) == 0
    saved = point.save(tmp_path / "saved")
    assert files(saved) == files(tmp_path / "by_command")
    of_command, ours = (
        json.loads((tmp_path / of / "summary.json").read_text("utf-8")) for of in ("by_command", "saved")
    )
    assert of_command == ours
    again = sf.open(saved)
    assert type(again) is type(point)
    assert again.flow_delivery == point.flow_delivery
    assert repr(again) == repr(point)
    assert again.to_xarray().equals(point.to_xarray())
    assert files(again.save(tmp_path / "copy")) == files(saved)
    with pytest.raises(sf.InputFaults, match="nothing is overwritten"):
        point.save(saved)


def test_another_value_of_a_key(point):
    wide = sf.run("ref90", speed="2100 rpm", pressure="350 bar", set={"valve_plate.film_thickness": "12 um"}, **LUMPED)
    assert wide.films.valve_plate.leakage_flow > 2.0 * point.films.valve_plate.leakage_flow


def test_plots_return_axes(point):
    import matplotlib as mpl

    mpl.use("Agg")
    for axes in (point.plot_losses(), point.plot_chamber(), point.plot_flows(), point.plot_ripple()):
        assert axes
        assert any(one.get_xlabel() for one in axes)


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: sf.run("ref9", fidelity="lumpd"), ["pump", "try:      ref90", "fidelity", "lumped"]),
        (lambda: sf.run(pressure=350, **LUMPED), ["swashfilm.run()", "0.35 kPa", "inlet_pressure"]),
        (lambda: sf.run(sped="3 rpm"), ["sped", "unknown argument", "try:      speed"]),
        (lambda: sf.run(set={"slipper.orifice": "1 mm"}), ["slipper.orifice", "unknown key"]),
        (lambda: sf.run(speed="2100 bar"), ["speed", "a rotational speed"]),
        (lambda: sf.film("nowhere.toml"), ["nowhere.toml", "no such file"]),
        (lambda: sf.film(PAD.replace("30 mPa s", "30 mm")), ["film.viscosity", "a dynamic viscosity"]),
        (lambda: sf.study(PAD), ["swashfilm.film()"]),
        (lambda: sf.map("ref90", pressures="5..35", **LUMPED), ["pressures"]),
        (lambda: sf.open("nowhere"), ["the folder of a finished run"]),
        (lambda: sf.duty("nowhere", "cycle.csv"), ["nowhere"]),
        (lambda: sf.export("nowhere", "matlap"), ["to", "try:      matlab", "nowhere"]),
        (lambda: sf.transient("nowhere.toml"), ["no such file"]),
        (lambda: sf.reference("nowhere.toml"), ["no such file"]),
        (lambda: sf.reproduce("fig99"), ["fig99"]),
        (lambda: sf.table("ref90", source="fixd"), ["source", "fixed"]),
        (lambda: sf.compare("ref90", "ref9"), ["ref9"]),
        (lambda: sf.compare("ref90", "ref90", set={"oil.grad": "ISO VG 32"}), ["oil.grad", "grade"]),
        (lambda: sf.compare("ref90", "ref90", sett={}), ["sett", "set"]),
    ],
)
def test_mistakes_raise_one_exception_with_every_fault(call, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(sf.InputFaults) as raised:
        call()
    for part in told:
        assert part in str(raised.value)
    assert "--" not in str(raised.value)


def test_a_film_from_text_tables_or_file(tmp_path):
    import tomllib

    path = tmp_path / "pad.toml"
    path.write_text(PAD, "utf-8")
    by_text, by_tables, by_file = sf.film(PAD), sf.film(tomllib.loads(PAD)), sf.film(path, refine=3)
    assert by_text.load == by_tables.load == by_file.load
    assert [title for title, _ in by_file.tables()] == ["Film pad", "On finer meshes"]
    assert by_text.plot_fields()
    assert len(by_text.to_pandas()) == 45
    assert sf.open(by_text.save(tmp_path / "run")).load == by_text.load


def test_a_study_over_a_key(tmp_path):
    found = sf.study(PAD + '[study]\n"film.viscosity" = ["20 mPa s", "40 mPa s"]\n')
    assert found.solved == 2
    load = found.to_xarray().load_N.values
    assert load[1] == pytest.approx(2.0 * load[0], rel=1e-9)
    assert len(found.to_pandas()) == 2
    assert found.plot_number("load_N")
    with pytest.raises(sf.InputFaults, match="load_N"):
        found.plot_number("load")
    assert sf.open(found.save(tmp_path / "run")).solved == 2


def test_maps_duty_and_comparison(tmp_path):
    levels = {"pressures": ["10 MPa", 20e6, "30 MPa"], "displacements": [0.5, 1.0], "check": 4}
    found = sf.map("ref90", speeds="2100rpm", **levels, **LUMPED)
    assert found.solved == 6
    assert len(found.to_pandas()) == 6
    assert found.plot_efficiency(definition="iso_4409")
    assert found.plot_losses()
    assert found.plot_shares()
    with pytest.raises(sf.InputFaults, match="iso_4409"):
        found.plot_efficiency(definition="iso")
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],speed [rpm],pressure [bar],displacement ratio [1]\n0,2100,100,1\n9,2100,300,1\n")
    duty = sf.duty(found, cycle)
    assert duty.duration == 9.0
    assert duty.plot_course()
    assert duty.plot_losses()
    assert "loss [W]" in duty.to_pandas().columns
    both = sf.compare(found, found.save(tmp_path / "map"), cycle)
    assert not any(row["told"] for row in both.summary["differences"])
    assert [title for title, _ in both.tables()][-1] == "Over the cycle"
    (exported,) = sf.export(found, "csv", tmp_path / "map.csv")
    assert len(exported.read_text("utf-8").splitlines()) == 7
