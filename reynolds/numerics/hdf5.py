"""Checks of HDF5 files before they are read: no data outside the file, sizes within memory, heaps that end.

Layout of a heap of texts and references: HDF5 File Format Specification 3.0, section III.E (sizes of 8 bytes).
"""

from __future__ import annotations

import struct
from mmap import ACCESS_READ, mmap
from pathlib import Path

from reynolds.numerics.files import LARGEST_CELLS, UnfitFile, expect_regular

_HEAP, _OBJECT = struct.Struct("<4sB3xQ"), struct.Struct("<HH4xQ")


def expect_contained(path: Path) -> None:
    """Raise UnfitFile for an HDF5 file with links or data in other files, soft links, or more than LARGEST_CELLS.

    Also for a broken heap of texts, on which the HDF5 library would not terminate. Raises OSError for a file of another
    kind.
    """
    import h5py

    expect_regular(path)
    _expect_whole_heaps(path)
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


def _expect_whole_heaps(path: Path) -> None:
    """Raise UnfitFile for a heap with an object that has no size or reaches beyond the heap."""
    if path.stat().st_size == 0:  # has no map
        return
    with path.open("rb") as file, mmap(file.fileno(), 0, access=ACCESS_READ) as data:
        begin = data.find(b"GCOL")
        while begin >= 0:
            if not _is_whole(data, begin):
                raise UnfitFile(path, f"a broken heap of texts and references at byte {begin}")
            begin = data.find(b"GCOL", begin + 4)


def _is_whole(data: mmap, begin: int) -> bool:
    if begin + _HEAP.size > len(data):
        return True  # these letters in other data: the library finds no heap here either
    _, version, size = _HEAP.unpack_from(data, begin)
    if version != 1 or begin + size > len(data):
        return True
    at, end = begin + _HEAP.size, begin + size
    while at + _OBJECT.size <= end:
        index, _, held = _OBJECT.unpack_from(data, at)
        at += _OBJECT.size + (held + 7) // 8 * 8 if index else held
        if at > end or (index == 0 and held == 0):
            return False
    return True
