"""Pages of films: the answer first, in units of the trade, with error bars and words on what limits the film."""

import json
import re
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from swashfilm.output.refinement import bar_text
from swashfilm.runs.film.answer import film_tiles, film_words
from swashfilm.runs.film.revolution.answer import revolution_tiles, revolution_words
from swashfilm.runs.film.series.answer import main_spans, study_tiles, study_words
from swashfilm.runs.reference.answer import reference_tiles, reference_words
from swashfilm.runs.transient.answer import transient_tiles, transient_words
from system import Dimension

ROOT = Path(__file__).parents[3]
FILM = {
    "load_N": 500.0, "leakage_flow_m3_per_s": 1e-6, "dissipation_W": 3.0, "film_thickness_min_m": 2e-6,
    "pressure_max_Pa": 5e6, "friction_coefficient": 0.01, "cavitated_area_fraction": 0.0,
}  # fmt: skip
TURN = {
    "gap": "slipper", "film_thickness_min_m": 3e-6, "film_thickness_min_at_deg": 255.0, "film_thickness_mean_m": 9e-6,
    "leakage_flow_m3_per_s": -1e-7, "friction_power_W": 120.0, "rubbing_power_W": 0.0, "pressure_max_Pa": 3e7,
    "share_of_turn": {"lift": 0.8, "cavitation": 0.2, "contact": 0.0}, "largest_multiplier": 0.5,
}  # fmt: skip


@pytest.fixture(scope="module")
def refined(tmp_path_factory):
    folder = tmp_path_factory.mktemp("film") / "run"
    assert main(["film", str(ROOT / "examples/films/linear_slider.toml"), "--refine", "3", "-o", str(folder)]) == 0
    return folder


def test_a_film_begins_with_its_load_and_error_bar(refined):
    page = (refined / "report.html").read_text("utf-8")
    head = page[: page.index("<nav>")].replace("\u00a0", " ")
    assert re.findall(r'class="name">([^<]*)<', head) == [
        "load", "leakage", "friction power", "least film", "largest pressure",
    ]  # fmt: skip
    assert "limit 47.6649 N +- 0.002 N" in head
    assert "The film carries 47.64 N." in head
    assert head.count("data:image/") == 1


def test_error_bars_say_why_they_are_missing(refined):
    summary = json.loads((refined / "summary.json").read_text("utf-8"))
    assert bar_text(summary, "film_thickness_min_m", Dimension.LENGTH) == "converged to round-off"
    assert bar_text({}, "load_N", Dimension.FORCE) == ""
    summary["refinement"]["numbers"]["load_N"] |= {"error": None, "verdict": "no order observed"}
    assert bar_text(summary, "load_N", Dimension.FORCE) == "no order observed: no error bar"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({}, "The film is full everywhere, and the walls do not touch."),
        ({"cavitated_area_fraction": 0.31}, "31 % of its area cavitates."),
        ({"contact_load_N": 200.0}, "Contact of the walls carries 200 N."),
        ({"lambda_ratio_min": 1.5}, "only 1.5 times as thick as the walls are rough"),
        ({"leakage_flow_m3_per_s": 0.0}, "Nothing leaks out"),
        ({"required_load_N": 800.0, "carried_load_N": 700.0, "position_source": "given"}, "carries 700 N of 800 N."),
        ({"required_load_N": 800.0, "carried_load_N": 800.0, "position_source": "rest"}, "under a load of 800 N."),
        ({"time_s": 0.02, "load_of_time_min_N": 1.0, "load_of_time_max_N": 9.0}, "lies between 1 N and 9 N."),
    ],
)
def test_words_tell_what_limits_a_film(more, words):
    assert words in film_words(FILM | more)
    assert all(tile.value for tile in film_tiles(FILM | more))


