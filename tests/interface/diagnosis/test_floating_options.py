"""`swashfilm diagnose --fidelity floating`: what its options refuse, all faults at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from swashfilm.__main__ import main

SCANT = """format = 1
name = "scant"
[pump]
displacement = "45 cm3/rev"
pistons = 9
[oil]
kinematic_viscosity_40C = "46 mm2/s"
kinematic_viscosity_100C = "6.8 mm2/s"
"""


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """The message on words that are refused with exit 2."""
    assert main(["diagnose", *words]) == 2
    return capsys.readouterr().err


def test_options_of_floating_films_ask_for_them(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    said = refused(capsys, "ref90", str(tmp_path), "--points", "12", "--rigid", "--variant", "worn_profile=x.toml")
    for option in ("--points", "--rigid", "--variant"):
        assert option in said
    assert said.count("--fidelity floating beside it") == 3


def test_a_wrong_fidelity_has_its_nearest(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    said = refused(capsys, "ref90", str(tmp_path), "--fidelity", "floatin")
    assert "'floatin'" in said
    assert "one of lumped, floating" in said


def test_variants_are_an_effect_and_a_file(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    words = ("--fidelity", "floating", "--variant", "worn_profil=x.toml", "--points", "2", "--film-tables")
    said = refused(capsys, "ref90", str(tmp_path), *words)
    assert "worn_profile" in said
    assert "4 to 10000" in said
    assert "--film-tables" in said
    said = refused(capsys, "ref90", str(tmp_path), "--fidelity", "floating", "--variant", "worn_profile=nowhere.toml")
    assert "nowhere.toml" in said


def test_floating_films_need_a_whole_pump_and_no_watch(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    scant = tmp_path / "scant.toml"
    scant.write_text(SCANT, encoding="utf-8")
    assert "a pump file stated in full" in refused(capsys, str(scant), str(tmp_path), "--fidelity", "floating")
    said = refused(capsys, "ref90", str(tmp_path), "--fidelity", "floating", "--watch")
    assert "tables belong to a recording" in said
