"""One operating point of a pump, from description to run folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, assert_never

from swashfilm.console.assumed import scaled_warning
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.schemas import write_new
from swashfilm.output.data.files import Column, write_columns, write_netcdf
from swashfilm.output.refinement import Refinement, refinement_summary, write_refinement
from swashfilm.output.run_folder import write_json
from swashfilm.output.scenes.picture3d import Frame, painter
from swashfilm.runs.pump.coefficients.edge_losses import loss_warnings, losses_left_out
from swashfilm.runs.pump.coefficients.flow import coefficient_warnings
from swashfilm.runs.pump.data import films_dataset, point_dataset, write_tables, write_unlike
from swashfilm.runs.pump.floating import floating_summary, scene_of, write_floating, write_unfinished
from swashfilm.runs.pump.forces import force_warnings, forces_summary, write_forces
from swashfilm.runs.pump.page import pump_figures, write_pump_page
from swashfilm.runs.pump.refine import of_level, refine_point
from swashfilm.runs.pump.result import PumpRun
from swashfilm.runs.pump.scene.given_films import films_scene, write_fields
from swashfilm.runs.pump.scene.views import pump_drawings
from swashfilm.runs.pump.summary import films_warnings, pump_summary
from swashfilm.runs.table.summary import point_by_table, table_point_summary, table_point_warnings
from system.description.assumptions import Assumption
from system.description.pump import PumpDescription
from system.multibody.floating_group import floating_joint_forces
from system.multibody.rotating_group import JointForces, joint_forces
from system.points.films import films_point
from system.points.floating import FloatingPoint, floating_point
from system.points.floating_gaps import FloatingOptions
from system.points.floating_solved import Solved
from system.points.lumped import lumped_point
from system.points.table.sources import Source
from system.pump.assembly import PumpPoint
from system.pump.operating import operating_point
from system.pump_file.file import check_pump, resolved_toml
from system.work.progress import Report, silent

if TYPE_CHECKING:
    import xarray

Drawings = Mapping[Path, Sequence[Frame]]
WRITING = 0.3
"""Time for writing the folder of a run with films, of the time for their solution."""


@dataclass(frozen=True)
class PumpCase:
    """One operating point to solve: the pump, the text of its file, and the fidelity of its films.

    table: file of a response table in place of the stored one; options: of floating gaps; side_by_side: a second
    process solves the piston of floating gaps; levels: of refinement, the first being that of the options; own: the
    pump at its own temperature, where that of the point has changed its films (`moved_to`): response tables belong to
    it; assumptions: for the values that the file of a scaled pump leaves out.
    """

    pump: PumpDescription
    given: str
    fidelity: Fidelity
    table: Path | None = None
    options: FloatingOptions | None = None
    side_by_side: bool = False
    levels: int = 1
    own: PumpDescription | None = None
    assumptions: tuple[Assumption, ...] = ()


@contextmanager
def unfinished_kept(case: PumpCase, folder: Path) -> Iterator[Solved]:
    """Yield the record of a floating point; if its solution stops, write the solved part to the folder."""
    solved = Solved()
    try:
        yield solved
    except BaseException as reason:
        if solved.gaps:
            _write_input(folder, case)
            write_unfinished(folder, case.pump.name, solved, reason)
        raise


def solve_pump(case: PumpCase, report: Report = silent, solved: Solved | None = None) -> PumpRun:
    """Solve a pump at its operating point; raise NotConverged and FilmNotConverged.

    solved: is filled with rounds and gaps of floating films (of the first level of a refinement) as they are solved.
    """
    match case.fidelity:
        case Fidelity.LUMPED:
            return lumped_run(case, lumped_point(case.pump, operating_point(case.pump)))
        case Fidelity.FIXED:
            return _films(case, report)
        case Fidelity.FLOATING:
            return _floating(case, report, solved)
        case Fidelity.TABLE:
            return _by_table(case)
        case _:
            assert_never(case.fidelity)


def lumped_run(case: PumpCase, point: PumpPoint) -> PumpRun:
    """Return the run of a solved lumped point of the case's pump."""
    pump = case.pump
    summary = pump_summary(pump, point, None, _warnings(pump, point) + loss_warnings(pump, point))
    return _run(case, point, summary, joint_forces(pump, point))


def _films(case: PumpCase, report: Report) -> PumpRun:
    pump, films = case.pump, films_point(case.pump, operating_point(case.pump), report=report)
    point = films.pump_point
    warnings = _warnings(pump, point) + loss_warnings(pump, point) + films_warnings(films)
    summary = pump_summary(pump, point, films, warnings)

    def fields(folder: Path) -> Drawings:
        write_unlike(folder, films)
        return pump_drawings(folder, films_scene(films), write_fields(folder, films))

    return _run(case, point, summary, joint_forces(pump, point), lambda: films_dataset(films), fields)


