"""`swashfilm diagnose --watch`: files that arrive, half-written ones, what changes in the answer, and its end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from diagnosis.report.text import headline
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from swashfilm.__main__ import main
from swashfilm.runs.diagnose import watch as room
from swashfilm.runs.diagnose.watch import Answer, answer_of, compared, recorded_files, watch
from system import Fault, InputFaults

PAGE = Path("runs/diagnose-1/report.html")
NAMED = Answer("Cause found.", {"churning": 0.97}, 40, PAGE)
NOTHING = Answer("No mismatch.", {}, 24, PAGE)


def _watched(folder: Path, steps: list[Callable[[], object]], answers: Iterator[Answer | InputFaults]) -> list[str]:
    """Lines of a watch during which a step is done at every second look that finds the folder still."""
    lines: list[str] = []
    looks = iter(step for one in steps for step in (*[lambda: None] * room.SETTLE, one))

    def pause(_: float) -> None:
        step = next(looks, None)
        if step is None:
            raise KeyboardInterrupt
        step()

    def diagnosed() -> Answer:
        found = next(answers)
        if isinstance(found, InputFaults):
            raise found
        return found

    with pytest.raises(KeyboardInterrupt):
        watch(folder, diagnosed, lines.append, pause)
    return lines


def test_each_change_gives_a_line_and_a_half_written_file_is_waited_out(tmp_path: Path) -> None:
    table = tmp_path / "steady.csv"
    (tmp_path / "recording.toml").write_text('[steady]\nfile = "steady.csv"\n')
    bare = InputFaults("recording.toml", [Fault("file", "no such file", "a recording")])
    half = InputFaults("steady.csv", [Fault("steady.file", "row 3 with 2 cells", "9 cells")])
    steps: list[Callable[[], object]] = [
        lambda: table.write_text("n,p"),
        lambda: table.write_text("n,p,q\n1,2,3\n"),
        lambda: None,
        lambda: table.write_text("n,p,q\n1,2,3\n4,5,6\n"),
        lambda: None,
    ]
    empty, first, *more = _watched(tmp_path, steps, iter([bare, half, NOTHING, NAMED]))
    assert "no such file" in empty
    assert "not diagnosed, waiting" in first
    assert "row 3 with 2 cells" in first
    assert [line[9:].partition(":")[0] for line in more] == ["first answer", "the answer has changed"]
    assert all(line.endswith(f"; {PAGE}") for line in more)


def test_what_changes_in_an_answer_is_said() -> None:
    likelier = Answer(NAMED.verdict, {"churning": 0.8}, 60, PAGE)
    assert compared(None, NAMED) == "first answer: Cause found: churning (probability 0.97), 40 points"
    assert compared(NAMED, NAMED).startswith("the same answer: ")
    assert "another probability" in compared(NAMED, likelier)
    assert compared(NOTHING, NAMED).endswith("before: No mismatch, 24 points")


def test_tables_in_other_folders_are_watched(tmp_path: Path) -> None:
    folder = tmp_path / "recording"
    folder.mkdir()
    (tmp_path / "far.csv").touch()
    (folder / "recording.toml").write_text('[steady]\nfile = "../far.csv"\n')
    assert {path.name for path in recorded_files(folder)} == {"recording.toml", "far.csv"}
    (folder / "recording.toml").write_text('[steady]\nfile = "../f')
    assert {path.name for path in recorded_files(folder)} == {"recording.toml"}


def test_other_files_of_the_folder_are_not_watched(tmp_path: Path) -> None:
    """A file that recording.toml does not name, and a run folder, start no diagnosis."""
    (tmp_path / "recording.toml").write_text('[steady]\nfile = "steady.csv"\n')
    (tmp_path / "steady.csv").write_text("n,p\n1,2\n")
    steps: list[Callable[[], object]] = [
        lambda: (tmp_path / "other.csv").write_text("garbage"),
        lambda: (tmp_path / "runs").mkdir(),
        lambda: None,
    ]
    assert len(_watched(tmp_path, steps, iter([NOTHING]))) == 1


def test_faults_are_told_apart_in_their_line(tmp_path: Path) -> None:
    faults = InputFaults("recording.toml", [Fault("a", "1", "2"), Fault("steady.file", "no such file", "a table")])
    (line,) = _watched(tmp_path, [lambda: None, lambda: None], iter([faults]))
    assert line.endswith("recording.toml; a: 1, expected 2; steady.file: no such file, expected a table")


def test_an_answer_is_told_as_on_its_page(named: Diagnosis) -> None:
    answer = answer_of(named, 40, PAGE)
    assert answer.verdict == headline(named)
    assert "probability" in answer.text
    suspicion = answer_of(replace(named, status=VerdictStatus.SUSPICION), 40, PAGE)
    assert suspicion.verdict == "Readings and simulation differ, but not clearly enough to name a cause"


def test_the_help_says_what_a_watch_cannot_have(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["diagnose", "--help"])
    assert "not beside -o or --apply" in " ".join(capsys.readouterr().out.split())


def test_ctrl_c_ends_a_watch_as_any_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(_: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(watch, "__defaults__", (stop,))
    assert main(["diagnose", "ref90", "--watch", str(tmp_path)]) == 130
    told = capsys.readouterr()
    assert "watching" in told.out
    assert "interrupted" in told.err


def test_a_watch_tells_faults_of_film_options(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["diagnose", "ref90", str(tmp_path), "--watch", "--fidelity", "lumpd"]) == 2
    assert "one of lumped" in capsys.readouterr().err
    assert main(["diagnose", "ref90", str(tmp_path), "--watch", "--points", "64"]) == 2
    assert "--fidelity floating beside it" in capsys.readouterr().err


def test_a_watch_needs_a_folder_and_writes_no_single_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["diagnose", "ref90", str(tmp_path / "none"), "--watch", "--apply", str(tmp_path / "found.toml")]
    assert main(words) == 2
    error = capsys.readouterr().err
    assert "no folder" in error
    assert "beside --watch" in error
