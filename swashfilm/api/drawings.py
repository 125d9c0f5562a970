"""Dimensions of a pump's drawing: cost of each, scatter of a series, optimum."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import door, words_of
from swashfilm.api.given import Case, case_path, pump_path
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.variation.optimise.result import OptimiseRun
    from swashfilm.runs.variation.sensitivity.result import SensitivityRun
    from swashfilm.runs.variation.tolerance.result import ToleranceRun
    from system.description.pump import PumpDescription


def sensitivity(
    pump: str | Path | PumpDescription = "ref90",
    *,
    keys: str | Sequence[str] | None = None,
    cycle: str | Path | None = None,
    fidelity: str = "lumped",
    report: Report = silent,
    **options: object,
) -> SensitivityRun:
    """Differentiate a pump's numbers by its dimensions, as `swashfilm sensitivity`.

    keys: dimensions or patterns, text or a list; levels, plan, table, workers and resume as those of `map`. Raises
    InputFaults and NotConverged.
    """
    given = {"keys": keys, "cycle": cycle, "fidelity": fidelity} | options
    with door("sensitivity"), pump_path(pump) as name:
        from swashfilm.runs.variation.case import varied_case
        from swashfilm.runs.variation.options import varied_executor
        from swashfilm.runs.variation.sensitivity.result import SensitivityRun
        from swashfilm.runs.variation.sensitivity.run import run_sensitivity
        from system.variation.sensitivity import variants_needed

        words = words_of("sensitivity", [name], given)
        case = varied_case(words)
        with varied_executor(words, case.seconds(variants_needed(len(case.keys)))) as executor:
            return SensitivityRun.ran(lambda folder: run_sensitivity(case, folder, executor, report))


def tolerance(
    pump: str | Path | PumpDescription = "ref90",
    *,
    pumps: int | None = None,
    limit: str | Sequence[str] = (),
    keys: str | Sequence[str] | None = None,
    cycle: str | Path | None = None,
    fidelity: str = "lumped",
    report: Report = silent,
    **options: object,
) -> ToleranceRun:
    """Solve a series of pumps drawn from the tolerances of their drawing, as `swashfilm tolerance`.

    limit: "efficiency >= 88 %", or several; seed, and levels, plan, table, workers and resume as those of `map`. Raises
    InputFaults.
    """
    limits = [limit] if isinstance(limit, str) else list(limit)
    given = {"pumps": pumps, "limit": limits, "keys": keys, "cycle": cycle, "fidelity": fidelity} | options
    with door("tolerance"), pump_path(pump) as name:
        from swashfilm.runs.variation.options import varied_executor
        from swashfilm.runs.variation.tolerance.command import tolerance_case
        from swashfilm.runs.variation.tolerance.result import ToleranceRun
        from swashfilm.runs.variation.tolerance.run import run_tolerance

        words = words_of("tolerance", [name], given)
        case = tolerance_case(words)
        with varied_executor(words, case.varied.seconds(case.pumps)) as executor:
            return ToleranceRun.ran(lambda folder: run_tolerance(case, folder, executor, report))


def optimise(case: Case, *, choose: str | None = None, report: Report = silent, **options: object) -> OptimiseRun:
    """Optimise dimensions of a pump under constraints, as `swashfilm optimise`.

    choose: "knee", an objective, or a row of the Pareto set; options: workers, cluster, resume, and those of floating
    gaps. Without a feasible design the result lists the obstacles. Raises InputFaults and NotConverged.
    """
    with door("optimise"), case_path(case) as path:
        from swashfilm.runs.variation.optimise.command import design_executor, optimise_case
        from swashfilm.runs.variation.optimise.result import OptimiseRun
        from swashfilm.runs.variation.optimise.run import run_optimise

        words = words_of("optimise", [path], {"choose": choose} | options)
        asked = optimise_case(words)
        with design_executor(words, asked) as executor:
            return OptimiseRun.ran(lambda folder: run_optimise(asked, folder, executor, report))
