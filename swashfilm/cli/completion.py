"""Completion of the command line by the shell: commands, options, and the values that an option lists."""

import argparse
import re
from collections.abc import Iterator

from swashfilm.cli.app import build_parser

_LISTED = re.compile(r"\{(.+)\}")


def complete_line() -> None:
    """Answer the shell's question, which is in the environment, and end the program; else do nothing."""
    import argcomplete

    parser, files = build_parser(), argcomplete.FilesCompleter()
    for action in _actions(parser):
        if values := values_of(action):
            action.completer = argcomplete.ChoicesCompleter(dict.fromkeys(values, ""))  # type: ignore[attr-defined]
        elif action.dest == "pump":
            action.completer = lambda prefix, **_: [*files(prefix), *_pumps()]  # type: ignore[attr-defined]
    argcomplete.autocomplete(parser)


def values_of(action: argparse.Action) -> list[str]:
    """Return the values that an option lists in its help as `{lumped,fixed}`; none for another option."""
    listed = _LISTED.fullmatch(action.metavar) if isinstance(action.metavar, str) else None
    return listed[1].split(",") if listed else []


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for own in action.choices.values():
                yield from _actions(own)
        else:
            yield action


def _pumps() -> tuple[str, ...]:
    from system.pump_file.file import builtin_pumps

    return builtin_pumps()
