"""Coefficients that come from elsewhere, CFD or a test bench: of ports over opening and Reynolds number, of steps.

A CSV file each, with `# source: where the numbers come from` ahead of its head. It holds in the range of its rows.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from system.csv_table import CsvTable, read_table
from system.faults import Fault, InputFaults
from system.kinematics import Array
from system.units import Dimension

PORT_HEADS = {"opening": Dimension.AREA, "reynolds": None, "flow_coefficient": None}
LOSS_HEADS = {"film_ratio": None, "reynolds": None, "extra_length": None, "loss_factor": None}
SOURCE = "source"


@dataclass(frozen=True)
class FlowCoefficients:
    """Flow coefficients Cd (K, N) of a port, u = Cd sqrt(2 dp/rho), at openings A (K,) in m2, ascending.

    Reynolds numbers (K, N) are u d_h/nu with d_h = sqrt(4 A/pi), ascending along N. `path` and `source` tell
    where they come from.
    """

    path: Path
    source: str
    opening: Array
    reynolds: Array
    flow_coefficient: Array

    @property
    def flow_number(self) -> Array:
        """(K, N): d_h/nu sqrt(2 dp/rho) = Re/Cd, which the pressure drop alone gives (McCloy and Martin 1980)."""
        return self.reynolds / self.flow_coefficient


@dataclass(frozen=True)
class LossFactors:
    """Of a film that meets one film_ratio (K,) times as thick, at Reynolds numbers (N,), both ascending.

    extra_length (K,) in thicknesses of the thinner film, loss_factor (K, N) of its rho u^2/2.
    """

    path: Path
    source: str
    film_ratio: Array
    reynolds: Array
    extra_length: Array
    loss_factor: Array


def read_flow_coefficients(path: Path) -> FlowCoefficients:
    """The flow coefficients of a file with the columns of PORT_HEADS.

    Raises InputFaults with everything wrong: as `read_table`, no source, a number out of its range, openings with
    unlike numbers of rows, and rows between which the flow would fall while the pressure drop rises (the flow
    number Re/Cd must rise with Re).
    """
    table = read_table(path, PORT_HEADS)
    faults = _source_faults(table)
    opening, reynolds, coefficient = (table.columns[name] for name in PORT_HEADS)
    for name, values in (("opening", opening), ("reynolds", reynolds), ("flow_coefficient", coefficient)):
        faults += _range_faults(table, name, values > 0.0, "above zero")
    faults += _range_faults(table, "flow_coefficient", coefficient <= 1.2, "1.2 at most, as no orifice has more")
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


def read_loss_factors(path: Path) -> LossFactors:
    """The loss factors of a file with the columns of LOSS_HEADS: every ratio at every Reynolds number.

    Raises InputFaults with everything wrong: as `read_table`, no source, numbers out of their range, a grid with
    holes, extra lengths that differ between the rows of one ratio.
    """
    table = read_table(path, LOSS_HEADS)
    faults = _source_faults(table)
    ratio, reynolds, extra, loss = (table.columns[name] for name in LOSS_HEADS)
    faults += _range_faults(table, "film_ratio", ratio > 0.0, "above zero")
    faults += _range_faults(table, "reynolds", reynolds >= 0.0, "zero or more")
    order = np.lexsort([reynolds, ratio])
    ratios, numbers = np.unique(ratio), np.unique(reynolds)
    shape = ratios.size, numbers.size
    if ratio.size != shape[0] * shape[1] or np.any(reynolds[order] != np.tile(numbers, shape[0])):
        faults.append(
            Fault("reynolds", f"{ratio.size} rows", f"each of {shape[0]} film ratios at each of {shape[1]}")
        )
    elif np.ptp(extra[order].reshape(shape), axis=1).max() > 0.0:
        faults.append(Fault("extra_length", "values that vary with Re", "one of each film ratio: Stokes flow's"))
    if faults:
        raise InputFaults(str(path), faults)
    return LossFactors(
        path, table.comment(SOURCE), ratios, numbers, extra[order].reshape(shape)[:, 0], loss[order].reshape(shape)
    )


def _source_faults(table: CsvTable) -> list[Fault]:
    """The fault of a file that does not say where its numbers come from."""
    if table.comment(SOURCE):
        return []
    return [Fault("file", "no source", "a line '# source: ..' that says where the numbers come from")]


def _range_faults(table: CsvTable, name: str, fine: NDArray[np.bool_], expected: str) -> list[Fault]:
    """A fault a line whose number is not fine."""
    values = table.columns[name]
    return [
        Fault(f"line {table.lines[row]}, {name}", f"{values[row]:g}", expected) for row in np.nonzero(~fine)[0]
    ]


def _order_faults(
    table: CsvTable, order: NDArray[np.int64], opening: Array, reynolds: Array, coefficient: Array
) -> list[Fault]:
    """A fault a line whose flow number does not exceed that of the next lower Reynolds number of its opening."""
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
