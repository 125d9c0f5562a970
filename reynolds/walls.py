"""Walls that give way: what the film solver asks of a wall's compliance."""

from __future__ import annotations

from typing import Protocol

from scipy.sparse import csr_array

from reynolds.mesh import Array


class Walls(Protocol):
    """Both walls of a film together, as one linear operator."""

    @property
    def matrix(self) -> Array | csr_array:
        """Opening of the film at the mesh's vertices by unit pressure at each unknown, (vertices, size) m/Pa."""
