"""Work in parts: kept by content, resumed, and whole but for the parts that fail or kill their process."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest

from reynolds import FilmNotConverged, InputError
from system.work.kept_results import KeptPoints, points_of_run, run_kept
from system.work.processes import ProcessPool, WorkerDied, process_pool
from system.work.tasks import PartStatus

PARTS = list(range(8))


@dataclass(frozen=True)
class Squares:
    """A file is left a solve; some parts fail, and some kill their process: `once` or at every try."""

    folder: Path
    seconds: float = 0.0
    faulty: int = -1
    stalls: int = -1
    breaks: int = -1
    kills: int = -1
    kills_once: int = -1

    def key(self, part):
        return f"square-{part}"

    def solve(self, part):
        tries = len(list(self.folder.glob(f"{part}-*")))
        (self.folder / f"{part}-{tries}").touch()
        time.sleep(self.seconds)
        if part == self.faulty:
            raise InputError("part", str(part), "another")
        if part == self.stalls:
            raise FilmNotConverged("it stalls", "nothing")
        if part == self.breaks:
            raise ZeroDivisionError("a bug")
        if part == self.kills or (part == self.kills_once and not tries):
            os.kill(os.getpid(), signal.SIGKILL)
        return {"square": part**2}

    def solves(self):
        return len(list(self.folder.iterdir()))


@pytest.fixture
def solves(tmp_path):
    folder = tmp_path / "solves"
    folder.mkdir()
    return folder


def test_what_is_kept_is_not_done_again(solves, tmp_path):
    work, store = Squares(solves), KeptPoints(tmp_path / "points")
    first = run_kept(work, PARTS[:5], store, ProcessPool(1))
    assert [outcome.record["square"] for outcome in first.outcomes] == [0, 1, 4, 9, 16]
    told = []
    again = run_kept(work, PARTS, store, ProcessPool(1), report=lambda *step: told.append(step))
    assert (again.known, work.solves()) == (5, 8)
    assert told[0] == (0, 3, "5 points kept")
    assert told[-1] == (3, 3, "solved")
    elsewhere = KeptPoints(tmp_path / "resumed" / "points")
    run_kept(work, PARTS, elsewhere, ProcessPool(1), earlier=points_of_run(tmp_path))
    assert work.solves() == 8
    assert len(list(elsewhere.folder.glob("*.json"))) == 8


def test_a_part_that_fails_says_why_and_stops_no_other(solves, tmp_path):
    work = Squares(solves, faulty=1, stalls=3, breaks=5)
    found = run_kept(work, PARTS, KeptPoints(tmp_path / "points"), ProcessPool(1), batch=3).outcomes
    assert [outcome.status for outcome in found].count(PartStatus.SOLVED) == 5
    assert found[1].status is PartStatus.FAULTY
    assert found[3].status is PartStatus.NOT_CONVERGED
    assert found[3].reason.startswith("it stalls")
    assert found[5].status is PartStatus.INTERNAL
    assert found[5].reason.startswith("ZeroDivisionError: a bug (")
    assert "test_kept_points.py" in found[5].reason
    run_kept(work, PARTS, KeptPoints(tmp_path / "points"), ProcessPool(1))
    assert work.solves() == 10  # what would fail again the same way is kept with its reason


def test_a_broken_file_is_done_anew(solves, tmp_path, caplog):
    work, store = Squares(solves), KeptPoints(tmp_path / "points")
    run_kept(work, PARTS, store, ProcessPool(1))
    (store.folder / "square-2.json").write_text("{")
    assert run_kept(work, PARTS, store, ProcessPool(1)).known == 7
    assert "square-2.json is broken" in caplog.text
    assert json.loads((store.folder / "square-2.json").read_text())["record"] == {"square": 4}


def test_a_number_that_is_none_is_told(tmp_path, solves):
    class Void(Squares):
        def solve(self, part):
            return {"square": float("nan")}

    (found,) = run_kept(Void(solves), [1], KeptPoints(tmp_path / "points"), ProcessPool(1)).outcomes
    assert found.status is PartStatus.INTERNAL
    assert not (tmp_path / "points").exists()


@pytest.mark.slow
def test_a_process_that_dies_costs_its_part_only(solves, tmp_path):
    """One part kills its process at every try, one only once; both go out with others, in batches of two."""
    work = Squares(solves, kills=3, kills_once=6)
    with process_pool(2) as executor:
        found = run_kept(work, PARTS, KeptPoints(tmp_path / "points"), executor, batch=2).outcomes
        assert sorted(executor.do(abs, [-1, -2])) == [1, 2]
    assert [outcome.status for outcome in found].count(PartStatus.SOLVED) == 7
    assert found[3].status is PartStatus.WORKER_DIED
    assert "died twice" in found[3].reason


@dataclass(frozen=True)
class InRows(Squares):
    """Squares done in rows."""

    def row(self):
        return self


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_a_part_of_a_row_is_kept_before_the_row_ends(solves, tmp_path, workers):
    """A row whose fourth part kills its process leaves three; alone, a row tells of each part as it is done."""
    store, told = KeptPoints(tmp_path / "kept"), []
    work = InRows(solves, kills=3 if workers == 2 else -1)
    with process_pool(workers) as pool:
        outcomes = run_kept(work, PARTS, store, pool, batch=4, report=lambda *said: told.append(said[0])).outcomes
    kept = {part for part in PARTS if store.get(f"square-{part}") is not None}
    if workers == 1:
        assert told == list(range(9))
        assert kept == set(PARTS)
    else:
        assert kept == set(PARTS) - {3}
        assert outcomes[3].status is PartStatus.WORKER_DIED
        # The first three were kept as they were done; the fourth is tried twice in its row and twice alone.
        assert [len(list(solves.glob(f"{part}-*"))) for part in range(4)] == [1, 1, 1, 4]


def test_do_raises_what_a_part_raised():
    with process_pool(2) as executor:
        with pytest.raises(ZeroDivisionError):
            list(executor.do(divided, [1, 0, 2]))
        with pytest.raises(WorkerDied):
            list(executor.do(killed, [1, 2]))


def divided(number):
    return 1 / number


def killed(number):
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
def test_a_killed_run_costs_what_was_at_work(solves, tmp_path):
    """The run is killed outright; its processes go with it, and only what was at work is solved again."""
    run = subprocess.Popen([sys.executable, __file__, str(solves), str(tmp_path / "points")])
    store, deadline = KeptPoints(tmp_path / "points"), time.monotonic() + 300.0
    while len(list(store.folder.glob("*.json"))) < 3 and time.monotonic() < deadline:
        time.sleep(0.02)
    run.kill()
    run.wait()
    time.sleep(2.0)
    kept, begun = len(list(store.folder.glob("*.json"))), len(list(solves.iterdir()))
    # The kill may come between two parts, when nothing is at work.
    assert 3 <= kept <= begun <= kept + 2
    assert kept < len(PARTS)
    assert run_kept(Squares(solves), PARTS, store, ProcessPool(1)).known == kept
    assert Squares(solves).solves() == begun + len(PARTS) - kept


@pytest.mark.slow
@pytest.mark.parametrize("times", [1, 2])
def test_ctrl_c_ends_a_run_whose_parts_at_work_are_kept(solves, tmp_path, times):
    """Once: the parts at work are ended and kept. Twice at once, as some shells send it: the run ends all the same."""
    run = subprocess.Popen([sys.executable, __file__, str(solves), str(tmp_path / "points")], stderr=subprocess.DEVNULL)
    store, deadline = KeptPoints(tmp_path / "points"), time.monotonic() + 300.0
    while len(list(store.folder.glob("*.json"))) < 2 and time.monotonic() < deadline:
        time.sleep(0.02)
    for _ in range(times):
        run.send_signal(signal.SIGINT)
    assert run.wait(60.0) != 0
    kept, begun = len(list(store.folder.glob("*.json"))), len(list(solves.iterdir()))
    assert kept == begun if times == 1 else kept <= begun
    time.sleep(1.0)  # nothing of the run is left at work
    assert len(list(store.folder.glob("*.json"))) == kept < len(PARTS)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's job in the background ignores it
    with process_pool(2) as executor:
        run_kept(Squares(Path(sys.argv[1]), seconds=0.4), PARTS, KeptPoints(Path(sys.argv[2])), executor)


@pytest.mark.slow
def test_points_of_a_row_under_way_are_told(solves, tmp_path):
    work, told = Squares(solves, seconds=2.5), []
    with process_pool(2) as executor:
        run_kept(
            work,
            PARTS[:6],
            KeptPoints(tmp_path / "points"),
            executor,
            batch=3,
            report=lambda *step: told.append(step[0]),
        )
    assert told == sorted(set(told))
    assert told[0] == 0
    assert told[-1] == 6
    assert 0 < told[1] < 3  # before the first row of three is whole
