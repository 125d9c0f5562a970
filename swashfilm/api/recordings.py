"""A recording beside the simulation of its pump, and the plan of a test before it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import door, words_of
from swashfilm.api.given import pump_path
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.calibrate.result import CalibrationRun
    from swashfilm.runs.diagnose.result import DiagnosisRun
    from swashfilm.runs.plan.result import PlanRun
    from system.description.pump import PumpDescription


def diagnose(
    pump: str | Path | PumpDescription, recording: str | Path, *, report: Report = silent, **options: object
) -> DiagnosisRun:
    """Compare a recording with the simulation of its pump, as `swashfilm diagnose`.

    pump: name, file (which may be incomplete) or description; recording: folder, or table beside a recording.toml.
    options: workers, film_tables; fidelity, steps, finer, rigid, isoviscous, isothermal, smooth, no_cavitation,
    variant, points, held_out. Raises InputFaults and NotConverged.
    """
    with door("diagnose"), pump_path(pump) as name:
        from diagnosis.finding import diagnose as found_by
        from diagnosis.study.acceptance import checked_recording
        from swashfilm.runs.diagnose.command import workers_and_file
        from swashfilm.runs.diagnose.films import film_model_of, film_options_of
        from swashfilm.runs.diagnose.result import DiagnosisRun
        from swashfilm.runs.diagnose.run import write_finding
        from system.effects.catalogue.entries import CATALOGUE, with_films_solved
        from system.pump_file.file import load_known_pump

        words = words_of("diagnose", [name, recording], options)
        workers, _ = workers_and_file(words)
        known = load_known_pump(name)
        film_options = film_options_of(words, known)
        readings = checked_recording(words.recording, known)
        catalogue = with_films_solved(known.pump, report) if words.film_tables else CATALOGUE
        films = film_model_of(known.pump, readings, film_options, workers, report)
        finding = found_by(known, readings, report, workers, catalogue, films)
        return DiagnosisRun.ran(lambda folder: write_finding(folder, finding))


def calibrate(
    pump: str | Path | PumpDescription, recording: str | Path, *, report: Report = silent, **options: object
) -> CalibrationRun:
    """Fit coefficients of a pump to a recording, as `swashfilm calibrate`.

    options: laws ("mixed_friction" or "none"), models ("all", "none" or names). Raises InputFaults and NotConverged.
    """
    with door("calibrate"), pump_path(pump) as name:
        from diagnosis.calibration import calibrate as found_by
        from diagnosis.study.acceptance import checked_recording
        from swashfilm.runs.calibrate.command import LAWS, loss_models
        from swashfilm.runs.calibrate.files import write_calibration_files
        from swashfilm.runs.calibrate.result import CalibrationRun
        from system.pump_file.file import load_known_pump

        words = words_of("calibrate", [name, recording], options)
        models = loss_models(words)
        known = load_known_pump(name)
        readings = checked_recording(words.recording, known)
        found = found_by(known, readings, report, models, words.laws == LAWS[0])
        title = readings.title or words.recording.stem
        return CalibrationRun.ran(lambda folder: write_calibration_files(folder, found, title))


def plan(
    pump: str | Path | PumpDescription = "ref90",
    *,
    campaign: str | Path | None = None,
    sensors: str | None = None,
    suspects: str | Sequence[str] | None = None,
    add: int | None = None,
    limit: str | Sequence[str] = (),
    report: Report = silent,
    **options: object,
) -> PlanRun:
    """Plan a test: the causes that its points separate, and the points and meters to add, as `swashfilm plan`.

    limit: "speed <= 1800 rpm", or several. options: speeds, pressures, displacements, temperatures, inlet_pressures,
    plan, cost, apart, set. Raises InputFaults and NotConverged.
    """
    limits = [limit] if isinstance(limit, str) else list(limit)
    given = {"campaign": campaign, "sensors": sensors, "suspects": suspects, "add": add, "limit": limits}
    with door("plan"), pump_path(pump) as name:
        from swashfilm.runs.plan.command import plan_case
        from swashfilm.runs.plan.result import PlanRun
        from swashfilm.runs.plan.run import run_plan

        case = plan_case(words_of("plan", [name], given | options))
        return PlanRun.ran(lambda folder: run_plan(case, folder, report))
