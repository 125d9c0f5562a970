"""Points by a Dask cluster: the same as by this process, whole where workers are killed; its faults."""

import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from system import InputFaults
from system.work.cluster import THREADS, about_worker, cluster, worker_faults
from system.work.kept_results import KeptPoints, run_kept
from system.work.tasks import PartStatus

PARTS = list(range(24))


@dataclass(frozen=True)
class Halves:
    """A part may kill its worker: the first time it is tried, or at every try."""

    folder: Path
    once: frozenset[int] = frozenset()
    always: int = -1

    def key(self, part):
        return f"half-{part}"

    def solve(self, part):
        tries = len(list(self.folder.glob(f"{part}-*")))
        (self.folder / f"{part}-{tries}").touch()
        if part == self.always or (part in self.once and not tries):
            os.kill(os.getpid(), signal.SIGKILL)
        if part == 5:
            raise ZeroDivisionError("a bug")
        return {"half": part / 2}


def test_without_dask_the_extra_is_named(monkeypatch):
    monkeypatch.setattr("system.work.cluster.find_spec", lambda name: None)
    with pytest.raises(InputFaults, match=r"\.\[cluster\]"), cluster("tcp://nowhere:1"):
        pass


def test_a_worker_that_differs_is_told():
    own = about_worker()
    good = own | dict.fromkeys(THREADS, "1")
    assert not list(worker_faults({"tcp://a": good}, own))
    assert [fault.path for fault in worker_faults({}, own)] == ["workers"]
    other = {"tcp://b": good | {"numpy": "1.0", "OMP_NUM_THREADS": "not set"}}
    assert [fault.path for fault in worker_faults(other, own)] == [
        "numpy of worker tcp://b",
        "OMP_NUM_THREADS of worker tcp://b",
    ]


@pytest.fixture(scope="module")
def local_cluster():
    distributed = pytest.importorskip("distributed", reason="the extra [cluster] is not installed")
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local:
        yield local.scheduler_address
    for name, value in before.items():
        os.environ.pop(name) if value is None else os.environ.update({name: value})


@pytest.mark.long
def test_killed_workers_cost_nothing_but_time(local_cluster, tmp_path):
    solves = tmp_path / "solves"
    solves.mkdir()
    work = Halves(solves, once=frozenset({3, 11}), always=17)
    with cluster(local_cluster) as executor:
        assert executor.workers == 2
        found = run_kept(work, PARTS, KeptPoints(tmp_path / "points"), executor).outcomes
    assert [outcome.record["half"] for outcome in found if outcome.status is PartStatus.SOLVED] == [
        part / 2 for part in PARTS if part not in (5, 17)
    ]
    assert found[17].status is PartStatus.WORKER_DIED
    assert "by itself too" in found[17].reason
    assert found[5].reason.startswith("ZeroDivisionError: a bug (")


@pytest.mark.long
def test_a_map_by_a_cluster_has_the_same_numbers(local_cluster, tmp_path):
    words = ["map", "ref90", "--fidelity", "lumped", "--speeds", "1500rpm", "--displacements", "1", "--check", "0"]
    assert main([*words, "-o", str(tmp_path / "here")]) == 0
    assert main([*words, "--cluster", local_cluster, "-o", str(tmp_path / "there")]) == 0
    assert (tmp_path / "here" / "map.csv").read_text() == (tmp_path / "there" / "map.csv").read_text()


@pytest.mark.long
def test_an_optimisation_by_a_cluster_tries_the_same_designs(local_cluster, tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(
        'format = 1\n[optimise]\npump = "ref90"\ndesigns = 8\ngenerations = 2\n'
        '[vary]\n"ports.groove_area" = "2..6 mm2"\n'
        '[objectives]\nloss = "least"\nchamber_pressure_peak = "least"\n'
    )
    words = ["optimise", str(case)]
    assert main([*words, "--workers", "1", "-o", str(tmp_path / "here")]) == 0
    assert main([*words, "--cluster", local_cluster, "-o", str(tmp_path / "there")]) == 0
    assert (tmp_path / "here" / "designs.csv").read_text() == (tmp_path / "there" / "designs.csv").read_text()


def test_nothing_else_needs_dask():
    code = (
        "import sys, swashfilm.runs.map.run, system.work.cluster; "
        "sys.exit(bool({'distributed', 'dask'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
