"""A damaged summary.json against the schema of its kind."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator, ValidationError

from system.inputs.faults import Fault

from .versions import run_schema

TOLD = 8


def summary_faults(path: Path, summary: Mapping[str, Any]) -> list[Fault]:
    """Return the places where a summary of a known kind differs from its schema, the first `TOLD`; empty if none."""
    schema = json.loads(run_schema(summary["kind"]))["properties"]["summary.json"]
    found = sorted(Draft202012Validator(schema).iter_errors(summary), key=lambda one: list(map(str, one.absolute_path)))
    faults = [_fault(path, one) for one in found[:TOLD]]
    if len(found) > TOLD:
        faults.append(Fault(path.name, f"{len(found) - TOLD} more differences", "the file as the run wrote it"))
    return faults


def _fault(path: Path, error: ValidationError) -> Fault:
    place = ".".join(map(str, error.absolute_path))
    message = error.message if len(error.message) < 160 else f"{error.message[:150]} .."
    return Fault(f"{path.name} {place}".rstrip(), message, "what a run of this version writes; run it anew")
