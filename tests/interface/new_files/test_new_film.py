"""`swashfilm new film`: a commented case of each kind, which is its schema's, checks clean and solves."""

import pytest
from jsonschema import Draft202012Validator

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.cli.new.film import film_kinds
from swashfilm.console.schemas import schema_of
from system.inputs.toml_table import read_toml

KINDS = list(film_kinds())
SCHEMA = Draft202012Validator(schema_of("case"))
CLOSED_FORMS = {"step_pad": 60.9677, "slider": 47.6649, "loaded_pad": 19.066}
"""Loads in N: Rayleigh's step and slope, the stated load of the pad."""


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_is_commented_and_checks(kind, tmp_path, capsys):
    path = sf.new("film", kind, output=tmp_path / "mine.toml")
    text = path.read_text("utf-8")
    assert text.startswith("#:schema ./case.schema.json\n# ")
    assert text.count(" # ") >= 2
    assert not list(SCHEMA.iter_errors(read_toml(path)[1]))
    assert main(["check", str(path)]) == 0
    assert "ok" in capsys.readouterr().out


@pytest.mark.parametrize(("kind", "load"), CLOSED_FORMS.items())
def test_free_films_bear_the_load_that_is_known(kind, load, tmp_path):
    assert sf.film(sf.new("film", kind, output=tmp_path / "mine.toml")).load == pytest.approx(load, rel=1e-3)


def test_the_journal_bears_the_load_of_its_sommerfeld_number(tmp_path):
    """Raimondi and Boyd 1958, converged: 1.31598 mu omega L D (R/C)^2 at 50.529 deg; the mesh errs by 0.3 %."""
    found = sf.film(sf.new("film", "journal", output=tmp_path / "mine.toml"))
    assert found.bearing_load == pytest.approx(1.31598 * 0.03 * 100.0 * 0.05 * 0.05 * 500.0**2, rel=3e-3)
    assert found.summary["attitude_angle_deg"] == pytest.approx(50.529, rel=3e-3)


@pytest.mark.parametrize("kind", ["piston", "slipper", "valve_plate"])
def test_gaps_solve(kind, tmp_path):
    assert sf.film(sf.new("film", kind, output=tmp_path / "mine.toml")).carried_load > 0.0


def test_the_study_solves(tmp_path):
    assert len(sf.study(sf.new("film", "study", output=tmp_path / "mine.toml")).to_pandas()) == 12


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=() if kind == "slipper_turn" else pytest.mark.long)
        for kind in KINDS
        if kind.endswith("_turn")
    ],
)
def test_turns_solve(kind, tmp_path):
    text = sf.new("film", kind, output=tmp_path / "mine.toml").read_text("utf-8")
    coarse = text.replace("steps = 120", "steps = 36").replace("steps = 126", "steps = 36")
    assert sf.film(coarse, rigid=True).film_thickness_min > 0.0


def test_the_usual_file_is_named_by_its_kind(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "film", "journal"]) == 0
    assert "swashfilm film journal.toml" in capsys.readouterr().out
    assert {path.name for path in tmp_path.iterdir()} == {"journal.toml", "case.schema.json"}


def test_unknown_kinds_get_the_nearest(tmp_path):
    with pytest.raises(sf.InputFaults) as refused:
        sf.new("film", "valve-plat", output=tmp_path / "none" / "mine.txt", pistons=9)
    assert {(fault.path, fault.nearest) for fault in refused.value.faults} >= {("KIND", "valve_plate")}
    assert {fault.path for fault in refused.value.faults} == {"KIND", "output", "pistons"}
