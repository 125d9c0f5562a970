"""Rows of coefficient files from computed flows, each below a comment with its case."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.numerics.files import append_whole, created, read_text
from swashfilm.console.terminal import show
from system.inputs.coefficients.film_passages import FilmLoss, FilmPassage
from system.inputs.coefficients.flow_files import PORT_HEADS, SOURCE
from system.inputs.coefficients.loss_files import GROOVE_HEADS, STEP_HEADS
from system.inputs.csv_table import Heads, read_table
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import Dimension

IN_UNIT = {"opening": ("mm2", 1e6)}
"""Unit of a column in files, and its factor on SI; other columns are bare numbers."""
SAME = 1e-5
PRESSURES = "pressures: static, means over the patches of inlet and outlet"
"""Definition of a row's pressure drop, on which its coefficient depends."""


def port_row(path: Path, case: Path, opening: float, reynolds: float, coefficient: float) -> None:
    """Add a row to a file of flow coefficients, opening in m2; raise as `append_row`."""
    values = {"opening": opening, "reynolds": reynolds, "flow_coefficient": coefficient}
    append_row(path, case, PORT_HEADS, values, ("opening", "reynolds"))


def loss_row(path: Path, case: Path, passage: FilmPassage, found: FilmLoss) -> None:
    """Add a row to a file of losses of steps or grooves; raise as `append_row`."""
    own = {"extra_length": found.extra_length, "loss_factor": found.loss_factor}
    values = sizes_of(passage) | {"reynolds": found.reynolds} | own
    append_row(path, case, _heads(passage), values, (*sizes_of(passage), "reynolds"))


def known_extra_length(path: Path | None, passage: FilmPassage) -> float | None:
    """Return the extra length of a passage in a file; None if it has none, or does not exist."""
    if path is None or not path.exists():
        return None
    columns = read_table(path, _heads(passage)).columns
    rows = np.flatnonzero(_alike(columns, sizes_of(passage)))
    return float(columns["extra_length"][rows[0]]) if rows.size else None


def sizes_of(passage: FilmPassage) -> dict[str, float]:
    """Return the columns that identify the passage."""
    wide = {} if passage.width_ratio is None else {"width_ratio": passage.width_ratio}
    return {"film_ratio": passage.film_ratio} | wide


def append_row(path: Path, case: Path, heads: Heads, values: Mapping[str, float], key: tuple[str, ...]) -> None:
    """Add a row of SI values below a comment with its case; a new file gets source, pressures and head.

    Raises InputFaults for a file with other columns, order or units, and for a row whose `key` it has already.
    """
    head = ", ".join(f"{name} [{_unit(heads, name)[0]}]" for name in heads)
    cells = (f"{values[name] * _unit(heads, name)[1]:.6g}" for name in heads)
    row = f"# case: {case.resolve()}\n{', '.join(cells)}\n"
    if not path.exists():
        ahead = f"# {SOURCE}: OpenFOAM, {case.resolve().name}\n# {PRESSURES}\n"
        with created(path) as beside:
            beside.write_text(f"{ahead}{head}\n{row}", encoding="utf-8")
    else:
        found = read_table(path, heads)
        if head not in read_text(path).splitlines():
            raise InputFaults(str(path), [Fault("head", "other order or units", head)])
        if np.any(_alike(found.columns, {name: values[name] for name in key})):
            where = f"Re {values['reynolds']:.6g} of this passage"
            raise InputFaults(str(path), [Fault("row", where, "a row that the file does not have yet")])
        append_whole(path, row.encode())
    show(f"row in {path}")


def _heads(passage: FilmPassage) -> Heads:
    return STEP_HEADS if passage.width_ratio is None else GROOVE_HEADS


def _unit(heads: Heads, name: str) -> tuple[str, float]:
    """Return the unit of a column, and its factor on SI."""
    return IN_UNIT[name] if isinstance(heads[name], Dimension) else ("1", 1.0)


def _alike(columns: Mapping[str, Array], values: Mapping[str, float]) -> Array:
    """Return the rows with these values."""
    return np.asarray(
        np.logical_and.reduce([np.isclose(columns[name], own, rtol=SAME) for name, own in values.items()])
    )
