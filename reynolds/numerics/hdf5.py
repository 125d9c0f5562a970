"""HDF5 files looked through before they are read: nothing outside them, and no more than memory holds."""

from __future__ import annotations

from pathlib import Path

from reynolds.numerics.files import LARGEST_CELLS, UnfitFile, expect_regular


def expect_contained(path: Path) -> None:
    """Raise UnfitFile for an HDF5 file with links or data in other files, soft links, or more than LARGEST_CELLS.

    Raises OSError for a file of another kind.
    """
    import h5py

    expect_regular(path)
    cells = 0
    with h5py.File(path) as file:
        todo, seen = [file], set()
        while todo:
            group = todo.pop()
            for name in group:
                if not isinstance(group.get(name, getlink=True), h5py.HardLink):
                    raise UnfitFile(path, f"{name!r} is a link to another place")
                item = group[name]
                if isinstance(item, h5py.Group):
                    address = h5py.h5o.get_info(item.id).addr
                    if address not in seen:
                        seen.add(address)
                        todo.append(item)
                elif isinstance(item, h5py.Dataset):
                    if item.is_virtual or item.external:
                        raise UnfitFile(path, f"{name!r} has its data in another file")
                    cells += item.size or 0
    if cells > LARGEST_CELLS:
        raise UnfitFile(path, f"{cells:.3g} numbers, more than {LARGEST_CELLS:.3g}")
