"""`swashfilm plan`: what it writes, prints and refuses."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.runs.plan.plots import apart_plot
from swashfilm.runs.plan.rows import never_rows

SUSPECTS = "churning,seal_drag,torque_offset,port_short_circuit"
WORDS = ["--suspects", SUSPECTS, "--add", "4"]


@pytest.fixture(scope="module")
def planned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run folder of a plan for four suspects."""
    place = tmp_path_factory.mktemp("plan") / "run"
    assert main(["plan", "ref90", *WORDS, "--limit", "speed <= 1800 rpm", "-o", str(place)]) == 0
    return place


def test_counts_and_distances(planned: Path) -> None:
    summary = json.loads((planned / "summary.json").read_text())
    distances = np.array(summary["distances"])
    assert summary["kind"] == "plan"
    assert summary["pairs"] == 6 == summary["told"] + summary["open"] + summary["never"]
    assert summary["told"] >= summary["told_planned"]
    assert np.all(distances >= np.array(summary["distances_planned"]) - 1e-9)
    assert np.all(distances <= np.array(summary["distances_ever"]) + 1e-9)
    np.testing.assert_allclose(distances, distances.T)
    assert np.all(np.diff(summary["nats"]) >= 0.0)


def test_a_constant_torque_and_a_torque_meter_off_its_zero_are_never_told_apart(planned: Path) -> None:
    rows = list(csv.DictReader((planned / "never.csv").open()))
    assert ("seal_drag", "torque_offset", "same_form") in {(r["suspect"], r["other"], r["reason"]) for r in rows}
    words = {one["name"]: one["words"] for one in json.loads((planned / "summary.json").read_text())["suspects"]}
    told = f"No point tells {words['seal_drag']} from {words['torque_offset']}"
    assert told in (planned / "report.html").read_text().replace("\u00a0", " ")


def test_table_of_suspects(planned: Path) -> None:
    head, *rows = csv.reader((planned / "apart.csv").open())
    assert head[1:] == SUSPECTS.split(",") == [row[0] for row in rows]


def test_points_lie_within_the_limits_and_can_be_planned_again(planned: Path, tmp_path: Path) -> None:
    rows = list(csv.DictReader((planned / "points.csv").open()))
    added = json.loads((planned / "summary.json").read_text())["added_readings"]
    assert 1 <= added <= 4
    assert sum(int(row["repeats [1]"]) for row in rows) == 18 + added
    assert max(float(row["speed [r/min]"]) for row in rows) <= 1800.0 + 1e-6
    assert [int(row["order"]) for row in rows] == list(range(1, len(rows) + 1))
    assert any(" from " in row["for"] for row in rows)
    again = tmp_path / "again"
    words = ["--campaign", str(planned / "points.csv"), "--suspects", SUSPECTS, "--add", "0", "-o", str(again)]
    assert main(["plan", "ref90", *words]) == 0
    one, other = (json.loads((place / "summary.json").read_text()) for place in (planned, again))
    assert other["planned_readings"] == one["planned_readings"] + one["added_readings"]
    assert other["added_readings"] == 0


def test_further_meters(planned: Path) -> None:
    rows = list(csv.DictReader((planned / "sensors.csv").open()))
    names = {row["meter"] for row in rows}
    assert {"Q_in", "T_case", "Q_slipper", "torque_uncoupled", "p_chamber"} <= names
    counts = [int(row["pairs told apart"]) for row in rows]
    assert counts == sorted(counts, reverse=True)


def test_a_meter_is_asked_for_where_no_point_tells(planned: Path) -> None:
    """The torque meter read uncoupled tells its own zero from a constant drag; points are chosen anew beside it."""
    summary = json.loads((planned / "summary.json").read_text())
    equipped = summary["equipped"]
    assert [one["name"] for one in equipped["meters"]] == ["torque_uncoupled"]
    assert equipped["told"] > summary["told"]
    names = [one["name"] for one in summary["suspects"]]
    pair = names.index("seal_drag"), names.index("torque_offset")
    assert equipped["distances"][pair[0]][pair[1]] > summary["apart_sigma"] > summary["distances"][pair[0]][pair[1]]
    rows = list(csv.DictReader((planned / "points_with_meters.csv").open()))
    assert sum(int(row["repeats [1]"]) for row in rows) == 18 + equipped["added_readings"]
    assert equipped["added_readings"] <= 4
    assert "With a reading of the torque meter uncoupled from the pump as well" in (
        (planned / "report.html").read_text().replace("\u00a0", " ")
    )


