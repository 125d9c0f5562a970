"""The run folder of a diagnosis: its tables, and the page that is made of them alone."""

from __future__ import annotations

import re
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pandas
import pytest
from made_diagnosis import LPM, PRESSURE, Q, agreeing, its_answer

from diagnosis import Diagnosis, Study
from diagnosis.detect.time_scan import TimeKind, TimeMark
from diagnosis.explain.ranked import HeldOut
from diagnosis.procedure.compared import NO_COMPARISON, Change, FilmChange, FilmComparison, PumpComparison
from diagnosis.procedure.pump_comparison import compare_pumps
from diagnosis.report.hidden import HEAD
from diagnosis.report.json_file import diagnosis_record
from diagnosis.report.tables import pull_sums
from diagnosis.verdict.diagnosis import ClaimedEffect
from swashfilm import open as open_run
from swashfilm.__main__ import main
from swashfilm.runs.diagnose.files import head_of, read_rows, write_diagnosis_files, write_rows
from swashfilm.runs.diagnose.page import AXES, strongest_courses, write_diagnose_page
from swashfilm.runs.diagnose.plots import effect_courses, residual_maps
from swashfilm.runs.diagnose.rows import change_rows, claim_rows, moved_words, place_rows, tiles
from swashfilm.runs.diagnose.told import MOST_LINES, WIDTH, answer_lines
from system import ChannelName, EffectId, Kind, load_pump
from system.work.progress import silent

E = EffectId


def _page(folder: Path) -> str:
    """The page with plain blanks before units."""
    return (folder / "report.html").read_text("utf-8").replace("\xa0", " ")


LEAKAGES = {"without": 0.4, "with": 1.0}, {"without": 0.4, "with": 1.1}


def test_the_page_tells_gaps_that_cannot_be_told_apart() -> None:
    """Ids and other gaps with their share stand in the column of what an effect cannot be separated from."""
    claim = {
        "id": "elastic_opening", "pair": "piston", "probability": 0.97, "equivalent": ["thermal_clearance"],
        "other_pairs": {"valve_plate": 0.35}, "parameters": [],
    }  # fmt: skip
    (row,) = claim_rows({"effects": [claim]})
    assert row[3] == "thermal_clearance, at the valve plate (0.35)"


