"""`swashfilm optimise`: what it writes, prints and refuses."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from stand_in_films import ThinningFilms

import swashfilm as sf
from swashfilm.__main__ import main
from system.description.keys import pump_keys

ROOT = Path(__file__).parents[3]


class ThinFilms(ThinningFilms):
    """Films that need no start."""

    def row(self):
        return self


CASE = """
format = 1

[optimise]
pump = "{pump}"
designs = 8
generations = 4

[points]
pressures = "15,35MPa"

[vary]
"ports.groove_start" = "-8..2 deg"
"ports.kidney_end" = {{ range = "166..180 deg", with = ["ports.kidney_full_end"] }}

[objectives]
loss = "least"
delivery_flow_ripple = "least"

[constraints]
chamber_pressure_peak = "<= 50 MPa"
loss = "<= 1.05 start"
"""
BENCH = CASE.format(pump=ROOT / "examples" / "recordings" / "bench_pump.toml")


def written(folder, text=BENCH):
    """Return the path of a case."""
    path = folder / "timing.toml"
    path.write_text(text)
    return path


def changed(*pairs):
    """Return the case with other words."""
    text = BENCH
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Run folder of the case."""
    place = tmp_path_factory.mktemp("optimise")
    assert main(["optimise", str(written(place)), "--workers", "1", "-o", str(place / "run")]) == 0
    return place / "run"


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def test_files(run):
    summary = summary_of(run)
    counts = summary["counts"]
    assert counts["tried"] == 32
    assert counts["solved"] + counts["refused"] == 32
    assert counts["refused"] > 0  # both ports open at once
    assert 0 < counts["pareto"] <= counts["feasible"] < counts["solved"]
    rows = [line.split(",") for line in (run / "designs.csv").read_text().splitlines()]
    assert rows[0][4:6] == ["ports.groove_start [deg]", "ports.kidney_end [deg]"]
    assert rows[1][:6] == ["1", "1", "solved", "no", "-5", "170"]  # the start
    assert len(rows) == 33
    assert len((run / "pareto.csv").read_text().splitlines()) == counts["pareto"] + 1
    page = (run / "report.html").read_text().replace("\u00a0", " ")
    for words in (
        "Chosen design beside the start",
        "nearest to the ideal point",
        "NSGA-II",
        "Dimensions along the Pareto",
        "Differences with the error of both",
        "error of both there",
    ):
        assert words in page
    assert summary["at_points"][0]["point"] == "delivery pressure 15 MPa"


def test_constraints_are_met_by_the_chosen_design(run):
    summary = summary_of(run)
    peak, loss = summary["constraints"]
    assert peak["start"] > 50e6 > peak["chosen"]
    assert loss["value"] == pytest.approx(1.05 * summary["measures"]["loss"]["start"])
    assert peak["met"]
    assert loss["met"]


def test_chosen_pump_runs(run):
    """The pump file gives the numbers of the design; the tied angle keeps its distance."""
    summary = summary_of(run)
    own = pump_keys(sf.load_pump(run / "chosen.toml"))
    gap = own["ports.kidney_end"].value - own["ports.kidney_full_end"].value
    assert gap == pytest.approx(np.radians(30.0))
    power = [sf.run(run / "chosen.toml", pressure=pressure, fidelity="lumped").power_balance
             for pressure in ("15 MPa", "35 MPa")]  # fmt: skip
    losses = [one["shaft_W"] - one["hydraulic_W"] for one in power]
    assert np.mean(losses) == pytest.approx(summary["measures"]["loss"]["chosen"], rel=1e-9)


def test_result(run):
    found = sf.open(run)
    assert [title for title, _ in found.tables()][1:] == ["Dimensions", "Objectives and constraints", "Constraints"]
    designs, front = found.to_pandas(), found.pareto()
    assert len(designs) == 32
    assert np.all(np.diff(front["loss"]) > 0.0)
    assert np.all(np.diff(front["delivery_flow_ripple"]) < 0.0)
    assert found.plot_pareto()
    assert found.plot_growth()
    assert found.plot_dimensions()
    assert main(["report", str(run)]) == 0