def _floating(case: PumpCase, report: Report, solved: Solved | None) -> PumpRun:
    pump = case.pump
    at, beside = operating_point(pump), case.side_by_side

    def solve(options: FloatingOptions | None, near: FloatingPoint | None, told: Report) -> FloatingPoint:
        return floating_point(pump, at, options, near=near, side_by_side=beside, report=told)

    told = of_level(report, 1, case.levels)
    found = floating_point(pump, at, case.options, side_by_side=beside, report=told, solved=solved)
    return floating_run(case, found, refine_point(found, case.levels, solve, report) if case.levels > 1 else None)


def floating_run(case: PumpCase, found: FloatingPoint, refinement: Refinement | None = None) -> PumpRun:
    """Return the run of a solved floating point of the case's pump, with its refinement."""
    point = found.pump_point
    summary = floating_summary(found, _warnings(case.pump, point) + losses_left_out(case.pump))
    if refinement is not None:
        summary["refinement"] = refinement_summary(refinement)

    def fields(folder: Path) -> Drawings:
        if refinement is not None:
            write_refinement(folder / "refinement.csv", refinement)
        return pump_drawings(folder, scene_of(found), write_floating(folder, found))

    return _run(case, point, summary, floating_joint_forces(found), None, fields)


def _by_table(case: PumpCase) -> PumpRun:
    pump, found = case.pump, point_by_table(case.own or case.pump, operating_point(case.pump), case.table)
    point = found.pump_point
    floats = found.table.origin.source is Source.FLOATING
    of_lands = losses_left_out(pump) if floats else loss_warnings(pump, point)
    warnings = [*_warnings(pump, point), *of_lands, *table_point_warnings(pump, found)]
    summary = pump_summary(pump, point, None, warnings) | table_point_summary(pump, found)
    return _run(case, point, summary, joint_forces(pump, point))


def _run(
    case: PumpCase,
    point: PumpPoint,
    summary: dict[str, Any],
    joints: JointForces,
    films: Callable[[], xarray.Dataset] | None = None,
    fields: Callable[[Path], Drawings] | None = None,
) -> PumpRun:
    """Return the run of a solved point: summary with forces, data with those of films, and files.

    fields: writes the files of the films into a folder that has results.nc; returns their drawings.
    """
    summary["forces"] = forces_summary(joints, point)
    summary["warnings"] += [*force_warnings(joints), *scaled_warning(case.assumptions)]
    places = [str(one) for one in (*joints.group.places.taken, *case.assumptions)]
    summary["assumptions"] += [one for one in places if one not in summary["assumptions"]]

    def data() -> xarray.Dataset:
        of_point = point_dataset(point, case.pump.name)
        return of_point if films is None else of_point.merge(films())

    def write(folder: Path) -> list[str]:
        _write_input(folder, case)
        with painter() if fields else nullcontext() as drawing:
            arrays = data()
            write_netcdf(arrays, folder / "results.nc", "pump")
            if fields and drawing:
                drawing.begin(fields(folder))
            write_tables(folder, arrays)
            write_pair_table(folder / "pairs.csv", point, summary)
            write_forces(folder, joints)
            write_json(folder / "summary.json", summary)
            figures = pump_figures(folder)
            reason = drawing.pictures().reason if drawing else ""
        added = [f"no_3d_picture: {reason}"] if reason else []
        write_json(folder / "summary.json", summary | {"warnings": summary["warnings"] + added})
        write_pump_page(folder, figures)
        return added

    return PumpRun(summary, write, data)


def _write_input(folder: Path, case: PumpCase) -> None:
    (folder / "input.toml").write_text(case.given, encoding="utf-8")
    write_new(folder / "resolved.toml", "pump", resolved_toml(case.pump))


def _warnings(pump: PumpDescription, point: PumpPoint) -> list[str]:
    """Return the warnings of the pump and of its point that hold for every fidelity."""
    stated = [*check_pump(pump).warnings, *point.warnings]
    return [*(str(warning) for warning in stated), *coefficient_warnings(pump, point)]


def write_pair_table(path: Path, point: PumpPoint, summary: dict[str, Any]) -> None:
    """Write the loss of the seven pairs as CSV, units in the head."""
    losses = summary["pair_loss"]
    counts = Column("count", [getattr(point.pairs, name).count for name in losses], "1")
    parts = [
        Column(part, [loss[f"{part}_W"] for loss in losses.values()], "W") for part in ("coulomb", "viscous", "total")
    ]
    share = Column("share", [100.0 * loss["share"] for loss in losses.values()], "%")
    write_columns(path, [Column("pair", list(losses)), counts, *parts, share])
