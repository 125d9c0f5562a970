"""A floating run that stops: its folder keeps the rounds and gaps solved until then, and the message names it."""

import json
from pathlib import Path

import pytest
import xarray

from reynolds import FilmNotConverged
from swashfilm.__main__ import main

pytestmark = pytest.mark.slow

COARSE = [
    "run", "ref90", "--pressure", "5 MPa", "--speed", "1000 rpm", "--rigid", "--isothermal", "--steps", "36",
    "--finer", "0.25",
]  # fmt: skip
SERIES = ("piston", "slipper", "valve_plate")
PARTIAL = Path("runs/ref90-1.partial")


@pytest.fixture(autouse=True)
def alone(tmp_path, monkeypatch):
    """An empty folder, and one process, in which the piston is solved before the slipper."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("system.work.processes.cores", lambda: 1)


def failed():
    return json.loads((PARTIAL / "failed.json").read_text("utf-8"))


def test_rounds_that_do_not_settle_are_kept_with_the_films_of_the_last(monkeypatch, capsys):
    monkeypatch.setattr("system.points.floating.ROUND_LIMIT", 2)
    assert main(COARSE) == 3
    text = capsys.readouterr().err
    assert f"What was solved until then is kept in {PARTIAL}" in text
    assert "No result was written" not in text
    found = failed()
    assert (found["state"], found["name"]) == ("failed", "ref90")
    assert "after 2 rounds the pressure still changes by" in found["error"]
    first, second = found["rounds"]
    assert second["pressure_change"] < first["pressure_change"]
    assert {gap: own["round"] for gap, own in found["gaps"].items()} == dict.fromkeys(SERIES, 2)
    for gap in SERIES:
        head, *rows = (PARTIAL / f"{gap}.csv").read_text("utf-8").splitlines()
        assert head.startswith("shaft_angle [deg],")
        assert len(rows) == (4 if gap == "valve_plate" else 36)
        with xarray.open_dataset(PARTIAL / "results.nc", group=gap, engine="h5netcdf") as data:
            thinnest = float(data["film_thickness_min"].min())
        assert thinnest == pytest.approx(found["gaps"][gap]["film_thickness_min_m"])
    assert 'pressure = "5 MPa"' in (PARTIAL / "resolved.toml").read_text("utf-8")
    assert main(["report", str(PARTIAL)]) == 2


def test_a_slipper_without_film_leaves_the_piston_of_its_round(monkeypatch, capsys):
    def no_film(*_, **__):
        raise FilmNotConverged("slipper: at 200 deg its lands lift 90 %", "wider lands")

    monkeypatch.setattr("system.points.floating_kinds.slipper_revolution", no_film)
    assert main(COARSE) == 3
    assert str(PARTIAL) in capsys.readouterr().err
    found = failed()
    assert found["error"] == "slipper: at 200 deg its lands lift 90 %. Try: wider lands"
    assert found["rounds"] == []
    assert {gap: own["round"] for gap, own in found["gaps"].items()} == {"piston": 1}
    assert (PARTIAL / "piston.csv").is_file()


def test_ctrl_c_keeps_what_is_solved(monkeypatch, capsys):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("system.points.floating_kinds.block_revolution", stopped)
    assert main(COARSE) == 130
    assert f"the finished part is kept in {PARTIAL}" in capsys.readouterr().err
    assert failed()["state"] == "interrupted"
    assert set(failed()["gaps"]) == {"piston", "slipper"}
