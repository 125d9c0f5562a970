"""Data files of runs: CSV files of columns, in units that people read, and NetCDF files in SI."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.tables import parted, read_csv, write_csv
from system.inputs.shown import known_unit, shown_in

if TYPE_CHECKING:
    import xarray

    from reynolds.numerics.arrays import Array

ROUND_OFF = 1e-10
"""Part of the largest number of a unit below which another number of it is round-off."""
CSV_DIGITS = 8


@dataclass(frozen=True)
class Column:
    """A column of a table: its name, its numbers in SI with their unit, or texts (unit None)."""

    name: str
    values: Sequence[Any] | np.ndarray
    unit: str | None = None


def write_columns(path: Path, columns: Iterable[Column]) -> None:
    """Write columns of equal length as CSV, heads `name [unit]` and numbers in the unit that people read.

    A number that is round-off beside the largest of its unit is written as 0, one that is not finite as an empty cell.
    """
    listed = list(columns)
    scales = largest_of_units((one.unit, one.values) for one in listed if one.unit is not None)
    heads, cells = [], []
    for column in listed:
        if column.unit is None:
            heads.append(column.name)
            cells.append([str(value) for value in column.values])
            continue
        values = np.array(column.values, dtype=float)
        shown = shown_in(
            column.unit, column.name, float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
        )
        values[np.abs(values) < round_off(column.name, column.unit, scales)] = 0.0
        heads.append(f"{column.name} [{shown.unit}]")
        cells.append([f"{value:.{CSV_DIGITS}g}" if np.isfinite(value) else "" for value in shown.of(values)])
    write_csv(path, heads, zip(*cells, strict=True))


def read_columns(path: Path) -> dict[str, Array]:
    """Return the columns of numbers of a CSV file by name, in SI; raise ValueError for a column of texts."""
    head, *rows = read_csv(path)
    found = {}
    for title, cells in zip(head, zip(*rows, strict=True), strict=True):
        name, unit = parted(title)
        found[name] = known_unit(unit).to_si(np.array([float(cell or "nan") for cell in cells]))
    return found


def columns_of(data: xarray.Dataset, along: str) -> list[Column]:
    """Return the variables of a data set over one dimension as columns, its coordinate first."""
    series = data.drop_dims([dim for dim in data.sizes if dim != along])
    names = [along, *(str(name) for name in series.data_vars)]
    return [Column(name, series[name].values, series[name].attrs.get("units", "1")) for name in names]


def largest_of_units(numbers: Iterable[tuple[str, Any]]) -> Mapping[str, float]:
    """Return the largest magnitude of the finite numbers of each unit, the scale of round-off.

    Bare numbers have no common scale, and neither have temperatures.
    """
    scales: dict[str, float] = {}
    for unit, values in numbers:
        known = np.abs(np.array(values, dtype=float))
        if unit not in ("", "1", "K") and np.any(np.isfinite(known)):
            scales[unit] = max(scales.get(unit, 0.0), float(np.max(known[np.isfinite(known)])))
    return scales


def round_off(name: str, unit: str, scales: Mapping[str, float]) -> float:
    """Return the size below which a number of this name and SI unit is round-off; fractions are of 1."""
    return ROUND_OFF * scales.get(unit, 1.0 if "fraction" in name else 0.0)


def write_netcdf(data: xarray.Dataset, path: Path, group: str | None = None) -> None:
    """Write a data set, or add it as a group to a file; every variable has `units` (SI) and `long_name`."""
    described(data).to_netcdf(path, mode="a" if group else "w", group=group, engine="h5netcdf")


def described(data: xarray.Dataset) -> xarray.Dataset:
    """Return the data set with the attributes `units` and `long_name` of every variable: 1, and its name in words."""
    found = data.copy()
    for name, variable in found.variables.items():
        variable.attrs = {"units": "1", "long_name": str(name).replace("_", " "), **variable.attrs}
    return found


def read_netcdf(path: Path, group: str | None = None) -> xarray.Dataset:
    """Return the data set of a NetCDF file, or of one group in it, loaded whole."""
    import xarray

    with xarray.open_dataset(path, group=group, engine="h5netcdf") as data:
        return data.load()
