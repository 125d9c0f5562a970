"""`swashfilm sensitivity` and `tolerance`: what they write, print and refuse."""

import csv
import json
from types import SimpleNamespace

import numpy as np
import pytest
from stand_in_films import ThinningFilms

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.runs.variation import case
from swashfilm.runs.variation.limits import limit_of
from swashfilm.runs.variation.sensitivity.rows import cost_rows
from swashfilm.runs.variation.tolerance.summary import table_warnings, warnings_of
from system import load_pump, operating_point
from system.maps.point import LumpedSolver, TableSolver
from system.points.table import sources
from system.pump_file.tables import BUILT_IN
from system.variation.measures import MEASURES, Needs, measures_of
from system.variation.scatter import Bound

KEYS = "slipper.film_thickness,ports.groove_start,oil.bulk_modulus,bearings.front_share,friction.*"
FIT = """
[[tolerance.fit]]
key = "piston.radial_clearance"
shape = "uniform"
hole_least = "22.01 mm"
hole_most = "22.05 mm"
shaft_least = "22.00 mm"
shaft_most = "22.02 mm"
"""


@pytest.fixture(scope="module")
def costs(tmp_path_factory):
    """Run folder of a sensitivity of some dimensions."""
    place = tmp_path_factory.mktemp("sensitivity") / "run"
    assert main(["sensitivity", "ref90", "--keys", KEYS, "-o", str(place)]) == 0
    return place


@pytest.fixture(scope="module")
def series(tmp_path_factory):
    """Run folder of a series whose piston clearance may cross zero, with its pump file."""
    place = tmp_path_factory.mktemp("tolerance")
    text = (sf.run("ref90", fidelity="lumped").save(place / "pump") / "input.toml").read_text("utf-8")
    (place / "pump.toml").write_text(text.replace("[operating]", FIT + "\n[operating]"))
    words = ["--pumps", "300", "--keys", "piston.radial_clearance,slipper.*", "--pressures", "10,30MPa"]
    limits = ["--limit", "efficiency >= 80 %", "--limit", "case drain <= 0.5 L/min"]
    assert main(["tolerance", str(place / "pump.toml"), *words, *limits, "-o", str(place / "run")]) == 0
    return place / "run"


def test_dimensions_set_on_the_command_line(tmp_path):
    words = ["--set", "valve_plate.film_thickness=6um", "--keys", "valve_plate.film_thickness"]
    assert main(["sensitivity", *words, "-o", str(tmp_path / "run")]) == 0
    (row,) = json.loads((tmp_path / "run" / "summary.json").read_text())["dimensions"]
    assert row["value"] == pytest.approx(6e-6)
    assert "command line: valve_plate.film_thickness = 6um" in (tmp_path / "run" / "input.toml").read_text()


def test_files_of_a_sensitivity(costs):
    summary = json.loads((costs / "summary.json").read_text())
    assert summary["kind"] == "sensitivity"
    rows = {row["key"]: row for row in summary["dimensions"]}
    assert rows["slipper.film_thickness"]["change_text"] == "1 um"
    assert rows["ports.groove_start"]["change"] == pytest.approx(np.radians(1.0))
    assert rows["slipper.film_thickness"]["sigma"] == pytest.approx(0.8e-6)
    (refused,) = summary["refused"]
    assert refused["key"] == "bearings.front_share"
    below, above = refused["reason"].removeprefix("the geometry refuses both sides: ").split("; ")
    assert below.startswith("at 0.6138 bearings.rear_share: 0.38: front_share + rear_share = 0.9938")
    assert above.startswith("at 0.6262 bearings.rear_share: 0.38: front_share + rear_share = 1.0062")
    assert rows["slipper.film_thickness"]["percent"] == pytest.approx(1e-7)
    assert rows["ports.groove_start"]["percent"] is None
    (shown,) = (row for row in cost_rows(summary) if row[0] == "ports.groove_start")
    assert shown[1:3] == ("0 deg", "+1 deg")
    assert shown[5:] == ("", "", "", "")
    rows["ports.groove_start"]["measures"]["efficiency.overall"] |= {"verdict": "no effect", "derivative": 0.0}
    (shown,) = (row for row in cost_rows(summary) if row[0] == "ports.groove_start")
    assert shown[4] == "about 0"  # the solver tells no smaller change apart
    page = (costs / "report.html").read_text()
    assert "dearest by +1 um" in page
    assert "Dimensions without a derivative" in page
    assert (costs / "sensitivity.csv").read_text().startswith("key,unit,value,change,side,sigma,loss [W]")


