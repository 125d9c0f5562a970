"""Small lumped maps of the bench pump as run folders of `swashfilm map`."""

from dataclasses import replace

from bench_pump import BENCH

from swashfilm.runs.map.files import write_map
from system import load_pump, resolved_toml
from system.inputs.units import RPM
from system.maps.data import map_data
from system.maps.plan import MapAxis, MapInput, map_plan
from system.maps.point import LumpedSolver, MapWork
from system.work.tasks import PartStatus, done_part

LEVELS = {
    MapInput.SPEED: tuple(RPM * speed for speed in (1000.0, 1500.0, 2000.0)),
    MapInput.PRESSURE: (10e6, 20e6, 25e6, 30e6),
    MapInput.RATIO: (0.5, 1.0),
    MapInput.TEMPERATURE: (313.15, 333.15),
}


def kept_map(folder, levels, without=(), solver=None):
    """The map of the bench pump in a run folder, lumped by default, some points without a result."""
    plan = map_plan(load_pump(str(BENCH)), [MapAxis(given, values) for given, values in levels.items()])
    work = MapWork(plan.pump, solver or LumpedSolver())
    outcomes = [done_part(work, point) for point in plan.points]
    for k in without:
        outcomes[k] = replace(outcomes[k], status=PartStatus.NOT_CONVERGED, reason="no film", record={})
    folder.mkdir()
    about = {"stated": {}, "resolved_toml": resolved_toml(plan.pump), "assumptions": []}
    write_map(folder / "map.nc", map_data(plan, work.solver.words, tuple(outcomes)), None, about)
    return folder
