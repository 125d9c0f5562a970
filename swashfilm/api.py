"""Front door: each command as a function that returns its result.

Arguments are those of the command line (`swashfilm COMMAND --help`): text with a unit ("350 bar") or a number in
SI; pressures are gauge. InputFaults lists every fault of the input.
"""

from __future__ import annotations

import argparse
import re
import tempfile
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reynolds.errors import InputError, NotConverged as NotConverged
from swashfilm.cli.app import options_of, parse
from swashfilm.console.inputs import COMMAND_LINE
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.pump_file.file import load_pump as load_pump
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.output.result import Result
    from swashfilm.runs.calibrate.result import CalibrationRun
    from swashfilm.runs.compare.result import CompareRun
    from swashfilm.runs.diagnose.result import DiagnosisRun
    from swashfilm.runs.film.result import FilmRun
    from swashfilm.runs.film.revolution.result import RevolutionRun
    from swashfilm.runs.film.series.result import StudyRun
    from swashfilm.runs.map.duty.result import DutyRun
    from swashfilm.runs.map.result import MapRun
    from swashfilm.runs.plan.result import PlanRun
    from swashfilm.runs.pump.result import PumpRun
    from swashfilm.runs.pump.vary.result import VariedRun
    from swashfilm.runs.reference.result import ReferenceRun
    from swashfilm.runs.reproduce.result import Reproduction
    from swashfilm.runs.table.result import TableRun
    from swashfilm.runs.transient.result import TransientRun
    from swashfilm.runs.variation.sensitivity.result import SensitivityRun
    from swashfilm.runs.variation.tolerance.result import ToleranceRun
    from system.description.pump import PumpDescription

Quantity = str | float
"""Text with its unit, or a number in SI."""
Case = str | Path | Mapping[str, Any]
"""Path of a case file, its text, or its tables."""

_SI = {
    **dict.fromkeys(("speed", "speeds"), "rad/s"), **dict.fromkeys(("temperature", "temperatures"), "K"),
    **dict.fromkeys(("pressure", "pressures", "inlet_pressure", "inlet_pressures", "case_pressure"), "Pa"),
}  # fmt: skip
_OF_COMMAND_LINE = (
    "-o",
    "--output",
    "--help",
    "--csv",
    "--animate",
    "--apply",
    "--page",
    "--watch",
    "--excel",
    "--units",
)
_RESULTS = (
    "pump", "pump.vary", "film", "film.revolution", "film.series", "map", "map.duty", "compare", "table", "transient",
    "plan", "reference", "reproduce", "diagnose", "calibrate", "variation.sensitivity", "variation.tolerance",
)  # fmt: skip
"""Rooms of `swashfilm.runs` with results."""


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
    with _door("run"), _pump_file(pump) as name:
        from swashfilm.runs.pump.command import pump_case
        from swashfilm.runs.pump.run import solve_pump

        return solve_pump(pump_case(_words("run", [name], given | options)), report)


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
    with _door("vary"), _pump_file(pump) as name:
        from swashfilm.runs.pump.command import varied_case
        from swashfilm.runs.pump.vary.result import VariedRun, run_varied

        words = _words("run", [name], given | options)
        study, count = varied_case(words)
        return VariedRun.ran(lambda folder: run_varied(study, folder, report, resumed=words.resume, workers=count))


def film(
    case: Case,
    *,
    refine: int | None = None,
    sensitivity: str | Sequence[str] | None = None,
    report: Report = silent,
    **options: object,
) -> FilmRun | RevolutionRun:
    """Solve one film, free or a gap of a pump, at an instant or over the turn, as `swashfilm film`.

    refine: number of meshes, for order and error. sensitivity: outputs whose derivatives by the film thickness are
    wanted, such as "load" or ["load", "flow.left"]. options: rigid, isoviscous, isothermal, smooth, no_cavitation.
    Raises InputFaults and FilmNotConverged.
    """
    with _door("film"), _case_file(case) as path:
        from swashfilm.case.gap.revolution import RevolutionCase
        from swashfilm.case.study import StudyCase
        from swashfilm.runs.film.command import film_case, outputs_of
        from swashfilm.runs.film.revolution.result import RevolutionRun
        from swashfilm.runs.film.revolution.run import run_revolution_case
        from swashfilm.runs.film.run import solve_film

        wanted = sensitivity if sensitivity is None or isinstance(sensitivity, str) else ",".join(sensitivity)
        words = _words("film", [path], {"refine": refine, "sensitivity": wanted} | options)
        found, meshes, _ = film_case(words)
        if isinstance(found, StudyCase):
            raise InputFaults(str(path), [Fault("study", "a study", "one film", "swashfilm.study()")])
        if isinstance(found, RevolutionCase):
            return RevolutionRun.ran(lambda folder: run_revolution_case(found, folder, report, meshes=meshes))
        return solve_film(found, report, meshes=meshes, outputs=outputs_of(words))


