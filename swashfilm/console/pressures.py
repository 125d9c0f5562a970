"""Option --units: the unit in which a command shows pressures."""

import argparse
from contextlib import AbstractContextManager, nullcontext

from swashfilm.console.inputs import COMMAND_LINE
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.shown import PressureUnit, pressures_in

NAMES = [unit.value for unit in PressureUnit]


def add_units_option(parser: argparse.ArgumentParser) -> None:
    """Add --units to a parser."""
    what = "unit of pressures in tables, pictures and CSV files (MPa; readings of a bench bar); inputs state their own"
    parser.add_argument("--units", metavar=f"{{{','.join(NAMES)}}}", help=what)


def pressures_of(options: argparse.Namespace) -> AbstractContextManager[None]:
    """Show pressures in the unit of a command line; raise InputFaults for one that is not known."""
    unit = getattr(options, "units", None)
    if unit is None:
        return nullcontext()
    if unit not in NAMES:
        fault = Fault("--units", repr(unit), f"one of {', '.join(NAMES)}", nearest_choice(unit, NAMES))
        raise InputFaults(COMMAND_LINE, [fault])
    return pressures_in(PressureUnit(unit))