def test_broken_off_and_resumed(run, tmp_path, capsys):
    """A run whose folder holds a part of the designs ends with the same ones; another choice is another pump."""
    begun = tmp_path / "run.partial"
    (begun / "points").mkdir(parents=True)
    for number, one in enumerate(sorted((run / "points").glob("*.json"))):
        if number % 3:
            (begun / "points" / one.name).write_text(one.read_text())
    words = [str(written(tmp_path)), "--workers", "1", "--resume", str(begun)]
    assert main(["optimise", *words, "-o", str(tmp_path / "again")]) == 0
    for one in (begun / "points").glob("*.json"):
        assert (tmp_path / "again" / "points" / one.name).read_text() == one.read_text()
    for name in ("designs.csv", "pareto.csv"):
        assert (tmp_path / "again" / name).read_text() == (run / name).read_text()
    assert main(["optimise", *words, "--choose", "1", "-o", str(tmp_path / "first")]) == 0
    by_loss = tmp_path / "by_loss"
    assert main(["optimise", *words, "--choose", "loss", "-o", str(by_loss)]) == 0
    first = summary_of(tmp_path / "first")
    assert first["chosen"]["row"] == summary_of(by_loss)["chosen"]["row"] == 1
    assert "row 1 of pareto.csv" in (tmp_path / "first" / "chosen.toml").read_text()
    assert main(["optimise", *words, "--choose", "999", "-o", str(tmp_path / "none")]) == 2
    assert "a row of pareto.csv, 1 to" in capsys.readouterr().err


def test_two_processes_try_the_same_designs(run, tmp_path):
    assert main(["optimise", str(written(tmp_path)), "--workers", "2", "-o", str(tmp_path / "run")]) == 0
    assert (tmp_path / "run" / "designs.csv").read_text() == (run / "designs.csv").read_text()


def test_values_that_a_scaled_pump_assumes_are_told(tmp_path, capsys):
    (tmp_path / "scant.toml").write_text(
        '[pump]\ndisplacement = "60 cm3/rev"\npistons = 9\n[oil]\ngrade = "ISO VG 46"\n'
    )
    case = written(tmp_path, CASE.format(pump="scant.toml").replace("generations = 4", "generations = 1"))
    main(["optimise", str(case), "--workers", "1", "-o", str(tmp_path / "run")])
    said = capsys.readouterr().out
    assert "scant.toml leaves" in said
    assert "values out, which are assumed" in said


def test_nothing_feasible(tmp_path, capsys):
    """The constraint in the way is named, and by how much the nearest design misses it."""
    beyond = '"15,35MPa"', '"15,35MPa"\nspeeds = "2200rpm"'
    case = written(
        tmp_path, changed(("<= 50 MPa", "<= 35.1 MPa"), ("-8..2 deg", "-8..-5 deg"), ("166..180", "166..171"), beyond)
    )
    place = tmp_path / "run"
    assert main(["optimise", str(case), "--workers", "1", "-o", str(place)]) == 3
    said = capsys.readouterr().out
    assert (
        "nothing_feasible: no design meets all constraints; highest chamber pressure <= 35.1 MPa is in the way" in said
    )
    assert "What is in the way" in said
    summary = summary_of(place)
    first = summary["obstacles"][0]
    assert (first["measure"], first["met"]) == ("chamber_pressure_peak", 0)
    assert first["violation"] == pytest.approx(first["nearest"] / 35.1e6 - 1.0)
    assert not (place / "chosen.toml").exists()
    assert "swashfilm run chosen.toml" not in said
    assert "operating.speed: at 2 of 2 points; at the first: 2200 rpm, limit rated_speed" in said
    assert "highest chamber pressure is missed by" in (place / "report.html").read_text()


def test_gradient_of_one_smooth_objective(tmp_path):
    """Narrower lands of a slipper: SLSQP, and the balance of the pocket holds the search back."""
    text = (ROOT / "examples" / "optimisations" / "slipper_land.toml").read_text()
    case = tomllib.loads(text.replace("../recordings", str(ROOT / "examples" / "recordings")))
    found = sf.optimise(case | {"points": {"pressures": "25MPa"}}, workers=1)
    assert found.method["name"] == "gradient"
    assert found.counts["tried"] < 150
    (limit,) = found.summary["constraints"]
    assert limit["holds"]
    loss = found.summary["measures"]["loss"]
    assert loss["chosen"] < 0.99 * loss["start"]
    assert not any(one.startswith("search_not_settled") for one in found.warnings)
    short = sf.optimise(case | {"points": {"pressures": "25MPa"}, "optimise": case["optimise"] | {"generations": 1}},
                        workers=1)  # fmt: skip
    (warning,) = (one for one in short.warnings if one.startswith("search_not_settled"))
    assert "used up its 1 generations" in warning
    assert "raise [optimise] generations to 2" in warning


