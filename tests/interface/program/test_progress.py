"""Progress: lines with the remaining time in a log, a bar on a terminal."""

import io
import itertools
import re

import pytest
from numba.core import event

from swashfilm.__main__ import main
from swashfilm.console import progress as module
from swashfilm.console.progress import BeforeWriting, progress


@pytest.fixture
def clock(monkeypatch):
    """A clock that goes on by two seconds whenever it is asked."""
    ticks = itertools.count(100.0, 2.0)
    monkeypatch.setattr(module.time, "monotonic", lambda: next(ticks))


def test_a_log_gets_the_first_line_the_last_and_one_every_few_seconds(clock):
    log = io.StringIO()
    with progress(5, "work", log) as step:
        for done in range(6):
            step(done, 5, "films")
    assert log.getvalue().splitlines() == [
        "work: 0/5 films (2.0 s)",
        "work: 3/5 films (8.0 s, 5 s to go)",
        "work: 5/5 films (12.0 s)",
    ]


def test_a_new_round_is_timed_from_its_own_beginning(clock):
    log = io.StringIO()
    with progress(10, "work", log) as step:
        for done in (1, 9, 10, 1, 2, 3, 4):
            step(done, 10, "films")
    assert log.getvalue().splitlines()[-1] == "work: 3/10 films (12.0 s, 9 s to go)"


def test_compilation_is_told_and_does_not_count_in_the_remaining_time(monkeypatch):
    """Ten seconds of kernels, one within another, in a round whose two steps take two."""
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    log, kernel = io.StringIO(), {"dispatcher": None}
    with progress(4, "work", log) as step:
        with event.trigger_event("numba:compile", kernel):
            now[0] += 4.0
            with event.trigger_event("numba:compile", kernel):
                now[0] += 6.0
        now[0] += 2.0
        step(2, 4, "films")
    assert log.getvalue().splitlines() == [
        "work: compiling the solvers for this machine, once; later runs do without",
        "work: 2/4 films (12.0 s, 2 s to go)",
        "work: compiled in 10 s",
    ]


def test_a_short_compilation_is_not_told(monkeypatch):
    monkeypatch.setattr(module.time, "monotonic", lambda: 100.0)
    log = io.StringIO()
    with progress(4, "work", log), event.trigger_event("numba:compile", {}):
        pass
    assert log.getvalue() == ""


def test_steps_that_are_not_known_have_no_count_and_no_time(clock):
    log = io.StringIO()
    with progress(0, "work", log) as step:
        for done in range(4):
            step(done, 0, "films")
        step(4, 8, "films")
    assert log.getvalue().splitlines() == ["work: films (2.0 s)", "work: films (8.0 s)"]


def test_the_folder_is_a_stage_of_its_own_in_the_remaining_time(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    log = io.StringIO()
    with progress(0, "work", log) as report:
        solving = BeforeWriting(report, 0.25)
        for done, time in ((0, 100.0), (10, 110.0), (20, 120.0)):
            now[0] = time
            solving(done, 20, "films")
        solving.writing()
    assert log.getvalue().splitlines() == [
        "work: 0/25 films (0.0 s)",
        "work: 10/25 films (10.0 s, 15 s to go)",
        "work: 20/25 films (20.0 s, 5 s to go)",
        "work: 20/25 writing fields, pictures and report (20.0 s, 5 s to go)",
    ]


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("run ref90 --fidelity lumped", "run ref90: writing fields, pictures and report"),
        ("map ref90 --fidelity lumped --pressures 10,20MPa --speeds 1000rpm --displacements 1 --check 0 --workers 1",
         "map ref90: 2/2 writing the map and its pictures"),
    ],
)  # fmt: skip
def test_a_command_tells_that_it_writes(tmp_path, capsys, command, told):
    assert main([*command.split(), "-o", str(tmp_path / "run")]) == 0
    assert told in capsys.readouterr().err


def test_a_terminal_gets_a_bar():
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    screen = Terminal()
    with progress(2, "work", screen) as step:
        step(1, 2, "films")
        step(0, 4, "again")
        step(4, 0, "unknown")
        step(4, 4, "done")
    assert re.search(r"work.*/4", screen.getvalue(), re.DOTALL)
