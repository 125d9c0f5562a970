"""Command `swashfilm reproduce`: figures and tables of the paper, its statements beside computed numbers."""

from __future__ import annotations

import argparse
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING

from reynolds.numerics.files import replaced
from swashfilm.case.gap.switches import SWITCHES, add_floating_options
from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, option_value, whole
from swashfilm.console.settings import add_set_option, set_values
from swashfilm.console.terminal import show, show_result, show_table
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording
    from swashfilm.runs.reproduce.run import ReproduceCase

ALL, LIST = "all", "list"
_LUMPED, _FLOATING = "lumped", "floating"
_TUNED = "fig13"


def add_reproduce_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument(
        "figure", nargs="?", default=ALL, metavar="FIGURE",
        help="fig2, table1, ..; several with commas; all; or list for the names",
    )  # fmt: skip
    command.add_argument(
        "--fidelity", metavar="{lumped,fixed,floating}",
        help="films of given thickness (lumped: seconds; with --recording), solved at given positions (fixed: "
        "minutes), or floating (the default: hours for all figures; points are kept between runs)",
    )  # fmt: skip
    command.add_argument("--pump", default="ref90", metavar="PUMP", help="built-in name or pump file (ref90)")
    add_set_option(command)
    command.add_argument(
        "--recording", type=Path, metavar="RECORDING",
        help="fig13: fit to readings of a bench (folder of a recording.toml), not to computed ones",
    )  # fmt: skip
    command.add_argument("--page", type=Path, metavar="FILE.md", help="write the page to this file as Markdown too")
    command.add_argument("--workers", metavar="N", help="processes that solve points side by side (1)")
    add_floating_options(command)


def run_reproduce_command(options: argparse.Namespace) -> int:
    """Run `swashfilm reproduce` and return its exit code; raise InputFaults with every fault of the options."""
    if options.figure == LIST:
        return _list()
    asked, workers = reproduce_case(options)
    from swashfilm.console.assumed import show_assumed

    show_assumed(options.pump)
    if minutes := asked.minutes:
        show(f"{asked.points} floating points: about {minutes:.0f} min of processor time, less those that are kept")
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.reproduce.page import count_words, markdown_page
    from swashfilm.runs.reproduce.result import Reproduction
    from swashfilm.runs.reproduce.run import run_reproduce
    from system.work.processes import process_pool

    with (
        run_folder("reproduce", options.output, workbook=options.excel) as folder,
        process_pool(workers) as executor,
        progress(1, f"reproduce {options.figure}") as report,
    ):
        run_reproduce(asked, executor, folder, report)
        found = Reproduction.opened(folder)
        if options.page is not None:
            _write_page(options.page, markdown_page(folder, _command(options)))
    show_result(found, folder)
    for figure in found.summary["figures"]:
        if all(row["figure"] != figure["name"] for row in found.claims):
            show(f"{figure['name']}: {' '.join(figure['remarks'])}")
    if found.summary["about"]:
        show(found.summary["about"])
    show(count_words(found.claims))
    return 0


def _list() -> int:
    from system.paper.figure import DRAWINGS, Figure

    show_table("Figures and tables", [(figure.value, figure.title) for figure in Figure])
    show_table("Drawings, without numbers", list(DRAWINGS.items()))
    return 0


def reproduce_case(options: argparse.Namespace) -> tuple[ReproduceCase, int]:
    """Return the case of a command line, and the number of workers; raise InputFaults with every fault."""
    from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
    from swashfilm.runs.reproduce.run import ReproduceCase
    from system.paper.figure import Figure
    from system.paper.points import PaperFidelity
    from system.pump_file.file import load_pump

    options.fidelity = options.fidelity or (_FLOATING if options.recording is None else _LUMPED)
    faults = _word_faults(options)
    stated = set_values(options.set, faults)
    try:
        pump = load_pump(options.pump, stated)
    except InputFaults as reason:
        raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None
    faults += floating_faults(options, pump, options.fidelity)
    if options.fidelity != _LUMPED:
        faults += alike_faults(pump)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    fidelity, recording = PaperFidelity(options.fidelity), _recording_of(options)
    figures = tuple(Figure) if options.figure == ALL else tuple(map(Figure.named, _named(options)))
    asked = ReproduceCase(pump, figures, fidelity, floating_options(options, pump), recording)
    return asked, int(options.workers or 1)


def _recording_of(options: argparse.Namespace) -> Recording | None:
    """Return the checked recording to which Fig. 13 is fitted; raise InputFaults where it is not suitable."""
    if options.recording is None:
        return None
    from swashfilm.runs.reproduce.run import recording_for_fig13

    return recording_for_fig13(options.recording, options.pump)


def _named(options: argparse.Namespace) -> list[str]:
    """Return the names of the figures that the command line requests."""
    return [name.strip() for name in options.figure.split(",")]


def _word_faults(options: argparse.Namespace) -> list[Fault]:
    """Return the faults of options that do not depend on the pump."""
    from system.paper.figure import DRAWINGS, Figure
    from system.paper.points import PaperFidelity

    faults: list[Fault] = []
    figures = [*([] if "," in options.figure else [ALL, LIST]), *(figure.value for figure in Figure)]
    expected = f"one of {', '.join(figures)}"
    for name in _named(options):
        if name in DRAWINGS:
            faults.append(Fault("FIGURE", f"{name}, a drawing ({DRAWINGS[name]})", expected))
        elif name not in figures:
            faults.append(Fault("FIGURE", repr(name), expected, nearest_choice(name, figures)))
    fidelities = [fidelity.value for fidelity in PaperFidelity]
    if options.fidelity not in fidelities:
        near = nearest_choice(options.fidelity, fidelities)
        faults.append(Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(fidelities)}", near))
    if options.recording is not None and (not {ALL, _TUNED} & set(_named(options)) or options.fidelity != _LUMPED):
        found = f"with {options.figure}, --fidelity {options.fidelity}"
        faults.append(Fault("--recording", found, f"{_TUNED} or {ALL}, --fidelity {_LUMPED}: only they use it"))
    whole(faults, "--workers", options.workers, 1, (1, 256))
    return faults


def _command(options: argparse.Namespace) -> str:
    """Return the command that writes the same page."""
    names = ("--fidelity", "--pump", "--recording", "--steps", "--finer")
    stated = {name: option_value(options, name) for name in names}
    words = [f" {name} {quote(str(text))}" for name, text in stated.items() if text not in (None, _FLOATING, "ref90")]
    words += [f" --set {quote(text)}" for text in options.set]
    words += [f" {switch}" for switch in SWITCHES if option_value(options, switch)]
    return f"swashfilm reproduce {options.figure}{''.join(words)} --page {quote(str(options.page))}"


def _write_page(path: Path, text: str) -> None:
    try:
        with replaced(path) as beside:
            beside.write_text(text, encoding="utf-8")
    except OSError as reason:
        raise InputFaults(COMMAND_LINE, [Fault("--page", f"{path}: {reason.strerror}", "a file to write")]) from None


COMMAND = Command(
    "reproduce",
    "figures of the paper: its statements beside computed numbers",
    add_reproduce_options,
    run_reproduce_command,
)
