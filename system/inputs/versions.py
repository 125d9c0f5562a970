"""Versions of the kinds of files: a reader takes every version up to its own, and refuses later ones in words."""

from __future__ import annotations

from system.inputs.faults import Fault, stated

LATER = "a later Swashfilm wrote the file: pip install --upgrade swashfilm"


def version_fault(path: str, found: object, newest: int, what: str, oldest: int = 1) -> Fault | None:
    """Return the fault of a version, None for a whole number from `oldest` to `newest`.

    path: the key that holds the version; what: the kind of file in words, "pump file".
    """
    whole = type(found) is int
    if whole and oldest <= found <= newest:  # type: ignore[operator]
        return None
    known = str(newest) if oldest == newest else f"{oldest} to {newest}"
    later = LATER if whole and found > newest else ""  # type: ignore[operator]
    return Fault(path, stated(found), f"{path} = {known}, the {what} format of this version", later)
