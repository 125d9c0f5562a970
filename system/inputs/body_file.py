"""A body's mesh from the file that a pump file names."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

from reynolds.bodies.mesh import BodyMesh
from reynolds.bodies.mesh_file import body_from_file
from reynolds.errors import InputError
from system.inputs.units import QuantityError


@dataclass(frozen=True)
class BodyFile:
    """A mesh as its file has it, places in the file's own unit; `content` is a hash of the file's content."""

    path: Path
    content: str
    body: BodyMesh = field(compare=False, repr=False)


def read_body_file(path: Path) -> BodyFile:
    """The body of a mesh file; raises QuantityError for one without a body."""
    try:
        body = body_from_file(path)
    except InputError as reason:
        raise QuantityError(reason.found, reason.expected) from None
    return BodyFile(path, hashlib.sha256(path.read_bytes()).hexdigest(), body)
