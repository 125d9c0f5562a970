"""Options of commands that vary a pump: pump, operating points, fidelity, dimensions, processes."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.settings import add_pump_argument, add_set_option
from swashfilm.runs.map.command import FIDELITIES, LEVELS, PLANS, SOLVED
from system.inputs.faults import Fault

if TYPE_CHECKING:
    from system.description.keys import PumpKey
    from system.variation.measures import Measure
    from system.work.tasks import Executor


def add_varied_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of a varied pump to the parser of a command."""
    add_pump_argument(command)
    add_set_option(command)
    for option, (_, example, what) in LEVELS.items():
        command.add_argument(option, metavar=example, help=f"{what}; a..b:n: n levels; one value: constant")
    command.add_argument(
        "--plan", metavar=f"{{{','.join(PLANS)}}}", default="point",
        help="levels of axes that are not stated: the pump's own point (point), or the paper's 112 points in shares of "
        "the rating (paper)",
    )  # fmt: skip
    command.add_argument(
        "--cycle",
        type=Path,
        metavar="CYCLE.csv",
        help="mean over a duty cycle; axes not stated get levels over its range",
    )
    command.add_argument(
        "--fidelity", metavar=f"{{{','.join(one.value for one in FIDELITIES)}}}", default=Fidelity.LUMPED.value,
        help="films of given thickness (lumped, default), solved at given positions (fixed), by balance of forces "
        "(floating), or by a response table (table), whose films follow the dimensions that are its axes",
    )  # fmt: skip
    command.add_argument("--table", type=Path, metavar="FILE.json", help="--fidelity table: file of the table")
    add_floating_options(command)
    command.add_argument("--keys", metavar="KEY,..", help="these dimensions alone: table.key, or a pattern (oil.*)")
    command.add_argument("--workers", metavar="N", help="processes that solve pumps side by side (all cores)")
    command.add_argument("--resume", type=Path, metavar="DIR", help="run folder with solved pumps of this run")


def chosen_keys(
    options: argparse.Namespace, known: Mapping[str, PumpKey], stated: Mapping[str, PumpKey], faults: list[Fault]
) -> dict[str, PumpKey]:
    """Return the dimensions of --keys, all known ones without it; add the fault of each word that names none.

    known: that may vary; stated: all of the pump, for the reason why one of them may not.
    """
    from system.description.keys import unknown_key

    if options.keys is None:
        return dict(known)
    found: dict[str, PumpKey] = {}
    for word in (one.strip() for one in options.keys.split(",")):
        own = {path: key for path, key in known.items() if fnmatchcase(path, word)}
        if not own and word in stated:
            why = "a dimension on which the films depend, but no axis of this response table"
            remedy = f"a table with it (swashfilm table --vary {word}), or --fidelity lumped, fixed or floating"
            faults.append(Fault("--keys", f"'{word}', {why}", remedy))
        elif not own:
            faults.append(unknown_key("--keys", word, known))
        found |= own
    return found


def needs_keys(options: argparse.Namespace) -> bool:
    """True where solving every dimension is too costly: films that float."""
    return options.fidelity == Fidelity.FLOATING.value and options.keys is None


def known_measures(fidelity: Fidelity, *, together: bool = False) -> tuple[Measure, ...]:
    """Return the measures of a fidelity; together: all points of a pump are solved at once."""
    from system.variation.measures import Needs, measures_of

    lumped = Needs.PRESSURE if together else Needs.COURSE
    return measures_of({Fidelity.LUMPED: lumped, Fidelity.TABLE: Needs.FILMS}.get(fidelity, Needs.LOADS))


def costly(fidelity: Fidelity) -> bool:
    """True for a fidelity that solves films anew for each pump."""
    return fidelity.value in SOLVED


@contextmanager
def varied_executor(options: argparse.Namespace, seconds: float) -> Iterator[Executor]:
    """Yield the processes that solve pumps: as many as have work for the seconds that they need to start."""
    from swashfilm.runs.map.run import START
    from system.work.processes import cores, process_pool

    wanted = cores() if options.workers is None else int(options.workers)
    with process_pool(max(1, min(wanted, int(seconds / START)))) as executor:
        yield executor
