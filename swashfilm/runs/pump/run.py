"""One operating point of a pump, from description to run folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, assert_never

from swashfilm.console.fidelity import Fidelity
from swashfilm.output.gap_names import FIELDS, vtu_name
from swashfilm.output.picture3d import draw
from swashfilm.output.run_folder import write_json
from swashfilm.runs.pump.data import GAPS, PICTURED_TURN, films_dataset, point_dataset, write_tables
from swashfilm.runs.pump.edge_losses import loss_warnings, losses_left_out
from swashfilm.runs.pump.fields import write_fields
from swashfilm.runs.pump.floating import floating_summary, write_floating
from swashfilm.runs.pump.flow_coefficients import coefficient_warnings
from swashfilm.runs.pump.forces import force_warnings, forces_summary, write_forces
from swashfilm.runs.pump.summary import pump_summary
from swashfilm.runs.pump.validity import films_warnings
from swashfilm.runs.table.summary import told_point, told_summary, told_warnings
from system.description.pump import PumpDescription
from system.multibody.floating_group import floating_joint_forces
from system.multibody.rotating_group import JointForces, joint_forces
from system.points.films import FilmsPoint, films_point
from system.points.floating import floating_point
from system.points.floating_gaps import FloatingOptions
from system.points.lumped import lumped_point
from system.points.table.sources import Source
from system.pump.assembly import PumpPoint
from system.pump.operating import operating_point
from system.pump_file.file import check_pump, resolved_toml
from system.work.progress import Report

if TYPE_CHECKING:
    import xarray


def run_pump(
    pump: PumpDescription,
    given: str,
    fidelity: Fidelity,
    folder: Path,
    report: Report,
    table: Path | None = None,
    options: FloatingOptions | None = None,
    side_by_side: bool = False,
) -> dict[str, Any]:
    """Run a pump at its operating point and fill a run folder; return the summary.

    Writes input.toml (`given`, as it came) and resolved.toml first, then summary.json, tables, results.nc, fields
    for ParaView, 3D pictures where this machine can draw them, and report.html. `table`: the file of a response
    table in place of the kept one; `options`: of floating gaps, whose piston may have a process of its own. Raises
    NotConverged and FilmNotConverged rather than give a number that is none.
    """
    (folder / "input.toml").write_text(given, encoding="utf-8")
    (folder / "resolved.toml").write_text(resolved_toml(pump), encoding="utf-8")
    match fidelity:
        case Fidelity.LUMPED:
            summary = _run_lumped(pump, folder)
        case Fidelity.FILMS:
            summary = _run_films(pump, folder, report)
        case Fidelity.FLOATING:
            summary = _run_floating(pump, folder, report, options, side_by_side)
        case Fidelity.TABLE:
            summary = _run_table(pump, folder, table)
        case _:
            assert_never(fidelity)
    write_json(folder / "summary.json", summary)
    from swashfilm.runs.pump.page import write_pump_page

    write_pump_page(folder)
    return summary


def _run_lumped(pump: PumpDescription, folder: Path) -> dict[str, Any]:
    point = lumped_point(pump, operating_point(pump))
    summary = pump_summary(pump, point, None, _warnings(pump, point) + loss_warnings(pump, point))
    _write_point(folder, point_dataset(point, pump.name), point, summary)
    _tell_forces(folder, joint_forces(pump, point), point, summary)
    return summary


def _run_films(pump: PumpDescription, folder: Path, report: Report) -> dict[str, Any]:
    films = films_point(pump, operating_point(pump), report=report)
    point = films.pump_point
    write_fields(folder, films)
    warnings = _warnings(pump, point) + loss_warnings(pump, point) + films_warnings(films)
    warnings += draw_gaps(folder, films)
    summary = pump_summary(pump, point, films, warnings)
    _write_point(folder, point_dataset(point, pump.name).merge(films_dataset(films)), point, summary)
    _tell_forces(folder, joint_forces(pump, point), point, summary)
    return summary


def _run_floating(
    pump: PumpDescription, folder: Path, report: Report, options: FloatingOptions | None, side_by_side: bool
) -> dict[str, Any]:
    found = floating_point(pump, operating_point(pump), options, side_by_side=side_by_side, report=report)
    point = found.pump_point
    summary = floating_summary(found, _warnings(pump, point) + losses_left_out(pump))
    _write_point(folder, point_dataset(point, pump.name), point, summary)
    _tell_forces(folder, floating_joint_forces(found), point, summary)
    reason = draw(write_floating(folder, found)).reason
    summary["warnings"] += [reason] if reason else []
    return summary


def _run_table(pump: PumpDescription, folder: Path, table: Path | None) -> dict[str, Any]:
    told = told_point(pump, operating_point(pump), table)
    point = told.pump_point
    floats = told.table.origin.source is Source.FLOATING
    of_lands = losses_left_out(pump) if floats else loss_warnings(pump, point)
    warnings = [*_warnings(pump, point), *of_lands, *told_warnings(told)]
    summary = pump_summary(pump, point, None, warnings) | told_summary(pump, told)
    _write_point(folder, point_dataset(point, pump.name), point, summary)
    _tell_forces(folder, joint_forces(pump, point), point, summary)
    return summary


def _warnings(pump: PumpDescription, point: PumpPoint) -> list[str]:
    """Warnings of the pump and of its point, whatever the fidelity."""
    stated = [*check_pump(pump).warnings, *point.warnings]
    return [*(str(warning) for warning in stated), *coefficient_warnings(pump, point)]


def _write_point(folder: Path, data: xarray.Dataset, point: PumpPoint, summary: dict[str, Any]) -> None:
    """Write results.nc and the tables of a point."""
    data.to_netcdf(folder / "results.nc", engine="h5netcdf")
    write_tables(folder, data)
    write_pair_table(folder / "pairs.csv", point, summary)


def _tell_forces(folder: Path, joints: JointForces, point: PumpPoint, summary: dict[str, Any]) -> None:
    """Write forces.csv and tell the summary of it, with its warnings and what was taken of places."""
    write_forces(folder, joints)
    summary["forces"] = forces_summary(joints, point)
    summary["warnings"] += force_warnings(joints)
    places = [str(taken) for taken in joints.group.places.taken]
    summary["assumptions"] += [taken for taken in places if taken not in summary["assumptions"]]


def draw_gaps(folder: Path, films: FilmsPoint) -> list[str]:
    """Draw each gap and the whole pump in 3D (piston.png .. pump.png); return why a picture is missing."""
    count, positions = len(films.gaps.shaft_angle), len(films.gaps.valve_plate)
    k = round(PICTURED_TURN * count)
    chambers = [(k + shift) % count for shift in range(0, count, positions)]
    one = {"piston": k, "slipper": k, "valve_plate": k % positions}
    drawings = {folder / f"{gap}.png": [folder / FIELDS / vtu_name(gap, one[gap])] for gap in GAPS}
    drawings[folder / "pump.png"] = drawings[folder / "valve_plate.png"] + [
        folder / FIELDS / vtu_name(gap, j) for gap in ("piston", "slipper") for j in chambers
    ]
    reason = draw(drawings).reason
    return [reason] if reason else []


def write_pair_table(path: Path, point: PumpPoint, summary: dict[str, Any]) -> None:
    """Write the loss of the seven pairs as CSV, units in the head."""
    lines = ["pair,count [1],coulomb [W],viscous [W],total [W],share [%]"]
    for name, loss in summary["pair_loss"].items():
        count = getattr(point.pairs, name).count
        lines.append(
            f"{name},{count},{loss['coulomb_W']:.6g},{loss['viscous_W']:.6g},{loss['total_W']:.6g},"
            f"{100.0 * loss['share']:.4g}"
        )
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
