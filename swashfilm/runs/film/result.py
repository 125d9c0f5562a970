"""Result of one film: numbers, tables, plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.result import Result, framed, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.film.fields.history import last_of
from swashfilm.runs.film.fields.maps import film_figure
from swashfilm.runs.film.fields.sections import section_figure, sections
from swashfilm.runs.film.page import summary_rows
from swashfilm.runs.film.sensitivity import sensitivity_figure, sensitivity_rows

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class FilmRun(Result):
    """One film: load, flows, friction, checks (SI), and its fields over the mesh."""

    kinds: ClassVar[tuple[str, ...]] = ("film",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "results.nc")

    def tables(self) -> list[Table]:
        """Return every number of the film; order and error where it is solved on finer meshes; sensitivities."""
        tables: list[Table] = [(f"Film {self.name}", list(summary_rows(self.summary)))]
        if found := self.summary.get("refinement"):
            tables.append(("On finer meshes", [refinement_head(found), *refinement_rows(found)]))
        if rows := sensitivity_rows(self.summary):
            tables.append((f"Sensitivity, the {self.summary['sensitivity']['kept']} kept as it is", rows))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return the fields at the vertices, one row each; of a transient those at its end."""
        return framed(last_of(self.to_xarray()).reset_coords())

    def plot_fields(self) -> list[Axes]:
        """Draw maps of pressure, thickness, and other fields that vary; of a transient at its end."""
        return plotted(lambda: film_figure(last_of(self.to_xarray())))

    def plot_sections(self) -> list[Axes]:
        """Draw pressure, thickness and temperature along the `sections` of the film; of a transient at its end."""
        return plotted(lambda: section_figure(sections(last_of(self.to_xarray()))))

    def plot_sensitivity(self) -> list[Axes]:
        """Draw maps of each output's derivative by the film thickness, none for a film solved without."""
        return plotted(lambda: sensitivity_figure(last_of(self.to_xarray())))
