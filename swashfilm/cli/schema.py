"""Command `swashfilm schema`: JSON Schema of a kind of file, for editors."""

import argparse
import json
from importlib import import_module

from swashfilm.console.command import Command
from swashfilm.console.terminal import show

SCHEMAS = {
    "case": "swashfilm.case.schema.case_schema",
    "pump": "system.pump_file.schema.pump_schema",
    "recording": "diagnosis.recording.form.recording_schema",
    "reference": "swashfilm.runs.reference.case.reference_schema",
    "transient": "swashfilm.runs.transient.case.transient_schema",
}
"""Functions that return a schema, by the kind of file."""


def run_schema_command(options: argparse.Namespace) -> int:
    """Run `swashfilm schema` and return its exit code."""
    show(json.dumps(schema_of(options.kind), indent=1, ensure_ascii=False))
    return 0


def schema_of(kind: str) -> dict[str, object]:
    """Return the JSON Schema (draft 2020-12) of a kind of file, one of SCHEMAS."""
    module, _, name = SCHEMAS[kind].rpartition(".")
    return getattr(import_module(module), name)()


def _add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("kind", choices=list(SCHEMAS), metavar="KIND", help=f"one of {', '.join(SCHEMAS)}")


COMMAND = Command(
    "schema", "JSON Schema of a file, with which an editor completes and checks keys", _add_options,
    run_schema_command, in_folder=False,
)  # fmt: skip
