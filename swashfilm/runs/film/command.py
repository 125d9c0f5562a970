"""Command `swashfilm film`: a single film, a film on finer meshes, or a study."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_switches, switched_keys
from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, expect, whole
from swashfilm.console.settings import add_set_option, set_values
from swashfilm.console.terminal import show, show_result
from system.inputs.faults import Fault, InputFaults

if TYPE_CHECKING:
    from swashfilm.case.file import Case
    from swashfilm.case.gap.revolution import RevolutionCase
    from swashfilm.case.study import StudyCase

EXAMPLE = "film.thickness=12um"
SOFT_PRICE = "elastic walls take about ten times as long as --rigid --isoviscous; a smaller 'finer' is faster"


def add_film_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("case", type=Path, metavar="CASE.toml", help="the film case")
    command.add_argument(
        "--refine", metavar="N",
        help="solve on N meshes, each twice as fine with half the time step, a warm film with two more levels; report "
        "order and limit",
    )  # fmt: skip
    command.add_argument("--resume", type=Path, metavar="DIR", help="of a study: run folder with finished points")
    command.add_argument("--workers", metavar="N", help="of a study: processes that solve points side by side (1)")
    command.add_argument(
        "--sensitivity", metavar="OUTPUTS",
        help="derivatives by the film at every place: load,flow.left,friction,.. (a wrong name lists all)",
    )  # fmt: skip
    command.add_argument("--csv", action="store_true", help="write the fields also as a table, fields.csv")
    command.add_argument(
        "--animate", action="store_true", help="of a revolution: write animation.gif (and .mp4 by ffmpeg)"
    )
    add_set_option(command, "the case", EXAMPLE)
    add_switches(command)


def run_film(options: argparse.Namespace) -> int:
    """Run `swashfilm film` and return its exit code; raise InputFaults with every fault of options or file."""
    from swashfilm.case.gap.revolution import RevolutionCase
    from swashfilm.case.study import StudyCase
    from swashfilm.console.assumed import show_assumed_in
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.film.run import solve_film

    case, meshes, workers = film_case(options)
    show_assumed_in(options.case)
    if isinstance(case, StudyCase):
        return _study(case, options, workers)
    if isinstance(case, RevolutionCase):
        return _revolution(case, options, meshes)
    with (
        run_folder(case.name, options.output, workbook=options.excel) as folder,
        progress(3, f"film {case.name}") as report,
    ):
        found = solve_film(case, report, meshes=meshes, as_table=options.csv, outputs=outputs_of(options))
        found.write(folder)
    show_result(found, folder)
    return 0


def film_case(options: argparse.Namespace) -> tuple[Case | StudyCase, int, int]:
    """Return the case, numbers of meshes and processes of a command line; raise InputFaults with all faults."""
    from swashfilm.case.gap.revolution import RevolutionCase
    from swashfilm.case.study import StudyCase
    from swashfilm.runs.film.refine import check_refinement
    from swashfilm.runs.film.solve.sensitivity import check_sensitivity

    expect(options.case, "film", "run")
    faults: list[Fault] = []
    meshes = whole(faults, "--refine", options.refine, 1, (2, 5), "a number of meshes")
    stated = set_values(options.set, faults, EXAMPLE)
    workers = whole(faults, "--workers", options.workers, 1, (1, 64), "a number of processes")
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    case = _loaded(options, stated)
    if not isinstance(case, (StudyCase, RevolutionCase)):
        if meshes > 1:
            check_refinement(case, meshes)
        if options.sensitivity is not None:
            check_sensitivity(case, outputs_of(options) or [options.sensitivity])
    return case, meshes, workers


def outputs_of(options: argparse.Namespace) -> list[str]:
    """Return the names of the outputs whose sensitivity is wanted, each once."""
    stated = options.sensitivity or ""
    return list(dict.fromkeys(name for part in stated.split(",") if (name := part.strip())))


def _revolution(case: RevolutionCase, options: argparse.Namespace, meshes: int) -> int:
    from gaps.films.physics import Effect
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.film.revolution.result import RevolutionRun
    from swashfilm.runs.film.revolution.run import run_revolution_case

    if Effect.ELASTIC_WALLS not in case.options.physics.left_out:
        show(SOFT_PRICE)
    label = f"film {case.name}"
    with (
        run_folder(case.name, options.output, workbook=options.excel) as folder,
        progress(case.options.steps, label) as report,
    ):
        run_revolution_case(case, folder, report, meshes=meshes, animated=options.animate)
        found = RevolutionRun.opened(folder)
    show_result(found, folder)
    return 0


def _study(study: StudyCase, options: argparse.Namespace, workers: int) -> int:
    from swashfilm.console.points import ended
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.film.series.page import run_study
    from swashfilm.runs.film.series.result import StudyRun

    label = f"study {study.name}"
    with (
        run_folder(study.name, options.output, workbook=options.excel) as folder,
        progress(len(study.points), label) as report,
    ):
        run_study(study, folder, report, resumed=options.resume, workers=workers)
        found = StudyRun.opened(folder)
    show_result(found, folder)
    return ended(found.summary)


def _loaded(options: argparse.Namespace, stated: Mapping[str, object]) -> Case | StudyCase:
    """Return the case; raise InputFaults with all faults of the file, or of options that are not for this kind."""
    from swashfilm.case.study import load_film

    switches: tuple[Fault, ...] = ()
    try:
        case = load_film(options.case, switched_keys(options), stated)
    except InputFaults as reason:
        if reason.source != COMMAND_LINE:
            raise
        switches, case = reason.faults, load_film(options.case, {}, stated)
    if faults := [*switches, *_option_faults(options, case)]:
        raise InputFaults(COMMAND_LINE, faults)
    return case


def _option_faults(options: argparse.Namespace, case: Case | StudyCase) -> list[Fault]:
    """Return the faults of options that are not for this kind of case."""
    from swashfilm.case.gap.revolution import RevolutionCase
    from swashfilm.case.study import StudyCase

    single, study, turn = "a single film", "a study", "a single case with revolution = true"
    for_study = {"--resume": options.resume, "--workers": options.workers}
    for_turn = {"--animate": options.animate or None}
    for_instant = {"--csv": options.csv or None, "--sensitivity": options.sensitivity}
    match case:
        case StudyCase():
            kind, unfit = study, [({"--refine": options.refine} | for_instant, single), (for_turn, turn)]
        case RevolutionCase():
            kind, unfit = turn, [(for_study, study), (for_instant, "a film at one instant")]
        case _:
            kind, unfit = single, [(for_study, study), (for_turn, turn)]
    return [
        Fault(name, f"an option beside {kind}", fit)
        for stated, fit in unfit
        for name, given in stated.items()
        if given is not None
    ]


COMMAND = Command("film", "one film: a free one or a gap of a pump", add_film_options, run_film)