def test_sensitivity_prints_the_dearest_first(costs, capsys):
    result = sf.open(costs)
    table = dict(result.tables())["Cost of each dimension, the dearest first"]
    assert table[1][0] == "slipper.film_thickness"
    assert table[1][3].startswith("-1")  # W for one more micrometre
    data = result.to_xarray()
    assert data["derivative"].sel(key="slipper.film_thickness", measure="loss") < 0.0
    assert result.to_pandas().loc["oil.bulk_modulus", "loss"] < 0.0
    assert result.plot_costs()
    assert result.plot_tolerances()
    assert main(["report", str(costs)]) == 0
    capsys.readouterr()


def test_sensitivity_is_resumed(costs, tmp_path, capsys):
    place = tmp_path / "again"
    assert main(["sensitivity", "--keys", KEYS, "--resume", str(costs), "-o", str(place)]) == 0
    assert "points kept" in capsys.readouterr().err
    one, other = (json.loads((folder / "summary.json").read_text()) for folder in (costs, place))
    assert one["dimensions"] == other["dimensions"]


def test_sensitivity_over_a_cycle(tmp_path):
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],pressure [bar]\n0,100\n10,300\n")
    found = sf.sensitivity("ref90", keys=["slipper.film_thickness"], cycle=cycle)
    assert found.points == 5
    assert sum(found.summary["weights"]) == pytest.approx(1.0)
    assert "duty cycle of 10 s, means; numbers of the worst point over all 5 points" in found.summary["at"]


def test_a_sensitivity_of_refused_dimensions_alone(tmp_path):
    """Every file is written without a single derivative, and the answer says so."""
    found = sf.sensitivity("ref90", keys=["bearings.front_share"])
    assert found.to_xarray()["derivative"].shape == (0, len(found.summary["measures"]))
    page = (found.save(tmp_path / "run") / "report.html").read_text().replace("\u00a0", " ")
    assert "Of 1 dimensions 0 change the loss. 1 of them has no derivative." in page


def test_points_beyond_the_rating_are_told():
    beyond = {"speeds": "2600rpm", "pressures": "420bar"}
    one = sf.sensitivity("ref90", keys=["oil.density"], **beyond)
    other = sf.tolerance("ref90", pumps=100, keys="slipper.film_thickness", **beyond)
    for found in (one, other):
        named = [warning.partition(":")[0] for warning in found.warnings]
        assert {"operating.pressure", "operating.speed"} <= set(named)


def test_values_that_a_pump_file_leaves_out_are_told_in_the_run(tmp_path):
    scant = tmp_path / "scant.toml"
    scant.write_text('[pump]\ndisplacement = "60 cm3/rev"\npistons = 9\n[oil]\ngrade = "ISO VG 46"\n')
    found = sf.map(scant, fidelity="lumped", speeds="1000,1500rpm", pressures="10,20MPa", displacements="1")
    assert any(one.startswith("pump.piston_diameter") for one in found.summary["assumptions"])
    for own in (found, sf.sensitivity(scant, keys=["oil.density"])):
        (warning,) = (one for one in own.warnings if one.startswith("values_scaled"))
        assert "values of the pump are not stated" in warning


def test_an_internal_error_at_a_pump_ends_a_sensitivity_with_1(tmp_path, monkeypatch):
    solve, stated = LumpedSolver.solve, load_pump("ref90").oil.density

    def broken(self, pump, point):
        if pump.oil.density > stated:
            raise RuntimeError("a fault of the program")
        return solve(self, pump, point)

    monkeypatch.setattr(LumpedSolver, "solve", broken)
    assert main(["sensitivity", "--keys", "oil.density", "--workers", "1", "-o", str(tmp_path / "run")]) == 1
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["internal_error"]


