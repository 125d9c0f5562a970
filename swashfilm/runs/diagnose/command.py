"""The command `swashfilm diagnose`: pump and recording in, a verdict in words out; and `check` of a recording."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from datetime import date
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, RECORDING, expect_order, whole
from swashfilm.console.schemas import write_new
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show, show_at_once, show_table
from swashfilm.runs.diagnose.films import FLOATING, add_film_options
from system.inputs.faults import Fault, InputFaults, nearest_path

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording

MOST_WORKERS = 64
USUAL_WORKERS = 4  # at most, where not stated: more wait for each other


def add_diagnose_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `swashfilm diagnose`."""
    command.add_argument("pump", metavar="PUMP", help="built-in name (ref90) or pump file (a few sizes suffice)")
    command.add_argument("recording", type=Path, metavar="RECORDING", help=RECORDING)
    add_set_option(command)
    what = "write the fitted pump with the effects found, its origin and tolerances, for `swashfilm run FILE.toml`"
    command.add_argument("--apply", type=Path, metavar="FILE.toml", help=what)
    what = f"processes that fit hypotheses side by side (as many as cores, {USUAL_WORKERS} at most)"
    command.add_argument("--workers", metavar="N", help=what)
    what = "elastic walls by solved films, which take about a minute, once for each pump"
    command.add_argument("--film-tables", action="store_true", help=what)
    add_film_options(command)
    what = (
        "diagnose again whenever recording.toml of the folder RECORDING or a table that it names arrives or changes, "
        "until Ctrl-C: a line and a run folder in runs each time; not beside -o or --apply"
    )
    command.add_argument("--watch", action="store_true", help=what)


def run_diagnose_command(options: argparse.Namespace) -> int:
    """Run `swashfilm diagnose` and return its exit code, 0 for any verdict; a watch ends by Ctrl-C."""
    expect_order(options.pump, options.recording, "diagnose")
    workers, apply = workers_and_file(options)
    if options.watch:
        _watch(options, workers)
    from diagnosis.finding import diagnose
    from diagnosis.study.acceptance import checked_recording
    from swashfilm.console.progress import progress
    from swashfilm.output.page import PAGE
    from swashfilm.output.run_folder import Interrupted, final_folder, run_folder
    from swashfilm.runs.diagnose.applied import applied_toml
    from swashfilm.runs.diagnose.films import film_model_of, film_options_of
    from swashfilm.runs.diagnose.result import DiagnosisRun
    from swashfilm.runs.diagnose.run import write_finding
    from swashfilm.runs.diagnose.told import MOST_LINES, answer_lines, show_contradictions
    from system.effects.catalogue.entries import CATALOGUE, with_films_solved
    from system.effects.effect import Kind
    from system.pump_file.file import load_known_pump

    known = load_known_pump(options.pump, set_values_of(options))
    film_options = film_options_of(options, known)
    recording = checked_recording(options.recording, known)
    show_contradictions(recording)
    name = f"diagnose-{recording.title or options.recording.stem}"
    with run_folder(name, options.output, workbook=options.excel) as folder, progress(1, "diagnosis") as report:
        catalogue = with_films_solved(known.pump, report) if options.film_tables else CATALOGUE
        try:
            films = film_model_of(known.pump, recording, film_options, workers, report)
        except KeyboardInterrupt:
            raise Interrupted(None, "solved points are kept; the same command continues from them") from None
        finding = diagnose(known, recording, report, workers, catalogue, films)
        write_finding(folder, finding)
        found = DiagnosisRun.opened(folder)
    show_contradictions(finding.study.recording, recording)
    for line in answer_lines(found.record["answer"], MOST_LINES - (apply is not None)):
        show(line)
    if apply is not None and finding.extended_pump is not None:
        write_new(apply, "pump", applied_toml(finding, finding.extended_pump, date.today()))
        what = "without the sensor's fault" if finding.diagnosis.kind is Kind.SENSOR_FAULT else "with it"
        fidelity = " --fidelity lumped" if films is None else ""  # floating films have all physics by default
        show(f"the pump as fitted, {what}: swashfilm run {quote(str(apply))}{fidelity}")
    elif apply is not None:
        show(f"nothing is claimed: {apply} is not written")
    show(f"results in {final_folder(folder)}; {PAGE} there has the evidence")
    return 0


