"""`swashfilm run --fidelity floating`: the folder it leaves. Two rounds of coarse films, roughly closed."""

import json

import numpy as np
import pytest
import pyvista
import xarray

from gaps import Accuracy
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.film.revolution.plots import film_plot
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
        "fields", "pump.pvd", "pump",
    }  # fmt: skip
    assert names >= {f"{gap}{end}" for gap in GAPS for end in (".csv", "_convergence.csv", ".pvd")}


def test_summary_tells_of_gaps_rounds_and_what_was_taken(folder):
    found = summary(folder)
    assert found["fidelity"] == "floating"
    assert set(found["gaps"]) == set(GAPS)
    for gap in found["gaps"].values():
        assert 0.0 < gap["film_thickness_min_m"] < gap["film_thickness_mean_m"] < 1e-4
        assert gap["turns"] >= 1
    assert found["checks"]["coupling_rounds"] == 2  # one on the way, and one that settles
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
    parts = whole.read()[0]
    assert parts.field_data["shaft_angle [deg]"] == pytest.approx(80.0)
    of_chambers = [f"{gap} {k}{film}" for gap in ("piston", "slipper") for k in range(1, 10) for film in ("", " film")]
    others = ["shaft", "swash plate", "valve plate", "block", "block film", "oil in the chambers"]
    assert sorted(parts.keys()) == sorted(of_chambers + others)
    for chamber in range(1, 10):
        at = np.radians(80.0 + 40.0 * (chamber - 1))
        away = np.array([np.cos(at), np.sin(at)])
        for part in ("piston", "piston film", "slipper", "slipper film"):
            gap, _, film = part.partition(" ")
            middle = parts[f"{gap} {chamber} {film}".strip()].points[:, :2].mean(axis=0)
            assert middle @ away > np.cos(np.radians(6.0)) * np.linalg.norm(middle)


def test_blocks_of_films_have_fields_with_units_and_lie_on_the_bore(folder):
    parts = pyvista.read(folder / "pump" / "pump_002.vtm")
    heads = {"film_pressure [Pa]", "film_thickness [m]", "film_fraction [1]"}
    for name in ("piston 4 film", "slipper 4 film", "block film"):
        assert heads <= set(parts[name].point_data)
        assert {"wall_shear [Pa]", "film_thickness_cell [m]"} <= set(parts[name].cell_data)
        assert 0.0 < parts[name]["film_fraction [1]"].min() <= parts[name]["film_fraction [1]"].max() == 1.0
    turned, cone = np.radians(60.0 + 3 * 40.0), np.radians(5.0)
    axis = np.array([np.sin(cone) * np.cos(turned), np.sin(cone) * np.sin(turned), np.cos(cone)])
    solid, film = parts["piston 4"].points, parts["piston 4 film"].points
    end = solid[np.argsort(solid @ axis)[:96]].mean(axis=0)  # of rim and middle of the piston's chamber end
    radius = np.linalg.norm(np.cross(film - end, axis), axis=1)
    assert radius == pytest.approx(11e-3, rel=1e-5)
    assert parts["block film"].points[:, 2] == pytest.approx(0.0)


def test_oil_of_the_chambers_has_their_numbers_and_pressures(folder):
    oil = pyvista.read(folder / "pump" / "pump_002.vtm")["oil in the chambers"]
    with xarray.open_dataset(folder / "results.nc", group="piston", engine="h5netcdf") as data:
        angles, pressure = np.degrees(data["shaft_angle"].values), data["chamber_pressure"].values
    for chamber in range(1, 10):
        own = oil["chamber_pressure [Pa]"][oil["chamber"] == chamber]
        at = (60.0 + 40.0 * (chamber - 1) - 1e-6) % 360.0
        assert own == pytest.approx(pressure[np.argmin(np.abs(angles - at))], rel=1e-9)


def test_the_least_film_of_a_gap_is_marked_with_angle_and_place(folder):
    for gap in GAPS:
        with xarray.open_dataset(folder / "results.nc", group=gap, engine="h5netcdf") as data:
            axes = film_plot(data.load()).axes[0]
            film = data["film_thickness_min"].values * 1e6
            k = int(np.argmin(film))
            angle = np.degrees(data["shaft_angle"].values[k])
            around = np.degrees(data["least_film_around"].values)
        marker = next(line for line in axes.lines if line.get_marker() == "v")
        assert (marker.get_xdata()[0], marker.get_ydata()[0]) == pytest.approx((angle, film[k]))
        assert f"at {angle:.0f} deg of the shaft; {around[k]:.0f} deg around" in axes.get_title(loc="left")
        assert ((around >= 0.0) & (around <= 360.0)).all()


def test_the_place_of_the_least_film_is_that_of_the_kept_fields(folder):
    with xarray.open_dataset(folder / "results.nc", group="slipper", engine="h5netcdf") as data:
        for film_angle in data["film_angle"].values:
            here = data.sel(film_angle=film_angle)
            at = int(np.argmin(here["film_thickness"].values))
            now = data.sel(shaft_angle=film_angle, method="nearest")
            x, y = here["x"].values[at], here["y"].values[at]
            assert now["least_film_radius"].item() == pytest.approx(np.hypot(x, y))
            assert now["least_film_around"].item() == pytest.approx(np.arctan2(y, x) % (2.0 * np.pi))


def test_the_page_shows_the_gaps_and_can_be_made_anew(folder):
    page = (folder / "report.html").read_text("utf-8")
    assert "floating fidelity" in page
    assert page.count("data:image/") >= 16
    drawn = [name for name in ("pump.png", "pump.webp") if (folder / name).is_file()]
    assert len(drawn) == page.count("coloured by film pressure</figcaption>")  # 2, or 0 without graphics libraries
    assert bool(drawn) != any("no_3d_picture" in one for one in map(str, summary(folder)["warnings"]))
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
    blocks = (tmp_path / "pump" / "pump_000.vtm").read_text("utf-8")
    for block, file in (("piston 3 film", "fields"), ("piston 3", "pump")):
        assert f'name="{block}" file="../chamber_3/{file}/piston' in blocks
    assert "piston-cylinder, chamber 3" in (tmp_path / "report.html").read_text("utf-8")
