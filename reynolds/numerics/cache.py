"""Arrays kept on disk under a hash of their inputs.

Folder: the argument, else SWASHFILM_CACHE, else XDG_CACHE_HOME/swashfilm, else ~/.cache/swashfilm.
"""

import hashlib
import logging
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array
from reynolds.numerics.npz import read_npz, write_npz

FORMAT = "swashfilm bodies 1"  # raised when the same input gives other arrays
SEAL = "seal"
"""Array with the hash of all others in a file."""
LOG = logging.getLogger(__name__)


class CacheOrigin(Enum):
    """Origin of arrays; recomputed: the cached file was broken."""

    COMPUTED = "computed"
    CACHE = "cache"
    RECOMPUTED = "recomputed"


@dataclass(frozen=True)
class CachedArrays:
    """Arrays by name, and their origin."""

    arrays: Mapping[str, Array]
    origin: CacheOrigin


def cache_folder(folder: Path | None = None) -> Path:
    """The cache folder; it need not exist."""
    if folder is not None:
        return folder
    if own := os.environ.get("SWASHFILM_CACHE"):
        return Path(own)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "swashfilm"


def content_key(*parts: object) -> str:
    """Hash of arrays by dtype, shape and values, and of anything else by its repr (data of frozen dataclasses)."""
    digest = hashlib.sha256(FORMAT.encode())
    for part in parts:
        if isinstance(part, np.ndarray):
            digest.update(f"{part.dtype.str}{part.shape}".encode())
            digest.update(np.ascontiguousarray(part).tobytes())
        else:
            digest.update(repr(part).encode())
        digest.update(b"\0")
    return digest.hexdigest()


def kept(key: str, compute: Callable[[], Mapping[str, Array]], folder: Path | None = None) -> CachedArrays:
    """The arrays of `compute`, from the cache if present.

    Afterwards the cache holds them: written beside and moved into place, so that no reader finds a partial file. A
    broken file is computed anew, as the origin and the log state. Raises FilmInputError where the folder cannot be
    written.
    """
    place = cache_folder(folder) / f"{key}.npz"
    found = _read(place) if place.is_file() else None
    if found is not None:
        return CachedArrays(found, CacheOrigin.CACHE)
    origin = CacheOrigin.RECOMPUTED if place.is_file() else CacheOrigin.COMPUTED
    arrays = dict(compute())
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        write_npz(place, {**arrays, SEAL: _seal(arrays)})
    except OSError as fault:
        expected = "a file that can be written there (SWASHFILM_CACHE names another folder)"
        raise FilmInputError("cache of bodies", f"{place}: {fault.strerror}", expected) from fault
    return CachedArrays(arrays, origin)


def _read(place: Path) -> dict[str, Array] | None:
    try:
        found = read_npz(place)
        if not np.array_equal(found.pop(SEAL, np.empty(0)), _seal(found)):
            raise ValueError("its arrays are not those that were written")
        return found
    except (OSError, ValueError) as fault:
        LOG.warning("%s is broken (%s): computed anew", place, fault)
        return None


def _seal(arrays: Mapping[str, Array]) -> Array:
    """The hash of arrays and their names, as numbers."""
    key = content_key(*(part for name in sorted(arrays) for part in (name, np.asarray(arrays[name]))))
    return np.frombuffer(bytes.fromhex(key), dtype=np.uint8)
