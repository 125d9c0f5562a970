"""Result of an operating point of a pump: numbers, tables, plots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from swashfilm.case.gap.physics import PHYSICS_HEAD, effect_rows
from swashfilm.console.fidelity import Fidelity
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.result import Numbers, Result, Table, plotted
from swashfilm.runs.pump import plots
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.floating import HEAD, floating_rows
from swashfilm.runs.pump.headline.powers import gathered, power_parts
from swashfilm.runs.pump.headline.ribbons import flow_diagram
from swashfilm.runs.pump.page import efficiency_rows, headline_rows, pair_rows
from swashfilm.runs.table.summary import TABLE_POINT_HEAD, source_words, table_point_rows
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import Dimension, QuantityError, parse_quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class FilmOfGap:
    """The film of one gap over a turn, SI; None where the fidelity does not compute it.

    load_share: least supported load over required load.
    """

    least_thickness: float | None
    mean_thickness: float | None
    leakage_flow: float | None
    friction_power: float | None
    pressure_max: float | None
    load_share: float | None


@dataclass(frozen=True)
class Films:
    """The films of the three gaps."""

    piston: FilmOfGap
    slipper: FilmOfGap
    valve_plate: FilmOfGap


class PumpRun(Result):
    """An operating point of a pump: flows, torque, efficiencies, losses, films; SI, gauge pressures."""

    kinds: ClassVar[tuple[str, ...]] = ("pump",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "results.nc")

    @property
    def flow_delivery(self) -> float:
        """Delivery flow in m3/s, at delivery pressure."""
        return float(self.summary["flow"]["delivery_m3_per_s"])

    @property
    def flow_inlet(self) -> float:
        """Inlet flow in m3/s, at inlet pressure."""
        return float(self.summary["flow"]["inlet_m3_per_s"])

    @property
    def flow_case(self) -> float:
        """Case drain flow in m3/s."""
        return float(self.summary["flow"]["case_m3_per_s"])

    @property
    def shaft_torque(self) -> float:
        """Mean shaft torque in N m."""
        return float(self.summary["torque"]["shaft_Nm"])

    @property
    def efficiency(self) -> Numbers:
        """Overall, volumetric and hydromechanical efficiency by ISO 4391/4409; 1."""
        return Numbers(self.summary["efficiency"]["iso_4409"])

    @property
    def losses(self) -> Numbers:
        """Losses of the seven friction pairs by name: coulomb, viscous, total in W, share in 1."""
        return Numbers(self.summary["pair_loss"])

    @property
    def films(self) -> Films:
        """The films of the three gaps."""
        return Films(**{gap: self._film(gap) for gap in GAPS})

    def _film(self, gap: str) -> FilmOfGap:
        own, table = self.summary["gaps"].get(gap, {}), self.summary.get("table", {})
        return FilmOfGap(
            own.get("film_thickness_min_m", table.get("film_thickness_min_m", {}).get(gap)),
            own.get("film_thickness_mean_m", table.get("film_thickness_mean_m", {}).get(gap)),
            self.summary["leakage"][f"{gap}_m3_per_s"],
            own.get("friction_power_mean_W", own.get("friction_power_W")),
            own.get("pressure_max_Pa"),
            own.get("carried_fraction_min"),
        )

    def tables(self) -> list[Table]:
        """Return operating point, efficiencies, friction pairs; gaps that float or come from a response table."""
        summary = self.summary
        tables: list[Table] = [
            (f"Pump {self.name}", headline_rows(summary)),
            ("Efficiencies: paper's Eqs. (3)-(5), ISO 4391/4409", efficiency_rows(summary)),
            ("Friction pairs: Coulomb, viscous, total, share", pair_rows(summary)),
        ]
        if summary["fidelity"] == Fidelity.FLOATING.value:
            tables.append(("Floating gaps: one piston, one slipper, the block", [HEAD, *floating_rows(summary)]))
            physics = effect_rows(summary["physics_left_out"], summary["cost"]["physics_seconds"])
            tables.append(("Physics of the floating gaps", [PHYSICS_HEAD, *physics]))
        if found := summary.get("refinement"):
            tables.append(("On finer levels", [refinement_head(found), *refinement_rows(found)]))
        if "table" in summary:
            title = f"Gaps by a table of the fidelity {source_words(summary)}"
            tables.append((title, [TABLE_POINT_HEAD, *table_point_rows(summary)]))
        return tables

    def plot_powers(self) -> list[Axes]:
        """Draw the sinks of the shaft power: delivered power, friction, leakage, throttling, as ribbons."""
        shaft = self.summary["power_balance"]["shaft_W"]
        return plotted(lambda: flow_diagram(shaft, gathered(power_parts(self.summary))))

    def plot_losses(self) -> list[Axes]:
        """Draw losses of the seven pairs, Coulomb and viscous."""
        return plotted(lambda: plots.loss_bar(self.summary))

    def plot_chamber(self) -> list[Axes]:
        """Draw chamber pressure and port openings over the shaft angle."""
        return plotted(lambda: plots.chamber_plot(self.to_xarray(), self.summary))

    def plot_flows(self) -> list[Axes]:
        """Draw delivery flow and leakage flows over the shaft angle."""
        return plotted(lambda: plots.flow_plot(self.to_xarray()))

    def plot_ripple(self) -> list[Axes]:
        """Draw port pressures, line flows and shaft torque over the shaft angle."""
        return plotted(lambda: plots.ripple_plot(self.to_xarray()))

    def plot_film(self, gap: str, angle: str | float = "270 deg") -> list[Axes]:
        """Draw film pressure and thickness of a gap ("piston", "slipper", "valve_plate") at a shaft angle.

        angle: text with its unit, or rad; the nearest solved angle is drawn. Raises InputFaults for another gap,
        for an invalid angle, and for a fidelity that solves no films.
        """
        data, faults = self.to_xarray(), []
        if gap not in GAPS:
            faults.append(Fault("gap", repr(gap), f"one of {', '.join(GAPS)}", nearest_choice(gap, GAPS)))
        elif f"{gap}_film_pressure" not in data:
            found = f"fidelity {self.summary['fidelity']}, without film fields"
            faults.append(Fault("gap", found, "a run of the fidelity fixed"))
        try:
            at = parse_quantity(angle, Dimension.ANGLE) if isinstance(angle, str) else float(angle)
        except QuantityError as reason:
            faults.append(Fault("angle", reason.found, reason.expected, reason.nearest))
        if faults:
            raise InputFaults("plot_film()", faults)
        angles = data[f"{gap}_angle"].values
        period = angles[-1] + angles[1]
        away = np.abs((angles - at + 0.5 * period) % period - 0.5 * period)
        return plotted(lambda: plots.gap_map(data, gap, int(np.argmin(away))))
