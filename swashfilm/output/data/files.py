"""Data files of runs: CSV files of columns, in units that people read, and NetCDF files in SI."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.files import expect_room
from reynolds.numerics.hdf5 import expect_contained
from swashfilm.formats.versions import check_stamp, stamped
from swashfilm.output.headline import named
from swashfilm.output.tables import parted, read_csv, write_csv
from system.inputs.faults import Fault, InputFaults
from system.inputs.shown import known_unit, largest_of_units, round_off, shown_in

if TYPE_CHECKING:
    import xarray

    from reynolds.numerics.arrays import Array

CSV_DIGITS = 8
"""Significant digits of a number in a CSV."""
RESULTS = "results.nc"
"""Arrays of a run in its folder."""
HEADS = 200_000
"""Bytes of names, attributes and the tree of a NetCDF file, at most."""


@dataclass(frozen=True)
class Column:
    """A column of a table: its name, its numbers in SI with their unit, or texts (unit None)."""

    name: str
    values: Sequence[Any] | np.ndarray
    unit: str | None = None


def column_of(key: str, values: Sequence[float]) -> Column:
    """Return the numbers of a key as a column of a table."""
    words, unit = named(key)
    return Column(words, values, unit or "1")


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


def write_netcdf(data: xarray.Dataset, path: Path, kind: str) -> None:
    """Write the data set of a kind of run folder; every variable has `units` (SI) and `long_name`.

    Raises OSError, before anything is written, on a full disk: there HDF5 only prints unrelated messages.
    """
    expect_room(path.parent, int(1.1 * data.nbytes) + HEADS)
    described(data).assign_attrs(stamped(kind)).to_netcdf(path, mode="w", engine="h5netcdf")


def add_group(data: xarray.Dataset, path: Path, group: str) -> None:
    """Add a data set to a NetCDF file as a group; described, and refused on a full disk, as by `write_netcdf`."""
    expect_room(path.parent, int(1.1 * data.nbytes) + HEADS)
    described(data).to_netcdf(path, mode="a", group=group, engine="h5netcdf")


def described(data: xarray.Dataset) -> xarray.Dataset:
    """Return the data set with the attributes `units` and `long_name` of every variable: 1, and its name in words."""
    found = data.copy()
    for name, variable in found.variables.items():
        variable.attrs = {"units": "1", "long_name": str(name).replace("_", " "), **variable.attrs}
    return found


def read_netcdf(path: Path, group: str | None = None) -> xarray.Dataset:
    """Return the data set of a NetCDF file, or of one group in it, loaded whole.

    Raises InputFaults for a file of another kind, a broken one, one with data outside it, and one that a later version
    wrote.
    """
    try:
        expect_contained(path)
        return _loaded(path, group)
    except InputFaults:
        raise
    except Exception as reason:  # HDF5 and its readers have no common class of faults
        words = " ".join(str(reason).split()) or type(reason).__name__
        raise InputFaults(str(path), [Fault("file", f"cannot be read: {words}", "the NetCDF file of a run")]) from None


def _loaded(path: Path, group: str | None) -> xarray.Dataset:
    import xarray

    with xarray.open_dataset(path, group=group, engine="h5netcdf") as data:
        check_stamp(path, data.attrs)
        return data.load()
