"""Result of an operating map."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.data.files import read_netcdf
from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.map.files import MAP, PARTS, map_of
from swashfilm.runs.map.page import BEST_HEAD, DISPLACEMENT_HEAD, axis_rows, best_rows, displacement_rows, failed_rows
from swashfilm.runs.map.panels import panels_figure
from swashfilm.runs.map.plots import efficiency_panels, loss_panels, share_plot, stacked_over
from swashfilm.runs.map.slices import main_slice
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
            tables.append(("Best points", [BEST_HEAD, *best_rows(summary)]))
        tables.append(("Displacement", [DISPLACEMENT_HEAD, *displacement_rows(summary)]))
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
        """Draw contours of an efficiency over speed and pressure, a panel for each distinct definition or for one.

        part: overall, volumetric, hydromechanical; definition: empty for all, "iso_4409" for both readings of that
        standard. A map of one speed or pressure is drawn over the next inputs that vary. Raises InputFaults for
        another name, and for a map of fewer than two such inputs.
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
        data, piece = self.data, main_slice(self.data)
        if piece is None:
            raise InputFaults("plot_efficiency()", [Fault("map", "fewer than two inputs with several levels", "two")])
        panels = [
            replace(panel, title=f"{panel.title}\n{words}")
            for panel, words in efficiency_panels(data, piece, part, chosen)
        ]
        return plotted(lambda: panels_figure(data, panels))

    def plot_losses(self) -> list[Axes]:
        """Draw contours of the loss and of the shares of its largest parts over the first two inputs that vary."""
        data, piece = self.data, main_slice(self.data)
        return plotted(lambda: None if piece is None else panels_figure(data, list(loss_panels(data, piece))))

    def plot_shares(self) -> list[Axes]:
        """Draw losses stacked over pressure, or over the first input that varies, in kW and as shares."""
        data = self.data
        given = stacked_over(data)
        return plotted(lambda: None if given is None else share_plot(data, given))