def study(
    case: Case, *, workers: int = 1, resume: str | Path | None = None, report: Report = silent, **options: object
) -> StudyRun:
    """Solve a study, a film case whose [study] table varies keys, as `swashfilm film`; raise InputFaults.

    workers: number of processes; resume: run folder with finished points. A point without a result has its reason.
    """
    with _door("study"), _case_file(case) as path:
        from swashfilm.case.study import StudyCase
        from swashfilm.runs.film.command import film_case
        from swashfilm.runs.film.series.page import run_study
        from swashfilm.runs.film.series.result import StudyRun

        words = _words("film", [path], {"workers": workers if workers > 1 else None, "resume": resume} | options)
        found, _, count = film_case(words)
        if not isinstance(found, StudyCase):
            raise InputFaults(str(path), [Fault("study", "missing", "a case with [study]", "swashfilm.film()")])
        return StudyRun.ran(lambda folder: run_study(found, folder, report, resumed=words.resume, workers=count))


def map(
    pump: str | Path | PumpDescription = "ref90",
    *,
    speeds: str | Sequence[Quantity] | None = None,
    pressures: str | Sequence[Quantity] | None = None,
    displacements: str | Sequence[float] | None = None,
    temperatures: str | Sequence[Quantity] | None = None,
    inlet_pressures: str | Sequence[Quantity] | None = None,
    fidelity: str = "floating",
    report: Report = silent,
    **options: object,
) -> MapRun:
    """Solve an operating map, as `swashfilm map`; levels are text ("5..35MPa:7") or a list.

    options: plan, table, direct, check, workers, cluster, resume. Raises InputFaults.
    """
    given = {
        "speeds": speeds,
        "pressures": pressures,
        "displacements": displacements,
        "temperatures": temperatures,
        "inlet_pressures": inlet_pressures,
        "fidelity": fidelity,
    }
    with _door("map"), _pump_file(pump) as name:
        from swashfilm.runs.map.command import map_case, map_executor
        from swashfilm.runs.map.result import MapRun
        from swashfilm.runs.map.run import run_map

        words = _words("map", [name], given | options)
        asked = map_case(words)
        with map_executor(words, asked) as executor:
            return MapRun.ran(lambda folder: run_map(asked, folder, executor, report))


def table(pump: str | Path | PumpDescription, *, report: Report = silent, **options: object) -> TableRun:
    """Build a response table of a pump's gaps, or of one gap by its case, as `swashfilm table`.

    options: speed, pressure, displacement, temperature (ranges "MIN..MAX" or one value), inlet_pressure,
    case_pressure, source, points, held_out, workers, steps, finer, rigid, isoviscous, isothermal. Raises InputFaults.
    """
    with _door("table"), _pump_file(pump) as name:
        from swashfilm.runs.table.command import table_case
        from swashfilm.runs.table.result import TableRun

        asked = table_case(_words("table", [name], options))
        return TableRun.ran(lambda folder: asked.run(folder, report))


def duty(of: MapRun | str | Path, cycle: str | Path) -> DutyRun:
    """Return energies and losses over a duty cycle (CSV) by a map: a MapRun, its run folder, or its map.nc."""
    with _door("duty"), _map_file(of) as path:
        from swashfilm.runs.map.duty.cycle_file import read_cycle
        from swashfilm.runs.map.duty.result import DutyRun
        from swashfilm.runs.map.duty.run import run_duty
        from swashfilm.runs.map.files import map_file, read_map

        data, error = read_map(map_file(path))
        given = read_cycle(Path(cycle), data.axes)
        return DutyRun.ran(lambda folder: run_duty(data, error, given, Path(cycle), folder))