def test_films_under_constraints(tmp_path, monkeypatch):
    """A fidelity with films: the least film is a constraint, and the search goes to it."""
    monkeypatch.setattr("swashfilm.runs.variation.case.solver_of", lambda source, options: ThinFilms())
    case = {
        "format": 1,
        "optimise": {"pump": "ref90", "fidelity": "fixed", "method": "evolution", "designs": 12, "generations": 6},
        "vary": {"valve_plate.film_thickness": "4..20 um"},
        "objectives": {"drain_flow": "least"},
        "constraints": {"film_least.valve_plate": ">= 3 um", "load_carried.slipper": ">= 90 %"},
    }
    found = sf.optimise(case, workers=1)
    film = found.summary["constraints"][0]
    assert film["chosen"] == pytest.approx(3e-6, rel=0.05)
    assert film["chosen"] >= 3e-6 * (1.0 - 1e-6)
    assert found.counts["pareto"] == 1
    assert found.method["why"] == "as the case states"


def test_floating_needs_its_numbers(tmp_path, capsys):
    case = changed(("designs = 8\ngenerations = 4", 'fidelity = "floating"'))
    assert main(["optimise", str(written(tmp_path, case))]) == 2
    said = capsys.readouterr().err
    assert "optimise.designs" in said
    assert "optimise.generations" in said
    assert "would take days" in said


def test_time_is_told_beforehand(tmp_path, monkeypatch, capsys):
    """Of floating films hours of processor time, before the first one is solved."""
    monkeypatch.setattr("swashfilm.runs.variation.case.solver_of", lambda source, options: ThinFilms())
    text = changed(("designs = 8\ngenerations = 4", 'fidelity = "floating"\ndesigns = 8\ngenerations = 1'))
    main(["optimise", str(written(tmp_path, text)), "--workers", "1", "-o", str(tmp_path / "run")])
    assert "8 designs at 2 points, floating: about" in capsys.readouterr().out


def test_films_by_a_model(tmp_path, monkeypatch):
    """One objective of costly designs: few of them by a quadratic model, to the same film as by evolution."""
    monkeypatch.setattr("swashfilm.runs.variation.case.solver_of", lambda source, options: ThinFilms())
    case = {
        "format": 1,
        "optimise": {"pump": "ref90", "fidelity": "floating", "designs": 12},
        "vary": {"valve_plate.film_thickness": "4..20 um"},
        "objectives": {"drain_flow": "least"},
        "constraints": {"film_least.valve_plate": ">= 3 um"},
    }
    found = sf.optimise(case, workers=1)
    assert found.method["name"] == "trust_region"
    assert found.counts["tried"] <= 12
    film = found.summary["constraints"][0]
    assert film["chosen"] == pytest.approx(3e-6, rel=0.05)
    assert film["met"]
    page = (found.save(tmp_path / "run") / "report.html").read_text().replace("\u00a0", " ")
    assert "COBYQA of SciPy" in page
    assert "differ by less than the error of both" not in page
    case["optimise"] |= {"generations": 4}
    with pytest.raises(sf.InputFaults) as raised:
        sf.optimise(case, workers=1)
    (fault,) = raised.value.faults
    assert (fault.path, fault.nearest) == ("optimise.generations", "leave it out")