@pytest.mark.usefixtures("rendered")
def test_the_folder_holds_tables_and_a_page(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """Pulls in residuals.csv are of the fit they name; the page is made anew from the folder alone."""
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    write_diagnose_page(tmp_path)
    rows = read_rows(tmp_path / "residuals.csv")
    assert len(rows) == 2 * PRESSURE.size
    flow = [row for row in rows if row["channel"] == "Q_case"]
    before, after = (np.sqrt(np.mean([float(row[key]) ** 2 for row in flow])) for key in ("pull_before", "pull_after"))
    assert after < 1.3 < 2.0 < before
    assert float(flow[0]["p_out [bar]"]) == pytest.approx(50)
    assert float(flow[0]["measured"]) == pytest.approx(float(study.observations.values[0, 0]) / LPM, rel=1e-5)
    assert [row["behind [nats]"] for row in read_rows(tmp_path / "hypotheses.csv")] == ["0", "4", "380"]
    opening = next(row for row in read_rows(tmp_path / "parameters.csv") if row["name"] == "opening")
    assert opening["before"] == ""
    assert float(opening["after"]) == pytest.approx(0.4, abs=4 * float(opening["sigma"]))
    page = _page(tmp_path)
    for part in (
        "Bench &lt;4&gt;",
        "The film at the valve plate opens under pressure",
        "point 3: far from its neighbours",
    ):
        assert part in page
    (tmp_path / "report.html").unlink()
    assert main(["report", str(tmp_path)]) == 0
    assert _page(tmp_path) == page


def test_a_page_says_what_changes_in_the_pump(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """A point run without and with the finding: links to both, each number with its unit; films told."""
    row = {"quantity": "case drain", "unit": "L/min", "without": "1.2", "with": "1.9", "change": "0.7"}
    film = {
        "quantity": "leakage, slipper", "unit": "L/min", "lumped_without": "0.4", "lumped_with": "1",
        "films_without": "0.4", "films_with": "1.1",
    }  # fmt: skip
    films = FilmComparison({}, (FilmChange("leakage, slipper", "L/min", *LEAKAGES),), "Films as they stand.")
    text = "Point 7, where the finding adds most: 2100 rpm."
    comparison = PumpComparison({}, {}, (Change("case drain", "L/min", 1.2, 1.9),), text, films)
    write_diagnosis_files(tmp_path, study, named, its_answer(named), comparison=comparison)
    write_diagnose_page(tmp_path)
    page = _page(tmp_path)
    for part in (
        "Point 7",
        'href="without/report.html"',
        'href="with/report.html"',
        "1.9 L/min",
        "Films as they stand.",
        "<td>0.4 -&gt; 1 L/min (x 2.5)</td><td>0.4 -&gt; 1.1 L/min (x 2.75)</td>",
        "with/pump.pvd",
    ):
        assert part in page
    assert read_rows(tmp_path / "changes.csv") == [row]
    assert read_rows(tmp_path / "films.csv") == [film]


def test_floating_films_stand_alone_on_the_page(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """No column of closed-form laws beside them; the page says what both runs are."""
    films = FilmComparison({}, (FilmChange("mean film, slipper", "um", {}, LEAKAGES[1]),), "Floating films.")
    compared = PumpComparison(changes=(Change("case drain", "L/min", 1.0, 2.0),), text="Point 3.", films=films)
    write_diagnosis_files(tmp_path, study, named, its_answer(named), (), compared)
    write_diagnose_page(tmp_path)
    assert list(read_rows(tmp_path / "films.csv")[0]) == ["quantity", "unit", "films_without", "films_with"]
    page = _page(tmp_path)
    assert "Both runs have floating films" in page
    assert "films, without -&gt; with" in page
    assert "closed-form laws" not in page


def test_a_meters_fault_is_no_change_of_the_pump(study: Study, named: Diagnosis) -> None:
    """Nothing is run, and why is told; nothing is told where nothing is claimed."""
    fault = replace(named, effects=(ClaimedEffect(E.TORQUE_OFFSET, None, 0.99, (), ()),))
    pump = load_pump("ref90")
    compared = compare_pumps(pump, study, fault, silent)
    assert compared == replace(
        NO_COMPARISON, text="A meter's fault costs the pump nothing: only the readings are wrong."
    )
    assert compare_pumps(pump, study, agreeing(named), silent) == NO_COMPARISON


def test_numbers_are_told_in_the_units_people_read(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """An opening in 1/GPa and not 1/Pa, in the table of what is claimed."""
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    write_diagnose_page(tmp_path)
    assert "opening 22 +- 2 1/GPa</td>" in _page(tmp_path)


HIDDEN_ROWS = [
    dict(zip(HEAD, row, strict=True))
    for row in (
        ("control_flow", "", "0.06 mm2", "control_flow.area", "0.06", "mm2", "yes", "Q_out", "-0.48", "L/min"),
        ("control_flow", "", "0.06 mm2", "control_flow.area", "0.06", "mm2", "yes", "torque", "0", "N m"),
        ("mixed_friction", "piston", "share 2", "mixed_friction.share", "2", "1", "no", "Q_out", "0", "L/min"),
        ("mixed_friction", "piston", "share 2", "mixed_friction.share", "2", "1", "no", "torque", "4", "N m"),
    )
]


def test_the_page_lists_effects_that_may_hide(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """Those that the recording limits in a table, the others by name; without the file, as earlier, no such section."""
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    write_rows(tmp_path / "hidden.csv", HIDDEN_ROWS)
    write_diagnose_page(tmp_path)
    page = _page(tmp_path).replace(' class="number"', "")
    assert "What may still hide" in page
    assert "<td>oil drawn by the control</td><td>0.06 mm2</td><td>-0.48 L/min</td><td>0 N m</td>" in page
    assert "Not limited by this recording: mixed friction at the pistons." in page
    found = open_run(tmp_path)
    assert [title for title, _ in found.tables()] == ["Channels", "Effects that may hide"]
    (tmp_path / "hidden.csv").unlink()
    write_diagnose_page(tmp_path)
    assert "What may still hide" not in _page(tmp_path)
    assert [title for title, _ in open_run(tmp_path).tables()] == ["Channels"]


def test_a_right_name_lets_the_pulls_fall(named: Diagnosis) -> None:
    before, after = pull_sums(named.before, named.after)
    assert after < 0.5 * before


@pytest.mark.parametrize("kind", [Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS])
def test_a_page_without_a_claim(study: Study, named: Diagnosis, tmp_path: Path, kind: Kind) -> None:
    found = replace(agreeing(named), kind=kind, after=named.before, fit=HeldOut({}, {}, {}, {}, False, "not split"))
    write_diagnosis_files(tmp_path, study, found, its_answer(found))
    write_diagnose_page(tmp_path)
    page = _page(tmp_path)
    assert "<h3>Claims</h3>" not in page
    assert "Effect on the pump" not in page
    assert ("What to look at" in page) == (kind is Kind.UNKNOWN_PHYSICS)


def test_a_value_claimed_to_be_wrong_is_shown_as_stated(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """Its prior is the stated one and not the tenfold of the hypothesis; no pull of a freed prior."""
    free = tuple(one.widened(10.0) if one.name == "film" else one for one in named.after.parameters)
    found = replace(named, after=replace(named.after, parameters=free))
    write_diagnosis_files(tmp_path, study, found, its_answer(found))
    write_diagnose_page(tmp_path)
    row = next(row for row in read_rows(tmp_path / "parameters.csv") if row["name"] == "film")
    assert (row["prior"], row["prior_sigma"], row["pull_after"]) == ("1", "0.05", "")
    kept = ("friction",)
    sums = tuple(sum(fit.pulls[fit.index(name)] ** 2 for name in kept) for fit in (named.before, named.after))
    assert pull_sums(found.before, found.after) == pytest.approx(sums)
    assert " free</td>" in _page(tmp_path)


@pytest.mark.parametrize("gone", ["speed [rpm]", "p_out [bar]", "both"])
def test_maps_are_drawn_without_an_axis(study: Study, named: Diagnosis, tmp_path: Path, gone: str) -> None:
    """An axis that no reading has, and a channel that was read at one displacement only."""
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    write_diagnose_page(tmp_path)
    rows = read_rows(tmp_path / "residuals.csv")
    for row in rows:
        row |= dict.fromkeys(("speed [rpm]", "p_out [bar]") if gone == "both" else (gone,), "")
    assert residual_maps(rows).axes
    for at, row in enumerate(rows):
        row["displacement_ratio [1]"] = "1" if row["channel"] == "Q_case" else ("1", "0.3")[at % 2]
    assert residual_maps(rows).axes


def test_what_is_added_is_drawn_over_an_axis_that_is_there(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """A constant has no axis, nor has a delivery pressure that was not recorded."""
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    write_diagnose_page(tmp_path)
    rows = read_rows(tmp_path / "residuals.csv")
    for row in rows:
        row |= {"p_out [bar]": "", "added": "0.5"}
    courses = strongest_courses(rows)
    assert courses
    assert {axis for _, axis in courses} == {"speed [rpm]"}
    assert effect_courses(rows, courses).axes
    assert strongest_courses([row | {head_of(row, axis): "" for axis in AXES} for row in rows]) == []


def test_where_is_told_by_what_shows_there(named: Diagnosis) -> None:
    """Traces have no place on the map; a drift has no point; with no mismatch no region stands."""
    onset, drift = (TimeMark(kind, Q, 39, 1e-4) for kind in (TimeKind.ONSET, TimeKind.DRIFT))
    rows = dict(place_rows(diagnosis_record(replace(named, location=replace(named.location, time=onset)))))
    assert rows["region of the map"] == "p_out above 250 bar"
    assert rows["onset"] == "Q_case from point 40 on"
    rows = dict(place_rows(diagnosis_record(replace(named, location=replace(named.location, time=drift)))))
    assert rows["drift"] == "Q_case"
    traces = replace(named.location, channels=(ChannelName.P_CHAMBER,), region=None)
    rows = dict(place_rows(diagnosis_record(replace(named, location=traces))))
    assert "region of the map" not in rows
    agreed = agreeing(replace(named, location=replace(named.location, time=drift)))
    assert dict(place_rows(diagnosis_record(agreed))) == {"drift": "Q_case"}


STATISTICS = re.compile(r"\b(null|nats|z|pulls?|chi2|held out)\b")


def test_statistics_stand_in_the_appendix_alone(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    write_diagnosis_files(tmp_path, study, named, its_answer(named, "It costs 2 L/min."))
    write_diagnose_page(tmp_path)
    page = re.sub(r'src="[^"]*"|<style>.*?</style>|<script.*?</script>', "", _page(tmp_path), flags=re.DOTALL)
    before, _, appendix = page.partition("Appendix: statistics</h2>")
    assert not STATISTICS.findall(re.sub("<[^>]*>", " ", before))
    assert {"nats", "chi2"} <= set(STATISTICS.findall(appendix))
    first = before[before.index('class="answer"') :]
    assert first.index("Cause found. The film") < first.index("It costs 2 L/min.") < first.index("<nav>")


def test_tables_without_rows_have_their_head(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    found = replace(named, next_point=None)
    write_diagnosis_files(tmp_path, study, found, its_answer(found))
    for name, first in (("next_points", "speed [rpm],"), ("changes", "quantity,unit,"), ("films", "quantity,unit,")):
        assert (tmp_path / f"{name}.csv").read_text("utf-8").startswith(first)
        assert len(pandas.read_csv(tmp_path / f"{name}.csv")) == 0


def test_tiles_are_size_cost_certainty_and_fit(named: Diagnosis) -> None:
    record = diagnosis_record(named) | {"answer": asdict(its_answer(named))}
    changes = [
        {"quantity": "delivery flow", "unit": "L/min", "without": "50", "with": "48", "change": "-2"},
        {"quantity": "efficiency, overall (ISO 4409)", "unit": "%", "without": "80", "with": "78.5", "change": "-1.5"},
        {"quantity": "shaft power", "unit": "W", "without": "9000", "with": "9100", "change": "100"},
    ]
    shown = tiles(record, {"points": 28, "channels": []}, changes)
    assert [tile.value for tile in shown] == ["22 %", "-1.5 points", "-2 L/min", "very sure", "0.016 L/min"]
    assert shown[0].note == "+- 2 per 100 bar, one sigma"
    assert shown[-1].note == "before 0.06; scatter of the meter 0.015"


def test_a_value_that_need_not_move_is_told() -> None:
    rows = [
        {"name": "dead_volume", "unit": "m3", "role": "base", "prior": "6e-6", "prior_sigma": "1.2e-7",
         "before": "4.6e-6", "after": "5.9e-6", "pull_before": "-11", "pull_after": "-0.8"},
        {"name": "Q_case.gain", "unit": "1", "role": "sensor", "prior": "0", "prior_sigma": "0.004", "before": "-0.02",
         "after": "0", "pull_before": "-20", "pull_after": "0"},
    ]  # fmt: skip
    told = "Without the finding the fit moves dead volume from 6 +- 0.12 cm3 to 4.6 cm3; with it, to 5.9 cm3."
    assert moved_words(rows) == told
    assert moved_words([row | {"pull_after": row["pull_before"]} for row in rows]) == ""
    assert moved_words([row | {"name": "form.3"} for row in rows]) == ""


def test_the_terminal_has_few_short_lines(named: Diagnosis) -> None:
    """However much there is to tell; the measurement stays."""
    answer = asdict(its_answer(named, "It costs 2 L/min of delivery and 8 points of efficiency."))
    lines = answer_lines(answer)
    assert len(lines) <= MOST_LINES
    assert lines[0].startswith("Cause found. The film at the valve plate")
    looks = [{"name": name, "text": "Look at this part of the pump. " * 40} for name in ("Churning", "Seal drag")]
    long = answer | {"look": looks, "fit": "Points are met. " * 30}
    cut = answer_lines(long)
    assert len(cut) <= MOST_LINES
    assert max(map(len, cut)) <= WIDTH
    assert "3 readings decide" in " ".join(cut)
    assert "Churning: Look at this part" in " ".join(cut)
    assert all(len(answer_lines(answer, most)) <= most for most in range(4, 12))


def test_the_terminal_names_the_rivals_before_the_cost(named: Diagnosis) -> None:
    """Of "one of two causes" both have their name, however much else there is."""
    alike = replace(named, effects=tuple(replace(one, equivalent=(E.FILM_HEATING,)) for one in named.effects))
    answer = asdict(its_answer(alike, f"It costs {'2 L/min of delivery and ' * 9}8 points of efficiency."))
    looks = [{"name": name, "text": "Look at this part of the pump. " * 40} for name in ("Churning", "Seal drag")]
    told = " ".join(answer_lines(answer | {"look": looks}, 9))
    assert "Heating of the oil films in place of elastic opening fits this recording as well." in told
    assert "It costs" not in told
    least = " ".join(answer_lines(answer | {"look": looks}, 7))
    assert "Heating of the oil films in place of elastic opening" in least
    assert "Churning" not in least


def test_maps_of_one_speed_are_drawn_over_temperature(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    write_diagnosis_files(tmp_path, study, named, its_answer(named))
    rows = read_rows(tmp_path / "residuals.csv")
    assert residual_maps(rows).axes[-2].get_xlabel() == "speed [r/min]"
    for at, row in enumerate(rows):
        row |= {"speed [rpm]": "", "T_case [degC]": str(30 + at)}
    assert residual_maps(rows).axes[-2].get_xlabel() == "case temperature [degC]"


def test_a_quantity_that_reads_the_same_has_no_change() -> None:
    row = {"quantity": "friction", "unit": "W", "without": "84.8638", "with": "84.8634", "change": "-0.00037"}
    assert next(iter(change_rows([row])))[:4] == ("friction", "84.86 W", "84.86 W", "0 W")
