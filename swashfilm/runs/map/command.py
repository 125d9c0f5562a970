"""Command `swashfilm map`: its options, its faults, its output."""

from __future__ import annotations

import argparse
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options
from swashfilm.console.command import Command
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text, option_value, whole
from swashfilm.console.settings import add_pump_argument, add_set_option, set_values
from swashfilm.console.terminal import show, show_at_once, show_result
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from swashfilm.runs.map.run import MapCase
    from system.description.pump import PumpDescription
    from system.maps.plan import MapAxis, MapPlan
    from system.work.tasks import Executor

LEVELS = {
    "--speeds": ("SPEED", "1000,1300,1700,2100rpm", "shaft speeds"),
    "--pressures": ("PRESSURE", "5..35MPa:7", "delivery pressures, gauge"),
    "--displacements": ("RATIO", "0.28,0.51,0.77,1.0", "fractions of the full displacement"),
    "--temperatures": ("TEMPERATURE", "30,50,70degC", "temperatures of the oil in the case"),
    "--inlet-pressures": ("INLET_PRESSURE", "25bar", "inlet pressures, gauge"),
}
"""Member of `MapInput`, example and meaning of each axis of a map."""
OPTIONS = {
    "operating.speed": "--speeds", "operating.pressure": "--pressures",
    "operating.displacement_ratio": "--displacements", "operating.temperature": "--temperatures",
    "operating.inlet_pressure": "--inlet-pressures",
}  # fmt: skip
"""Option of each input by its key in a pump file."""
MOST_WORKERS = 256
MOST_LISTED = 6
"""Largest number of levels that a fault lists."""
FIDELITIES = (Fidelity.LUMPED, Fidelity.FIXED, Fidelity.FLOATING, Fidelity.TABLE)
SOLVED = (Fidelity.FIXED.value, Fidelity.FLOATING.value)
"""Fidelities that solve films."""
WORTH_TELLING = 120.0
"""Seconds of processor time above which the command says what it will take."""
MANY = 5000
"""Points whose check alone takes more than a second."""
PLANS = ("paper", "point")


def add_map_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    add_pump_argument(command)
    for option, (_, example, what) in LEVELS.items():
        command.add_argument(option, metavar=example, help=f"{what}; a..b:n: n levels; one value: constant")
    add_set_option(command)
    command.add_argument(
        "--plan", metavar=f"{{{','.join(PLANS)}}}", default="paper",
        help="levels of axes that are not stated: the paper's 112 points in shares of the rated speed and pressure "
        "(paper), or the pump's own point (point)",
    )  # fmt: skip
    command.add_argument(
        "--fidelity", metavar=f"{{{','.join(one.value for one in FIDELITIES)}}}", default=Fidelity.FLOATING.value,
        help="films of given thickness (lumped), solved at given positions (fixed) or by balance of forces (floating), "
        "both by a response table built first where it needs fewer points than the map; or an existing table (table)",
    )  # fmt: skip
    command.add_argument("--table", type=Path, metavar="FILE.json", help="--fidelity table: file of the table")
    command.add_argument("--direct", action="store_true", help="--fidelity fixed, floating: solve each point, no table")
    add_floating_options(command)
    command.add_argument(
        "--check", metavar="N",
        help="fresh points that measure the error between levels (40; where each solves films up to 8 beside an axis "
        "of two levels, else 0)",
    )  # fmt: skip
    command.add_argument("--workers", metavar="N", help="processes that solve points side by side (all cores)")
    command.add_argument("--cluster", metavar="ADDRESS", help="Dask scheduler; its workers solve points")
    command.add_argument("--resume", type=Path, metavar="DIR", help="run folder with points of this run")


def run_map_command(options: argparse.Namespace) -> int:
    """Run `swashfilm map` and return its exit code; raise InputFaults with every fault of options and file."""
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.points import ended
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.map.result import MapRun
    from swashfilm.runs.map.run import run_map

    asked = map_case(options)
    show_assumed(options.pump)
    early = [*asked.plan.checked().warnings.values()]
    for warning in early:
        show(f"warning: {warning}")
    if asked.cost > WORTH_TELLING:
        show(f"{asked.points_words}: about {asked.cost / 60.0:.0f} min of processor time; --resume continues")
    name = asked.plan.pump.name
    with (
        run_folder(f"map-{name}", options.output, workbook=options.excel) as folder,
        progress(asked.plan.size, f"map {name}") as report,
    ):
        try:
            # Within the folder: after Ctrl-C the processes end the points they are at, and keep them there.
            with map_executor(options, asked) as executor:
                run_map(asked, folder, executor, report)
        except KeyboardInterrupt:
            raise _stopped(asked, folder) from None
        found = MapRun.opened(folder)
    show_result(found, folder, before=early)
    return ended(found.summary)


