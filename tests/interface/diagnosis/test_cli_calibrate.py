"""`swashfilm calibrate`: what it refuses, and the way through from files to files."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import replace
from importlib.resources import files
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from recording_heads import HEAD

from diagnosis import Study, calibrate
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.refit import refit
from reynolds import NotConverged
from swashfilm.__main__ import main
from swashfilm.runs.calibrate.answer import calibrate_answer
from swashfilm.runs.calibrate.page import parameter_rows
from swashfilm.runs.calibrate.words import parameter_words
from system import SIMULATED, BenchPoints, EffectId, Extension, LumpedBench, entry_of, load_pump
from system.bench.calibration.equation_21 import paper_priors

PUMP = load_pump("ref90")
RECORDING = (
    HEAD
    + """displacement_ratio = { column = "e", unit = "1", sigma = 0.0 }
p_out = { column = "p", unit = "bar", sigma = 0.1 }
p_in = { column = "s", unit = "bar", sigma = 0.02 }
p_case = { column = "c", unit = "bar", sigma = 0.01 }
T_in = { column = "t", unit = "degC", sigma = 0.15 }
T_case = { column = "T", unit = "degC", sigma = 0.15 }
Q_out = { column = "Q", unit = "L/min", sigma = 0.1 }
Q_in = { column = "I", unit = "L/min", sigma = 0.1 }
Q_case = { column = "q", unit = "L/min", sigma = 0.015 }
torque = { column = "M", unit = "N m", sigma = 0.3 }
"""
)
PLANTED = {"friction.slipper_swash_plate": 0.009, "friction.piston_cylinder": 0.022}
WIDE = ("--set", "tolerance.friction=0.66")
BOUNDARY = {"mixed_friction.slipper": 0.05}


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("mixed_friction.hersey_scale", "Hersey scale of mixed friction"),
        ("mixed_friction.exponent", "exponent of mixed friction"),
        ("mixed_friction.piston", "mixed friction, piston"),
        ("displacement", "displacement factor"),
    ],
)
def test_a_parameter_of_no_part_has_a_name_of_its_own(name: str, words: str) -> None:
    assert parameter_words(name) == words


def _made(folder: Path, law: Extension | None = None) -> Path:
    """A recording of 24 points of the pump with other friction of slippers and pistons, and with `law` on."""
    grid = np.array(list(product((1000.0, 1600.0, 2100.0), (10e6, 17e6, 26e6, 35e6), (0.4, 1.0))))
    count = len(grid)
    points = BenchPoints(
        speed=grid[:, 0] * np.pi / 30,
        p_out=grid[:, 1],
        displacement_ratio=grid[:, 2],
        p_in=np.full(count, 2.5e6),
        p_case=np.full(count, 1.5e5),
        T_case=np.full(count, 328.15),
        T_in=np.full(count, 323.15),
        hours=np.full(count, np.nan),
        order=np.arange(count, dtype=float),
        warming=np.zeros(count),
    )
    bench = LumpedBench(PUMP, points, SIMULATED, paper_priors(PUMP)[0])
    bench = bench if law is None else bench.with_extensions((law,))
    values = np.array([(PLANTED | BOUNDARY).get(one.name, one.centre) for one in bench.parameters])
    noise = np.random.default_rng(4).standard_normal((count, 4)) * [0.1, 0.1, 0.015, 0.3]
    read = bench.predict(values) * [6e4, 6e4, 6e4, 1.0] + noise
    folder.mkdir()
    (folder / "recording.toml").write_text(RECORDING, encoding="utf-8")
    with (folder / "steady.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["n", "e", "p", "s", "c", "t", "T", "Q", "I", "q", "M"])
        for (n, p, e), row in zip(grid, read, strict=True):
            writer.writerow([n, e, p / 1e5, 25.0, 1.5, 50.0, 55.0, *(f"{number:.5f}" for number in row)])
    return folder


def _table(folder: Path, name: str) -> list[dict[str, str]]:
    with (folder / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_from_files_to_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Planted coefficients are found within 3 sigma; models in one table; the fitted pump loads, and reports."""
    out = tmp_path / "out"
    recording = _made(tmp_path / "made")
    words = ["calibrate", "ref90", str(recording), *WIDE, "-o", str(out), "--models", "wilson"]
    assert main(words) == 0
    told = capsys.readouterr().out
    assert "friction coefficient, slipper-swash plate" in told
    page = (out / "report.html").read_text("utf-8")
    assert page.index("The recording determines") < page.index("<nav>") < page.index("chi-square")
    assert "e-05 m" not in page
    assert "zero good to 0.5\u00a0rpm" in page
    found = {row["name"]: row for row in _table(out, "parameters.csv")}
    slipper = found["friction.slipper_swash_plate"]
    assert float(slipper["prior_high"]) == pytest.approx(PUMP.friction.slipper_swash_plate * np.exp(0.66), rel=1e-4)
    assert slipper["source"] == "[tolerance]"
    assert "assumed by" in told
    for name, planted in PLANTED.items():
        assert abs(float(found[name]["mean"]) - planted) < 3 * float(found[name]["sigma"])
    assert float(found["friction.slipper_swash_plate"]["sigma_over_prior [1]"]) < 0.5
    rows = _table(out, "heldout.csv")
    rms = {(row["model"], row["left_out"]): float(row["rms"]) for row in rows if row["channel"] == "torque"}
    assert rms["physics", "speed"] < rms["wilson", "speed"]
    points = [int(row["point"]) for row in _table(out, "residuals.csv")]
    assert (min(points), max(points)) == (1, len(_table(recording, "steady.csv")))
    assert {row["rank"] for row in _table(out, "equation_21.csv") if row["speed [rpm]"]} == {"2"}
    calibrated = load_pump(str(out / "pump_calibrated.toml"))
    mean = float(found["friction.slipper_swash_plate"]["mean"])
    assert calibrated.friction.slipper_swash_plate == pytest.approx(mean, rel=1e-5)
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    assert not summary["hersey"]["supported"]
    assert main(["report", str(out)]) == 0