def test_files_of_a_tolerance(series):
    summary = json.loads((series / "summary.json").read_text())
    pumps = summary["pumps"]
    assert sum(pumps["refused"].values()) == pumps["drawn"] - pumps["solved"] > 5
    assert any("refused by the geometry" in one for one in summary["warnings"])
    assert [one["limit"] for one in summary["limits"]] == ["efficiency >= 80 %", "case drain <= 0.5 L/min"]
    shares = summary["measures"]["drain_flow"]["shares"]
    assert sum(one["first"]["value"] for one in shares) == pytest.approx(1.0, abs=0.05)
    assert len(summary["at_points"]) == 2
    page = (series / "report.html").read_text().replace("\u00a0", " ")
    for words in ("Scatter at each operating point", "hole 22.01 mm to 22.05 mm", "a third tighter", "of 100"):
        assert words in page
    rows = list(csv.DictReader((series / "pumps.csv").open()))
    assert len(rows) == pumps["solved"]
    clearances = [float(row["piston.radial_clearance [um]"]) for row in rows]
    assert 0.0 < min(clearances) < max(clearances) == pytest.approx(25.0, abs=2.0)
    assert all(float(row["efficiency.overall [1]"]) < 1.0 for row in rows)
    assert not [head for head in rows[0] if "[SI]" in head]
    found = {row["measure"]: row["unit"] for row in csv.DictReader((series / "shares.csv").open())}
    assert found["drain_flow"] == "L/min"
    assert main(["report", str(series)]) == 0


def test_result_of_a_tolerance(series):
    found = sf.open(series)
    assert found.to_xarray()["dimension"].shape == (found.pumps["solved"], 2)
    assert "drain_flow" in found.to_pandas().columns
    assert found.plot_scatter()
    assert found.plot_shares()
    assert [title for title, _ in found.tables()][-1] == "Limits"


def test_both_as_functions(tmp_path):
    found = sf.tolerance("ref90", pumps=100, keys="slipper.film_thickness", limit="loss <= 20 kW")
    assert found.limits[0]["missing"]["value"] == 0.0
    assert (found.save(tmp_path / "run") / "report.html").is_file()
    with pytest.raises(sf.InputFaults, match="no dimension"):
        sf.sensitivity("ref90", keys="oil.densty")


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["sensitivity", "--keys", "piston.clearance"], ["--keys", "piston.radial_clearance"]),
        (["sensitivity", "--keys", "pump.displacement"], ["it follows from the geometry"]),
        (["sensitivity", "--fidelity", "floating"], ["--keys", "hours"]),
        (["sensitivity", "--fidelity", "lumpd", "--plan", "papr"], ["lumped", "paper"]),
        (["sensitivity", "--table", "t.json"], ["--table", "--fidelity table"]),
        (["sensitivity", "--resume", "nowhere"], ["--resume", "which holds no points"]),
        (["sensitivity", "--workers", "0"], ["--workers"]),
        (["sensitivity", "--steps", "36"], ["--steps", "--fidelity lumped"]),
        (["sensitivity", "--cycle", "nowhere.csv"], ["nowhere.csv"]),
        (["sensitivity", "nowhere.toml"], ["nowhere.toml"]),
        (["sensitivity", "--set", "oil.densty=900kg/m3"], ["oil.densty", "try:      density"]),
        (["tolerance", "--keys", "oil.density"], ["without a tolerance"]),
        (["tolerance", "--keys", "oil.densty"], ["oil.density"]),
        (["tolerance", "--pumps", "99"], ["--pumps", "100 to"]),
        (["tolerance", "--pumps", "150"], ["--pumps", "315 at least"]),
        (["tolerance", "--seed", "one"], ["--seed"]),
        (["tolerance", "--limit", "eficiency >= 88 %"], ["eficiency", "efficiency"]),
        (["tolerance", "--limit", "case drain <= 1.5 bar"], ["not a volume flow"]),
        (["tolerance", "--limit", "efficiency >= much"], ["a share"]),
        (["tolerance", "--limit", "efficiency >= nan %"], ["'nan %'", "a share"]),
        (["tolerance", "--limit", "88 %"], ["a quantity, >= or <="]),
        (["tolerance", "--limit", "efficiency >= 86"], ["'86', 8600 %", "try:      efficiency >= 86 %"]),
        (["tolerance", "--limit", "least film, slipper >= 1 um"], ["fidelity does not know", "--fidelity floating"]),
    ],
)
def test_faults(words, expected, capsys):
    assert main(words) == 2
    error = capsys.readouterr().err
    for word in expected:
        assert word in error


