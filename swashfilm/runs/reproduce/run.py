"""Run of the paper's figures: computed, judged and written to a run folder; Fig. 13 also by a recording."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

from diagnosis.calibration import calibrate
from diagnosis.recording.model import Recording
from diagnosis.study.acceptance import checked_recording
from reynolds.numerics.cache import cache_folder
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.schemas import write_new
from swashfilm.formats.versions import headed
from swashfilm.runs.map.run import POINT_COST
from swashfilm.runs.reproduce.files import claim_rows, figure_row, write_reproduction
from system.bench.calibration.equation_21 import LOSS_CHANNELS
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.paper.figure import DRAWINGS, Figure
from system.paper.figures.coefficients import fig13_of
from system.paper.judge import FigureResult
from system.paper.points import LossReading, PaperFidelity, places_of
from system.paper.reproduce import Means, reproduce
from system.points.floating_gaps import FloatingOptions
from system.pump_file.file import load_known_pump, load_pump, resolved_toml
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor, PartStatus

PAPERS_OWN = "ref90"
"""Built-in pump that represents the paper's."""


@dataclass(frozen=True)
class ReproduceCase:
    """A reproduction to run: pump, figures, fidelity, options of floating gaps, recording of Fig. 13.

    recording: checked; None for computed readings.
    """

    pump: PumpDescription
    figures: tuple[Figure, ...]
    fidelity: PaperFidelity
    floating: FloatingOptions
    recording: Recording | None = None

    @property
    def points(self) -> int:
        """Number of operating points of the figures."""
        return len(places_of(self.pump, self.figures))

    @property
    def minutes(self) -> float:
        """Approximate processor time of floating points, min; 0 for another fidelity."""
        floats = self.fidelity is PaperFidelity.FLOATING
        return self.points * POINT_COST[Fidelity.FLOATING] / 60.0 if floats else 0.0


def paper_points() -> KeptPoints:
    """Return the store of points of the costly fidelities, kept between runs."""
    return KeptPoints(cache_folder() / "paper" / "points", frozenset({PartStatus.SOLVED}))


def about(asked: ReproduceCase) -> str:
    """Return remarks on a pump that does not represent the paper's, and on film physics left out; empty without."""
    own, remarks = load_pump(PAPERS_OWN), []
    if asked.pump != own:
        named = asked.pump.name if asked.pump.name != own.name else f"{own.name} with other values"
        remarks.append(
            f"The statements are about the paper's pump, which {own.name} represents. For {named} the verdicts compare "
            "two different pumps; they do not test the statements."
        )
    without = asked.floating.physics.left_out_words
    if asked.fidelity is PaperFidelity.FLOATING and without:
        remarks.append(f"The floating films leave out: {', '.join(without)}.")
    return " ".join(remarks)


def run_reproduce(asked: ReproduceCase, executor: Executor, folder: Path, report: Report) -> dict[str, Any]:
    """Compute the figures and write claims, data, pictures, resolved.toml, summary.json and report.html.

    Returns the summary. Points of films and floating gaps are kept, so that an interrupted run continues from
    them. Raises as `system.paper.reproduce.reproduce`.
    """
    began = process_time()
    means = Means(paper_points(), executor, asked.floating, report)
    results = _results(asked, means)
    write_new(folder / "resolved.toml", "pump", resolved_toml(asked.pump))
    summary = {
        **headed("reproduction"),
        "pump": asked.pump.name,
        "about": about(asked),
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


def _results(asked: ReproduceCase, means: Means) -> tuple[FigureResult, ...]:
    """Return the figures in their order, Fig. 13 by the recording, if any."""
    if asked.recording is None:
        return reproduce(asked.pump, asked.figures, asked.fidelity, means)
    others = tuple(figure for figure in asked.figures if figure is not Figure.FIG13)
    found = {one.figure: one for one in reproduce(asked.pump, others, asked.fidelity, means)}
    found[Figure.FIG13] = recorded_fig13(asked.pump, asked.recording, means.report)
    return tuple(found[figure] for figure in asked.figures)


def _verdicts(results: Sequence[FigureResult], fidelity: PaperFidelity) -> dict[str, int]:
    """Return the number of statements with each verdict."""
    found: dict[str, int] = {}
    for row in claim_rows(results, fidelity.value):
        found[row["verdict"]] = found.get(row["verdict"], 0) + 1
    return found


def recording_for_fig13(path: Path, pump: str) -> Recording:
    """Return the recording of a path, checked against a pump by name or file; raise InputFaults if unsuitable."""
    recording = checked_recording(path, load_known_pump(pump))
    missing = [one.value for one in LOSS_CHANNELS if recording.channel(one) is None]
    if missing:
        needed = f"{', '.join(one.value for one in LOSS_CHANNELS)}: Eq. (2) contains them"
        raise InputFaults(str(path), [Fault("[channel]", f"no {', '.join(missing)}", needed)])
    return recording


def recorded_fig13(pump: PumpDescription, recording: Recording, report: Report) -> FigureResult:
    """Return Eq. (21) fitted to a checked recording as by `swashfilm calibrate`, other parameters as fitted.

    Raises InputFaults where it lacks readings of Eq. (2) or has too few readings, and NotConverged.
    """
    found = calibrate(pump, recording, report, models=(), with_hersey=False)
    title = recording.title or "recording"
    if not found.equation:
        raise InputFaults(title, [Fault("--recording", "; ".join(found.notes), "the readings of Eq. (2)")])
    count = len(found.points.speed)
    fitted = f'Fitted to the recording "{title}", {count} points, together with all other parameters of the pump.'
    notes = f"Assumed: {'; '.join(found.notes)}."
    return fig13_of({LossReading.WITH_SHEAR: found.equation, LossReading.MIXED: found.mixed}, (fitted, notes))
