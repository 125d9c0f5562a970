"""Inputs common to all commands: kind of file, text of the pump file."""

import argparse
from collections.abc import Mapping
from pathlib import Path
from shlex import quote
from typing import Any

from reynolds.numerics.files import is_file, read_text
from system.inputs.faults import Fault, InputFaults

COMMAND_LINE = "command line"
"""Source of the faults of options."""
RECORDING = "folder with a recording.toml, or a table beside one"
"""Help on the path of a recording."""


def option_value(options: argparse.Namespace, option: str) -> Any:
    """Return the value of an option on the command line; None if it is left out."""
    return getattr(options, option[2:].replace("-", "_"))


def whole(
    faults: list[Fault], option: str, text: str | None, usual: int, bounds: tuple[int, int], what: str = "a number"
) -> int:
    """Return the whole number of an option, `usual` where it is left out; list the fault of one out of bounds."""
    if text is None or (text.isdecimal() and bounds[0] <= int(text) <= bounds[1]):
        return usual if text is None else int(text)
    faults.append(Fault(option, repr(text), f"{what}, {bounds[0]} to {bounds[1]}"))
    return usual


def given_text(pump: str, stated: Mapping[str, object]) -> str:
    """Return the text of the pump file, headed by comments with the values that the command line sets."""
    from importlib.resources import files

    from system.pump_file.file import builtin_pumps

    built_in = files("system.description").joinpath("pumps", f"{pump}.toml")
    text = built_in.read_text("utf-8") if pump in builtin_pumps() else read_text(Path(pump))
    return "".join(f"# command line: {path} = {value}\n" for path, value in stated.items()) + text


def expect_order(pump: str, recording: Path, command: str) -> None:
    """Raise InputFaults for a recording in the place of PUMP and a pump in that of RECORDING; suggest the command."""
    from system.pump_file.file import builtin_pumps

    is_pump = str(recording) in builtin_pumps() or "pump" in _tables_of(recording)
    if is_pump and (Path(pump).is_dir() or "channel" in _tables_of(Path(pump))):
        found = f"'{pump}', a recording; RECORDING is '{recording}', a pump"
        near = f"PUMP and RECORDING swapped? swashfilm {command} {quote(str(recording))} {quote(pump)}"
        raise InputFaults(COMMAND_LINE, [Fault("PUMP", found, "a built-in name or a pump file", near)])


def _tables_of(path: Path) -> set[str]:
    """Return the names of the tables of a TOML file; none for any other path."""
    from system.inputs.toml_table import read_toml

    try:
        return {name for name, part in read_toml(path)[1].items() if isinstance(part, dict)}
    except InputFaults:
        return set()


def expect(path: str | Path, wanted: str, command: str) -> None:
    """Raise InputFaults for a file of the other kind ("pump" or "film"); name the command that reads it."""
    from system.inputs.toml_table import read_toml

    if not is_file(Path(path)):
        return
    _, tables = read_toml(Path(path))
    found = next((kind for kind in ("film", "pump") if isinstance(tables.get(kind), dict)), wanted)
    if found != wanted and "gap" not in tables:
        near = f"swashfilm {command} {quote(str(path))}"
        fault = Fault("file", f"a file with [{found}]", f"a file with [{wanted}]", near)
        raise InputFaults(str(path), [fault])
