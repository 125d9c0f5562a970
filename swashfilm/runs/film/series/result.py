"""Result of a study of films: spans of numbers, tables, plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.data.files import read_netcdf
from swashfilm.output.page import expect_files
from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.film.series.page import failed_rows, span_rows
from swashfilm.runs.film.series.plots import number_plot, stribeck_plot
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from pathlib import Path

    import pandas
    import xarray
    from matplotlib.axes import Axes


class StudyRun(Result):
    """A study: every number of every point over the varied keys, SI."""

    kinds: ClassVar[tuple[str, ...]] = ("film_study",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "study.nc", "input.toml")

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return study.nc of a run folder."""
        expect_files(folder, ("study.nc",), "a study's run folder")
        return read_netcdf(folder / "study.nc")

    def tables(self) -> list[Table]:
        """Return least and largest value of every number with their points, and points without a result."""
        summary, head = self.summary, ("", "least", "at", "largest", "at")
        title = f"Study {self.name}: {summary['solved']} of {summary['points']} points"
        tables: list[Table] = [(title, [head, *span_rows(summary)])]
        if summary["failed"]:
            tables.append(("Points without a result", list(failed_rows(summary))))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return one row per point, the varied keys as index; units in the data set's attributes."""
        data = self.to_xarray()
        return data[[name for name in data.data_vars if "shaft_angle_deg" not in data[name].dims]].to_dataframe()

    def plot_stribeck(self) -> list[Axes]:
        """Draw the friction coefficient over the Hersey number; nothing where neither varies."""
        return plotted(lambda: stribeck_plot(self.to_xarray()))

    def plot_number(self, key: str) -> list[Axes]:
        """Draw a number by its key, such as "load_N", over the varied keys; raise InputFaults for another key."""
        data = self.to_xarray()
        keys = [str(name) for name in data.data_vars if name not in ("status", "reason")]
        if key not in keys:
            fault = Fault("key", repr(key), f"one of {', '.join(keys)}", nearest_choice(key, keys))
            raise InputFaults("plot_number()", [fault])
        return plotted(lambda: number_plot(data, key))
