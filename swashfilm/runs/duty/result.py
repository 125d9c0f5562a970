"""Result of a duty cycle."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.duty.page import COURSE, EFFICIENCY_HEAD, ENERGY_HEAD, efficiency_rows, energy_rows, marked_rows
from swashfilm.runs.duty.plots import course_of, course_plot, sinks_plot

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


class DutyRun(Result):
    """A duty cycle by a map: energies, losses, mean efficiency, with the error of interpolation."""

    kinds: ClassVar[tuple[str, ...]] = ("duty",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", COURSE)

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return course.csv of a run folder."""
        return read_table(folder / COURSE)

    def tables(self) -> list[Table]:
        """Return energies, mean efficiencies, and the time between points with a warning."""
        summary = self.summary
        tables: list[Table] = [
            (f"Duty of {self.name}, {summary['duration_s']:.6g} s", [ENERGY_HEAD, *energy_rows(summary)]),
            ("Mean efficiency", [EFFICIENCY_HEAD, *efficiency_rows(summary)]),
        ]
        if summary["marked"]:
            tables.append(("Time between points of the map with a warning", list(marked_rows(summary))))
        return tables

    def plot_course(self) -> list[Axes]:
        """Draw speed, pressure, displacement, power and efficiency over time."""
        return plotted(lambda: course_plot(course_of(self.to_xarray())))

    def plot_losses(self) -> list[Axes]:
        """Draw the energy lost by kind."""
        return plotted(lambda: sinks_plot(self.summary))
