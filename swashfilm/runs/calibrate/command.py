"""The command `swashfilm calibrate`: pump and recording in, coefficients with their uncertainty out."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, RECORDING, expect_order
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show, show_table
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from system.bench.loss_models.model import LossModelName

LAWS = ("mixed_friction", "none")
ALL, NONE = "all", "none"


def add_calibrate_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `swashfilm calibrate`."""
    command.add_argument("pump", metavar="PUMP", help="built-in name (ref90) or pump file (a few sizes suffice)")
    command.add_argument("recording", type=Path, metavar="RECORDING", help=RECORDING)
    add_set_option(command)
    what = "friction law tried beside constant coefficients: over the Hersey number, or none"
    command.add_argument("--laws", metavar=f"{{{','.join(LAWS)}}}", default=LAWS[0], help=what)
    what = "loss models compared by the same cross-validation: names separated by commas, all, or none"
    command.add_argument("--models", metavar="NAME,..", default=ALL, help=what)


def run_calibrate_command(options: argparse.Namespace) -> int:
    """Run `swashfilm calibrate` and return its exit code; raises InputFaults with every fault of the options."""
    models = loss_models(options)
    expect_order(options.pump, options.recording, "calibrate")
    from diagnosis.calibration import calibrate
    from diagnosis.recording.model import NoteKind
    from diagnosis.study.acceptance import checked_recording
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import final_folder, run_folder
    from swashfilm.runs.calibrate.files import CALIBRATED, write_calibration_files
    from swashfilm.runs.calibrate.result import CalibrationRun
    from swashfilm.runs.diagnose.told import show_contradictions
    from system.pump_file.file import load_known_pump

    known = load_known_pump(options.pump, set_values_of(options))
    recording = checked_recording(options.recording, known)
    show_contradictions(recording)
    title = recording.title or options.recording.stem
    with (
        run_folder(f"calibrate-{title}", options.output, workbook=options.excel) as folder,
        progress(1, f"calibrate {known.pump.name}") as report,
    ):
        found = calibrate(known, recording, report, models, options.laws == LAWS[0])
        write_calibration_files(folder, found, title)
        run = CalibrationRun.opened(folder)
    for text in run.paragraphs:
        show(text)
    for heading, rows in run.tables():
        show_table(heading, rows)
    show_contradictions(found.study.recording, recording)
    for note in found.notes:
        if note.startswith(NoteKind.REMOVED.value):
            show(note)
    show(f"the fitted pump is {final_folder(folder) / CALIBRATED}")
    show(f"results in {final_folder(folder)}")
    return 0


def loss_models(options: argparse.Namespace) -> list[LossModelName]:
    """The loss models of a command line; raises InputFaults for other names and laws."""
    from system.bench.loss_models.model import LossModelName

    faults: list[Fault] = []
    if options.laws not in LAWS:
        nearest = nearest_choice(options.laws, LAWS)
        faults.append(Fault("--laws", repr(options.laws), f"one of {', '.join(LAWS)}", nearest))
    known = [name.value for name in LossModelName]
    asked = {ALL: known, NONE: []}.get(options.models, options.models.split(","))
    for name in asked:
        if name not in known:
            expected = f"{ALL}, {NONE}, or of {', '.join(known)}"
            faults.append(Fault("--models", repr(name), expected, nearest_choice(name, known)))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return [LossModelName(name) for name in asked]


COMMAND = Command(
    "calibrate",
    "coefficients of a pump fitted to a recording, with their uncertainty",
    add_calibrate_options,
    run_calibrate_command,
)
