"""Options of the command line for runs with floating gaps: steps, mesh and physics."""

import argparse
from dataclasses import replace

from swashfilm.case.gap.physics import effects_of
from swashfilm.case.gap.revolution import FINER
from swashfilm.case.gap.switches import SWITCHES, switched_keys
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.inputs import option_value
from system.description.pump import SINGLE_PARTS, PumpDescription
from system.inputs.faults import Fault
from system.points.floating_gaps import FloatingOptions, usual_options
from system.pump.chamber_kinds import kinds

ALIKE = "identical chambers; with differing ones: swashfilm run with --fidelity lumped, fixed or floating"
FEWEST_STEPS, MOST_STEPS = 24, 7200


def floating_options(options: argparse.Namespace, pump: PumpDescription) -> FloatingOptions:
    """Return the options of the floating gaps by a command line without faults; the pump's where it states none."""
    usual = usual_options(pump.pump.pistons)
    steps = usual.steps if options.steps is None else int(options.steps)
    physics = usual.physics.without(*effects_of(switched_keys(options)))
    finer = usual.finer if options.finer is None else float(options.finer)
    return replace(usual, steps=steps, physics=physics, finer=finer, keep=max(1, usual.keep * steps // usual.steps))


def floating_faults(
    options: argparse.Namespace, pump: PumpDescription, chosen: str, by: str = "--fidelity"
) -> list[Fault]:
    """Return the faults of the options of floating gaps.

    Option `by` has chosen a fidelity.
    """
    numbers = {"--steps": options.steps, "--finer": options.finer}
    stated = [option for option, text in numbers.items() if text is not None] + _switched(options)
    if chosen != Fidelity.FLOATING.value:
        wanted = f"{by} {Fidelity.FLOATING.value} beside it"
        return [Fault(option, f"{by} {chosen}", wanted) for option in stated]
    return _steps_faults(options, pump) + _finer_faults(options)


def alike_faults(pump: PumpDescription) -> list[Fault]:
    """Return a fault for each single part of a pump, for runs that need identical chambers."""
    singles = [f"{name}.{number}" for name in SINGLE_PARTS for number, _ in getattr(pump, f"single_{name}s")]
    return [] if kinds(pump).alike else [Fault(part, "a single part", ALIKE) for part in singles]


def _steps_faults(options: argparse.Namespace, pump: PumpDescription) -> list[Fault]:
    if options.steps is None:
        return []
    pistons = pump.pump.pistons
    expected = f"a whole multiple of the {pistons} pistons, {FEWEST_STEPS} to {MOST_STEPS}"
    if not options.steps.isdecimal():
        return [Fault("--steps", repr(options.steps), expected)]
    steps = int(options.steps)
    if steps % pistons or not FEWEST_STEPS <= steps <= MOST_STEPS:
        within = min(max(steps, FEWEST_STEPS), MOST_STEPS)
        nearest = min(max(round(within / pistons), -(-FEWEST_STEPS // pistons)), MOST_STEPS // pistons) * pistons
        return [Fault("--steps", options.steps, expected, str(nearest))]
    return []


def _finer_faults(options: argparse.Namespace) -> list[Fault]:
    try:
        fits = options.finer is None or FINER[0] <= float(options.finer) <= FINER[1]
    except ValueError:
        fits = False
    expected = f"a number, {FINER[0]:g} to {FINER[1]:g}, times the usual cells each way"
    return [] if fits else [Fault("--finer", repr(options.finer), expected)]


def _switched(options: argparse.Namespace) -> list[str]:
    return [switch for switch in SWITCHES if option_value(options, switch)]
