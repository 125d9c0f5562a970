"""Loss files of film edges, from CFD or `swashfilm reference`: steps, and grooves across a film.

A CSV file with `# source: where the numbers come from` ahead of its head, every size at every Reynolds number
u h/nu of the (thinner) film. It is valid in the range of its rows.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.coefficients.file_table import FileTable
from system.inputs.coefficients.flow_files import SOURCE, range_faults, source_faults
from system.inputs.csv_table import CsvTable, read_table
from system.inputs.faults import Fault, InputFaults

STEP_HEADS = {"film_ratio": None, "reynolds": None, "extra_length": None, "loss_factor": None}
GROOVE_HEADS = {
    "film_ratio": None, "width_ratio": None, "reynolds": None, "extra_length": None, "loss_factor": None,
}  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class LossFactors(FileTable):
    """At S passages, by rising `sizes`, and Reynolds numbers (N,), ascending.

    extra_length (S,) in thicknesses of the thinner film, loss_factor (S, N) of its rho u^2/2. sizes: film behind /
    film before (S, 1) of steps; film in the groove / film and width / film (S, 2) of grooves.
    """

    sizes: Array
    reynolds: Array
    extra_length: Array
    loss_factor: Array


def read_step_losses(path: Path) -> LossFactors:
    """The losses of a file with the columns of STEP_HEADS, by film ratio.

    Raises InputFaults with all faults: as `read_table`, no source, numbers out of their range, a grid with holes, extra
    lengths that vary between the rows of one passage, no step into a thinner film or none out of it.
    """
    table = read_table(path, STEP_HEADS)
    ratio = table.columns["film_ratio"]
    faults = range_faults(table, "film_ratio", ratio > 0.0, "above zero")
    if not faults and not (ratio.min() < 1.0 < ratio.max()):
        found = f"{ratio.min():g} to {ratio.max():g}"
        faults.append(Fault("film_ratio", found, "rows below 1, into the film, and above 1, out of it"))
    return _gridded(table, ["film_ratio"], faults)


def read_groove_losses(path: Path) -> LossFactors:
    """The losses of a file with the columns of GROOVE_HEADS, by film ratio and width ratio; raises as above."""
    table = read_table(path, GROOVE_HEADS)
    faults = range_faults(table, "film_ratio", table.columns["film_ratio"] > 1.0, "above 1")
    faults += range_faults(table, "width_ratio", table.columns["width_ratio"] > 0.0, "above zero")
    return _gridded(table, ["film_ratio", "width_ratio"], faults)


def _gridded(table: CsvTable, names: list[str], faults: list[Fault]) -> LossFactors:
    """The losses with sizes (S, len(names)); raises InputFaults with these faults and the gaps of the grid."""
    columns = table.columns
    reynolds, extra, loss = columns["reynolds"], columns["extra_length"], columns["loss_factor"]
    faults = source_faults(table) + faults + range_faults(table, "reynolds", reynolds >= 0.0, "zero or more")
    sizes = np.column_stack([columns[name] for name in names])
    kinds, numbers = np.unique(sizes, axis=0), np.unique(reynolds)
    order = np.lexsort([reynolds, *sizes.T[::-1]])
    shape = len(kinds), numbers.size
    if len(sizes) != len(kinds) * numbers.size or np.any(reynolds[order] != np.tile(numbers, len(kinds))):
        faults.append(Fault("reynolds", f"{len(sizes)} rows", f"each of {shape[0]} passages at each of {shape[1]}"))
    elif np.ptp(extra[order].reshape(shape), axis=1).max() > 0.0:
        faults.append(Fault("extra_length", "values that vary with Re", "one value a passage, that of Stokes flow"))
    if faults:
        raise InputFaults(str(table.path), faults)
    by_passage = extra[order].reshape(shape)[:, 0], loss[order].reshape(shape)
    return LossFactors(table.path, table.comment(SOURCE), kinds, numbers, *by_passage)