FAULTS = [
    (('pump = "', 'fidelity = "lumpd"\npump = "'), "optimise.fidelity", "one of 'lumped', 'fixed'", "lumped"),
    (("designs = 8", "designs = 2"), "optimise.designs", "at least 8", ""),
    (("designs = 8", 'choose = "los"'), "optimise.choose", "knee, loss, delivery_flow_ripple, or a row", "loss"),
    (("designs = 8", 'method = "gradient"'), "optimise.method", "one objective", "evolution"),
    (("designs = 8", 'method = "trust_region"'), "optimise.method", "one objective", "evolution"),
    (("designs = 8", 'table = "x.json"'), "optimise.table", 'fidelity = "table"', ""),
    (('pressures = "15,35MPa"', 'speed = "1000rpm"'), "points.speed", "one of speeds, pressures", "speeds"),
    (('"15,35MPa"', '"5-35MPa"'), "points.pressures", "a range with a number of levels", "5..35MPa:7"),
    (('"15,35MPa"', "[]"), "points.pressures", "levels, such as", ""),
    (('pressures = "15,35MPa"', 'cycle = "none.csv"'), "points.cycle", "a CSV file", ""),
    (('pressures = "15,35MPa"', "cycle = 3"), "points.cycle", "the path of a CSV file", ""),
    (
        ("ports.groove_start", "ports.groove_strat"),
        "vary.ports.groove_strat",
        "a number of the pump file",
        "ports.groove_start",
    ),
    (("ports.groove_start", "pump.cross_angle"), "vary.pump.cross_angle", "a number to start from", "[pump.pump]"),
    (('"-8..2 deg"', '"2..-8 deg"'), "vary.ports.groove_start", "a lower bound, then a higher one", ""),
    (('"-8..2 deg"', '"-8..2"'), "vary.ports.groove_start", "bounds with their unit", "-8..2 deg"),
    (('"-8..2 deg"', '"2 mm..3 mm"'), "vary.ports.groove_start", "an angle", ""),
    (('"-8..2 deg"', '"1 deg"'), "vary.ports.groove_start", "two bounds", ""),
    (('"-8..2 deg"', '"1-3 deg"'), "vary.ports.groove_start", "two bounds", "1..3deg"),
    (("with = [", "wiht = ["), "vary.ports.kidney_end.wiht", "range or with", "with"),
    (
        ('["ports.kidney_full_end"]', '["slipper.mass"]'),
        "vary.ports.kidney_end.with",
        "a dimension like ports.kidney_end",
        "",
    ),
    (('["ports.kidney_full_end"]', '["ports.groove_start"]'), "vary.ports.kidney_end", "each dimension once", ""),
    (
        ("[vary]", '[vary]\n"slipper.land_outer_radius" = "12..20 mm"'),
        "vary.slipper.land_outer_radius",
        "half the smallest distance of neighbouring ball centres",
        "15 mm",
    ),
    (('loss = "least"', 'loss = "minimal"'), "objectives.loss", "least or most", "least"),
    (('loss = "least"', 'losses = "least"'), "objectives.losses", "one of loss", "loss"),
    (
        ('loss = "least"', '"film_least.piston" = "most"'),
        "objectives.film_least.piston",
        "one of loss",
        'fidelity = "floating"',
    ),
    (('loss = "<= 1.05 start"', 'drain_flow = "1 L/min"'), "constraints.drain_flow", "a limit", "<= 1 L/min"),
    (('loss = "<= 1.05 start"', 'drain_flow = "<= 1 MPa"'), "constraints.drain_flow", "flow", ""),
    (('loss = "<= 1.05 start"', 'pressure_rate = "<= 3"'), "constraints.pressure_rate", "GPa/s", ""),
    (
        ("<= 50 MPa", "<= 30 MPa"),
        "constraints.chamber_pressure_peak",
        "chambers deliver at the delivery pressure",
        "<= 35 MPa",
    ),
    (
        ('loss = "<= 1.05 start"', '"efficiency.overall" = ">= 101 %"'),
        "constraints.efficiency.overall",
        "100 % or less",
        ">= 100 %",
    ),
    (
        ('loss = "<= 1.05 start"', 'drain_flow = [">= 2 L/min", "<= 1 L/min"]'),
        "constraints.drain_flow",
        "a least value below",
        "",
    ),
    (("<= 1.05 start", "<= 1.0.5 start"), "constraints.loss", "a bare number", ""),
    (('loss = "<= 1.05 start"', 'pressure_rate = "<= 1.2.3 GPa/s"'), "constraints.pressure_rate", "GPa/s", ""),
    (("<= 50 MPa", "<= 50"), "constraints.chamber_pressure_peak", "a value with its unit", "<= 50 MPa"),
    (
        ('loss = "<= 1.05 start"', '"efficiency.overall" = ">= 86"'),
        "constraints.efficiency.overall",
        "a share of at most 100 %",
        ">= 86 %",
    ),
    (
        ("<= 50 MPa", "<= 0.5 start"),
        "constraints.chamber_pressure_peak",
        "chambers deliver at the delivery pressure",
        "<= 35 MPa",
    ),
    (("[constraints]", "[constraint]"), "constraint", "one of format, optimise", "constraints"),
    (("format = 1", "format = 2"), "format", "format = 1", ""),
]


