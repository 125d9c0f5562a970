"""The command `swashfilm diagnose`: a pump and a recording in, a verdict in words out."""

from __future__ import annotations

import argparse
from pathlib import Path

from swashfilm.terminal import show, show_table


def add_diagnose_options(command: argparse.ArgumentParser) -> None:
    """The words that `swashfilm diagnose` takes."""
    command.add_argument("pump", metavar="PUMP", help="built-in name (ref90) or pump file, which may know little")
    command.add_argument(
        "recording",
        type=Path,
        metavar="RECORDING",
        help="folder of a recording.toml, or a table beside one",
    )


def run_diagnose_command(options: argparse.Namespace) -> int:
    """Run `swashfilm diagnose` and return its exit code, 0 whatever the verdict."""
    from diagnosis.diagnosis_file import read_diagnosis
    from diagnosis.scant_pump import load_known_pump
    from diagnosis.words import paragraphs
    from swashfilm.diagnose_page import CHANNEL_HEAD, channel_rows
    from swashfilm.diagnose_run import checked_recording, run_diagnosis
    from swashfilm.progress import progress
    from swashfilm.run_folder import final_folder, run_folder

    known = load_known_pump(options.pump)
    recording = checked_recording(options.recording, known)
    name = f"diagnose-{recording.title or options.recording.stem}"
    with run_folder(name, options.output) as folder, progress(1, "diagnosis") as report:
        found = run_diagnosis(known, recording, folder, report)
        record = read_diagnosis(folder / "diagnosis.json")
    for text in paragraphs(found):
        show(text)
    show_table("Channels", [CHANNEL_HEAD, *channel_rows(record)])
    show(f"results in {final_folder(folder)}")
    return 0
