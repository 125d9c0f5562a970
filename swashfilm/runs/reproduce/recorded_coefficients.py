"""Fig. 13 of the paper by a recording: coefficients fitted to readings of a bench."""

from pathlib import Path

from diagnosis.calibration import calibrate
from diagnosis.recording.model import Recording
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.scaled_pump import load_known_pump
from system.bench.calibration.equation_21 import LOSS_CHANNELS
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.paper.figures.coefficients import fig13_of
from system.paper.judge import FigureResult
from system.paper.points import LossReading
from system.work.progress import Report


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
