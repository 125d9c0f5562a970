"""Operating points of a pump, and the response tables of its gaps."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import Quantity, door, words_of
from swashfilm.api.given import pump_path
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.pump.result import PumpRun
    from swashfilm.runs.pump.vary.result import VariedRun
    from swashfilm.runs.table.result import TableRun
    from system.description.pump import PumpDescription


def load_pump(source: str | Path, overrides: Mapping[str, object] | None = None) -> PumpDescription:
    """Return the description of a built-in pump (by name) or of a pump file (by path), in SI.

    overrides: values in place of the file's, {"operating.speed": "1500 rpm"}; numbers are in SI. Raises InputFaults.
    """
    from swashfilm.api.tables import settings_of_file
    from system.pump_file.file import load_pump as loaded

    return loaded(source, settings_of_file(overrides or {}))


def run(
    pump: str | Path | PumpDescription = "ref90",
    *,
    speed: Quantity | None = None,
    pressure: Quantity | None = None,
    displacement: float | None = None,
    temperature: Quantity | None = None,
    inlet_pressure: Quantity | None = None,
    case_pressure: Quantity | None = None,
    fidelity: str = "floating",
    table: str | Path | None = None,
    set: Mapping[str, object] | None = None,
    report: Report = silent,
    **options: object,
) -> PumpRun:
    """Solve one operating point of a pump, as `swashfilm run`.

    set: values that replace those of the pump file, {"slipper.orifice_diameter": "0.8 mm"}. options of floating
    gaps: steps, finer, rigid, isoviscous, smooth, no_cavitation, isothermal. Raises InputFaults and NotConverged.
    """
    given = {
        "speed": speed,
        "pressure": pressure,
        "displacement": displacement,
        "temperature": temperature,
        "inlet_pressure": inlet_pressure,
        "case_pressure": case_pressure,
        "fidelity": fidelity,
        "table": table,
        "set": set,
    }
    if several := [name for name in ("vary", "workers", "resume") if name in options]:
        raise InputFaults(
            "swashfilm.run()", [Fault(one, "an argument of several points", "swashfilm.vary()") for one in several]
        )
    with door("run"), pump_path(pump) as name:
        from swashfilm.runs.pump.command import pump_case
        from swashfilm.runs.pump.run import solve_pump

        return solve_pump(pump_case(words_of("run", [name], given | options)), report)


def vary(
    pump: str | Path | PumpDescription,
    over: Mapping[str, str],
    *,
    workers: int = 1,
    resume: str | Path | None = None,
    report: Report = silent,
    **options: object,
) -> VariedRun:
    """Solve a pump over levels of keys of its file, as `swashfilm run --vary`.

    over: {"valve_plate.film_thickness": "6..14um:9"}, several keys: a grid. options: those of `run`. A point
    without a result has its reason. Raises InputFaults.
    """
    given = {"vary": over, "workers": workers if workers > 1 else None, "resume": resume}
    with door("vary"), pump_path(pump) as name:
        from swashfilm.runs.pump.command import varied_case
        from swashfilm.runs.pump.vary.result import VariedRun, run_varied

        words = words_of("run", [name], given | options)
        study, count = varied_case(words)
        return VariedRun.ran(lambda folder: run_varied(study, folder, report, resumed=words.resume, workers=count))


def table(pump: str | Path | PumpDescription, *, report: Report = silent, **options: object) -> TableRun:
    """Build a response table of a pump's gaps, or of one gap by its case, as `swashfilm table`.

    options: speed, pressure, displacement, temperature (ranges "MIN..MAX" or one value), inlet_pressure,
    case_pressure, source, points, held_out, workers, steps, finer, rigid, isoviscous, isothermal. Raises InputFaults.
    """
    with door("table"), pump_path(pump) as name:
        from swashfilm.runs.table.command import table_case
        from swashfilm.runs.table.result import TableRun

        asked = table_case(words_of("table", [name], options))
        return TableRun.ran(lambda folder: asked.run(folder, report))
