"""The paper's figures as a run: made, judged and left in a run folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

from diagnosis.recording.model import Recording
from reynolds.numerics.cache import cache_folder
from swashfilm.runs.reproduce.files import claim_rows, figure_row, write_reproduction
from swashfilm.runs.reproduce.recorded_coefficients import recorded_fig13
from system.description.pump import PumpDescription
from system.paper.figure import DRAWINGS, Figure
from system.paper.judge import FigureResult
from system.paper.reproduce import Means, PaperFidelity, reproduce
from system.points.floating_gaps import FloatingOptions
from system.pump_file.file import load_pump, resolved_toml
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor

PAPERS_OWN = ("ref90", "ref90_floating")
"""Built-in pumps that stand for the paper's."""


@dataclass(frozen=True)
class ReproduceAsked:
    """What is asked for: pump, figures, fidelity, how gaps float where they do, what Fig. 13 is tuned to.

    recording: checked; None where readings are made.
    """

    pump: PumpDescription
    figures: tuple[Figure, ...]
    fidelity: PaperFidelity
    floating: FloatingOptions
    recording: Recording | None = None


def paper_points() -> KeptPoints:
    """Where points of the costly fidelities are kept between runs."""
    return KeptPoints(cache_folder() / "paper" / "points")


def about(pump: PumpDescription) -> str:
    """What the paper's statements are to a pump that does not stand for the paper's own; else nothing."""
    if any(pump == load_pump(name) for name in PAPERS_OWN):
        return ""
    return (
        f"The statements are of the paper's own pump, for which ref90 stands: against {pump.name} they tell how "
        "far another pump goes with them, not whether they hold."
    )


def run_reproduce(asked: ReproduceAsked, executor: Executor, folder: Path, report: Report) -> dict[str, Any]:
    """Make the figures and write claims, data, pictures, resolved.toml, summary.json and report.html.

    Returns the summary. Points of films and floating gaps are kept, so that a run that breaks off goes on with
    them. Raises as `system.paper.reproduce.reproduce`.
    """
    began = process_time()
    means = Means(paper_points(), executor, asked.floating, report)
    results = _results(asked, means)
    (folder / "resolved.toml").write_text(resolved_toml(asked.pump), encoding="utf-8")
    summary = {
        "format": 1,
        "kind": "reproduction",
        "pump": asked.pump.name,
        "about": about(asked.pump),
        "fidelity": asked.fidelity.value,
        "verdicts": _verdicts(results, asked.fidelity),
        "figures": [figure_row(result) for result in results],
        "drawings": dict(DRAWINGS),
        "seconds": process_time() - began,
        "warnings": [],
    }
    write_reproduction(folder, results, summary)
    from swashfilm.runs.reproduce.page import write_reproduce_page

    write_reproduce_page(folder)
    return summary


def _results(asked: ReproduceAsked, means: Means) -> tuple[FigureResult, ...]:
    """The figures in the order asked for, Fig. 13 by the recording where there is one."""
    if asked.recording is None:
        return reproduce(asked.pump, asked.figures, asked.fidelity, means)
    others = tuple(figure for figure in asked.figures if figure is not Figure.FIG13)
    found = {one.figure: one for one in reproduce(asked.pump, others, asked.fidelity, means)}
    found[Figure.FIG13] = recorded_fig13(asked.pump, asked.recording, means.report)
    return tuple(found[figure] for figure in asked.figures)


def _verdicts(results: Sequence[FigureResult], fidelity: PaperFidelity) -> dict[str, int]:
    """How many statements came out how."""
    found: dict[str, int] = {}
    for row in claim_rows(results, fidelity.value):
        found[row["verdict"]] = found.get(row["verdict"], 0) + 1
    return found