def compare(
    one: MapRun | str | Path | PumpDescription,
    other: MapRun | str | Path | PumpDescription,
    cycle: str | Path | None = None,
    *,
    fidelity: str | None = None,
    workers: int = 1,
) -> CompareRun:
    """Compare two maps or pumps, also over a duty cycle, as `swashfilm compare`; raise InputFaults.

    fidelity: of the map of a pump; None for lumped.
    """
    with _door("compare"), _map_or_pump(one) as first, _map_or_pump(other) as second:
        from swashfilm.runs.compare.command import compare_case
        from swashfilm.runs.compare.result import CompareRun

        options = {"cycle": cycle, "fidelity": fidelity, "workers": workers}
        return CompareRun.ran(compare_case(_words("compare", [first, second], options)).run)


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
    with _door("sensitivity"), _pump_file(pump) as name:
        from swashfilm.runs.variation.case import varied_case
        from swashfilm.runs.variation.options import varied_executor
        from swashfilm.runs.variation.sensitivity.result import SensitivityRun
        from swashfilm.runs.variation.sensitivity.run import run_sensitivity
        from system.variation.sensitivity import variants_needed

        words = _words("sensitivity", [name], given)
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
    with _door("tolerance"), _pump_file(pump) as name:
        from swashfilm.runs.variation.options import varied_executor
        from swashfilm.runs.variation.tolerance.command import tolerance_case
        from swashfilm.runs.variation.tolerance.result import ToleranceRun
        from swashfilm.runs.variation.tolerance.run import run_tolerance

        words = _words("tolerance", [name], given)
        case = tolerance_case(words)
        with varied_executor(words, case.varied.seconds(case.pumps)) as executor:
            return ToleranceRun.ran(lambda folder: run_tolerance(case, folder, executor, report))


def export(of: MapRun | str | Path, to: str, output: str | Path | None = None) -> tuple[Path, ...]:
    """Write a map for another program and return the files, as `swashfilm export`; raise InputFaults.

    of: a MapRun, its run folder, or its map.nc; to: "modelica", "matlab", "amesim", "fmu" or "csv"; output: the file,
    by default the pump's name in the working folder. Points without a result and missing binaries are Python warnings.
    """
    with _door("export"), _map_file(of) as path:
        from swashfilm.runs.export.write import export_of

        written = export_of(path, to, None if output is None else Path(output)).write()
    for warning in written.warnings:
        warnings.warn(warning, stacklevel=2)
    return written.paths


def plan(
    pump: str | Path | PumpDescription = "ref90",
    *,
    speeds: Quantity | Sequence[Quantity] | None = None,
    pressures: Quantity | Sequence[Quantity] | None = None,
    displacements: Quantity | Sequence[Quantity] | None = None,
    temperatures: Quantity | Sequence[Quantity] | None = None,
    campaign: str | Path | None = None,
    sensors: str | None = None,
    suspects: str | Sequence[str] | None = None,
    add: int | None = None,
    limit: str | Sequence[str] = (),
    report: Report = silent,
    **options: object,
) -> PlanRun:
    """Plan a test: what its points tell apart, and which points and meters to add, as `swashfilm plan`.

    limit: limits of the bench, ["speed <= 1800 rpm"]. options: inlet_pressures, plan, cost, apart, set. Raises
    InputFaults and NotConverged.
    """
    limits = [limit] if isinstance(limit, str) else list(limit)
    given = {
        "speeds": speeds, "pressures": pressures, "displacements": displacements, "temperatures": temperatures,
        "campaign": campaign, "sensors": sensors, "suspects": suspects, "add": add, "limit": limits,
    }  # fmt: skip
    with _door("plan"), _pump_file(pump) as name:
        from swashfilm.runs.plan.command import plan_case
        from swashfilm.runs.plan.result import PlanRun
        from swashfilm.runs.plan.run import run_plan

        case = plan_case(_words("plan", [name], given | options))
        return PlanRun.ran(lambda folder: run_plan(case, folder, report))


def transient(case: Case) -> TransientRun:
    """Solve displacement in time, as `swashfilm transient`; raise InputFaults and NotConverged."""
    with _door("transient"), _case_file(case) as path:
        from swashfilm.runs.transient.case import load_transient
        from swashfilm.runs.transient.run import solve_transient

        return solve_transient(load_transient(path))


def reference(case: Case, *, report: Report = silent) -> ReferenceRun:
    """Solve coefficients from the Navier-Stokes equations, as `swashfilm reference`; raise InputFaults."""
    with _door("reference"), _case_file(case) as path:
        from swashfilm.runs.reference.case import load_reference
        from swashfilm.runs.reference.result import ReferenceRun
        from swashfilm.runs.reference.run import run_reference

        found = load_reference(path)
        return ReferenceRun.ran(lambda folder: run_reference(found, folder, report))