def _stopped(asked: MapCase, folder: Path) -> KeyboardInterrupt:
    """Return the interruption of a map: of one without a finished point it says so, and how long a point takes."""
    from swashfilm.output.run_folder import Interrupted
    from system.work.kept_results import POINTS

    if any((folder / POINTS).glob("*.json")):
        return KeyboardInterrupt()
    if asked.by_table:
        return Interrupted(None, "solved points of the response table are kept; the same command continues from them")
    takes = f"one takes about {asked.point_seconds:.3g} s of processor time"
    return Interrupted(None, f"no point is finished, {takes}; nothing was kept, and the same command starts again")


@contextmanager
def map_executor(options: argparse.Namespace, asked: MapCase) -> Iterator[Executor]:
    """Yield the workers that solve points: processes of this machine, or workers of a cluster."""
    from swashfilm.runs.map.run import worth_starting
    from system.work.processes import cores, process_pool

    if options.cluster is not None:
        from system.work.cluster import cluster

        with cluster(options.cluster) as executor:
            yield executor
        return
    wanted = cores() if options.workers is None else int(options.workers)
    with process_pool(worth_starting(asked, wanted)) as executor:
        yield executor


def map_case(options: argparse.Namespace, axes: Sequence[MapAxis] | None = None) -> MapCase:
    """Return the map of a command line, over these axes or over those that it states.

    Raises InputFaults with every fault.
    """
    from swashfilm.console.floating_options import floating_options
    from swashfilm.runs.map.run import MapCase
    from system.maps.plan import MOST_POINTS, map_plan
    from system.pump_file.file import load_known_pump

    faults = _word_faults(options)
    stated = set_values(options.set, faults)
    own_axes = stated_axes(options, faults)
    expect(options.pump, "pump", "film")
    try:
        known = load_known_pump(options.pump, stated)
    except InputFaults as reason:
        raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None
    pump = known.pump
    levels = with_usual(options.plan, pump, own_axes) if axes is None else axes
    faults += set_beside_levels(
        stated, levels, "" if axes is None else "no operating point: both maps have the same levels"
    )
    plan = map_plan(pump, levels)
    if MANY < plan.size <= MOST_POINTS:
        show_at_once(f"{plan.size} points: each is checked before the first is solved")
    faults += [*by_option(plan.checked().faults), *_solver_faults(options, plan)]
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    checks = None if options.check is None else int(options.check)
    fidelity = Fidelity(options.fidelity)
    given = given_text(options.pump, stated)
    floating = floating_options(options, pump)
    return MapCase(
        plan, fidelity, given, options.table, options.direct, checks, options.resume, floating, known.assumptions
    )


def stated_axes(options: argparse.Namespace, faults: list[Fault]) -> list[MapAxis]:
    """Return the axes that the command line states; add faults to `faults`."""
    from swashfilm.console.levels import map_axis
    from system.maps.plan import MapInput

    axes = []
    for option, (name, example, _) in LEVELS.items():
        text = option_value(options, option)
        if text is None:
            continue
        found = map_axis(option, text, MapInput[name], example)
        if isinstance(found, Fault):
            faults.append(found)
        else:
            axes.append(found)
    return axes


def set_beside_levels(stated: Collection[str], axes: Sequence[MapAxis], expected: str = "") -> list[Fault]:
    """Return the faults of keys of --set that give one value to an input with levels; expected: in place of options."""
    from system.maps.plan import MapInput

    levels = {axis.input: ", ".join(map(axis.input.text, axis.values)) for axis in axes}
    given = {path: MapInput[LEVELS[option][0]] for path, option in OPTIONS.items() if path in stated}
    return [
        Fault(
            f"--set {path}",
            f"beside levels of it, {levels[one]}",
            expected or f"one of the two: {OPTIONS[path]}, or --plan point",
        )
        for path, one in given.items()
        if one in levels
    ]