def test_all_faults_at_once(capsys):
    words = ["tolerance", "--limit", "hm", "--pumps", "7", "--keys", "oil.density", "--plan", "none"]
    assert main(words) == 2
    assert "4 faults" in capsys.readouterr().err


def test_a_pump_without_tolerances(tmp_path, capsys):
    text = (sf.run("ref90", fidelity="lumped").save(tmp_path / "pump") / "input.toml").read_text("utf-8")
    before, _, after = text.partition("[tolerance]")
    bare = before + "[operating]" + after.partition("[operating]")[2]
    (tmp_path / "bare.toml").write_text(bare)
    assert main(["tolerance", str(tmp_path / "bare.toml")]) == 2
    assert "no dimension that scatters" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "name", "bound", "value"),
    [
        ("efficiency >= 88 %", "efficiency.overall", Bound.LEAST, 0.88),
        ("volumetric efficiency >= 0.95", "efficiency.volumetric", Bound.LEAST, 0.95),
        ("case drain <= 1.5 L/min", "drain_flow", Bound.MOST, 2.5e-5),
        ("leakage.piston<=60 mL/min", "leakage.piston", Bound.MOST, 1e-6),
        ("Loss <= 2 kW", "loss", Bound.MOST, 2000.0),
        ("hottest oil, slipper <= 90 degC", "film_temperature.slipper", Bound.MOST, 363.15),
    ],
)
def test_limits_as_text(text, name, bound, value):
    faults = []
    found = limit_of(text, measures_of(Needs.FILMS), faults)
    assert not faults
    assert (found.measure.name, found.bound, found.value) == (name, bound, pytest.approx(value))


def stand_in_table(place, *words):
    """File of a response table of REF90 at full stroke and 2100 r/min over pressure, whose points a stand-in solves."""
    held = ["--speed", "2100rpm", "--displacement", "1", "--pressure", "15MPa..38MPa"]
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("SWASHFILM_CACHE", str(place / "cache"))
        patched.setattr(sources, "solver_of", lambda source, options: ThinningFilms())
        assert main(["table", "ref90", *held, *words, "-o", str(place / "run")]) == 0
    return place / "run" / "table.json"


@pytest.fixture(scope="module")
def film_table(tmp_path_factory):
    """Table over pressure and viscosity."""
    return stand_in_table(tmp_path_factory.mktemp("table"), "--points", "24", "--held-out", "6")


def test_sensitivity_by_a_response_table(film_table):
    """Dimensions beside the films, and the viscosity, which the table has as an axis."""
    of_table = {"fidelity": "table", "table": film_table}
    found = sf.sensitivity("ref90", keys="ports.groove_*,oil.kinematic_viscosity_40C", **of_table)
    rows = {row["key"]: row["measures"] for row in found.summary["dimensions"]}
    assert rows["oil.kinematic_viscosity_40C"]["film_least.slipper"]["derivative"] > 0.0  # thicker on thicker oil
    assert rows["ports.groove_start"]["loss"]["derivative"] < 0.0
    assert "slipper.film_thickness" in found.summary["held_by_fidelity"]
    with pytest.raises(sf.InputFaults, match="on which the films depend, but no axis of this response table"):
        sf.sensitivity("ref90", keys="slipper.film_thickness", **of_table)


def test_tolerance_by_a_response_table(film_table):
    of_table = {"fidelity": "table", "table": film_table, "pumps": 100}
    found = sf.tolerance("ref90", keys="oil.kinematic_viscosity_40C", limit="least film, slipper >= 1 um", **of_table)
    shares = found.summary["measures"]["film_least.slipper"]["shares"]
    assert shares[0]["total"]["value"] == pytest.approx(1.0, abs=0.02)
    with pytest.raises(sf.InputFaults, match=r"slipper.film_thickness.*no axis of these dimensions") as reason:
        sf.tolerance("ref90", **of_table | {"pumps": 400})
    assert "oil.kinematic_viscosity_40C" in reason.value.faults[0].nearest


