"""Time operating maps: `python benchmarks/map.py [--films] [--cluster]`.

Prints wall and processor time of the paper's 112 lumped points and of a finer lumped map by one and two processes;
with --films of the 112 points by a response table that is built for it, and nothing else; with --cluster by two
workers of a Dask cluster on this machine too. Processor time is of this process and of all that it started, their
start included: on a machine that others use it is the figure to read. Results go to a folder that is thrown away,
the response table's points too.
"""

import argparse
import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

from rich.console import Console
from rich.table import Table

from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.map.run import MapCase, run_map
from system.maps.plan import MapAxis, MapInput, MapPlan, map_plan
from system.maps.usual_levels import usual_axes
from system.pump_file.file import load_pump
from system.work.processes import process_pool
from system.work.tasks import Executor

FINE = 17
"""Pressures of the finer map, at five temperatures: 4 x 17 x 4 x 5 points."""
GOALS = {"112 lumped": 30.0, "112 films by table": 600.0}
"""Seconds on two cores."""


def main() -> None:
    """Run the requested maps and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--films", action="store_true")
    parser.add_argument("--cluster", action="store_true")
    options = parser.parse_args()
    pump = load_pump("ref90")
    paper = map_plan(pump, usual_axes(pump))
    if options.films:
        rows = [timed("112 films by table", paper, Fidelity.FIXED, lambda: process_pool(2))]
    else:
        plans = {"112 lumped": paper, f"{len(finer(paper).points)} lumped": finer(paper)}
        timed("112 lumped", paper, Fidelity.LUMPED, lambda: process_pool(1))  # compiles
        makers = [lambda: process_pool(1), lambda: process_pool(2), *([local_cluster] if options.cluster else [])]
        rows = [timed(name, plan, Fidelity.LUMPED, maker) for maker in makers for name, plan in plans.items()]
    table = Table("map", "by", "wall / s", "processor / s", "goal, wall / s", title=f"load {os.getloadavg()[0]:.1f}")
    for row in rows:
        table.add_row(*row)
    Console().print(table)


def finer(plan: MapPlan) -> MapPlan:
    """The paper's box with more levels."""
    pressures = MapAxis(MapInput.PRESSURE, tuple(5e6 + 30e6 * k / (FINE - 1) for k in range(FINE)))
    warm = MapAxis(MapInput.TEMPERATURE, (303.15, 313.15, 323.15, 333.15, 343.15))
    return map_plan(plan.pump, [*usual_axes(plan.pump), pressures, warm])


def timed(
    name: str, plan: MapPlan, fidelity: Fidelity, maker: Callable[[], AbstractContextManager[Executor]]
) -> tuple[str, ...]:
    """A map run whole, page and all, with the start and the end of those who do its points."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SWASHFILM_CACHE"] = folder
        run = Path(folder) / "run"
        run.mkdir()
        wall, processor = time.perf_counter(), processor_seconds()
        with maker() as executor:
            summary = run_map(MapCase(plan, fidelity), run, executor, lambda *_: None)
            by = f"{type(executor).__name__.lower()} of {executor.workers}"
        assert summary["solved"] == summary["points"], summary["failed"]
        wall, processor = time.perf_counter() - wall, processor_seconds() - processor
    goal = f"{GOALS[name]:.0f}" if name in GOALS else ""
    return name, by, f"{wall:.1f}", f"{processor:.1f}", goal


def processor_seconds() -> float:
    """Of this process and of those it started that have ended."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


@contextmanager
def local_cluster() -> Iterator[Executor]:
    """Two workers of a Dask cluster on this machine."""
    from distributed import LocalCluster

    from system.work.cluster import THREADS, cluster

    os.environ.update(dict.fromkeys(THREADS, "1"))
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local,
        cluster(local.scheduler_address) as executor,
    ):
        yield executor


if __name__ == "__main__":
    main()
