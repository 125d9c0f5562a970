"""Results of operating maps, duty cycles and comparisons."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.data.files import read_netcdf
from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.map.compare import DIFFERENCE_HEAD, DUTY_HEAD, difference_rows, duty_rows
from swashfilm.runs.map.duty import (
    COURSE,
    EFFICIENCY_HEAD,
    ENERGY_HEAD,
    course_of,
    course_plot,
    efficiency_rows,
    energy_rows,
    marked_rows,
)
from swashfilm.runs.map.files import MAP, PARTS, map_of
from swashfilm.runs.map.page import axis_rows, best_rows, displacement_rows, failed_rows
from swashfilm.runs.map.plots import efficiency_plot, loss_plot, share_plot, slice_of
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.maps.data import MapData
from system.maps.plan import MapInput
from system.pump.efficiency import EfficiencyDefinition

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


class MapRun(Result):
    """An operating map: every number of a pump over speed, pressure, displacement, temperature, inlet pressure."""

    kinds: ClassVar[tuple[str, ...]] = ("map",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", MAP)

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return map.nc of a run folder."""
        return read_netcdf(folder / MAP)

    @property
    def data(self) -> MapData:
        """The map as arrays over its axes, SI."""
        return map_of(self.to_xarray())

    def tables(self) -> list[Table]:
        """Return axes and computing time, best points, displacement, points without a result."""
        summary = self.summary
        tables: list[Table] = [(f"Map of {self.name}, {summary['solver']}", list(axis_rows(summary)))]
        if summary["best"]:
            tables.append(("Best points", list(best_rows(summary))))
        tables.append(("Displacement", list(displacement_rows(summary))))
        if summary["failed"]:
            tables.append(("Points without a result", list(failed_rows(summary))))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return one row per point, the five axes as columns; units in the heads."""
        data = self.to_xarray()
        axes = [one.value for one in MapInput]
        own = [name for name in data.data_vars if list(data[name].dims) == axes]
        frame = data[own].to_dataframe().reset_index()
        frame.columns = [f"{name} [{data[name].attrs.get('units', '1')}]" for name in frame.columns]
        return frame

    def plot_efficiency(self, part: str = "overall", definition: str = "") -> list[Axes]:
        """Draw contours of an efficiency over pressure and displacement, a panel for each definition or for one.

        part: overall, volumetric, hydromechanical; definition: empty for all, "iso_4409" for both readings of that
        standard. Raises InputFaults for another name, and for a map of one pressure or displacement.
        """
        names = [*(one.value for one in EfficiencyDefinition), "iso_4409"]
        faults = [
            Fault(word, repr(found), f"one of {', '.join(known)}", nearest_choice(found, known))
            for word, found, known in (("part", part, PARTS), ("definition", definition or names[0], names))
            if found not in known
        ]
        if faults:
            raise InputFaults("plot_efficiency()", faults)
        chosen = tuple(one for one in EfficiencyDefinition if one.value.startswith(definition))
        data, piece = self.data, slice_of(self.data, MapInput.PRESSURE, MapInput.RATIO)
        if piece is None:
            fault = Fault("map", "one level of pressure or displacement", "two levels of each")
            raise InputFaults("plot_efficiency()", [fault])
        return plotted(lambda: efficiency_plot(data, piece, (part,), chosen))

    def plot_losses(self) -> list[Axes]:
        """Draw contours of the loss and of the shares of its largest parts over pressure and displacement."""
        data = self.data
        piece = slice_of(data, MapInput.PRESSURE, MapInput.RATIO)
        return plotted(lambda: None if piece is None else loss_plot(data, piece))

    def plot_shares(self) -> list[Axes]:
        """Draw losses stacked over pressure, in kW and as shares."""
        data = self.data
        return plotted(lambda: share_plot(data))


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
            tables.append(("Time between points with a warning", list(marked_rows(summary))))
        return tables

    def plot_course(self) -> list[Axes]:
        """Draw speed, pressure, displacement, power and efficiency over time."""
        return plotted(lambda: course_plot(course_of(self.to_xarray())))


class CompareRun(Result):
    """Two maps side by side: means and largest differences."""

    kinds: ClassVar[tuple[str, ...]] = ("comparison",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "differences.csv")

    @property
    def name(self) -> str:
        """Names of both pumps."""
        return f"compare-{'-'.join(self.summary['pumps'])}"

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return differences.csv of a run folder."""
        return read_table(folder / "differences.csv")

    def tables(self) -> list[Table]:
        """Return differences by number, and over the cycle where there is one."""
        summary = self.summary
        title = " and ".join(str(name) for name in summary["names"])
        tables: list[Table] = [(title, [DIFFERENCE_HEAD, *difference_rows(summary)])]
        if summary["duty"]:
            tables.append(("Over the cycle", [DUTY_HEAD, *duty_rows(summary)]))
        return tables
