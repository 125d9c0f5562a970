"""Headers of the files of a run folder as plain values: the names and types for other programs, without the numbers."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5netcdf
import numpy as np

from swashfilm.output.tables import parted
from system.inputs.shown import known_unit

OF_THE_PROGRAM = ("plots", "points", "fields", "pump", "tables")
"""Folders of a run folder that the program alone reads."""
INPUTS = ("cycle.csv",)
"""Files of a run folder that are copies of the user's."""
TEXT = "text"
_PLACEHOLDERS = {
    re.compile(r"\bchamber_\d+"): "chamber_N",
    re.compile(r"^sensitivity_.+"): "sensitivity_OUTPUT",
    re.compile(r"^data/.+\.csv"): "data/FIGURE.csv",
}
"""Names of files and variables that depend on the input, and their placeholders."""


def folder_header(folder: Path) -> dict[str, Any]:
    """Return the header of every .json, .nc, .npz and .csv of a run folder by its name, without run folders in it."""
    return {_named(path.relative_to(folder).as_posix()): _READERS[path.suffix](path) for path in _files(folder)}


def _files(folder: Path) -> Iterator[Path]:
    others = [summary.parent for summary in folder.rglob("summary.json") if summary.parent != folder]
    for path in sorted(folder.rglob("*")):
        left_out = path.relative_to(folder).parts[0] in OF_THE_PROGRAM or any(map(path.is_relative_to, others))
        own = not left_out and path.name not in INPUTS and not path.name.endswith(".schema.json")
        if path.suffix in _READERS and path.is_file() and own:
            yield path


def _named(name: str) -> str:
    for pattern, placeholder in _PLACEHOLDERS.items():
        name = pattern.sub(placeholder, name)
    return name


def _json(path: Path) -> Any:
    return json.loads(path.read_text("utf-8"))


def _netcdf(path: Path) -> dict[str, Any]:
    with h5netcdf.File(path) as file:
        return _group(file)


def _group(group: Any) -> dict[str, Any]:
    variables = {_named(name): _variable(name, one) for name, one in group.variables.items()}
    found: dict[str, Any] = {"attributes": {name: _plain(value) for name, value in group.attrs.items()}}
    groups = {_named(name): _group(one) for name, one in group.groups.items()}
    return found | {"variables": variables} | ({"groups": groups} if groups else {})


def _variable(name: str, variable: Any) -> dict[str, Any]:
    keys = ("units", "long_name") if _named(name) == name else ("units",)
    stated = {key: str(variable.attrs[key]) for key in keys if key in variable.attrs}
    return {"dimensions": list(variable.dimensions), **stated}


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, (np.generic, np.ndarray)) and value.size == 1 else str(value)


def _npz(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as arrays:
        return {name: {"dimensions": int(arrays[name].ndim)} for name in arrays.files}


def _csv(path: Path) -> dict[str, str]:
    """Return the SI unit of each column, TEXT for a head without one."""
    with path.open(encoding="utf-8", newline="") as file:
        head = next(csv.reader((line for line in file if not line.startswith("#")), skipinitialspace=True))
    return {name: known_unit(unit).si if unit else TEXT for name, unit in map(parted, head)}


_READERS = {".json": _json, ".nc": _netcdf, ".npz": _npz, ".csv": _csv}
