"""JSON Schemas of the kinds of files, and files that name theirs, so that an editor completes and checks keys."""

import json
from importlib import import_module
from pathlib import Path

from reynolds.numerics.files import created, replaced
from swashfilm.formats.versions import VERSIONS, run_schema

SCHEMAS = {
    "case": "swashfilm.case.schema.case_schema",
    "optimise": "swashfilm.runs.variation.optimise.schema.optimise_schema",
    "pump": "system.pump_file.schema.pump_schema",
    "recording": "diagnosis.recording.form.recording_schema",
    "reference": "swashfilm.runs.reference.case.reference_schema",
    "transient": "swashfilm.runs.transient.case.transient_schema",
}
"""Functions that return the schema of an input, by the kind of file."""
RUN_SCHEMAS = tuple(f"run.{kind}" for kind in VERSIONS)
"""Names of the schemas of run folders."""


def schema_of(kind: str) -> dict[str, object]:
    """Return the JSON Schema (draft 2020-12) of a kind of input, one of SCHEMAS."""
    module, _, name = SCHEMAS[kind].rpartition(".")
    return getattr(import_module(module), name)()


def schema_text(kind: str) -> str:
    """Return the schema of a kind of input or of run folder, one of SCHEMAS or RUN_SCHEMAS, as text."""
    if kind in RUN_SCHEMAS:
        return run_schema(kind.removeprefix("run.")).rstrip()
    return json.dumps(schema_of(kind), indent=1, ensure_ascii=False)


def write_new(path: Path, kind: str, text: str) -> None:
    """Write a new file whose first line names its schema, and the schema beside it if absent.

    Raises OSError for a folder that cannot be written to, and for a file that exists.
    """
    schema = path.parent / f"{kind}.schema.json"
    if not schema.exists():
        with replaced(schema) as beside:
            beside.write_text(schema_text(kind) + "\n", encoding="utf-8")
    with created(path) as beside:
        beside.write_text(f"#:schema ./{schema.name}\n{text}", encoding="utf-8")
