"""Time operating maps: `python benchmarks/map.py [--films] [--cluster]`.

Prints wall and processor time of the paper's 112 lumped points and of a finer lumped map by one and two processes,
with --films of the 112 points by a response table that is built for it, with --cluster by two workers of a Dask
cluster on this machine. Results go to a folder that is thrown away, the response table's points too.
"""

import argparse
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.table import Table

from swashfilm.fidelity import Fidelity
from swashfilm.map_run import MapAsked, run_map
from system.map_plan import MapAxis, MapInput, MapPlan, map_plan, paper_axes
from system.pump_file import load_pump
from system.side_by_side import HERE, crew
from system.work import Hands

FINE = 17
"""Pressures of the finer map, at five temperatures: 4 x 17 x 4 x 5 points."""
GOALS = {"112 lumped": 30.0, "112 films by table": 600.0}
"""Seconds on two cores."""


def main() -> None:
    """Run what is asked for and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--films", action="store_true")
    parser.add_argument("--cluster", action="store_true")
    options = parser.parse_args()
    pump = load_pump("ref90")
    paper = map_plan(pump, paper_axes())
    plans = {"112 lumped": paper, f"{len(finer(paper).points)} lumped": finer(paper)}
    timed("112 lumped", paper, Fidelity.LUMPED, HERE)  # compiles
    rows = [timed(name, plan, Fidelity.LUMPED, HERE) for name, plan in plans.items()]
    with crew(2) as hands:
        rows += [timed(name, plan, Fidelity.LUMPED, hands) for name, plan in plans.items()]
        rows += [timed("112 films by table", paper, Fidelity.FILMS, hands)] if options.films else []
    if options.cluster:
        with local_cluster() as hands:
            rows += [timed(name, plan, Fidelity.LUMPED, hands) for name, plan in plans.items()]
    table = Table("map", "by", "wall / s", "process / s", "goal / s", title=f"load {os.getloadavg()[0]:.1f}")
    for row in rows:
        table.add_row(*row)
    Console().print(table)


def finer(plan: MapPlan) -> MapPlan:
    """The paper's box with more levels."""
    pressures = MapAxis(MapInput.PRESSURE, tuple(5e6 + 30e6 * k / (FINE - 1) for k in range(FINE)))
    warm = MapAxis(MapInput.TEMPERATURE, (303.15, 313.15, 323.15, 333.15, 343.15))
    return map_plan(plan.pump, [*paper_axes(), pressures, warm])


def timed(name: str, plan: MapPlan, fidelity: Fidelity, hands: Hands) -> tuple[str, ...]:
    """A map run whole, page and all."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SWASHFILM_CACHE"] = folder
        run = Path(folder) / "run"
        run.mkdir()
        wall, process = time.perf_counter(), time.process_time()
        summary = run_map(MapAsked(plan, fidelity), run, hands, lambda *_: None)
        assert summary["solved"] == summary["points"], summary["failed"]
        wall, process = time.perf_counter() - wall, time.process_time() - process
    goal = f"{GOALS[name]:.0f}" if name in GOALS else ""
    by = f"{type(hands).__name__.lower()} of {hands.workers}"
    return name, by, f"{wall:.1f}", f"{process:.1f} (this process)", goal


@contextmanager
def local_cluster() -> Iterator[Hands]:
    """Two workers of a Dask cluster on this machine."""
    from distributed import LocalCluster

    from system.cluster import THREADS, cluster

    os.environ.update(dict.fromkeys(THREADS, "1"))
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local,
        cluster(local.scheduler_address) as hands,
    ):
        yield hands


if __name__ == "__main__":
    main()
