"""Versions of the kinds of files: a reader accepts every version up to its own, and refuses later ones by name."""

from __future__ import annotations

from system.inputs.faults import Fault, stated

LATER = "a later Swashfilm wrote the file: pip install --upgrade swashfilm"
EARLIER = "a version before the first release wrote the file: build it anew"


def version_fault(path: str, found: object, newest: int, what: str, oldest: int = 1) -> Fault | None:
    """Return the fault of a version, None for a whole number from `oldest` to `newest`.

    path: the key that holds the version; what: the kind of file in words, "pump file".
    """
    known = str(newest) if oldest == newest else f"{oldest} to {newest}"
    remedy = ""
    if isinstance(found, int) and not isinstance(found, bool):
        if oldest <= found <= newest:
            return None
        remedy = LATER if found > newest else EARLIER if oldest > 1 else ""
    return Fault(path, stated(found), f"{path} = {known}, the {what} format of this version", remedy)
