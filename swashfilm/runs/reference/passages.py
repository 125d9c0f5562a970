"""Passages of `swashfilm reference`: sizes in words, solution, and columns of the coefficient table."""

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
        """Ratio of the Reynolds number of its table to u h/nu, at which it is solved."""

    def solve(self, reynolds: Sequence[float], cells: int) -> Correction:
        """Return its flow at ascending Reynolds numbers u h/nu; raise FilmNotConverged."""


@dataclass(frozen=True)
class StepPassage:
    """A step from a film to one film_ratio times as thick."""

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
        """Return its flow."""
        from reynolds.stokes.corrections import step_correction

        return step_correction(self.film_ratio, reynolds, cells)


@dataclass(frozen=True)
class GroovePassage:
    """A groove across a film: thickness in it film_ratio films, width width_ratio films."""

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
        """Return its flow."""
        from reynolds.stokes.corrections import groove_correction

        return groove_correction(self.film_ratio, self.width_ratio, reynolds, cells)


@dataclass(frozen=True)
class OrificePassage:
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
        """Return its flow; `cells` across the diameter."""
        from reynolds.stokes.corrections import orifice_correction
        from reynolds.stokes.space import Symmetry

        ratio = self.length / self.diameter
        return orifice_correction(ratio, self.pipe_ratio, reynolds, Symmetry.AXIAL, -(-cells // 2))


@dataclass(frozen=True)
class SlotPassage:
    """A plane slot of given width, m, between channels pipe_ratio times as high.

    Its table has the Reynolds number of ports: the diameter of a circle of the opening's area replaces h.
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
        """Return its flow; `cells` across the height."""
        from reynolds.stokes.corrections import orifice_correction
        from reynolds.stokes.space import Symmetry

        ratio = self.length / self.height
        return orifice_correction(ratio, self.pipe_ratio, reynolds, Symmetry.PLANE, -(-cells // 2))


@dataclass(frozen=True)
class SolvedPassage:
    """A passage, its correction, and the mesh error (K,): change of the pressure drop with half the cells.

    mesh_error is relative to the sum of friction and inertia, which may cancel in the drop.
    """

    passage: Passage
    correction: Correction
    mesh_error: Array
