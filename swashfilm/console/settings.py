"""Option --set: other values of keys of a pump file or a case."""

import argparse
from collections.abc import Iterable

from swashfilm.console.inputs import COMMAND_LINE
from system.inputs.faults import Fault, InputFaults
from system.inputs.toml_table import parse_toml

EXAMPLE = "valve_plate.film_thickness=10um"
LEVELS_EXAMPLE = "valve_plate.film_thickness=6..14um:9"
"""Of --vary, which has levels in place of the value of --set."""


def add_set_option(parser: argparse.ArgumentParser, of: str = "the pump file", example: str = EXAMPLE) -> None:
    """Add --set to a parser; of: the file whose keys it sets."""
    what = f"another value of a key of {of}, such as {example}; may be repeated"
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help=what)


def add_pump_argument(parser: argparse.ArgumentParser) -> None:
    """Add the pump to the parser of a command whose default is the reference pump."""
    what = "built-in name (ref90, the default) or pump file"
    parser.add_argument("pump", nargs="?", default="ref90", metavar="PUMP", help=what)


def set_values(texts: Iterable[str], faults: list[Fault], example: str = EXAMPLE) -> dict[str, object]:
    """Return the values of --set by key, as written in a file.

    Lists the fault of a text that is no KEY=VALUE, and of a key with two values.
    """
    stated: dict[str, object] = {}
    for text in texts:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not (equals and key and value):
            faults.append(Fault("--set", repr(text), f"KEY=VALUE, such as {example}"))
            continue
        found = toml_value(value)
        if stated.setdefault(key, found) != found:
            faults.append(Fault(f"--set {key}", f"{stated[key]!r} and {found!r}", "one value of a key"))
    return stated


def set_values_of(options: argparse.Namespace, example: str = EXAMPLE) -> dict[str, object]:
    """Return the values of a command line's --set by key; raise InputFaults for texts that are no KEY=VALUE."""
    faults: list[Fault] = []
    stated = set_values(options.set, faults, example)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return stated


def toml_value(text: str) -> object:
    """Return the value of a TOML text; text that is not a TOML value, such as `10um`, is a string."""
    try:
        return parse_toml(f"value = {text}")["value"]
    except ValueError:
        return text