def test_a_scatter_below_the_error_of_its_table_is_told():
    """Case drain of 2 +- 0.01 by a table that errs by 1 %; the torque scatters by more than its table errs."""
    found = SimpleNamespace(
        measures=(MEASURES["drain_flow"], MEASURES["shaft_torque"], MEASURES["loss"]),
        scatters=(SimpleNamespace(mean=2.0, deviation=0.01), SimpleNamespace(mean=300.0, deviation=1.0),
                  SimpleNamespace(mean=5.0, deviation=0.1)),
    )  # fmt: skip
    numbers = SimpleNamespace(largest=lambda: {"case_drain": 0.01, "shaft_torque": 0.001})
    (told,) = table_warnings(TableSolver(SimpleNamespace(numbers=numbers)), found)
    assert told.startswith("table_error: case drain scatters by")
    assert not list(table_warnings(LumpedSolver(), found))


WIDE = """
[[tolerance.dimension]]
key = "piston.radial_clearance"
shape = "uniform"
least = "6 um"
most = "18 um"
"""
GAP_KEYS = "piston.radial_clearance,slipper.film_thickness"


@pytest.fixture(scope="module")
def wide_table(tmp_path_factory):
    """Table over pressure and two dimensions, one of them over its tolerance."""
    vary = ["--vary", "piston.radial_clearance=8um..20um", "--vary", "slipper.film_thickness"]
    return stand_in_table(tmp_path_factory.mktemp("wide"), "--temperature", "50degC", *vary)


@pytest.mark.long
def test_tolerance_by_a_table_of_dimensions_is_that_of_the_films(wide_table, monkeypatch):
    """The series by the table, against the stand-in's films solved for every pump."""
    asked = {"keys": GAP_KEYS, "pumps": 100, "seed": 3}
    by_table = sf.tolerance("ref90", fidelity="table", table=wide_table, **asked).to_pandas()
    monkeypatch.setattr(case, "solver_of", lambda source, options: ThinningFilms())
    solved = sf.tolerance("ref90", fidelity="fixed", **asked).to_pandas()
    for column in ("drain_flow", "loss"):
        assert by_table[column].to_numpy() == pytest.approx(solved[column].to_numpy(), rel=5e-3)
        assert by_table[column].std() > 0.0


def test_sensitivity_by_a_table_of_dimensions(wide_table):
    """The slipper's leakage goes as the cube of its film."""
    found = sf.sensitivity("ref90", keys=GAP_KEYS, fidelity="table", table=wide_table).summary
    rows = {row["key"]: row["measures"] for row in found["dimensions"]}
    film = 10e-6
    slope = rows["slipper.film_thickness"]["leakage.slipper"]
    middle = found["measures"]["leakage.slipper"]["value"]
    assert slope["derivative"] * film == pytest.approx(3.0 * middle, rel=0.05)


def test_pumps_beyond_the_box_of_a_table_are_told_at_once(wide_table, tmp_path):
    wide = tmp_path / "wide.toml"
    wide.write_text((BUILT_IN / "ref90.toml").read_text("utf-8") + WIDE)
    with pytest.raises(sf.InputFaults, match=r"beyond the table's box, 8 um .. 20 um") as reason:
        sf.tolerance(wide, keys="piston.radial_clearance", fidelity="table", table=wide_table, pumps=200)
    assert reason.value.faults[0].nearest.endswith("vary piston.radial_clearance")


BY_TABLE = """
format = 1
[optimise]
pump = "ref90"
fidelity = "table"
table = "{table}"
method = "trust_region"
designs = 12
[vary]
"piston.radial_clearance" = "{bounds}"
[objectives]
loss = "least"
"""


def test_optimisation_by_a_table_of_dimensions(wide_table, tmp_path):
    """The clearance of the chosen design loses less than the pump as stated."""
    asked = tmp_path / "clearance.toml"
    asked.write_text(BY_TABLE.format(table=wide_table, bounds="8.5..19.5 um"))
    found = sf.optimise(asked).summary
    (clearance,) = found["dimensions"]
    assert 8.5e-6 <= clearance["chosen"] <= 19.5e-6
    assert clearance["chosen"] != pytest.approx(clearance["start"], rel=0.05)
    assert found["measures"]["loss"]["chosen"] < found["measures"]["loss"]["start"]
    asked.write_text(BY_TABLE.format(table=wide_table, bounds="5..18 um"))
    with pytest.raises(sf.InputFaults, match=r"in the box of the response table, 8 um .. 20 um"):
        sf.optimise(asked)


