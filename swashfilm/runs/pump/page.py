"""Page of an operating point: self-contained report.html from the files of the run folder."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.console.fidelity import Fidelity
from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_netcdf
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.figures import smaller
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.pump import plots as pump_plots
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.floating import floating_view
from swashfilm.runs.pump.forces import ForcesView, forces_view
from swashfilm.runs.pump.headline.answer import pump_answer
from swashfilm.runs.pump.headline.powers import power_parts
from swashfilm.runs.pump.scene.reliefs import gap_explorer
from swashfilm.runs.pump.scene.view import pump_view
from swashfilm.runs.pump.scene.views import PICTURE, TURNING
from swashfilm.runs.pump.summary import chamber_numbers
from swashfilm.runs.table.summary import TABLE_POINT_HEAD, source_words, table_point_rows
from system.inputs.shown import pressure_text, shown_in
from system.inputs.units import LPM
from system.pump.bench import EFFICIENCIES
from system.pump.laws.friction_pairs import Pair

Rows = list[tuple[str, ...]]


@dataclass(frozen=True)
class PumpFigures:
    """Figures and answer of a run folder's page, apart from 3D pictures, which a process may still draw.

    view: the rotatable pump, in place of its picture; None without films in the folder.
    """

    answer: Answer
    pictures: dict[str, Picture]
    gap_maps: dict[str, Picture]
    floating: dict[str, Any] | None
    forces: ForcesView | None
    view: Explorer | None


def pump_figures(folder: Path) -> PumpFigures:
    """Draw the figures of a pump's run folder; raise InputFaults where summary.json or results.nc is missing."""
    summary = _summary_of(folder)
    data = read_netcdf(folder / "results.nc")
    floats = Fidelity(summary["fidelity"]) is Fidelity.FLOATING
    maps = {
        map_caption(data, gap): inlined(drawn, gap_explorer(data, gap))
        for gap, drawn in pump_plots.gap_maps(data).items()
    }
    return PumpFigures(
        pump_answer(summary),
        _pictures(data, summary),
        maps,
        floating_view(folder, summary) if floats else None,
        forces_view(folder, summary),
        pump_view(folder),
    )


def _summary_of(folder: Path) -> dict[str, Any]:
    return read_summary(folder, ("summary.json", "resolved.toml", "results.nc"), "a pump's run folder")


def write_pump_page(folder: Path, figures: PumpFigures | None = None) -> Path:
    """Write report.html of a pump's run folder from its summary.json, resolved.toml and results.nc.

    figures: those of the folder, where they are drawn already. The page includes 3D pictures of the folder. Raises
    InputFaults where one of the three is missing.
    """
    summary, drawn = _summary_of(folder), figures or pump_figures(folder)
    return write_page(
        folder,
        "pump",
        answer=drawn.answer,
        summary=summary,
        headline=headline_rows(summary),
        efficiencies=efficiency_rows(summary),
        bench=bench_rows(summary),
        pairs=pair_rows(summary),
        power=power_rows(summary),
        gaps=gap_rows(summary) if drawn.floating is None else [],
        floating=drawn.floating,
        table_rows=list(table_point_rows(summary)) if "table" in summary else [],
        table_head=TABLE_POINT_HEAD,
        table_source=source_words(summary) if "table" in summary else "",
        refinement=[refinement_head(found), *refinement_rows(found)] if (found := summary.get("refinement")) else [],
        ripple=ripple_rows(summary),
        steady=is_steady(summary),
        coefficients=[tuple(one[key] for key in ("key", "file", "source", "range")) for one in summary["coefficients"]],
        checks=check_rows(summary),
        forces=drawn.forces,
        pictures=drawn.pictures,
        gap_maps=drawn.gap_maps,
        solid=[(gap.replace("_", " "), png) for gap in GAPS if (png := _kept(folder / f"{gap}.png"))],
        pump=_kept(folder / PICTURE, drawn.view),
        turning=TURNING if (folder / TURNING).is_file() else "",
        resolved=kept_text(folder, "resolved.toml"),
    )