def diagnose(
    pump: str | Path | PumpDescription, recording: str | Path, *, report: Report = silent, **options: object
) -> DiagnosisRun:
    """Compare a recording with the simulation of its pump, as `swashfilm diagnose`.

    pump: name, file (which may be incomplete) or description; recording: folder, or table beside a recording.toml.
    options: workers, film_tables; fidelity, steps, finer, rigid, isoviscous, isothermal, smooth, no_cavitation,
    variant, points, held_out. Raises InputFaults and NotConverged.
    """
    with _door("diagnose"), _pump_file(pump) as name:
        from diagnosis.finding import diagnose as found_by
        from diagnosis.study.acceptance import checked_recording
        from swashfilm.runs.diagnose.command import workers_and_file
        from swashfilm.runs.diagnose.films import film_model_of, film_options_of
        from swashfilm.runs.diagnose.result import DiagnosisRun
        from swashfilm.runs.diagnose.run import write_finding
        from system.effects.catalogue.entries import CATALOGUE, with_films_solved
        from system.pump_file.file import load_known_pump

        words = _words("diagnose", [name, recording], options)
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
    with _door("calibrate"), _pump_file(pump) as name:
        from diagnosis.calibration import calibrate as found_by
        from diagnosis.study.acceptance import checked_recording
        from swashfilm.runs.calibrate.command import LAWS, loss_models
        from swashfilm.runs.calibrate.files import write_calibration_files
        from swashfilm.runs.calibrate.result import CalibrationRun
        from system.pump_file.file import load_known_pump

        words = _words("calibrate", [name, recording], options)
        models = loss_models(words)
        known = load_known_pump(name)
        readings = checked_recording(words.recording, known)
        found = found_by(known, readings, report, models, words.laws == LAWS[0])
        title = readings.title or words.recording.stem
        return CalibrationRun.ran(lambda folder: write_calibration_files(folder, found, title))


def reproduce(figure: str = "all", *, report: Report = silent, **options: object) -> Reproduction:
    """Reproduce the paper's figures and tables, as `swashfilm reproduce`.

    options: fidelity, pump, recording, workers, steps, finer, rigid, isoviscous, isothermal. Raises InputFaults.
    """
    with _door("reproduce"):
        from swashfilm.runs.reproduce.command import reproduce_case
        from swashfilm.runs.reproduce.result import Reproduction
        from swashfilm.runs.reproduce.run import run_reproduce
        from system.work.processes import process_pool

        asked, workers = reproduce_case(_words("reproduce", [figure], options))
        with process_pool(workers) as executor:
            return Reproduction.ran(lambda folder: run_reproduce(asked, executor, folder, report))


def new(
    kind: str,
    of: str | Path | None = None,
    *,
    displacement: Quantity | None = None,
    pistons: int | None = None,
    oil: str | None = None,
    speed: Quantity | None = None,
    pressure: Quantity | None = None,
    circuit: str | None = None,
    part: str | None = None,
    output: str | Path | None = None,
) -> Path:
    """Write a commented file to start from and return its path, as `swashfilm new`; nothing is overwritten.

    kind: "pump" (with displacement to circuit), "recording" (of: its table; part: its sheet, group or variable),
    "film" (of: its kind). Raises InputFaults.
    """
    if isinstance(displacement, float):
        displacement = f"{displacement!r} m3/rev"
    given: dict[str, object] = {
        "displacement": displacement,
        "pistons": pistons,
        "oil": oil,
        "speed": speed,
        "pressure": pressure,
        "circuit": circuit,
        "part": part,
    }
    with _door("new"):
        from swashfilm.cli.new.command import new_file

        words = _words("new", [kind] if of is None else [kind, of], given)
        words.output = None if output is None else Path(output)
        return new_file(words).write()


def open(folder: str | Path) -> Result:
    """Return the result of a finished run folder, of the class of its kind; raise InputFaults without one."""
    import json

    place = Path(folder)
    with _door("open"):
        summary = place / "summary.json"
        if not summary.is_file():
            fault = Fault("folder", f"no {summary}", "the folder of a finished run", nearest_path(place))
            raise InputFaults("command line", [fault])
        kind = json.loads(summary.read_text("utf-8")).get("kind")
        kinds = {name: found for found in _result_classes() for name in found.kinds}
        if kind not in kinds:
            near = nearest_choice(str(kind), kinds)
            raise InputFaults(str(place), [Fault("kind", repr(kind), f"one of {', '.join(kinds)}", near)])
        return kinds[kind].opened(place)