@pytest.mark.slow
def test_friction_over_the_hersey_number_is_found_where_it_is(tmp_path: Path) -> None:
    """Boundary friction of .05 in the slippers that speed takes away: odds above three nats, and a curve."""
    law = entry_of(EffectId.MIXED_FRICTION).extensions[0].members[3]
    recording, out = _made(tmp_path / "made", law), tmp_path / "out"
    stated = files("system.description").joinpath("pumps", "ref90.toml").read_text("utf-8")
    pump = tmp_path / "unstated.toml"
    pump.write_text(re.sub(r"(?m)^(guide_|bearing_|)friction = .*\n", "", stated), "utf-8")
    assert main(["calibrate", str(pump), str(recording), "-o", str(out), "--models", "none"]) == 0
    found = {row["name"]: row["source"] for row in _table(out, "parameters.csv")}
    assert found["friction.slipper_swash_plate"] == "the paper's 0.008 to 0.03"
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    assert any("[tolerance] states no sigma" in note for note in summary["notes"])
    assert not any("tolerance.friction" in note for note in summary["notes"])
    assert summary["hersey"]["supported"]
    assert any("constant friction coefficients" in note and "given up" in note for note in summary["notes"])
    assert _table(out, "heldout.csv") == []
    slipper = [float(row["friction [1]"]) for row in _table(out, "hersey.csv") if row["gap"] == "slipper"]
    assert slipper[0] > 1.5 * slipper[-1]
    assert load_pump(str(out / "pump_calibrated.toml")).physics.mixed_friction is not None


PLATE = """[pump]
displacement = "90 cm3"
pistons = 9
rated_speed = "2100 rpm"
[oil]
grade = "ISO VG 68"
"""