def test_a_table_of_dimensions_serves_the_pump_with_others_in_its_box(wide_table, tmp_path):
    """The same file takes the pump with another clearance, and refuses one beyond the box or of another dimension."""
    asked = {"fidelity": "table", "table": wide_table}
    for gap in (10, 17):
        stated = {"piston.radial_clearance": f"{gap} um"}
        by_table = sf.run("ref90", set=stated, **asked).summary["leakage"]["piston_m3_per_s"]
        pump = load_pump("ref90", stated)
        solved = ThinningFilms().solve(pump, operating_point(pump)).pump_point
        assert by_table == pytest.approx(solved.leakage_flow.piston, rel=5e-3)
    with pytest.raises(sf.InputFaults, match=r"piston.radial_clearance"):
        sf.run("ref90", set={"piston.radial_clearance": "25 um"}, **asked)
    with pytest.raises(sf.InputFaults, match="a table of this very pump"):
        sf.run("ref90", set={"slipper.orifice_diameter": "1 mm"}, **asked)


NORMAL_FILM = """
[[tolerance.dimension]]
key = "slipper.film_thickness"
shape = "normal"
sigma = "{sigma} %"
"""


@pytest.mark.parametrize(
    ("sigma", "words", "told"),
    [
        (100, [], ["pumps drawn are refused by the geometry", "by slipper.film_thickness, such as -", "10 % at most",
                   "try:      a narrower tolerance of slipper.film_thickness"]),
        (45, ["--pumps", "315"], ["--pumps", "at least for 13 dimensions", "try:      3"]),
    ],
)  # fmt: skip
def test_a_series_of_which_the_geometry_refuses_many_ends_early(sigma, words, told, tmp_path, capsys):
    """Before a pump is solved: what is left of it is no sample of the series, or too few for the shares."""
    wide = tmp_path / "wide.toml"
    wide.write_text((BUILT_IN / "ref90.toml").read_text("utf-8") + NORMAL_FILM.format(sigma=sigma))
    assert main(["tolerance", str(wide), *words, "-o", str(tmp_path / "run")]) == 2
    error = capsys.readouterr().err
    for word in told:
        assert word in error
    assert not list(tmp_path.glob("run*"))


def test_refused_pumps_are_one_warning():
    """With how many, the commonest keys, an example of each and its limit."""
    refused = {"slipper.film_thickness: -1 um, expected at least 0.01 um": 30, "a.b: 2, expected at most 1": 9,
               "c.d: 3, expected at most 2": 2, "e.f: 4, expected at most 3": 1}  # fmt: skip
    found = SimpleNamespace(
        pumps=500, refused=refused, failed={}, measures=(), scatters=(), surface=SimpleNamespace(held_out=())
    )
    (warning,) = warnings_of(found)
    assert warning.startswith("pumps_refused: 42 of 500 pumps are refused by the geometry")
    assert "30 by slipper.film_thickness, such as -1 um, expected at least 0.01 um, 9 by a.b" in warning
    assert "1 by others; narrow the tolerances" in warning


def test_shares_of_numbers_that_do_not_scatter_are_no_warning():
    """A number that is the same for all pumps, up to round-off, has no variance that a surface could miss."""
    rough, same = SimpleNamespace(words="loss"), SimpleNamespace(words="hottest oil")
    found = SimpleNamespace(
        refused={}, failed={}, measures=(rough, same), surface=SimpleNamespace(held_out=np.array([0.5, 0.0])),
        scatters=(SimpleNamespace(mean=1000.0, deviation=3.0), SimpleNamespace(mean=320.0, deviation=1e-13)),
    )  # fmt: skip
    (warning,) = warnings_of(found)
    assert warning.startswith("shares_uncertain: a quadratic surface explains less than 90 % of loss:")