def _result_classes() -> Iterator[type[Result]]:
    """Yield the classes of results; one without kinds is the base of the others."""
    for room in _RESULTS:
        module = import_module(f"swashfilm.runs.{room}.result")
        yield from (one for one in vars(module).values() if isinstance(one, type) and getattr(one, "kinds", None))


def _words(command: str, positional: Sequence[object], given: Mapping[str, object]) -> argparse.Namespace:
    """Return the options of a command line; raise InputFaults for names that the command does not have."""
    known = [option[2:].replace("-", "_") for option in options_of(command) if option not in _OF_COMMAND_LINE]
    if unknown := [name for name in given if name not in known]:
        expected = f"one of {', '.join(known)}"
        faults = [Fault(name, "unknown argument", expected, nearest_choice(name, known)) for name in unknown]
        raise InputFaults(COMMAND_LINE, faults)
    words = [command, *(str(one) for one in positional)]
    for name, value in given.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(option)
        elif isinstance(value, Mapping):
            words += [f"{option}={key}={one}" for key, one in value.items()]
        elif isinstance(value, list) and name == "limit":
            words += [f"{option}={one}" for one in value]
        elif value is not None and value is not False:
            words.append(f"{option}={_text(name, value)}")
    return parse(words)


def _text(name: str, value: object) -> str:
    """Return a value as text of the command line: numbers of a quantity in SI get their unit."""
    if isinstance(value, (str, Path)):
        return str(value)
    if isinstance(value, Iterable):
        return ",".join(_text(name, one) for one in value)
    return f"{value!r} {_SI[name]}" if name in _SI else repr(value)


@contextmanager
def _door(name: str) -> Iterator[None]:
    """Convert faults of a command line to those of a call: options are its arguments, the source its name."""
    try:
        yield
    except InputFaults as reason:
        source = f"swashfilm.{name}()" if reason.source == COMMAND_LINE else reason.source
        faults = [
            replace(
                fault, path=_argument(fault.path), expected=_argument(fault.expected), nearest=_argument(fault.nearest)
            )
            for fault in reason.faults
        ]
        raise InputFaults(source, faults, reason.lines) from None
    except InputError as reason:
        fault = Fault(reason.where, reason.found, reason.expected)
        raise InputFaults(f"swashfilm.{name}()", [fault]) from reason


def _argument(text: str) -> str:
    return re.sub(r"--([a-z][a-z-]*)", lambda found: found[1].replace("-", "_"), text)


@contextmanager
def _pump_file(pump: str | Path | PumpDescription) -> Iterator[str]:
    """Yield the name or path of a pump; a description is written to a temporary file."""
    if isinstance(pump, (str, Path)):
        yield str(pump)
        return
    from system.pump_file.file import resolved_toml

    with _written(f"{pump.name}.toml", resolved_toml(pump)) as path:
        yield str(path)


@contextmanager
def _case_file(case: Case) -> Iterator[Path]:
    """Yield the path of a case; text and tables are written to a temporary file."""
    if isinstance(case, Mapping):
        import tomli_w

        case = tomli_w.dumps(case)
    if isinstance(case, str) and "\n" in case:
        with _written("case.toml", case) as path:
            yield path
        return
    yield Path(case)


@contextmanager
def _map_file(of: MapRun | str | Path) -> Iterator[Path]:
    """Yield the path of a map; a result is written to a temporary folder."""
    if isinstance(of, (str, Path)):
        yield Path(of)
        return
    with tempfile.TemporaryDirectory(prefix="swashfilm-") as place:
        of.write(Path(place))
        yield Path(place)


@contextmanager
def _map_or_pump(of: MapRun | str | Path | PumpDescription) -> Iterator[str]:
    from system.description.pump import PumpDescription

    with _pump_file(of) if isinstance(of, PumpDescription) else _map_file(of) as place:
        yield str(place)


@contextmanager
def _written(name: str, text: str) -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="swashfilm-") as place:
        path = Path(place) / re.sub(r"[^\w.-]+", "-", name)
        path.write_text(text, encoding="utf-8")
        yield path
