"""Command `swashfilm check`: the content of a file with all defaults, or its faults, without a run."""

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.console.settings import add_set_option, set_values_of
from swashfilm.console.terminal import show
from swashfilm.runs.diagnose.command import check_recording_command, is_recording
from system.inputs.faults import Fault, InputFaults

EXAMPLE = "film.thickness=12um"


def run_check_command(options: argparse.Namespace) -> int:
    """Run `swashfilm check` and return its exit code; raise InputFaults with every fault of the file."""
    from system.pump_file.file import builtin_pumps

    stated = set_values_of(options, EXAMPLE)
    if options.file in builtin_pumps():
        _show_pump(options.file, stated)
    else:
        _show_file(options.file, stated)
    show(f"{options.file}: ok")
    return 0


def _show_file(file: str, stated: Mapping[str, object]) -> None:
    """Show a file with other values of keys, by its kind; raise InputFaults for a file of no known kind."""
    from system.inputs.toml_table import read_toml

    path = Path(file)
    tables = {} if is_recording(path, ()) else read_toml(path)[1]
    if is_recording(path, list(tables)):
        if stated:
            raise InputFaults(COMMAND_LINE, [Fault("--set", "an option beside a recording", "a pump file or a case")])
        check_recording_command(path)
    elif "transient" in tables:
        from swashfilm.runs.transient.case import load_transient

        show(load_transient(path, stated).resolved)
    elif "optimise" in tables:
        from swashfilm.runs.variation.optimise.command import checked_words

        show(checked_words(path, stated))
    elif "reference" in tables:
        from swashfilm.runs.reference.case import load_reference

        show("\n".join(passage.words for passage in load_reference(path, stated).passages))
    elif {"film", "gap"} & set(tables):
        show(_checked_film(path, tables, stated))
    elif isinstance(tables.get("pump"), dict):
        _show_pump(file, stated)
    else:
        cases = "[transient], [optimise], [reference]"
        kinds = f"[pump] (a pump file), [film] (a film case), {cases} or [channel] (a recording)"
        raise InputFaults(file, [Fault("file", f"tables {', '.join(tables) or 'none'}", kinds)])


def _show_pump(file: str, stated: Mapping[str, object]) -> None:
    """Show a pump with all its assumptions and warnings."""
    from swashfilm.console.assumed import scaled_warning
    from system.multibody.assumed import assumptions
    from system.pump_file.file import check_pump, load_known_pump, resolved_toml

    known = load_known_pump(file, stated)
    show(resolved_toml(known.pump))
    for one in (*known.assumptions, *assumptions(known.pump)):
        show(f"# {one}")
    for warning in check_pump(known.pump).warnings:
        show(f"warning: {warning}")
    for text in scaled_warning(known.assumptions):
        show(f"warning: {text}")


def _checked_film(path: Path, tables: Mapping[str, Any], stated: Mapping[str, object]) -> str:
    """Return the resolved film case of a file, of a study or table at its first point; raise InputFaults."""
    from swashfilm.case.file import FilmCase
    from swashfilm.case.study import StudyCase, load_film
    from swashfilm.runs.film.checks.extent import case_warnings
    from swashfilm.runs.table.gap_case import load_gap_table

    if "table" in tables:
        asked = load_gap_table(path, values=stated)
        show(f"a table over {len(asked.axes)} keys")
        return asked.study.case(asked.study.points[0]).resolved
    found = load_film(path, values=stated)
    if isinstance(found, StudyCase):
        show(f"a study of {len(found.points)} points")
    case = found.case(found.points[0]) if isinstance(found, StudyCase) else found
    warned = case_warnings(case) if isinstance(case, FilmCase) else []
    return "\n".join([case.resolved, *(f"warning: {text}" for text in warned)])


def _add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="pump file, built-in pump, any case, or recording")
    add_set_option(command, "the pump file or case", EXAMPLE)


COMMAND = Command(
    "check",
    "validate a pump file, case or recording without running it",
    _add_options,
    run_check_command,
    in_folder=False,
)