def _watch(options: argparse.Namespace, workers: int) -> None:
    """Diagnose a folder repeatedly, each time into a run folder of its own; ends by KeyboardInterrupt."""
    from diagnosis.finding import diagnose
    from diagnosis.study.acceptance import checked_recording
    from swashfilm.output.page import PAGE
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.diagnose.films import film_options_of
    from swashfilm.runs.diagnose.run import write_finding
    from swashfilm.runs.diagnose.watch import Answer, answer_of, watch
    from system.effects.catalogue.entries import CATALOGUE, with_films_solved
    from system.pump_file.file import load_known_pump
    from system.work.progress import silent

    known = load_known_pump(options.pump, set_values_of(options))
    film_options_of(options, known)  # their faults; a watch has no floating films
    catalogue = with_films_solved(known.pump, silent) if options.film_tables else CATALOGUE

    def diagnosed() -> Answer:
        recording = checked_recording(options.recording, known)
        with run_folder(f"diagnose-{recording.title or options.recording.stem}") as folder:
            finding = diagnose(known, recording, silent, workers, catalogue)
            write_finding(folder, finding)
        points = len(finding.study.recording.steady.values)
        return answer_of(finding.diagnosis, points, final_folder(folder) / PAGE)

    show(f"watching {options.recording}: Ctrl-C ends")
    watch(options.recording, diagnosed, show_at_once)


def workers_and_file(options: argparse.Namespace) -> tuple[int, Path | None]:
    """Number of processes and file of the fitted pump; raises InputFaults with the faults of both."""
    from system.work.processes import cores

    faults: list[Fault] = []
    usual = min(cores(), USUAL_WORKERS)
    workers = whole(faults, "--workers", options.workers, usual, (1, MOST_WORKERS), "a number of processes")
    apply = _apply(options, faults)
    if options.watch:
        faults += _of_watch(options)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return workers, apply


def is_recording(path: Path, tables: Sequence[str]) -> bool:
    """True if the path of `check` is a recording: a folder, a table of readings, or a TOML file with [channel]."""
    return path.is_dir() or "channel" in tables or (path.suffix.lower() != ".toml" and path.is_file())


def check_recording_command(path: Path) -> None:
    """Show a recording as understood; raises InputFaults with every fault of its files and readings at once."""
    from diagnosis.checks.notes import note_text
    from diagnosis.recording.model import NoteKind
    from diagnosis.study.acceptance import checked_recording

    recording = checked_recording(path)
    show(f"{recording.title or path.stem}: {len(recording.steady.values)} points")
    show_table("Channels: readings, range, one sigma of repeatability at mid range", list(_channel_rows(recording)))
    for note in sorted(recording.notes, key=lambda note: note.kind is not NoteKind.WARNED):
        show(f"warning: {note_text(note)}" if note.kind is NoteKind.WARNED else note_text(note))


def _channel_rows(recording: Recording) -> Sequence[tuple[str, ...]]:
    """(channel, readings, least to largest, sigma) of all steady channels."""
    import numpy as np

    from diagnosis.recording.model import reading_sigma
    from diagnosis.recording.units import channel_unit, difference, difference_unit, reading

    rows = []
    for channel in recording.channels:
        values = recording.steady.column(channel.name)
        known = values[np.isfinite(values)]
        if known.size:
            ends = (f"{reading(channel.name, float(end)):.4g}" for end in (known.min(), known.max()))
            sigma = difference(channel.name, float(reading_sigma(channel, np.median(known, keepdims=True))[0]))
            span = f"{' to '.join(ends)} {channel_unit(channel.name)}".removesuffix(" 1")
            noise = f"{sigma:.2g} {difference_unit(channel.name)}".removesuffix(" 1")
            rows.append((channel.name.value, str(known.size), span, noise))
    return rows


def _apply(options: argparse.Namespace, faults: list[Fault]) -> Path | None:
    """File of the fitted pump: new, in an existing folder."""
    path: Path | None = options.apply
    if path is not None and path.exists():
        faults.append(Fault("--apply", f"{path}, which is there already", "a new file: nothing is overwritten"))
    elif path is not None and not path.resolve().parent.is_dir():
        faults.append(Fault("--apply", f"{path}, in no folder", "a file in a folder that is there"))
    return path


def _of_watch(options: argparse.Namespace) -> Iterator[Fault]:
    """Faults of a watch: it needs a folder, and writes neither one file nor one run folder."""
    if not options.recording.is_dir():
        near = str(options.recording.parent) if options.recording.is_file() else nearest_path(options.recording)
        yield Fault("--watch", f"{options.recording}, which is no folder", "the folder of a recording", near)
    if options.fidelity == FLOATING:
        yield Fault("--watch", "--fidelity floating", "the same command without --watch: tables belong to a recording")
    for name, given in (("--apply", options.apply), ("-o", options.output)):
        if given is not None:
            expected = "a run folder of its own for every diagnosis of a watch, in runs"
            yield Fault(name, f"{given} beside --watch", expected, "the same command without --watch")


COMMAND = Command(
    "diagnose",
    "mismatch of a recording and the simulation of its pump: place, cause, certainty",
    add_diagnose_options,
    run_diagnose_command,
)
