"""A call as the equivalent command line: words from arguments, and faults in terms of arguments."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path

from reynolds.errors import InputError
from swashfilm.cli.app import COMMANDS, options_of, parse
from swashfilm.console.inputs import COMMAND_LINE
from system.inputs.faults import Fault, InputFaults, nearest_choice

Quantity = str | float
"""Text with its unit, or a number in SI."""

_SI = {
    **dict.fromkeys(("speed", "speeds"), "rad/s"), **dict.fromkeys(("temperature", "temperatures"), "K"),
    **dict.fromkeys(("pressure", "pressures", "inlet_pressure", "inlet_pressures", "case_pressure"), "Pa"),
}  # fmt: skip
_OF_COMMAND_LINE = (
    "-o", "--output", "--help", "--csv", "--animate", "--apply", "--page", "--watch", "--excel", "--units",
)  # fmt: skip


def words_of(command: str, positional: Sequence[object], given: Mapping[str, object]) -> argparse.Namespace:
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
            from swashfilm.api.tables import settings_of_file

            words += [f"{option}={key}={one}" for key, one in settings_of_file(value).items()]
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
def door(name: str) -> Iterator[None]:
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
    """Return a text with the options of the commands as arguments; options of other programs stay."""
    return re.sub(r"--([a-z][a-z-]*)", lambda found: _argument_of(found[0]), text)


def _argument_of(option: str) -> str:
    return option[2:].replace("-", "_") if option in _options() else option


@cache
def _options() -> frozenset[str]:
    return frozenset(option for name in COMMANDS for option in options_of(name))
