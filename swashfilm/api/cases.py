"""Displacement in time, Navier-Stokes references, the paper's figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swashfilm.api.calls import door, words_of
from swashfilm.api.given import Case, case_path
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.reference.result import ReferenceRun
    from swashfilm.runs.reproduce.result import Reproduction
    from swashfilm.runs.transient.result import TransientRun


def transient(case: Case) -> TransientRun:
    """Solve displacement in time, as `swashfilm transient`; raise InputFaults and NotConverged."""
    with door("transient"), case_path(case) as path:
        from swashfilm.runs.transient.case import load_transient
        from swashfilm.runs.transient.run import solve_transient

        return solve_transient(load_transient(path))


def reference(case: Case, *, report: Report = silent) -> ReferenceRun:
    """Solve coefficients from the Navier-Stokes equations, as `swashfilm reference`; raise InputFaults."""
    with door("reference"), case_path(case) as path:
        from swashfilm.runs.reference.case import load_reference
        from swashfilm.runs.reference.result import ReferenceRun
        from swashfilm.runs.reference.run import run_reference

        found = load_reference(path)
        return ReferenceRun.ran(lambda folder: run_reference(found, folder, report))


def reproduce(figure: str = "all", *, report: Report = silent, **options: object) -> Reproduction:
    """Reproduce the paper's figures and tables, as `swashfilm reproduce`.

    options: fidelity, pump, recording, workers, steps, finer, rigid, isoviscous, isothermal. Raises InputFaults.
    """
    with door("reproduce"):
        from swashfilm.runs.reproduce.command import reproduce_case
        from swashfilm.runs.reproduce.result import Reproduction
        from swashfilm.runs.reproduce.run import run_reproduce
        from system.work.processes import process_pool

        asked, workers = reproduce_case(words_of("reproduce", [figure], options))
        with process_pool(workers) as executor:
            return Reproduction.ran(lambda folder: run_reproduce(asked, executor, folder, report))
