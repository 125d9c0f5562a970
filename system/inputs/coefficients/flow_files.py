"""Coefficients from CFD or a test bench: of ports and bores over opening and Reynolds number.

A CSV file with `# source: where the numbers come from` ahead of its head. It is valid in the range of its rows. Those
of the edges of films are in `loss_files`.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.inputs.coefficients.file_table import FileTable
from system.inputs.csv_table import CsvTable, read_table
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import Dimension

PORT_HEADS = {"opening": Dimension.AREA, "reynolds": None, "flow_coefficient": None}
SOURCE = "source"


@dataclass(frozen=True, eq=False, repr=False)
class FlowCoefficients(FileTable):
    """Flow coefficients Cd (K, N) of a port, u = Cd sqrt(2 dp/rho), at openings A (K,) in m2, ascending.

    Reynolds numbers (K, N) are u d_h/nu with d_h = sqrt(4 A/pi), ascending along N.
    """

    opening: Array
    reynolds: Array
    flow_coefficient: Array

    @property
    def flow_number(self) -> Array:
        """(K, N): d_h/nu sqrt(2 dp/rho) = Re/Cd, which the pressure drop alone gives (McCloy and Martin 1980)."""
        return self.reynolds / self.flow_coefficient


def read_flow_coefficients(path: Path) -> FlowCoefficients:
    """The flow coefficients of a file with the columns of PORT_HEADS.

    Raises InputFaults with all faults: as `read_table`, no source, a number out of its range, openings with different
    numbers of rows, and rows between which the flow would fall while the pressure drop rises (the flow number Re/Cd
    must rise with Re).
    """
    table = read_table(path, PORT_HEADS)
    faults = source_faults(table)
    opening, reynolds, coefficient = (table.columns[name] for name in PORT_HEADS)
    for name, values in (("opening", opening), ("reynolds", reynolds), ("flow_coefficient", coefficient)):
        faults += range_faults(table, name, values > 0.0, "above zero")
    faults += range_faults(table, "flow_coefficient", coefficient <= 1.2, "1.2 at most, as no orifice has more")
    order = np.lexsort([reynolds, opening])
    sizes, counts = np.unique(opening, return_counts=True)
    if np.any(counts != counts[0]):
        found = ", ".join(f"{1e6 * size:.4g} mm2 with {count}" for size, count in zip(sizes, counts, strict=True))
        faults.append(Fault("opening", found, "as many rows of each opening"))
    faults += [] if faults else _order_faults(table, order, opening, reynolds, coefficient)
    if faults:
        raise InputFaults(str(path), faults)
    shape = sizes.size, counts[0]
    return FlowCoefficients(
        path, table.comment(SOURCE), sizes, reynolds[order].reshape(shape), coefficient[order].reshape(shape)
    )


def source_faults(table: CsvTable) -> list[Fault]:
    """The fault of a file without the source of its numbers."""
    if table.comment(SOURCE):
        return []
    return [Fault("source", "missing", "a line '# source: ..' that says where the numbers come from")]


def range_faults(table: CsvTable, name: str, fine: NDArray[np.bool_], expected: str) -> list[Fault]:
    """A fault for each line with an invalid number."""
    values = table.columns[name]
    return [Fault(f"line {table.lines[row]}, {name}", f"{values[row]:g}", expected) for row in np.nonzero(~fine)[0]]


def _order_faults(
    table: CsvTable, order: NDArray[np.int64], opening: Array, reynolds: Array, coefficient: Array
) -> list[Fault]:
    """A fault for each line whose flow number does not exceed that of the next lower Reynolds number of its opening."""
    faults = []
    for before, row in pairwise(order):
        if opening[before] != opening[row]:
            continue
        below, own = (reynolds[k] / coefficient[k] for k in (before, row))
        if not own > below:
            found = f"Re/Cd {own:.4g} at Re {reynolds[row]:g}, {below:.4g} at Re {reynolds[before]:g}"
            expected = "Re/Cd that rises with Re: more pressure drop, more flow"
            faults.append(Fault(f"line {table.lines[row]}, flow_coefficient", found, expected))
    return faults