def map_caption(data: Any, gap: str) -> str:
    """Return the title of a gap's maps with their shaft angle; the valve plate's maps repeat after each pitch."""
    k = pump_plots.pictured(data, gap)
    angle = np.degrees(data[f"{gap}_angle"].values[k])
    whose = "block" if gap == "valve_plate" else "shaft"
    return f"{TITLES[gap]} at {whose} angle {angle:.0f} deg, given position"


def headline_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (name, value with its unit) of the operating point and its results."""
    at, flow, torque = summary["operating_point"], summary["flow"], summary["torque"]
    ripple, errors = summary["ripple"], summary["checks"]
    return [
        ("shaft speed", f"{at['shaft_speed_rad_per_s'] * 30 / np.pi:.1f} r/min"),
        ("delivery pressure (gauge)", shown_in("Pa").text(at["delivery_pressure_Pa"])),
        ("inlet pressure (gauge)", shown_in("Pa").text(at["inlet_pressure_Pa"])),
        ("case pressure (gauge)", shown_in("Pa").text(at["case_pressure_Pa"])),
        ("displacement ratio", f"{at['displacement_ratio']:.3f}"),
        ("swash angle", f"{np.degrees(at['swash_angle_rad']):.3f} deg"),
        ("oil temperature", f"{at['temperature_K'] - 273.15:.1f} degC"),
        ("oil viscosity", f"{at['viscosity_Pa_s'] * 1e3:.2f} mPa s"),
        ("displacement, geometric", f"{summary['displacement']['geometric_m3_per_rev'] * 1e6:.2f} mL/r"),
        ("displacement, derived", f"{summary['displacement']['derived_m3_per_rev'] * 1e6:.2f} mL/r"),
        ("flow, geometric", f"{flow['geometric_m3_per_s'] * LPM:.2f} L/min"),
        ("flow, delivery", f"{flow['delivery_m3_per_s'] * LPM:.2f} L/min"),
        ("flow, inlet", f"{flow['inlet_m3_per_s'] * LPM:.2f} L/min"),
        ("flow, case drain", f"{flow['case_m3_per_s'] * LPM:.4f} L/min"),
        *((f"leakage, {TITLES[gap]}", f"{summary['leakage'][f'{gap}_m3_per_s'] * LPM:.4f} L/min") for gap in GAPS),
        ("torque, shaft", f"{torque['shaft_Nm']:.2f} N m"),
        ("torque, ideal at delivery pressure", f"{torque['ideal_delivery_Nm']:.2f} N m"),
        ("torque, ideal at pressure difference", f"{torque['ideal_difference_Nm']:.2f} N m"),
        ("ripple, delivery pressure", f"{pressure_text(ripple['delivery_pressure_peak_to_peak_Pa'], 4)} peak to peak"),
        ("ripple, delivery flow", f"{ripple['delivery_flow_peak_to_peak_m3_per_s'] * LPM:.3f} L/min peak to peak"),
        ("ripple, shaft torque", f"{ripple['shaft_torque_peak_to_peak_Nm']:.2f} N m peak to peak"),
        ("energy balance error, torque from forces", f"{errors['energy_balance_error']:.2g} of the shaft power"),
    ]


def efficiency_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (efficiency, paper's in %, ISO's in %); none where the machine does not pump."""
    norms = [summary["efficiency"][key] for key in ("paper", "iso_4409")]
    return [
        (f"{name} efficiency", *("none" if norm[name] is None else f"{100 * norm[name]:.2f} %" for norm in norms))
        for name in EFFICIENCIES
    ]