STARVED = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["157.07963 mm", "6.25 mm"], cells = [32, 4], periodic = "x", cell="quadrilateral" }
thickness = "50e-6*(1 + 0.6*cos(x/0.025))"
velocity = ["2.5 m/s", "0 m/s"]
viscosity = "30 mPa s"
geometry = "cylinder"
[boundary]
bottom = { pressure = "0 bar" }
top = { pressure = "0 bar" }
"""


def test_flows_that_are_all_round_off_are_none(tmp_path):
    """A journal whose cavity takes all: nothing passes its ends, beside 0.05 L/min around the shaft."""
    (tmp_path / "starved.toml").write_text(STARVED, encoding="utf-8")
    assert main(["film", str(tmp_path / "starved.toml"), "--refine", "3", "-o", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    around = 2.5 * 50e-6 * (0.15707963 * 0.00625) ** 0.5
    assert summary["scale"]["flow_m3_per_s"] == pytest.approx(around, rel=0.02)
    assert abs(summary["leakage_flow_m3_per_s"]) < 1e-12 * around
    assert "Nothing leaks out" in film_words(summary)
    assert next(tile.value for tile in film_tiles(summary) if tile.name == "leakage").startswith("0 ")
    flow = summary["refinement"]["numbers"]["leakage_flow_m3_per_s"]
    assert flow["verdict"] == "converged to round-off"


def test_a_turn_tells_its_thinnest_place_and_a_leakage_that_flows_in():
    words = revolution_words(TURN)
    assert "thinnest at 255 deg of shaft angle: 3 um" in words
    assert "6 mL/min flow in from the case" in words
    assert "full film in 80 %" in words
    assert "The motion is stable" in words
    assert "unstable" in revolution_words(TURN | {"largest_multiplier": 1.2})
    tiles = {tile.name: tile for tile in revolution_tiles(TURN)}
    assert tiles["friction power, mean"].note == "without contact"


def test_a_study_tells_ends_and_failures():
    at = {"film.velocity[0]": "177.827941004 mm/s"}
    span = {"min": 14.2, "max": 500.0, "min_at": at, "max_at": {"film.velocity[0]": "1 m/s"}}
    values, numbers = ["177.827941004 mm/s", "1 m/s", "2 m/s"], [0.177827941004, 1.0, 2.0]
    summary = {
        "kind": "film_study", "points": 3, "solved": 2, "numbers": {"load_N": span},
        "axes": [{"key": "film.velocity[0]", "values": values, "numbers": numbers, "unit": "m/s"}],
        "failed": [{"values": at, "status": "failed", "reason": "no position"}],
    }  # fmt: skip
    words = study_words(summary)
    assert "2 films over film.velocity[0] (0.177828 m/s to 2 m/s, 3 values)." in words
    assert "The load lies between 14.2 N (at 0.177828 m/s) and 500 N (at 1 m/s)." in words
    assert "One point has no result, at 0.177828 m/s: no position." in words
    assert [tile.value for tile in study_tiles(summary)] == ["2 of 3", "500 N"]


def test_the_load_of_a_film_is_what_film_and_contact_carry():
    found = FILM | {"carried_load_N": 700.0, "contact_load_N": 200.0}
    assert next(film_tiles(found)).value == "700 N"
    assert "The film carries 700 N." in film_words(found)
    spans = {key: {"min": 1.0, "max": 2.0} for key in ("load_N", "carried_load_N")}
    assert [key for key, _ in main_spans({"numbers": spans})] == ["carried_load_N"]


def test_a_transient_that_does_not_move_says_so():
    turn = {"delivery_flow_m3_per_s": 3e-3, "shaft_torque_Nm": 500.0}
    summary = {
        "pump": "ref90", "displacement_ratio_start": 1.0, "displacement_ratio_end": 1.0, "travel_10_to_90_s": None,
        "swash_angle": {"start_rad": 0.28, "end_rad": 0.28, "fastest_rad_per_s": 0.0}, "first_turn": turn,
        "last_turn": turn, "chamber_pressure_largest_Pa": 3.5e7, "actuator_pressure_largest_Pa": 2.5e6,
        "stops": [],
    }  # fmt: skip
    assert "stays at 16.04 deg" in transient_words(summary)
    assert "from 10 to 90 % of the way" not in [tile.name for tile in transient_tiles(summary)]


def test_a_reference_flow_tells_its_coefficients():
    row = {"reynolds": 200.0, "loss_factor": 2.07, "flow_coefficient": None, "mesh_error": 1e-3}
    row["pressure_drop_over_film_equation"] = None
    summary = {"passage": "film_step", "table": "step.csv", "holds_for": "laminar flow"}
    summary["passages"] = [{"words": "a step", "extra_length": 0.5, "rows": [row]}]
    assert "one passage (film step)" in reference_words(summary)
    assert [tile.name for tile in reference_tiles(summary)] == [
        "extra length of slow flow", "loss factor", "largest mesh error",
    ]  # fmt: skip
