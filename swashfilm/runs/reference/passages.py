"""The passages that `swashfilm reference` solves: what each is called, how it is solved, what its table holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from reynolds.numerics.arrays import Array

if TYPE_CHECKING:
    from reynolds.stokes.corrections import Correction


class Passage(Protocol):
    """One passage: its sizes in words, its flow, and the first columns of its table of coefficients."""

    @property
    def words(self) -> str:
        """Its sizes with their units."""

    @property
    def sizes(self) -> dict[str, float]:
        """Columns of its table, by head with unit."""

    @property
    def scale(self) -> float:
        """What makes of u h/nu, at which it is solved, the Reynolds number of its table."""

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Its flow at ascending Reynolds numbers u h/nu; raises FilmNotConverged."""


@dataclass(frozen=True)
class Step:
    """A film that ends at one film_ratio times as thick."""

    film_ratio: float
    scale: float = 1.0

    @property
    def words(self) -> str:
        """Its sizes."""
        return f"film behind / film before = {self.film_ratio:g}"

    @property
    def sizes(self) -> dict[str, float]:
        """Columns of its table."""
        return {"film_ratio [1]": self.film_ratio}

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Its flow."""
        from reynolds.stokes.corrections import step_correction

        return step_correction(self.film_ratio, reynolds, cells)


@dataclass(frozen=True)
class Groove:
    """A groove across a film: film_ratio times as thick there, width_ratio films wide."""

    film_ratio: float
    width_ratio: float
    scale: float = 1.0

    @property
    def words(self) -> str:
        """Its sizes."""
        return f"film in the groove / film = {self.film_ratio:g}, width / film = {self.width_ratio:g}"

    @property
    def sizes(self) -> dict[str, float]:
        """Columns of its table."""
        return {"film_ratio [1]": self.film_ratio, "width_ratio [1]": self.width_ratio}

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Its flow."""
        from reynolds.stokes.corrections import groove_correction

        return groove_correction(self.film_ratio, self.width_ratio, reynolds, cells)


@dataclass(frozen=True)
class Orifice:
    """A sharp-edged bore, m, between pipes pipe_ratio times as wide."""

    diameter: float
    length: float
    pipe_ratio: float
    scale: float = 1.0

    @property
    def words(self) -> str:
        """Its sizes."""
        size = f"diameter {1e3 * self.diameter:g} mm, length {1e3 * self.length:g} mm"
        return f"{size}, pipes {self.pipe_ratio:g} times as wide"

    @property
    def sizes(self) -> dict[str, float]:
        """Columns of its table."""
        return {"opening [mm2]": 0.25e6 * np.pi * self.diameter**2}

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Its flow; `cells` across the diameter."""
        from reynolds.stokes.corrections import orifice_correction
        from reynolds.stokes.space import Symmetry

        ratio = self.length / self.diameter
        return orifice_correction(ratio, self.pipe_ratio, reynolds, Symmetry.AXIAL, -(-cells // 2))


@dataclass(frozen=True)
class Slot:
    """A plane slot of given width, m, between channels pipe_ratio times as high.

    Its table has the Reynolds number of ports, with the diameter of a circle of the opening's area in place of h.
    """

    width: float
    height: float
    length: float
    pipe_ratio: float

    @property
    def words(self) -> str:
        """Its sizes."""
        return (
            f"height {1e3 * self.height:g} mm, width {1e3 * self.width:g} mm, length {1e3 * self.length:g} mm, "
            f"channels {self.pipe_ratio:g} times as high"
        )

    @property
    def opening(self) -> float:
        """Its area, m2."""
        return self.height * self.width

    @property
    def sizes(self) -> dict[str, float]:
        """Columns of its table."""
        return {"opening [mm2]": 1e6 * self.opening}

    @property
    def scale(self) -> float:
        """sqrt(4 A/pi)/h."""
        return float(np.sqrt(4.0 * self.opening / np.pi) / self.height)

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Its flow; `cells` across the height."""
        from reynolds.stokes.corrections import orifice_correction
        from reynolds.stokes.space import Symmetry

        ratio = self.length / self.height
        return orifice_correction(ratio, self.pipe_ratio, reynolds, Symmetry.PLANE, -(-cells // 2))


@dataclass(frozen=True)
class Solved:
    """A passage, its correction, and how far the pressure drops (K,) of half the cells are from its own.

    mesh_error: over friction and inertia added up, which may cancel in a drop.
    """

    passage: Passage
    correction: Correction
    mesh_error: Array
