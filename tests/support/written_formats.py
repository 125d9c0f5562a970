"""Run folders against the schemas of their formats."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from formats import Names
from headers import folder_header
from jsonschema import Draft202012Validator

REMEDY = (
    "Where the change is meant: `python tools/formats.py FOLDER` writes the schema of a version that no release has; "
    "otherwise the version in swashfilm/formats/versions.py rises by one first"
)


@cache
def validator(names: Names) -> Draft202012Validator:
    """The schema of a kind and version; FileNotFoundError where there is none."""
    return Draft202012Validator(json.loads(names.path.read_text("utf-8")))


def folder_faults(folder: Path) -> list[str]:
    """Differences of the files of a run folder, and of those in it, from the schemas of kind and version."""
    found = []
    for place in sorted(summary.parent for summary in folder.rglob("summary.json")):
        header = folder_header(place)
        names = Names(f"run.{header['summary.json']['kind']}", header["summary.json"]["format"])
        if not names.path.is_file():
            found.append(f"{names.key}: no schema of this kind and version")
            continue
        for one in validator(names).iter_errors(header):
            found.append(f"{names.key}: {'/'.join(map(str, one.absolute_path))}: {one.message[:200]}")
    return found
