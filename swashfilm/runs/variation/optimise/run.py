"""Run of an optimisation: searched, one design chosen, then summary, tables, data set, pump file and page."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from swashfilm.console.fidelity import Fidelity
from swashfilm.output.run_folder import write_json
from swashfilm.runs.variation.optimise.case import KNEE, OptimiseCase
from swashfilm.runs.variation.optimise.files import CHOSEN, DATA, chosen_pump, write_beside, write_data, write_designs
from swashfilm.runs.variation.optimise.page import write_optimise_page
from swashfilm.runs.variation.optimise.summary import optimise_summary
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import resolved_toml
from system.variation.optimisation.evolution import evolve
from system.variation.optimisation.gradient import descend
from system.variation.optimisation.method import Method
from system.variation.optimisation.optimum import Optimisation, Search, optimise
from system.variation.optimisation.pareto import knee
from system.variation.optimisation.trust_region import approach
from system.work.kept_results import POINTS, points_of_run
from system.work.progress import Report
from system.work.tasks import Executor

STEP = {Fidelity.LUMPED: 1e-3, Fidelity.TABLE: 5e-3}
"""Step of differences and last region of trust, of the bounds' distance; SOLVED for films, which have more noise."""
SOLVED = 0.02


def run_optimise(case: OptimiseCase, folder: Path, executor: Executor, report: Report) -> dict[str, Any]:
    """Optimise a pump; write points/, summary.json, designs.csv, pareto.csv, chosen.toml, compare/, results.nc, page.

    Returns the summary; without a feasible design there are no chosen.toml and compare/. Raises NotConverged where the
    pump as stated has no result, InputFaults for a chosen row that the Pareto set lacks.
    """
    varied = case.varied
    (folder / "input.toml").write_text(varied.given, encoding="utf-8")
    (folder / "resolved.toml").write_text(resolved_toml(varied.pump), encoding="utf-8")
    earlier = points_of_run(varied.resume) if varied.resume else None
    found = optimise(
        varied.work, case.problem, search_of(case), case.search.trials(case.problem), folder / POINTS, executor,
        report, earlier,
    )  # fmt: skip
    chosen = chosen_of(found, case.search.choose)
    summary = optimise_summary(case, found, chosen)
    write_designs(folder, found)
    if chosen is not None:
        said = f"Design {chosen + 1} of swashfilm optimise {case.name}: {summary['chosen']['why']}"
        design = found.designs[chosen]
        pump = chosen_pump(varied.pump, found.problem.variant(design.place))
        (folder / CHOSEN).write_text(f"# {said}\n{resolved_toml(pump)}", encoding="utf-8")
        write_beside(folder, varied, found.start, pump, design)
    write_data(folder / DATA, varied, found)
    write_json(folder / "summary.json", summary)
    write_optimise_page(folder)
    return summary


def search_of(case: OptimiseCase) -> Search:
    """Return the search of a case."""
    own, step = case.search, STEP.get(case.varied.fidelity, SOLVED)
    match own.method:
        case Method.GRADIENT:
            return partial(descend, step=step, iterations=own.generations)
        case Method.TRUST_REGION:
            return partial(approach, designs=own.designs, last=step)
    return partial(evolve, designs=own.designs, generations=own.generations, seed=own.seed)


def chosen_of(found: Optimisation, choose: str) -> int | None:
    """Return the place of the chosen design: the knee, the best of an objective, or that of a row; None without any."""
    members = found.pareto.members
    if not members:
        return None
    if choose == KNEE:
        return knee(found.problem, found.designs, members)
    if choose.isdecimal():
        if int(choose) > len(members):
            fault = Fault("choose", f"row {choose}", f"a row of pareto.csv, 1 to {len(members)}", str(len(members)))
            raise InputFaults("optimisation", [fault])
        return members[int(choose) - 1]
    at = [one.measure.name for one in found.problem.objectives].index(choose)
    return min(members, key=lambda member: float(found.problem.aims([found.designs[member]])[0, at]))
