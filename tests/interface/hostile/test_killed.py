"""Killed at any moment (kill -9): what was kept stays, and no half file reads as a whole one."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from reynolds.numerics.files import append_whole, json_lines, replaced
from swashfilm.output.page import read_summary
from system.points.table.store import read_table
from system.work.kept_results import KeptPoints
from system.work.tasks import PartOutcome, PartStatus

ROOT = Path(__file__).resolve().parents[3]
ROWS = {"values": list(range(20_000))}
ENVIRONMENT = os.environ | {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def write_file(folder: Path, number: int) -> None:
    """A file of its own."""
    with replaced(folder / f"{number}.json") as beside:
        beside.write_text(json.dumps(ROWS))


def write_again(folder: Path, number: int) -> None:
    """The same file, every time anew."""
    write_file(folder, 0)


def write_point(folder: Path, number: int) -> None:
    """A point of a map or a table."""
    KeptPoints(folder).put(PartOutcome(str(number), PartStatus.SOLVED, "", ROWS, 1.0, "here"))


def killed_while(write: Callable[[Path, int], None], folder: Path, seconds: float) -> int:
    """Number of calls that had ended when the process that makes them one after the other was killed."""
    told, tells = os.pipe()
    child = os.fork()
    if not child:
        try:
            for number in range(1_000_000):
                write(folder, number)
                os.write(tells, b".")
        finally:
            os._exit(1)
    time.sleep(seconds)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    os.close(tells)
    with os.fdopen(told, "rb") as ended:
        return len(ended.read())


@pytest.mark.parametrize("write", [write_file, write_again, write_point])
def test_files_are_whole_or_absent(write, tmp_path):
    draw = random.Random(25)
    for kill in range(8):
        folder = tmp_path / str(kill)
        folder.mkdir()
        ended = killed_while(write, folder, draw.uniform(0.02, 0.2))
        kept = sorted(folder.glob("*.json"))
        assert len(kept) >= (min(ended, 1) if write is write_again else ended)
        assert all(json.loads(path.read_text()) for path in kept)
        if write is write_point:
            assert all(KeptPoints(folder).get(path.stem).record == ROWS for path in kept)


def test_rows_are_whole(tmp_path):
    def write(folder: Path, number: int) -> None:
        append_whole(folder / "rows.jsonl", json.dumps({"number": number, "text": "x" * 3000}).encode() + b"\n")

    place = tmp_path / "rows.jsonl"
    for _ in range(8):
        ended = killed_while(write, tmp_path, 0.05)
        rows = json_lines(place)
        assert all(len(row["text"]) == 3000 for row in rows)
        assert len(rows) >= ended
        place.unlink(missing_ok=True)  # killed before its first row, the writer leaves no file


def test_rows_behind_an_unfinished_one_are_read(tmp_path):
    """Killed in the middle of a row, whatever its place in it; the next run's row begins on a line of its own."""
    place, row = tmp_path / "rows.jsonl", b'{"number": 1}'
    for cut in range(1, len(row)):
        place.write_bytes(b'{"number": 0}\n' + row[:cut])
        append_whole(place, b'{"number": 2}\n')
        assert [one["number"] for one in json_lines(place)] == [0, 2]


def starts(command: list[str], kept: Callable[[], set[Path]], most: int) -> Iterator[set[Path]]:
    """Start a command again and again, kill it as soon as it has kept something new; what it had kept each time."""
    for _ in range(most):
        before = kept()
        run = subprocess.Popen(command, cwd=ROOT, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        while run.poll() is None and kept() == before:
            time.sleep(0.01)
        if run.poll() is not None:
            assert run.returncode == 0, run.stderr.read().decode()
            return
        run.kill()
        run.wait()
        yield kept()
    raise AssertionError(f"not at its end after {most} starts")


@pytest.mark.long
def test_a_table_killed_after_every_point_goes_on(tmp_path, monkeypatch):
    """Points that were kept are not solved again; a table is there only when it is whole."""
    monkeypatch.setitem(ENVIRONMENT, "SWASHFILM_CACHE", str(tmp_path / "cache"))
    out, points = tmp_path / "out", tmp_path / "cache" / "tables" / "points"
    command = [
        sys.executable, "-m", "swashfilm", "table", "ref90", "--speed", "2100rpm", "--displacement", "1",
        "--temperature", "50degC", "--pressure", "20MPa..35MPa", "--points", "4", "--held-out", "2", "-o", str(out),
    ]  # fmt: skip

    def kept() -> set[Path]:
        return set(points.glob("*.json"))

    first: dict[Path, bytes] = {}
    for known in starts(command, kept, 12):
        assert not out.exists()
        assert not list(points.parent.glob("*.json"))
        assert all(path.read_bytes() == text for path, text in first.items())
        first |= {path: path.read_bytes() for path in known}
    assert len(first) >= 4
    read_summary(out)
    read_table(out / "table.json")


@pytest.mark.long
def test_a_proof_killed_after_every_case_goes_on(tmp_path):
    results, page = tmp_path / "proof", tmp_path / "proof.md"
    command = [
        sys.executable, "benchmarks/proof.py", "--part", "null", "--cases", "3", "--development",
        "--results", str(results), "--page", str(page),
    ]  # fmt: skip

    def kept() -> set[Path]:
        return set(results.glob("*.json"))

    first: dict[Path, bytes] = {}
    for known in starts(command, kept, 6):
        assert not page.exists()
        assert all(path.read_bytes() == text for path, text in first.items())
        assert all(json.loads(path.read_text())["verdict"] for path in known)
        first |= {path: path.read_bytes() for path in known}
    assert len(first) >= 2
    assert page.read_text().endswith("\n")
