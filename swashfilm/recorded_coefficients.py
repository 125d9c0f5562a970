"""Fig. 13 of the paper by a recording: coefficients tuned to what a bench has read."""

from __future__ import annotations

from diagnosis.recording import Recording
from swashfilm.calibrate_run import calibrate
from swashfilm.progress import Report
from system.description import PumpDescription
from system.faults import Fault, InputFaults
from system.paper.coefficients import fig13_of
from system.paper.judge import FigureResult
from system.paper.points import Reading


def recorded_fig13(pump: PumpDescription, recording: Recording, report: Report) -> FigureResult:
    """Eq. (21) tuned to a checked recording as `swashfilm calibrate` does, all else of the pump as fitted.

    Raises InputFaults where Eq. (2) cannot be had of it or it has too few readings, NotConverged.
    """
    found = calibrate(pump, recording, (), False, report)
    title = recording.title or "recording"
    if not found.equation:
        raise InputFaults(title, [Fault("--recording", "; ".join(found.notes), "what Eq. (2) is made of")])
    count = len(found.points.speed)
    told = f'Tuned to the recording "{title}", {count} points; all else of the pump as it fits them.'
    notes = f"What was taken: {'; '.join(found.notes)}."
    return fig13_of({Reading.WITH_SHEAR: found.equation, Reading.MIXED: found.mixed}, (told, notes))