@pytest.mark.slow
def test_a_pump_known_by_its_type_plate_is_set_to_the_level_and_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its assumptions are those of the level; what its sigmas leave out is a warning on terminal and in the file."""
    recording, out = _made(tmp_path / "made"), tmp_path / "out"
    (tmp_path / "plate.toml").write_text(PLATE, "utf-8")
    words = ["calibrate", str(tmp_path / "plate.toml"), str(recording), "--models", "none", "--laws", "none"]
    assert main([*words, "-o", str(out)]) == 0
    assert "warning: plate is known by its type plate" in capsys.readouterr().out
    summary = json.loads((out / "summary.json").read_text("utf-8"))
    assert any("plate is known by its type plate" in note for note in summary["notes"])
    assert any("at the level of the recording" in text for text in summary["assumptions"])


def test_a_fit_that_was_given_up_has_no_coefficients(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its place promises a fall of the objective: neither its values nor their sigmas hold."""

    def given_up(study: Study, *_: object) -> Explanation:
        fit = refit(study, *_)
        assert fit.posterior is not None
        aside = fit.posterior.xi + 3.0 / np.sqrt(fit.posterior.xi.size)
        left = fit.posterior.residual - fit.posterior.slopes @ (aside - fit.posterior.xi)
        place = replace(fit.posterior, xi=aside, residual=left, objective=float(left @ left + aside @ aside))
        return replace(fit, posterior=place)

    monkeypatch.setattr("diagnosis.calibration.refit", given_up)
    with pytest.raises(NotConverged, match=r"given up .* `swashfilm diagnose` tells where"):
        calibrate(PUMP, _made(tmp_path / "made"), models=(), with_hersey=False)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["calibrate"], "RECORDING"),
        (["calibrate", "ref90", "nowhere"], "no such file"),
        (["calibrate", "ref91", "nowhere"], "ref91"),
        (["calibrate", "ref90", "nowhere", "--models", "willson"], "wilson"),
        (["calibrate", "ref90", "nowhere", "--laws", "mixed"], "mixed_friction"),
        (["calibrate", "ref90", "nowhere", "--law", "none"], "--laws"),
    ],
)
def test_what_is_wrong_is_told(words: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert told in capsys.readouterr().err


def test_the_answer_tells_the_scatter_that_the_readings_show() -> None:
    """A pull of zero, of readings as they are written, and readings met exactly are no scatter of one."""

    def row(channel: str, measured: str, fitted: str, pull: str) -> dict[str, str]:
        return {"channel": channel, "unit": "N m", "measured": measured, "fitted": fitted, "pull": pull}

    rows = [row("torque", "100", "98", "2"), row("torque", "100.001", "100", "0"), row("Q_out", "80", "80", "0")]
    summary = {"readings": 3, "points": 2, "hersey": None}
    answer = calibrate_answer(summary, [], rows)
    notes = [tile.note for tile in answer.tiles if "error of the fit" in tile.name]
    assert notes == ["rms; scatter of the meter 1 N m", "rms; every reading is met exactly"]
    assert "Beyond the scatter of its meter is" in answer.words
    assert "(1.4 times)" in answer.words


def _parameter(name: str, **cells: str) -> dict[str, str]:
    """A row of parameters.csv: 0.4 +- 0.1, assumed 0.2 to 0.6."""
    plain = {"unit": "1", "prior_low": "0.2", "prior": "0.4", "prior_high": "0.6", "lower": "0", "upper": "1.4"}
    fitted = {"mean": "0.4", "sigma": "0.1", "sigma_over_prior [1]": "0.3", "off_over_prior [1]": "0.5"}
    return {"name": name, **plain, **fitted, "at_bound": "no", "source": "[tolerance]", **cells}


def test_a_value_at_its_bound_is_no_result() -> None:
    """Its sigma does not count; the page and the terminal name it in words, tile, sentence and table."""
    held = _parameter("friction.slipper_swash_plate", mean="1.4", at_bound="yes")
    summary = {"readings": 3, "points": 2, "hersey": None}
    answer = calibrate_answer(summary, [held, _parameter("dead_volume")], [])
    assert "determines: dead volume." in answer.words
    assert "end of their range, so that no sigma of them holds: friction coefficient of slipper" in answer.words
    assert "friction.slipper" not in answer.words
    assert [tile.note for tile in answer.tiles][1] == "at the end of its range; assumed 0.20 to 0.60"
    assert answer.tiles[2].value == "1 of 2"
    assert list(parameter_rows([held])) == [
        ("friction coefficient, slipper-swash plate", "0.20 to 0.60", "[tolerance]", "1.4", "at the end of its range")
    ]


def test_a_value_far_from_what_was_assumed_is_a_warning() -> None:
    """From 3 sigma on, of pump and meters; one beyond its assumed range is not 'as assumed'."""
    far = _parameter("throttle_share", mean="1.28", **{"off_over_prior [1]": "4.4"})
    meter = _parameter("Q_out.gain", **{"off_over_prior [1]": "-3.2"})
    off = _parameter("friction.ball_guide_retainer", **{"off_over_prior [1]": "-1.9", "sigma_over_prior [1]": "0.93"})
    answer = calibrate_answer({"readings": 3, "points": 2, "hersey": None}, [far, meter, off], [])
    assert "Warning: throttle share 1.28 is 4.4 sigma from what was assumed (0.20 to 0.60)" in answer.words
    assert "gain of delivery flow (Q_out) 40 % is 3.2 sigma" in answer.words
    assert "stay as assumed" not in answer.words
    ends = [row[-1] for row in parameter_rows([far, off])]
    assert ends == ["determined, 4.4 sigma off", "moved, not narrowed"]
