"""Commands that the program suggests: pasted into a shell, each names the files meant, spaces or not."""

from __future__ import annotations

import argparse
import shlex
import shutil
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from swashfilm.console.inputs import expect
from swashfilm.output.run_folder import Interrupted, run_folder
from swashfilm.runs.map.files import map_file
from swashfilm.runs.reproduce.command import _command, add_reproduce_options
from system import InputFaults
from system.inputs.toml_table import toml_tables

OPEN06 = Path(__file__).parents[3] / "examples" / "recordings" / "open-06"
PLATE = ("--displacement", "45 cm3", "--pistons", "9", "--oil", "ISO VG 46", "--speed", "2600 rpm")


def _words(text: str, command: str) -> list[str]:
    """The words after a command in a message, as a shell parts them."""
    line = next(one for one in text.splitlines() if command in one)
    return shlex.split(line[line.index(command) + len(command) :])


def test_the_next_command_of_a_new_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "Prüf lauf"
    folder.mkdir()
    table = folder / "neue Messung.csv"
    shutil.copy(OPEN06 / "steady.csv", table)
    assert main(["new", "recording", str(table)]) == 0
    told = capsys.readouterr().out
    assert _words(told, "swashfilm check") == [str(table)]
    assert _words(told, "swashfilm diagnose PUMP") == [str(table)]
    (folder / "recording.toml").unlink()
    assert main(["check", str(table)]) == 2
    assert _words(capsys.readouterr().err, "swashfilm new recording") == [str(table)]
    film = folder / "mein Film.toml"
    assert main(["new", "film", "slider", "-o", str(film)]) == 0
    assert _words(capsys.readouterr().out, "swashfilm film") == [str(film)]
    pump = folder / "Pumpe neu.toml"
    options = ("--pressure", "350 bar", "--circuit", "open")
    assert main(["new", "pump", *PLATE, *options, "-o", str(pump)]) == 0
    assert _words(capsys.readouterr().out, "swashfilm run")[0] == str(pump)
    assert "swashfilm check 'Pumpe neu.toml'" in pump.read_text("utf-8")
    with pytest.raises(InputFaults) as fault:
        expect(film, "pump", "film")
    assert f"swashfilm film '{film}'" in str(fault.value)
    with pytest.raises(InputFaults) as fault:
        map_file(pump)
    assert f"swashfilm map '{pump}'" in str(fault.value)


@pytest.mark.parametrize("kept", [False, True])
def test_the_same_command_again(
    kept: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    partial = tmp_path / "ein Lauf.partial"
    (partial / "points").mkdir(parents=True)

    def stop(_: list[str]) -> int:
        raise Interrupted(partial if kept else None)

    monkeypatch.setattr("swashfilm.cli.app.run_command", stop)
    words = ["map", "Pumpe neu.toml", "--set", "piston.radial_clearance=14 um"]
    assert main(words) == 130
    resumed = ["--resume", str(partial)] if kept else []
    assert _words(capsys.readouterr().err, ": swashfilm map") == [*words[1:], *resumed]


def test_an_option_with_spaces_in_the_command_of_a_page() -> None:
    parser = argparse.ArgumentParser()
    add_reproduce_options(parser)
    words = ["fig2", "--fidelity", "lumped", "--pump", "Pumpe neu.toml", "--set", "piston.radial_clearance=14 um"]
    words += ["--page", "meine Seite.md"]
    assert shlex.split(_command(parser.parse_args(words)))[2:] == words


def test_where_solved_points_are_kept(tmp_path: Path) -> None:
    def stopped() -> None:
        with run_folder("any", tmp_path / "mein Lauf") as folder:
            (folder / "points").mkdir()
            (folder / "points" / "1.json").touch()
            raise ValueError(str(folder))

    with pytest.raises(ValueError, match="mein Lauf") as reason:
        stopped()
    assert shlex.split(reason.value.__notes__[0].partition("--resume ")[2]) == [str(reason.value)]


@pytest.mark.parametrize("command", ["diagnose", "calibrate"])
def test_pump_and_recording_in_the_other_order(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A folder and a recording.toml in the place of PUMP, a pump file and a built-in pump in that of RECORDING."""
    pump = tmp_path / "Pumpe neu.toml"
    pump.write_text("[pump]\npistons = 9\n", "utf-8")
    for recording, known in ((OPEN06, pump), (OPEN06 / "recording.toml", pump), (OPEN06, Path("ref90"))):
        assert main([command, str(recording), str(known)]) == 2
        told = capsys.readouterr().err
        assert "PUMP and RECORDING swapped?" in told
        assert _words(told, f"swapped? swashfilm {command}") == [str(known), str(recording)]
    assert main([command, str(tmp_path / "none"), str(pump)]) == 2
    assert "swapped" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("line", "near"),
    [
        ('Q_out = { column = "Q", unit = "l/min", sigma = 0,1 }', "sigma = 0.1"),
        ('Q_out = { sigma = -2,5, unit = "l/min" }', "sigma = -2.5"),
        ("gain = 0,1", "0.1"),
        ('Q_out = { column = "Q" ', ""),
    ],
)
def test_a_decimal_comma_in_a_file_is_told(line: str, near: str) -> None:
    with pytest.raises(InputFaults) as fault:
        toml_tables("recording.toml", f"[channel]\n{line}\n")
    (one,) = fault.value.faults
    assert one.nearest == near
    assert ("decimals with a point" in one.expected) == bool(near)
