"""Command `swashfilm schema`: JSON Schema of a kind of file, for editors."""

import argparse

from swashfilm.console.command import Command
from swashfilm.console.schemas import RUN_SCHEMAS, SCHEMAS, schema_text
from swashfilm.console.terminal import show


def run_schema_command(options: argparse.Namespace) -> int:
    """Run `swashfilm schema` and return its exit code."""
    show(schema_text(options.kind))
    return 0


def _add_options(command: argparse.ArgumentParser) -> None:
    what = f"an input: one of {', '.join(SCHEMAS)}; or a run folder: {', '.join(RUN_SCHEMAS)}"
    command.add_argument("kind", choices=[*SCHEMAS, *RUN_SCHEMAS], metavar="KIND", help=what)


COMMAND = Command(
    "schema", "JSON Schema of a file, with which an editor completes and checks keys", _add_options,
    run_schema_command, in_folder=False,
)  # fmt: skip