@pytest.mark.parametrize(
    ("change", "where", "expected", "nearest"), FAULTS, ids=[f"{n}-{one[1]}" for n, one in enumerate(FAULTS)]
)
def test_faults(tmp_path, change, where, expected, nearest):
    with pytest.raises(sf.InputFaults) as raised:
        sf.optimise(changed(change))
    found = [one for one in raised.value.faults if one.path == where]
    assert len(raised.value.faults) == 1
    assert expected in found[0].expected
    assert nearest in found[0].nearest


def test_tables_that_are_missing():
    with pytest.raises(sf.InputFaults) as raised:
        sf.optimise('format = 1\n[optimise]\npump = "ref90"\n[objectives]\n')
    assert {one.path for one in raised.value.faults} == {"vary", "objectives"}


def test_dotted_keys_are_quoted_ones(tmp_path, capsys):
    """Names of dimensions and measures may be written as dotted keys; `check` tells what a file asks for."""
    text = changed(('"ports.groove_start"', "ports.groove_start"), ('"ports.kidney_end"', "ports.kidney_end"))
    assert main(["check", str(written(tmp_path, text))]) == 0
    said = capsys.readouterr().out
    assert "vary ports.kidney_end with ports.kidney_full_end 166 deg to 180 deg" in said
    assert "search by evolution: 2 objectives" in said


def test_loss_over_a_duty_cycle(tmp_path):
    """Points and weights are those of the cycle, whose file lies beside the case."""
    (tmp_path / "cycle.csv").write_text("time [s],pressure [bar]\n0,100\n10,300\n")
    case = written(
        tmp_path, changed(('pressures = "15,35MPa"', 'cycle = "cycle.csv"'), ("generations = 4", "generations = 1"))
    )
    assert main(["optimise", str(case), "--workers", "1", "-o", str(tmp_path / "run")]) in (0, 3)
    summary = summary_of(tmp_path / "run")
    assert "duty cycle of 10 s" in summary["at"]
    assert len(summary["weights"]) == 5
    assert sum(summary["weights"]) == pytest.approx(1.0)
    losses = [one["measures"]["loss"]["start"] for one in summary["at_points"]]
    assert summary["measures"]["loss"]["start"] == pytest.approx(np.dot(losses, summary["weights"]))


def test_set_and_a_pump_of_the_case(tmp_path):
    """--set changes a key of the case; [pump.SECTION] and [operating] change the pump, as in other cases."""
    text = BENCH.replace(
        "[points]", '[pump.pump]\ndead_volume = "8 cm3"\n\n[operating]\nspeed = "1500 rpm"\n\n[points]'
    )
    place = tmp_path / "run"
    words = [str(written(tmp_path, text)), "--set", "optimise.generations=1", "--workers", "1", "-o", str(place)]
    assert main(["optimise", *words]) in (0, 3)
    assert summary_of(place)["counts"]["tried"] == 8
    assert 'dead_volume = "8 cm3"' in (place / "resolved.toml").read_text()
    assert summary_of(place)["levels"]["shaft_speed"] == pytest.approx([50.0 * np.pi])


def test_options(tmp_path, capsys):
    case = str(written(tmp_path))
    for words, said in (
        (["--workers", "0"], "a number, 1 to 256"),
        (["--workers", "2", "--cluster", "x"], "one of the two"),
        (["--resume", str(tmp_path / "none")], "which holds no points"),
        (["--steps", "90"], "fidelity lumped"),
    ):
        assert main(["optimise", case, *words]) == 2
        assert said in capsys.readouterr().err
