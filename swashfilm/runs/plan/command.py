"""Command `swashfilm plan`: its options, its output."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.settings import add_pump_argument, add_set_option
from swashfilm.console.terminal import show_result
from swashfilm.runs.map.command import LEVELS

if TYPE_CHECKING:
    from swashfilm.runs.plan.case import PlanCase

PLANS = ("grid", "paper", "point")
STEPS = 100
"""Steps of the progress before the computation reports its own."""


def add_plan_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    add_pump_argument(command)
    add_set_option(command)
    for option, (_, example, what) in LEVELS.items():
        command.add_argument(option, metavar=example, help=f"planned {what}; a..b:n: n levels; one value: constant")
    command.add_argument(
        "--plan", metavar=f"{{{','.join(PLANS)}}}", default="grid",
        help="levels of axes that are not stated: three speeds, three pressures, two displacements (grid), the paper's "
        "112 points in shares of the rating (paper), or the pump's own point (point)",
    )  # fmt: skip
    command.add_argument(
        "--campaign", type=Path, metavar="FILE.csv", help="planned points: speed [rpm], pressure [bar], .., repeats [1]"
    )
    command.add_argument(
        "--sensors", metavar="NAME=SIGMA,..",
        help="meters of the bench: Q_out,Q_case=0.02L/min,torque=0.2%%; without a sigma that of an ordinary bench "
        "(default: Q_out, Q_case, torque)",
    )  # fmt: skip
    command.add_argument(
        "--suspects", metavar="NAME,..", help="effects, faults and wrong values to tell apart (all): churning, "
        "elastic_opening.slipper, torque_offset; an effect's id alone means all its places",
    )  # fmt: skip
    command.add_argument("--add", metavar="N", help="readings to add, at most (24)")
    command.add_argument(
        "--further", metavar="NAME,..", help="meters that the bench could add: Q_slipper,torque_uncoupled (all)"
    )
    command.add_argument("--add-meters", metavar="N", help="further meters to ask for, at most (1)")
    command.add_argument(
        "--limit", action="append", default=[], metavar="'NAME <= VALUE'",
        help="limit of the bench for points to add: 'speed <= 1800 rpm', 'temperature >= 40 degC', "
        "'inlet pressure >= 12 bar'; may be repeated",
    )  # fmt: skip
    command.add_argument("--cost", metavar="PERCENT", help="loss of efficiency that a suspect has to cause (1%%)")
    command.add_argument("--apart", metavar="SIGMA", help="distance from which two are told apart (3.4)")


def run_plan_command(options: argparse.Namespace) -> int:
    """Run `swashfilm plan` and return its exit code; raise InputFaults with every fault."""
    from swashfilm.console.assumed import show_assumed
    from swashfilm.console.progress import progress
    from swashfilm.output.run_folder import run_folder
    from swashfilm.runs.plan.result import PlanRun
    from swashfilm.runs.plan.run import run_plan

    case = plan_case(options)
    show_assumed(options.pump)
    name = f"plan-{case.pump.name}"
    with run_folder(name, options.output, workbook=options.excel) as folder, progress(STEPS, name) as report:
        run_plan(case, folder, report)
        found = PlanRun.opened(folder)
    show_result(found, folder)
    return 0


def plan_case(options: argparse.Namespace) -> PlanCase:
    """Return the test of a command line; raise InputFaults with every fault."""
    from swashfilm.runs.plan.case import planned_case

    return planned_case(options, PLANS)


COMMAND = Command("plan", "what a test will tell apart, and which points to add", add_plan_options, run_plan_command)
