"""The paper's figures as a run: made, judged and left in a run folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

from reynolds.bodies.cache import cache_folder
from swashfilm.progress import Report
from swashfilm.reproduce_files import claim_rows, write_reproduction
from system.description import PumpDescription
from system.floating_gaps import FloatingOptions
from system.kept_points import KeptPoints
from system.paper.figures import DRAWINGS, Figure
from system.paper.judge import FigureResult
from system.paper.reproduce import Means, PaperFidelity, reproduce
from system.pump_file import resolved_toml
from system.work import Hands


@dataclass(frozen=True)
class ReproduceAsked:
    """What is asked for: the pump, figures, a fidelity, and how gaps float where they do."""

    pump: PumpDescription
    figures: tuple[Figure, ...]
    fidelity: PaperFidelity
    floating: FloatingOptions


def paper_points() -> KeptPoints:
    """Where points of the costly fidelities are kept between runs."""
    return KeptPoints(cache_folder() / "paper" / "points")


def run_reproduce(asked: ReproduceAsked, hands: Hands, folder: Path, report: Report) -> dict[str, Any]:
    """Make the figures and write claims, data, pictures, resolved.toml, summary.json and report.html.

    Returns the summary. Points of films and floating gaps are kept, so that a run that breaks off goes on with
    them. Raises as `system.paper.reproduce.reproduce`.
    """
    began = process_time()
    means = Means(paper_points(), hands, asked.floating, report)
    results = reproduce(asked.pump, asked.figures, asked.fidelity, means)
    (folder / "resolved.toml").write_text(resolved_toml(asked.pump), encoding="utf-8")
    summary = {
        "format": 1,
        "kind": "reproduction",
        "pump": asked.pump.name,
        "fidelity": asked.fidelity.value,
        "verdicts": _verdicts(results, asked.fidelity),
        "drawings": dict(DRAWINGS),
        "seconds": process_time() - began,
        "warnings": [],
    }
    write_reproduction(folder, results, summary)
    from swashfilm.reproduce_page import write_reproduce_page

    write_reproduce_page(folder)
    return summary


def _verdicts(results: Sequence[FigureResult], fidelity: PaperFidelity) -> dict[str, int]:
    """How many statements came out how."""
    found: dict[str, int] = {}
    for row in claim_rows(results, fidelity.value):
        found[row["verdict"]] = found.get(row["verdict"], 0) + 1
    return found
