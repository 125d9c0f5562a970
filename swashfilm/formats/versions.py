"""Version of each kind of run folder, which summary.json states as `format`, NetCDF files as `format_version`.

A version covers summary.json, the NetCDF files and the tables of a folder. Readers accept every version up to this one.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from numbers import Integral
from pathlib import Path
from typing import Any

from system.inputs.faults import Fault, InputFaults, nearest_choice, stated
from system.inputs.versions import version_fault

VERSIONS = {
    "calibration": 1,
    "comparison": 2,
    "diagnosis": 1,
    "duty": 1,
    "film": 1,
    "film_revolution": 1,
    "film_study": 1,
    "gap_table": 1,
    "map": 1,
    "optimisation": 1,
    "plan": 1,
    "pump": 1,
    "pump_study": 1,
    "reference": 1,
    "reproduction": 1,
    "response_table": 1,
    "sensitivity": 1,
    "tolerance": 1,
    "transient": 1,
}
OURS = "swashfilm "
"""Begins the attribute `format` of a NetCDF file; the kind of its run folder follows."""


def run_schema(kind: str) -> str:
    """Return the JSON Schema of a kind of run folder at its version, as text: the header of each of its files."""
    return files("swashfilm.formats").joinpath("schemas", f"run.{kind}-{VERSIONS[kind]}.json").read_text("utf-8")


def headed(kind: str) -> dict[str, Any]:
    """Return the first entries of the summary of a kind of run folder."""
    return {"format": VERSIONS[kind], "kind": kind}


def stamped(kind: str) -> dict[str, Any]:
    """Return the attributes by which a NetCDF file states its format."""
    return {"format": OURS + kind, "format_version": VERSIONS[kind]}


def expect_known(path: Path, summary: Any) -> None:
    """Raise InputFaults for the summary of an unknown kind of run, or of a later version. path: of its file."""
    kind, version = (summary.get(key) if isinstance(summary, dict) else None for key in ("kind", "format"))
    if not isinstance(kind, str) or kind not in VERSIONS:
        near = nearest_choice(str(kind), VERSIONS)
        raise InputFaults(str(path), [Fault("kind", stated(kind), f"one of {', '.join(VERSIONS)}", near)])
    if fault := version_fault("format", version, VERSIONS[kind], f"{kind.replace('_', ' ')} run"):
        raise InputFaults(str(path), [fault])


def check_stamp(path: Path, attributes: Mapping[str, Any]) -> None:
    """Raise InputFaults for a NetCDF file of a later version; one without a version is older than versions."""
    kind = str(attributes.get("format", "")).removeprefix(OURS)
    if kind in VERSIONS:
        stamp = attributes.get("format_version")
        found = int(stamp) if isinstance(stamp, Integral) else stamp
        if fault := version_fault("format_version", found, VERSIONS[kind], f"{kind.replace('_', ' ')} file"):
            raise InputFaults(str(path), [fault])