def with_usual(plan: str, pump: PumpDescription, stated: Sequence[MapAxis]) -> list[MapAxis]:
    """Return the axes of --plan for a pump, replaced by the stated ones."""
    from system.maps.usual_levels import usual_axes

    usual = {axis.input: axis for axis in usual_axes(pump)} if plan == "paper" else {}
    return list((usual | {axis.input: axis for axis in stated}).values())


def by_option(found: Sequence[Fault]) -> Iterator[Fault]:
    """Yield the faults of a plan's points under the option of their input, those with the same expectation as one."""
    alike: dict[tuple[str, str, str], list[str]] = {}
    for fault in found:
        path = OPTIONS.get(fault.path, fault.path)
        alike.setdefault((path, fault.expected, fault.nearest), []).append(fault.found)
    for (path, expected, nearest), values in alike.items():
        more = " .." if len(values) > MOST_LISTED else ""
        listed = "; ".join(values[:MOST_LISTED]) + more
        yield Fault(path, listed, expected, nearest)


def _word_faults(options: argparse.Namespace) -> list[Fault]:
    """Return the faults of words and numbers of the command line that do not depend on the pump."""
    faults = solving_faults(options, options.cluster)
    whole(faults, "--check", options.check, 0, (0, 10000))
    if options.direct and options.fidelity not in SOLVED:
        faults.append(Fault("--direct", f"beside --fidelity {options.fidelity}", f"--fidelity {' or '.join(SOLVED)}"))
    return faults


def solving_faults(options: argparse.Namespace, cluster: str | None = None) -> list[Fault]:
    """Return the faults of --plan, --fidelity, --table, --workers and --resume that do not depend on the pump."""
    faults = []
    names = [fidelity.value for fidelity in FIDELITIES]
    for option, known in (("--plan", PLANS), ("--fidelity", names)):
        word = option_value(options, option)
        if word not in known:
            faults.append(Fault(option, repr(word), f"one of {', '.join(known)}", nearest_choice(word, known)))
    if options.table and options.fidelity != Fidelity.TABLE.value:
        faults.append(Fault("--table", f"beside --fidelity {options.fidelity}", "no table, or --fidelity table"))
    return [*faults, *process_faults(options, cluster)]


def process_faults(options: argparse.Namespace, cluster: str | None = None) -> list[Fault]:
    """Return the faults of --workers and --resume, and of --workers beside a cluster."""
    from system.work.kept_results import points_of_run

    faults: list[Fault] = []
    whole(faults, "--workers", options.workers, 1, (1, MOST_WORKERS))
    if cluster is not None and options.workers is not None:
        faults.append(Fault("--workers", "beside --cluster", "one of the two: a cluster has its own workers"))
    if options.resume is not None:
        try:
            points_of_run(options.resume)
        except InputFaults as reason:
            faults += reason.faults
    return faults


def _solver_faults(options: argparse.Namespace, plan: MapPlan) -> Iterator[Fault]:
    """Yield the faults of a plan that the fidelity does not solve."""
    from swashfilm.console.floating_options import alike_faults, floating_faults
    from swashfilm.runs.map.run import POINT_COST, MapCase
    from system.maps.plan import MapInput

    if options.fidelity not in (fidelity.value for fidelity in FIDELITIES):
        return
    yield from floating_faults(options, plan.pump, options.fidelity)
    fidelity = Fidelity(options.fidelity)
    if fidelity is Fidelity.LUMPED:
        return
    yield from alike_faults(plan.pump)
    asked = MapCase(plan, fidelity, direct=options.direct)
    levels = len(plan.axes[list(MapInput).index(MapInput.INLET_PRESSURE)].values)
    if levels > 1 and (asked.by_table or fidelity is Fidelity.TABLE):
        seconds = POINT_COST.get(fidelity, POINT_COST[Fidelity.FLOATING]) * plan.size
        yield Fault(
            "--inlet-pressures", f"{levels} levels; a response table holds one",
            "one inlet pressure per map, --fidelity lumped, or --direct",
            f"--direct needs about {seconds:.0f} s of processor time",
        )  # fmt: skip


COMMAND = Command(
    "map", "a pump over speed, pressure, displacement, temperature, inlet pressure", add_map_options, run_map_command
)
