"""Tables in MAT files, of MATLAB up to v7 and of v7.3 (which is HDF5)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource, expect_few, foreign
from reynolds.numerics.hdf5 import expect_contained

_PLAIN = "s = table2struct(T, 'ToScalar', true); save('recording.mat', '-struct', 's')"


def read_matlab(source: TableSource) -> TableColumns:
    """Return the columns of a MAT file: its vectors of numbers, or the fields of the struct named by `variable`.

    The columns of a matrix M are `M:1`, `M:2`, ... Vectors of another length than most are left out, with a note.
    Raises TableFault for a file that is no MAT file, an unknown variable, and for MATLAB's table and timeseries
    objects, whose content is not documented outside MATLAB.
    """
    with source.path.open("rb") as file:
        signature = file.read(128)
    is_hdf5 = signature[:8] == b"\x89HDF\r\n\x1a\n" or signature.startswith(b"MATLAB 7.3")
    with foreign(source, "a MAT file"):
        variables = _from_hdf5(source) if is_hdf5 else _from_mat5(source)
    if source.variable:
        chosen = variables.get(source.variable)
        if chosen is None:
            raise TableFault(f"no variable {source.variable!r}", f"one of {', '.join(variables)}")
        variables = chosen if isinstance(chosen, Mapping) else {source.variable: chosen}
    structs = [name for name, value in variables.items() if isinstance(value, Mapping)]
    found = {
        name: column
        for variable, value in variables.items()
        if not isinstance(value, Mapping)
        for name, column in _vectors(variable, value).items()
    }
    if not found:
        raise TableFault("no vector of numbers", "vectors, or variable = a struct of vectors", ", ".join(structs))
    lengths = [len(column) for column in found.values()]
    rows = max(set(lengths), key=lengths.count)
    short = [name for name, column in found.items() if len(column) != rows]
    notes = (f"left out, since not of {rows} rows as most are: {', '.join(short)}",) if short else ()
    return TableColumns({name: column for name, column in found.items() if len(column) == rows}, notes)


def _from_mat5(source: TableSource) -> Mapping[str, Any]:
    from scipy.io import loadmat, whosmat

    expect_few(sum(math.prod(shape) for _, shape, _ in whosmat(source.path)))
    variables = loadmat(source.path, simplify_cells=True)
    if any(type(value).__name__ == "MatlabOpaque" for value in variables.values()) or "None" in variables:
        raise _object_fault()
    return {name: value for name, value in variables.items() if not name.startswith("__")}


def _from_hdf5(source: TableSource) -> Mapping[str, Any]:
    import h5py

    expect_contained(source.path)
    with h5py.File(source.path) as file:
        return {name: _hdf5_value(item) for name, item in file.items() if not name.startswith("#")}


def _hdf5_value(item: Any) -> Any:
    """A struct as a mapping, numbers as an array; HDF5 holds MATLAB's arrays transposed."""
    if "MATLAB_object_decode" in item.attrs:
        raise _object_fault()
    if hasattr(item, "items"):
        return {name: _hdf5_value(inner) for name, inner in item.items()}
    return np.asarray(item[()]).T


def _vectors(name: str, value: Any) -> Mapping[str, np.ndarray]:
    """The columns of a variable: one for a vector, `name:k` for a matrix, none without numbers."""
    array = np.atleast_1d(np.asarray(value))
    if array.dtype.kind not in "fiub":
        return {}
    array = np.squeeze(array.astype(float)) if array.size > 1 else array.astype(float).ravel()
    if array.ndim == 1:
        return {name: array}
    if array.ndim == 2:
        return {f"{name}:{k}": column for k, column in enumerate(array.T, start=1)}
    return {}


def _object_fault() -> TableFault:
    return TableFault("a MATLAB object (table, timetable or timeseries)", "plain vectors or a struct of them", _PLAIN)
