"""Operating maps and their uses: duty cycles, comparisons, files for other programs."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import Quantity, door, words_of
from swashfilm.api.given import map_or_pump_path, map_path, pump_path
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.compare.result import CompareRun
    from swashfilm.runs.map.duty.result import DutyRun
    from swashfilm.runs.map.result import MapRun
    from system.description.pump import PumpDescription


def map(
    pump: str | Path | PumpDescription = "ref90",
    *,
    speeds: str | Sequence[Quantity] | None = None,
    pressures: str | Sequence[Quantity] | None = None,
    displacements: str | Sequence[float] | None = None,
    temperatures: str | Sequence[Quantity] | None = None,
    inlet_pressures: str | Sequence[Quantity] | None = None,
    fidelity: str = "floating",
    report: Report = silent,
    **options: object,
) -> MapRun:
    """Solve an operating map, as `swashfilm map`; levels are text ("5..35MPa:7") or a list.

    options: plan, table, direct, check, workers, cluster, resume. Raises InputFaults.
    """
    given = {
        "speeds": speeds,
        "pressures": pressures,
        "displacements": displacements,
        "temperatures": temperatures,
        "inlet_pressures": inlet_pressures,
        "fidelity": fidelity,
    }
    with door("map"), pump_path(pump) as name:
        from swashfilm.runs.map.command import map_case, map_executor
        from swashfilm.runs.map.result import MapRun
        from swashfilm.runs.map.run import run_map

        words = words_of("map", [name], given | options)
        asked = map_case(words)
        with map_executor(words, asked) as executor:
            return MapRun.ran(lambda folder: run_map(asked, folder, executor, report))


def duty(of: MapRun | str | Path, cycle: str | Path) -> DutyRun:
    """Return energies and losses over a duty cycle (CSV) by a map: a MapRun, its run folder, or its map.nc."""
    with door("duty"), map_path(of) as path:
        from swashfilm.runs.map.duty.cycle_file import read_cycle
        from swashfilm.runs.map.duty.result import DutyRun
        from swashfilm.runs.map.duty.run import run_duty
        from swashfilm.runs.map.files import map_file, read_map

        data, error = read_map(map_file(path))
        given = read_cycle(Path(cycle), data.axes)
        return DutyRun.ran(lambda folder: run_duty(data, error, given, Path(cycle), folder))


def compare(
    one: MapRun | str | Path | PumpDescription,
    other: MapRun | str | Path | PumpDescription,
    cycle: str | Path | None = None,
    *,
    fidelity: str | None = None,
    workers: int = 1,
    **options: object,
) -> CompareRun:
    """Compare two maps or pumps, also over a duty cycle, as `swashfilm compare`; raise InputFaults.

    fidelity: of the map of a pump; None for lumped. options: those of the command, such as set={"piston.mass": "150 g"}
    of the other pump.
    """
    with door("compare"), map_or_pump_path(one) as first, map_or_pump_path(other) as second:
        from swashfilm.runs.compare.command import compare_case
        from swashfilm.runs.compare.result import CompareRun

        options |= {"cycle": cycle, "fidelity": fidelity, "workers": workers}
        return CompareRun.ran(compare_case(words_of("compare", [first, second], options)).run)


def export(of: MapRun | str | Path, to: str, output: str | Path | None = None) -> tuple[Path, ...]:
    """Write a map for another program and return the files, as `swashfilm export`; raise InputFaults.

    of: a MapRun, its run folder, or its map.nc; to: "modelica", "matlab", "amesim", "fmu" or "csv"; output: the file,
    by default the pump's name in the working folder. Points without a result and missing binaries are Python warnings.
    """
    with door("export"), map_path(of) as path:
        from swashfilm.runs.export.write import export_of

        written = export_of(path, to, None if output is None else Path(output)).write()
    for warning in written.warnings:
        warnings.warn(warning, stacklevel=2)
    return written.paths