def test_a_bench_that_has_a_meter_beside_its_points_plans_with_it(planned: Path, tmp_path: Path) -> None:
    """The torque meter read uncoupled, of the bench's own: the same points tell the pair, and no page asks for it."""
    own = ["--sensors", "Q_out,Q_case,torque,torque_uncoupled"]
    assert main(["plan", "ref90", *WORDS, *own, "--limit", "speed <= 1800 rpm", "-o", str(tmp_path / "run")]) == 0
    found = json.loads((tmp_path / "run" / "summary.json").read_text())
    without = json.loads((planned / "summary.json").read_text())
    names = [one["name"] for one in found["suspects"]]
    drag, zero = names.index("seal_drag"), names.index("torque_offset")
    assert without["distances_planned"][drag][zero] < 1.0 < found["distances_planned"][drag][zero]
    assert found["told"] > without["told"]
    assert "torque_uncoupled" not in {row["meter"] for row in csv.DictReader((tmp_path / "run/sensors.csv").open())}


def test_page_begins_with_its_answer_and_can_be_written_again(planned: Path) -> None:
    page = planned / "report.html"
    text = page.read_text()
    plain = text.replace("\u00a0", " ")
    assert "of 6" in plain
    assert "The planned test, 18 readings, tells" in plain
    assert '<table class="dense within">\n<tr><th>order' in text  # in the column of the page: its last cells are words
    page.unlink()
    assert main(["report", str(planned)]) == 0
    assert page.read_text() == text


def test_function_of_the_command(planned: Path) -> None:
    found = sf.open(planned)
    assert found.pairs == 6
    assert found.tables()[0][1][0] == ("pairs of suspects", "6")
    assert "speed" in found.to_xarray()


def _faults(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["plan", *words]) == 2
    return capsys.readouterr().err


