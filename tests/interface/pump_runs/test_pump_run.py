"""`swashfilm run`: the folder it leaves, in both fidelities."""

import json
import re
import shutil
from functools import partial

import numpy as np
import pandas
import pytest
import pyvista
import xarray

from swashfilm.__main__ import main
from swashfilm.runs.pump import run as pump_run
from system import films_point, load_pump, resolved_toml

TURN = 2.0 * np.pi


@pytest.fixture(scope="module")
def lumped(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lumped") / "run"
    assert main(["run", "ref90", "--fidelity", "lumped", "--pressure", "20 MPa", "-o", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def films(tmp_path_factory):
    folder = tmp_path_factory.mktemp("films") / "run"
    assert main(["run", "ref90", "--fidelity", "fixed", "--speed", "1500 rpm", "-o", str(folder)]) == 0
    return folder


def summary(folder):
    return json.loads((folder / "summary.json").read_text("utf-8"))


def test_lumped_folder_holds_what_the_contract_says(lumped):
    names = {path.name for path in lumped.iterdir()}
    assert names >= {
        "input.toml", "resolved.toml", "summary.json", "results.nc", "revolution.csv", "pairs.csv", "forces.csv",
        "report.html",
    }  # fmt: skip
    found = summary(lumped)
    assert found["kind"] == "pump"
    assert found["fidelity"] == "lumped"
    assert found["operating_point"]["delivery_pressure_Pa"] == pytest.approx(20e6)
    assert found["checks"]["mass_balance_error"] < 1e-6
    assert found["gaps"] == {}


def test_every_headline_number_carries_its_unit(lumped):
    units = re.compile(r"_(Pa|Pa_s|W|K|N|Nm|rad|m|m2|m3_per_s|m3_per_rev|rad_per_s)$")
    bare = re.compile(
        r"(^format$|ratio$|share$|error$|error_max$|overall|volumetric|hydromechanical|revolutions|steps|rounds"
        r"|fraction|angles|unknowns)"
    )

    def walk(values):
        for key, value in values.items():
            if isinstance(value, dict):
                walk(value)
            elif isinstance(value, (int, float)):
                assert units.search(key) or bare.search(key), key

    walk(summary(lumped))


def test_tables_carry_units_and_agree_with_the_summary(lumped):
    revolution = pandas.read_csv(lumped / "revolution.csv")
    assert "shaft_angle [deg]" in revolution.columns
    assert "chamber_pressure [MPa]" in revolution.columns
    assert len(revolution) == 360
    pairs = pandas.read_csv(lumped / "pairs.csv").set_index("pair")
    for name, loss in summary(lumped)["pair_loss"].items():
        assert pairs.loc[name, "total [W]"] == pytest.approx(loss["total_W"], rel=1e-5)
    assert pairs["share [%]"].sum() == pytest.approx(100.0, abs=0.01)


def test_a_delivery_line_ripples(lumped, tmp_path):
    """[delivery_line] in the pump file, its ripple in summary, table and page; a held pressure has none."""
    held = summary(lumped)["ripple"]
    assert held["delivery_pressure_peak_to_peak_Pa"] == 0.0
    assert held["delivery_orifice_area_m2"] is None
    assert held["shaft_torque_peak_to_peak_Nm"] > 0.0
    text = (lumped / "resolved.toml").read_text("utf-8")
    stated = tmp_path / "line.toml"
    stated.write_text(text + '\n[delivery_line]\nkind = "orifice"\nvolume = "1 L"\n', "utf-8")
    assert main(["run", str(stated), "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0
    found = summary(tmp_path / "run")
    assert found["operating_point"]["delivery_pressure_Pa"] == pytest.approx(20e6, rel=1e-5)
    ripple = found["ripple"]
    revolution = pandas.read_csv(tmp_path / "run" / "revolution.csv")
    swing = 1e6 * np.ptp(revolution["delivery_pressure [MPa]"])
    assert ripple["delivery_pressure_peak_to_peak_Pa"] == pytest.approx(swing, rel=1e-6)
    assert 0.0 < ripple["delivery_pressure_order_z_Pa"] < swing
    assert 1e-6 < ripple["delivery_orifice_area_m2"] < 1e-4
    assert np.mean(revolution["delivery_line_flow [L/min]"]) / 6e4 == pytest.approx(
        found["flow"]["delivery_m3_per_s"], rel=1e-3
    )
    assert np.mean(revolution["shaft_torque [N m]"]) == pytest.approx(found["torque"]["shaft_Nm"], rel=1e-3)
    assert found["checks"]["energy_balance_error"] < 1e-3
    assert "Ripple" in (tmp_path / "run" / "report.html").read_text("utf-8")


def test_a_stated_orifice_sets_the_pressure(lumped, tmp_path, capsys):
    stated = tmp_path / "line.toml"
    line = '\n[delivery_line]\nkind = "orifice"\nvolume = "1 L"\norifice_area = "16 mm2"\n'
    stated.write_text((lumped / "resolved.toml").read_text("utf-8") + line, "utf-8")
    assert main(["run", str(stated), "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0
    found = summary(tmp_path / "run")
    assert any(text.startswith("port_pressure_follows_line") for text in found["warnings"])
    flow, point = found["flow"]["delivery_m3_per_s"], found["operating_point"]
    expected = 0.5 * 860.0 * (flow / (0.7 * 16e-6)) ** 2 + point["inlet_pressure_Pa"]
    assert point["delivery_pressure_Pa"] == pytest.approx(expected, rel=1e-2)


def test_results_carry_units(lumped):
    with xarray.open_dataset(lumped / "results.nc", engine="h5netcdf") as data:
        assert all("units" in data[name].attrs for name in data.data_vars)


def test_report_is_one_self_contained_file(lumped):
    page = (lumped / "report.html").read_text("utf-8")
    assert set(re.findall(r'src="(.{5})', page)) == {"data:"}
    links = set(re.findall(r'href="([^"#][^"]*)', page))
    assert links == {path.name for path in lumped.iterdir()} - {"report.html"}
    for words in ("ISO 4391/4409", "Losses of the seven friction pairs", "Chamber pressure and port openings"):
        assert words in page
    assert "drive torque, difference from the shaft&#39;s, relative to its mean" in page


def test_report_is_made_anew_from_the_folder(lumped):
    before = (lumped / "report.html").read_text("utf-8")
    (lumped / "report.html").unlink()
    assert main(["report", str(lumped)]) == 0
    assert (lumped / "report.html").read_text("utf-8") == before


def test_a_folder_that_is_not_whole_is_bad_input(lumped, tmp_path, capsys):
    for name, text, told in (
        ("summary.json", '{"format": 1, "kind": "pump"}', "what a run of this version writes"),
        ("results.nc", "cut off", "the NetCDF file of a run"),
    ):
        broken = shutil.copytree(lumped, tmp_path / name)
        (broken / name).write_text(text, "utf-8")
        assert main(["report", str(broken)]) == 2
        assert told in capsys.readouterr().err


def test_a_pump_that_delivers_nothing_has_no_efficiency(tmp_path, capsys):
    """Hot, slow and nearly at zero stroke the gaps take more than the pistons move."""
    folder = tmp_path / "run"
    point = ["--speed", "100rpm", "--displacement", "0.05", "--temperature", "120degC"]
    assert main(["run", "ref90", "--fidelity", "lumped", *point, "-o", str(folder)]) == 0
    found = summary(folder)
    assert found["flow"]["delivery_m3_per_s"] < 0.0
    assert all(value is None for norm in found["efficiency"].values() for value in norm.values())
    (told,) = (warning for warning in found["warnings"] if warning.startswith("no_delivery"))
    widest = max(found["leakage"], key=found["leakage"].get).removesuffix("_m3_per_s")
    assert f"through the {widest.replace('_', ' ')} gap" in told
    assert f"{found['leakage'][f'{widest}_m3_per_s'] * 6e4:.3g} of " in told
    assert "overall efficiency          none" in capsys.readouterr().out


def test_a_small_stroke_that_presses_oil_back_is_no_leak(tmp_path):
    """At 1 % of the stroke the dead volume takes more oil back than the pistons move, and the gaps hardly leak."""
    folder = tmp_path / "run"
    assert main(["run", "ref90", "--fidelity", "lumped", "--displacement", "0.01", "-o", str(folder)]) == 0
    found = summary(folder)
    flow, leakage = found["flow"], sum(found["leakage"].values())
    assert flow["delivery_m3_per_s"] < 0.0 < leakage < flow["geometric_m3_per_s"]
    (told,) = (warning for warning in found["warnings"] if warning.startswith("no_delivery"))
    back = flow["geometric_m3_per_s"] - leakage - flow["delivery_m3_per_s"]
    assert f"the pistons move {flow['geometric_m3_per_s'] * 6e4:.3g} L/min" in told
    assert f"take {back * 6e4:.3g} L/min back from delivery to inlet" in told


@pytest.mark.parametrize(
    ("stated", "told"),
    [
        (["--speed", "499rpm"], True),
        (["--speed", "500rpm"], False),
        (["--speed", "20rpm", "--set", "physics.mixed_friction.piston=0.1",
          "--set", "physics.mixed_friction.hersey_scale=2e-8"], False),
    ],
)  # fmt: skip
def test_constant_coefficients_far_below_their_speeds_are_told(stated, told, tmp_path):
    folder = tmp_path / "run"
    assert main(["run", "ref90", "--fidelity", "lumped", *stated, "-o", str(folder)]) == 0
    assert any(one.startswith("friction_at_low_speed: ") for one in summary(folder)["warnings"]) is told


def test_resolved_pump_runs_to_the_same_numbers(lumped, tmp_path):
    again = tmp_path / "again"
    assert main(["run", str(lumped / "resolved.toml"), "--fidelity", "lumped", "-o", str(again)]) == 0
    assert summary(again)["torque"] == pytest.approx(summary(lumped)["torque"], rel=1e-9)


@pytest.mark.slow
def test_films_summary_says_where_each_position_comes_from(films):
    gaps = summary(films)["gaps"]
    assert set(gaps) == {"piston", "slipper", "valve_plate"}
    for report in gaps.values():
        assert report["mass_balance_error_max"] < 1e-9
        assert report["energy_balance_error_max"] < 1e-9
        assert "position given by the description" in report["statement"]


@pytest.mark.slow
def test_films_balances_close(films):
    checks = summary(films)["checks"]
    assert checks["mass_balance_error"] < 1e-6
    assert checks["work_balance_error"] < 1e-5
    assert checks["energy_balance_error"] < 1e-3


@pytest.mark.slow
def test_paraview_series_lie_in_their_true_place(films):
    whole = pyvista.get_reader(str(films / "pump.pvd"))
    assert len(whole.time_values) == 36
    assert whole.time_values[9] == pytest.approx(90.0)
    whole.set_active_time_value(90.0)
    names = whole.read()[0].keys()
    assert sum(name.endswith(" film") for name in names) == 19  # the ring, nine pistons, nine slippers
    piston = pyvista.read(films / "fields" / "piston_009.vtu")
    centred = piston.points - piston.points.mean(axis=0)
    axis = np.linalg.svd(centred, full_matrices=False)[2]
    cone = np.radians(5.0)
    # At 90 deg the bore lies in the y, z plane, leaning outward by the cone angle.
    direction = max(np.abs(row @ [0.0, np.sin(cone), np.cos(cone)]) for row in axis)
    assert direction == pytest.approx(1.0, abs=2e-3)
    ring = pyvista.read(films / "fields" / "valve_plate_000.vtu")
    assert np.ptp(ring.points[:, 2]) == 0.0
    rim = load_pump("ref90").valve_plate.land_radius_4  # the mesh is a polygon of the same area
    assert np.hypot(*ring.points[:, :2].T).max() == pytest.approx(rim, rel=1e-3)
    for name in ("film_pressure [Pa]", "film_thickness [m]", "film_fraction [1]"):
        assert name in piston.point_data
    assert "wall_shear [Pa]" in piston.cell_data


@pytest.mark.slow
def test_films_report_shows_the_gaps(films):
    page = (films / "report.html").read_text("utf-8")
    assert "slipper-swash plate at shaft angle 270 deg, given position" in page
    assert "The three gaps" in page
    assert page.count("data:image/") >= 7
    assert "Load not carried" in page


def test_forces_between_the_parts_are_told(lumped):
    """A table over the turn with units in its head, and a section of the page whose sums close."""
    forces = pandas.read_csv(lumped / "forces.csv")
    assert len(forces) == 360
    assert all(re.search(r" \[(N|N m|deg)\]$", name) for name in forces.columns)
    found = summary(lumped)["forces"]
    assert max(found["closure"].values()) < 1e-12
    assert forces["drive_torque_on_shaft [N m]"].mean() == pytest.approx(
        found["sizes"]["drive_torque_on_shaft"]["mean_Nm"], rel=1e-9
    )
    page = (lumped / "report.html").read_text("utf-8")
    assert "Forces between the parts" in page
    assert "bearings.front_position" in page


@pytest.fixture(scope="module")
def worn(tmp_path_factory):
    """On coarse meshes: what is asked here is which films stand where."""
    folder = tmp_path_factory.mktemp("worn") / "run"
    stated = ["--set", "piston.3.radial_clearance=22um"]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pump_run, "films_point", partial(films_point, finer=0.25))
        assert main(["run", "ref90", "--fidelity", "fixed", *stated, "-o", str(folder)]) == 0
    return folder


@pytest.mark.slow
def test_a_worn_piston_stands_beside_the_others(worn):
    found = summary(worn)
    assert found["unlike"]["chamber_3"]["chambers"] == [3]
    leaks = [of["gaps"]["piston"]["leakage_flow_mean_m3_per_s"] for of in (found["unlike"]["chamber_3"], found)]
    assert leaks[0] > 2.0 * leaks[1]
    names = {path.name for path in (worn / "chamber_3").iterdir()}
    assert names >= {"piston.csv", "slipper.csv", "piston.pvd", "slipper.pvd", "fields"}
    assert "valve_plate.csv" not in names
    assert len(pandas.read_csv(worn / "chamber_3" / "piston.csv")) == 36
    assert len(pandas.read_csv(worn / "valve_plate.csv")) == 36  # over the turn
    films = []
    for group in ("chamber_3", None):
        with xarray.open_dataset(worn / "results.nc", group=group, engine="h5netcdf") as data:
            films.append(data["piston_film_thickness_mean"].values)
    wider = 22e-6 - load_pump("ref90").piston.radial_clearance
    assert films[0] - films[1] == pytest.approx(np.full(36, wider), rel=0.02)
    blocks = (worn / "pump" / "pump_000.vtm").read_text("utf-8")
    for block, place in (("piston 3 film", "fields"), ("piston 3", "pump")):
        assert f'name="{block}" file="../chamber_3/{place}/piston' in blocks
    assert "piston-cylinder, chamber 3" in (worn / "report.html").read_text("utf-8")


@pytest.mark.parametrize(
    "words",
    [
        ["run", "worn.toml", "--fidelity", "table"],
        ["map", "worn.toml", "--fidelity", "fixed"],
        ["table", "worn.toml", "--source", "fixed"],
    ],
)
def test_what_needs_identical_chambers_names_the_part_and_the_remedy(words, tmp_path, capsys):
    pump = tmp_path / "worn.toml"
    pump.write_text(resolved_toml(load_pump("ref90", {"piston.3.radial_clearance": "22 um"})), "utf-8")
    assert main([str(pump) if word == "worn.toml" else word for word in words]) == 2
    told = capsys.readouterr().err
    assert "piston.3" in told
    assert "swashfilm run with --fidelity lumped, fixed or floating" in told