def bench_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (loss, by the paper's Eqs. (1), (2), by the split without the oil's compression energy)."""
    paper, exact = summary["paper_loss"], summary["bench_split"]
    return [
        ("volumetric", f"{paper['volumetric_W']:.1f} W", f"{exact['leakage_W']:.1f} W"),
        ("hydromechanical", f"{paper['hydromechanical_W']:.1f} W", f"{exact['hydromechanical_W']:.1f} W"),
        ("stored in the oil", "counted as volumetric", f"{exact['elastic_W']:.1f} W"),
    ]


def pair_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (pair, Coulomb, viscous, total, share) of the seven friction pairs and their sum."""
    rows: Rows = []
    for pair in Pair:
        loss = summary["pair_loss"][pair.value]
        numbers = (f"{loss[key]:.1f} W" for key in ("coulomb_W", "viscous_W", "total_W"))
        rows.append((pair.words, *numbers, f"{100 * loss['share']:.2f} %"))
    total = {
        key: sum(loss[key] for loss in summary["pair_loss"].values()) for key in ("coulomb_W", "viscous_W", "total_W")
    }
    return [*rows, ("all pairs", *(f"{value:.1f} W" for value in total.values()), "100 %")]


def power_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (part of the shaft power, W, share of it), and the whole."""
    shaft = summary["power_balance"]["shaft_W"]
    parts = [(part.name, part.watts) for part in power_parts(summary)]
    named = [*parts, ("shaft power", shaft)]
    return [(name, f"{_plain(watts, 1)} W", f"{_plain(100.0 * watts / abs(shaft), 3)} %") for name, watts in named]


def _plain(value: float, digits: int) -> str:
    """Return a number with so many decimals, without the sign of a zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


def gap_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (gap, given film, leakage, friction power, statement); then those of differing chambers."""
    named = [(TITLES[gap], report) for gap, report in summary["gaps"].items()]
    for kind in summary["unlike"].values():
        named += [(f"{TITLES[gap]}, {chamber_numbers(kind)}", report) for gap, report in kind["gaps"].items()]
    return [
        (
            name,
            f"{report['film_thickness_mean_m'] * 1e6:.2f} um (least {report['film_thickness_min_m'] * 1e6:.2f} um)",
            f"{report['leakage_flow_mean_m3_per_s'] * LPM:.4f} L/min",
            f"{report['friction_power_mean_W']:.1f} W",
            report["statement"],
        )
        for name, report in named
    ]


def ripple_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (ripple, peak to peak, its orders z, 2 z and 3 z)."""
    ripple = summary["ripple"]
    units = {"pressure": "Pa", "flow": "m3/s", "torque": "N m"}
    rows: Rows = []
    for name in ("delivery_pressure", "delivery_flow", "inlet_pressure", "inlet_flow", "shaft_torque"):
        shown = shown_in(units[name.rpartition("_")[2]])
        keys = [key for key in ripple if key.startswith(name)]
        rows.append((name.replace("_", " "), *(shown.text(ripple[key], 3) for key in keys)))
    return rows


def is_steady(summary: Mapping[str, Any]) -> bool:
    """Return True where both port pressures are constant."""
    ripple = summary["ripple"]
    return all(ripple[f"{port}_pressure_peak_to_peak_Pa"] < pump_plots.STEADY for port in ("delivery", "inlet"))


def check_rows(summary: Mapping[str, Any]) -> Rows:
    """Return (check, value): balances, convergence and effort of the solvers, with those of the gaps."""
    rows: Rows = [(key.replace("_", " "), f"{value:.3g}") for key, value in summary["checks"].items()]
    for gap, report in summary["gaps"].items():
        for key in ("mass_balance_error_max", "energy_balance_error_max", "unknowns"):
            if key in report:
                rows.append((f"{TITLES[gap]} film, {key.replace('_', ' ')}", f"{report[key]:.3g}"))
    return rows


def _pictures(data: Any, summary: Mapping[str, Any]) -> dict[str, Picture]:
    pictures = {
        "losses": pump_plots.loss_bar(summary),
        "chamber": pump_plots.chamber_plot(data, summary),
        "flows": pump_plots.flow_plot(data),
        "ripple": pump_plots.ripple_plot(data),
    }
    if "piston_film_pressure" in data:
        pictures["films"] = pump_plots.film_series(data)
    return {name: inlined(png) for name, png in pictures.items()}


def _kept(picture: Path, explorer: Explorer | None = None) -> Picture | None:
    """Return a picture of the folder as a page embeds it; None where this machine could not draw it."""
    return inlined(smaller(picture.read_bytes()), explorer) if picture.is_file() else None