def test_all_faults_come_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["ref90", "--suspects", "churnin,flow_lag,Q_in_gain", "--sensors", "Q_ot,torque=-1Nm", "--add", "x",
             "--limit", "sped <= 1800 rpm", "--limit", "speed <= 3 bar", "--limit", "fast", "--cost", "50%",
             "--apart", "0", "--plan", "gird", "--pressures", "20..99MPa:3", "-o", str(tmp_path / "run")]  # fmt: skip
    told = _faults(words, capsys)
    for expected in (
        "'churnin', nothing that is known", "churning", "'flow_lag', which steady readings do not show",
        "'Q_in_gain', the fault of a meter that the bench lacks", "'Q_ot', no meter of a bench", "Q_out",
        "torque=-1Nm", "--add\n    found:    'x'", "'sped', no input that a bench sets", "speed", "'fast'", "--cost",
        "--apart",
        "--plan\n    found:    'gird'", "try:      grid", "99 MPa",
    ):  # fmt: skip
        assert expected in told
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--suspects", "churning"], ("one, 'churning'", "two at least")),
        (["--sensors", "p_out"], ("no meter of what the pump does", "Q_out, Q_in, Q_case, torque")),
        (["--sensors", "torque=nan%"], ("torque=nan%", "a sigma above 0")),
        (["--sensors", "torque=0.2 bar"], ("torque=0.2 bar", "N m")),
        (["--sensors", "T_case=3 degC"], ("T_case=3 degC", "in K", "sigma above 0")),
        (["--sensors", "Q_out,torque_uncoupled"], ("torque_uncoupled", "torque beside it")),
        (["--further", "Q_slippr"], ("'Q_slippr', no meter of a bench", "Q_slipper")),
        (["--further", "torque"], ("'torque', a meter that the bench has", "Q_in")),
        (["--add-meters", "x"], ("--add-meters", "'x'")),
        (["--speeds", "1000,2000rpm", "--limit", "speed <= 1800 rpm"], ("2000 r/min", "1800 r/min")),
        (["--limit", "pressure <= 5 MPa", "--limit", "pressure >= 9 MPa"], ("pressure from 9 MPa to 5 MPa", "rises")),
        (["--campaign", "nowhere.csv"], ("'nowhere.csv', which is no file",)),
    ],
)
def test_faults(words: list[str], expected: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    told = _faults(["ref90", *words], capsys)
    for text in expected:
        assert text in told


def test_faults_of_a_campaign_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "points.csv"
    path.write_text("sped [rpm],pressure [bar]\n1000,200\n")
    assert "speed [rpm]" in _faults(["ref90", "--campaign", str(path)], capsys)
    path.write_text("speed [rpm],pressure [bar],repeats [1]\n1000,200,0\n1000,x,1\n")
    told = _faults(["ref90", "--campaign", str(path), "--suspects", "churnin"], capsys)
    assert "'x'" in told
    assert "'churnin'" in told
    path.write_text("speed [rpm],pressure [bar],repeats [1]\n1000,200,1.5\n1000,300,1\n")
    assert "1.5" in _faults(["ref90", "--campaign", str(path)], capsys)
    path.write_text("speed [rpm],pressure [bar]\n9000,200\n1000,900\n")
    told = _faults(["ref90", "--campaign", str(path), "--speeds", "1000rpm"], capsys)
    for text in ("--speeds\n    found:    beside --campaign", "speed 9000 r/min", "2100 r/min", "90 MPa", "35 MPa"):
        assert text in told
    path.write_text("speed [rpm],pressure [bar]\n")
    assert "one point at least" in _faults(["ref90", "--campaign", str(path)], capsys)


def test_a_suspect_too_small_to_show_is_told_by_its_size() -> None:
    """What would tell: the size from which it stands out, since distances grow with it; the meters beside it."""
    plain = {"words": "seal drag", "costs_efficiency": 0.01, "capped": False, "seen_sigma": 1.5}
    drain = plain | {"words": "thicker film", "costs_efficiency": 0.004}
    capped, hidden = plain | {"words": "lift", "capped": True}, plain | {"words": "nothing", "seen_sigma": 0.003}
    pairs = [(0, 1, ["Q_in"]), (1, 2, []), (2, 3, [])]
    never = [{"pair": [a, b], "unseen": [a, b], "reason": "unseen", "further": more} for a, b, more in pairs]
    told = {"suspects": [plain, drain, capped, hidden], "never_apart": never, "apart_sigma": 3.0}
    summary = told | {"cost_of_efficiency": 0.01, "further": [{"name": "Q_in", "words": "a meter"}]}
    rows = {one: (why, what) for one, why, what in never_rows(summary)}
    assert rows["seal drag from anything"] == (
        "too small at 1 point: it stands out by 1.5 of the 3.0 sigma needed, with these points",
        "a meter, or a size 2 times as large, --cost 2%",
    )
    assert rows["thicker film from anything"][1] == "a meter, or a size 2 times as large"
    assert rows["lift from anything"][1] == "no meter that is known here"
    assert rows["nothing from anything"] == (
        "hardly moves any reading of this bench, by 0.0 sigma with these points", "no meter that is known here",
    )  # fmt: skip


def test_names_of_many_suspects_stand_once() -> None:
    """Beside the rows, with the numbers of the columns: twice they leave no room for letters that can be read."""
    names = [f"another suspect of some length {at}" for at in range(30)]
    distances = np.full((30, 30), 4.0).tolist()
    summary = {"suspects": [{"words": name} for name in names], "distances": distances, "apart_sigma": 3.4}
    figure = apart_plot(summary | {"never_apart": []})
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.get_xticklabels()] == [str(at) for at in range(1, 31)]
    assert [text.get_text() for text in axes.get_yticklabels()] == [f"{name}  {at}" for at, name in enumerate(names, 1)]
    letters = axes.get_yticklabels()[0].get_fontsize() / 72.0
    assert letters / figure.get_figwidth() > 9.0 / 1056.0  # pixels, of a figure as wide as the page
