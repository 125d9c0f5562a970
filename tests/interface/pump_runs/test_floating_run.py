"""`swashfilm run --fidelity floating`: the folder it leaves. One round of coarse films, roughly closed."""

import json

import numpy as np
import pytest
import pyvista
import xarray

from gaps import Accuracy
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.pump.page import write_pump_page
from swashfilm.runs.pump.run import PumpCase, solve_pump
from system import RIGID, FloatingOptions, load_pump

pytestmark = pytest.mark.slow

GAPS = ("piston", "slipper", "valve_plate")
ROUGHLY = FloatingOptions(
    RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.5, reach=1.0), keep=2
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("system.points.floating.PRESSURE_TOLERANCE", 1.0)
        patch.setattr("system.points.floating.FRICTION_TOLERANCE", 1.0)
        patch.setattr("system.points.floating.SPIN_TOLERANCE", 1.0)
        place = tmp_path_factory.mktemp("floating")
        pump = load_pump("ref90", {"operating.pressure": "5 MPa", "operating.speed": "1000 rpm"})
        solve_pump(PumpCase(pump, "", Fidelity.FLOATING, options=ROUGHLY)).write(place)
    return place


def summary(folder):
    return json.loads((folder / "summary.json").read_text("utf-8"))


def test_the_folder_holds_what_the_files_page_says(folder):
    names = {path.name for path in folder.iterdir()}
    assert names >= {
        "input.toml", "resolved.toml", "summary.json", "results.nc", "revolution.csv", "pairs.csv", "forces.csv",
        "report.html",
        "fields", "pump.pvd",
    }  # fmt: skip
    assert names >= {f"{gap}{end}" for gap in GAPS for end in (".csv", "_convergence.csv", ".pvd")}


def test_summary_tells_of_gaps_rounds_and_what_was_taken(folder):
    found = summary(folder)
    assert found["fidelity"] == "floating"
    assert set(found["gaps"]) == set(GAPS)
    for gap in found["gaps"].values():
        assert 0.0 < gap["film_thickness_min_m"] < gap["film_thickness_mean_m"] < 1e-4
        assert gap["turns"] >= 1
    assert found["checks"]["coupling_rounds"] == 1
    assert set(found["spin_ratio"]) == {"piston", "slipper"}
    assert found["cost"]["solve_seconds"] == pytest.approx(sum(found["cost"]["rounds_seconds"]))
    assert {"elastic_walls", "pressure_viscosity", "heat"} == set(found["physics_left_out"])
    assert list(found["cost"]["physics_seconds"]) == ["rigid"]
    assert any(taken.startswith("piston.guide_length") for taken in found["assumptions"])


def test_results_have_a_group_for_each_gap(folder):
    with xarray.open_dataset(folder / "results.nc", engine="h5netcdf") as data:
        assert data["chamber_pressure"].attrs["units"] == "Pa"
    for gap in GAPS:
        with xarray.open_dataset(folder / "results.nc", group=gap, engine="h5netcdf") as data:
            assert data.attrs["gap"] == gap
            assert data.sizes["shaft_angle"] == (4 if gap == "valve_plate" else 36)


def test_the_series_of_the_whole_pump_stands_in_its_place(folder):
    whole = pyvista.get_reader(str(folder / "pump.pvd"))
    assert len(whole.time_values) == 18
    whole.set_active_time_value(whole.time_values[3])
    parts = whole.read()
    assert len(parts) == 19  # the ring, nine pistons, nine slippers
    middles = np.array([part.points.mean(axis=0) for part in parts])
    around = np.sort(np.degrees(np.arctan2(middles[1:10, 1], middles[1:10, 0])) % 360.0)
    assert np.diff(around) == pytest.approx(np.full(8, 40.0), abs=3.0)


def test_the_page_shows_the_gaps_and_can_be_made_anew(folder):
    page = (folder / "report.html").read_text("utf-8")
    assert "floating fidelity" in page
    assert page.count("data:image/png") >= 16
    for word in ("Assumed values", "Convergence to a periodic turn", "largest contact load"):
        assert word in page
    assert write_pump_page(folder).read_text("utf-8") == page


@pytest.mark.long
def test_a_worn_piston_stands_beside_the_others(tmp_path, monkeypatch):
    monkeypatch.setattr("system.points.floating.PRESSURE_TOLERANCE", 1.0)
    monkeypatch.setattr("system.points.floating.FRICTION_TOLERANCE", 1.0)
    stated = {"operating.pressure": "5 MPa", "piston.3.radial_clearance": "22 um"}
    worn_pump = load_pump("ref90", stated)
    solve_pump(PumpCase(worn_pump, "", Fidelity.FLOATING, options=ROUGHLY)).write(tmp_path)
    found = summary(tmp_path)
    assert found["unlike"]["chamber_3"]["chambers"] == [3]
    worn, other = found["unlike"]["chamber_3"]["gaps"]["piston"], found["gaps"]["piston"]
    assert worn["leakage_flow_m3_per_s"] > 2.0 * other["leakage_flow_m3_per_s"]
    assert {path.name for path in (tmp_path / "chamber_3").iterdir()} >= {"piston.csv", "slipper.pvd", "fields"}
    with xarray.open_dataset(tmp_path / "results.nc", group="chamber_3/piston", engine="h5netcdf") as data:
        assert data.attrs["clearance_m"] == pytest.approx(22e-6)
    with xarray.open_dataset(tmp_path / "results.nc", group="valve_plate", engine="h5netcdf") as data:
        assert data.sizes["shaft_angle"] == 36
    assert "chamber_3/fields/piston" in (tmp_path / "pump.pvd").read_text("utf-8")
    assert "piston-cylinder, chamber 3" in (tmp_path / "report.html").read_text("utf-8")
