"""`swashfilm diagnose`: what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest
from recording_heads import HEAD

from swashfilm.__main__ import main

RECORDING = f"""{HEAD}p_out = {{ column = "p", unit = "bar", sigma = 0.3 }}
Q_case = {{ column = "q", unit = "L/min", sigma = 0.02 }}
"""


def _folder(tmp_path: Path, rows: str, recording: str = RECORDING) -> Path:
    (tmp_path / "recording.toml").write_text(recording, encoding="utf-8")
    (tmp_path / "steady.csv").write_text("n,p,q\n" + rows, encoding="utf-8")
    return tmp_path


def test_too_few_readings_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two readings settle no thirty parameters: exit code 2, and nothing is left behind."""
    folder = _folder(tmp_path, "1000,100.1,1.02\n1500,200.2,2.13\n")
    assert main(["diagnose", "ref90", str(folder), "-o", str(tmp_path / "out")]) == 2
    assert "at 2 operating points" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_missing_recording_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diagnose", "ref90", str(tmp_path / "nowhere")]) == 2
    assert "no such file" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["diagnose"], ["diagnose", "ref90"], ["diagnose", "ref90", "x", "--quick"]])
def test_words_that_are_wrong_or_missing_are_told(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    error = capsys.readouterr().err
    assert "RECORDING" in error or "--quick" in error


def test_the_nearest_option_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diagnose", "ref90", "x", "--aply", "found.toml"]) == 2
    assert "--apply" in capsys.readouterr().err.partition("--aply")[2]


def test_an_unknown_pump_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = _folder(tmp_path, "1000,100.1,1.02\n")
    assert main(["diagnose", "ref91", str(folder)]) == 2
    assert "ref91" in capsys.readouterr().err
