"""Result of a gap over the turn: numbers, tables, plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.film.revolution.page import FILES, revolution_rows
from swashfilm.runs.film.revolution.plots import film_plot, path_plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class RevolutionRun(Result):
    """One gap over the turn: films, flows, friction (SI), series over the shaft angle, fields at kept angles."""

    kinds: ClassVar[tuple[str, ...]] = ("film_revolution",)
    files: ClassVar[tuple[str, ...]] = FILES

    def tables(self) -> list[Table]:
        """Return every number of the turn; order and error where it is solved on finer meshes."""
        tables: list[Table] = [(f"Film {self.name}", list(revolution_rows(self.summary)))]
        if found := self.summary.get("refinement"):
            tables.append(("On finer meshes", [refinement_head(found), *refinement_rows(found)]))
        return tables

    def plot_film(self) -> list[Axes]:
        """Draw film thickness and chamber pressure over the shaft angle."""
        return plotted(lambda: film_plot(self.to_xarray()))

    def plot_path(self) -> list[Axes]:
        """Draw the position of the part over the shaft angle."""
        return plotted(lambda: path_plot(self.to_xarray()))
