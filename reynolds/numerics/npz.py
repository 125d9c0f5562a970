"""Arrays of an NPZ file: only numbers, no objects, sizes within memory."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.numerics.files import LARGEST_CELLS, UnfitFile, expect_regular, replaced


def read_npz(path: Path) -> dict[str, Array]:
    """Return the arrays of a file by name.

    Raises OSError for a file that is absent or too large, ValueError for any other that holds no arrays of finite
    numbers.
    """
    expect_regular(path)
    try:
        with zipfile.ZipFile(path) as parts:
            if (size := sum(part.file_size for part in parts.infolist())) > 8 * LARGEST_CELLS:
                raise UnfitFile(path, f"{size / 1e6:.0f} MB unpacked")
        with np.load(path, allow_pickle=False) as stored:
            found = {name: stored[name] for name in stored.files}
    except UnfitFile:
        raise
    except Exception as reason:  # zip, zlib, struct and memory have no common class of faults
        raise ValueError(" ".join(str(reason).split()) or type(reason).__name__) from reason
    for name, array in found.items():
        if array.dtype.kind not in "fiub" or not np.isfinite(array).all():
            raise ValueError(f"{name} holds something else than finite numbers")
    return found


def write_npz(path: Path, arrays: Mapping[str, Array]) -> None:
    """Write arrays by name, as `replaced` writes: whole, or not at all."""
    with replaced(path) as beside, beside.open("wb") as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]
