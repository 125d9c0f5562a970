"""Floating films of a diagnosis: options of the command line, and the model from tables of solved films."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.case.gap.switches import add_floating_options
from swashfilm.console.inputs import COMMAND_LINE, option_value, whole
from system.inputs.faults import Fault, InputFaults, nearest_choice

if TYPE_CHECKING:
    from diagnosis.recording.model import Recording
    from system.description.pump import PumpDescription
    from system.effects.effect import EffectId
    from system.points.floating_gaps import FloatingOptions
    from system.points.table.film_physics import FilmModel
    from system.pump_file.file import KnownPump
    from system.work.progress import Report

LUMPED, FLOATING = FIDELITIES = ("lumped", "floating")
MOST = 10000  # points
OF_FLOATING = ("--points", "--held-out", "--variant")


@dataclass(frozen=True)
class FilmOptions:
    """Request for a diagnosis with floating films.

    floating: the films of the simulation, with the physics that they leave out; variants: the pump with an effect in
    its films; learnt, held_out: points of each table, 0 for the usual number.
    """

    floating: FloatingOptions
    variants: Mapping[EffectId, PumpDescription]
    learnt: int
    held_out: int


def add_film_options(command: argparse.ArgumentParser) -> None:
    """Add the options of the films to `swashfilm diagnose`."""
    what = "films of the simulation: of given thickness (lumped), or floating, by tables of solved films"
    command.add_argument("--fidelity", metavar="{lumped,floating}", default=LUMPED, help=what)
    add_floating_options(command)
    what = "floating films: an effect (worn_profile or shear_thinning) that the films of another pump file have"
    command.add_argument("--variant", metavar="EFFECT=FILE.toml", action="append", help=what)
    what = "floating films: points to fit of each table (22 for three inputs)"
    command.add_argument("--points", metavar="N", help=what)
    what = "floating films: points of each table that determine its error (a quarter of these)"
    command.add_argument("--held-out", metavar="N", help=what)


def film_options_of(options: argparse.Namespace, known: KnownPump) -> FilmOptions | None:
    """The options of floating films, None without them; raise InputFaults with every fault."""
    from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options

    faults = list(_of_fidelity(options, known))
    floats = options.fidelity == FLOATING
    faults += floating_faults(options, known.pump, options.fidelity)
    faults += alike_faults(known.pump) if floats else []
    learnt = whole(faults, "--points", options.points, 0, (4, MOST))
    held_out = whole(faults, "--held-out", options.held_out, 0, (2, MOST))
    variants = dict(_variants(options.variant or (), faults)) if floats else {}
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return FilmOptions(floating_options(options, known.pump), variants, learnt, held_out) if floats else None


def film_model_of(
    pump: PumpDescription, recording: Recording, asked: FilmOptions | None, workers: int, report: Report
) -> FilmModel | None:
    """The films of a pump over the points of a recording, None if not requested.

    Tables are built if not kept. Raises InputFaults for too few points, NotConverged as `film_model`.
    """
    if asked is None:
        return None
    from diagnosis.study.films.box import film_box
    from system.points.table.film_physics import FilmTask, film_counts, film_model
    from system.work.processes import process_pool

    box = film_box(pump, recording)
    learnt, held_out = film_counts(len(box.axes))
    if 0 < asked.learnt < 2 ** (len(box.axes) + 1):
        expected = f"at least {2 ** (len(box.axes) + 1)}: the recording varies {len(box.axes)} inputs"
        raise InputFaults(COMMAND_LINE, [Fault("--points", str(asked.learnt), expected)])
    counts = asked.learnt or learnt, asked.held_out or held_out
    task = FilmTask(box.pump, asked.floating, box.axes, *counts, asked.variants)
    with process_pool(workers) as executor:
        return film_model(task, executor=executor, report=report)


def _of_fidelity(options: argparse.Namespace, known: KnownPump) -> Iterator[Fault]:
    """Faults of the fidelity, and of options beside it."""
    if options.fidelity not in FIDELITIES:
        nearest = nearest_choice(options.fidelity, FIDELITIES)
        yield Fault("--fidelity", repr(options.fidelity), f"one of {', '.join(FIDELITIES)}", nearest)
    elif options.fidelity == LUMPED:
        for option in OF_FLOATING:
            if option_value(options, option) is not None:
                yield Fault(option, "--fidelity lumped", "--fidelity floating beside it")
    elif known.scant:
        yield Fault("--fidelity", "floating, of a pump that is known in part", "a pump file stated in full")
    if options.fidelity == FLOATING and options.film_tables:
        yield Fault("--film-tables", "--fidelity floating", "one of the two: floating films have elastic walls")


def _variants(stated: Iterable[str], faults: list[Fault]) -> Iterator[tuple[EffectId, PumpDescription]]:
    """Effects and pumps of --variant; list its faults."""
    from system.effects.effect import EffectId
    from system.points.table.film_physics import VARIANTS
    from system.pump_file.file import load_pump

    names = [one.value for one in VARIANTS]
    for text in stated:
        name, _, file = text.partition("=")
        if name not in names or not file:
            expected = f"EFFECT=FILE.toml, EFFECT one of {', '.join(names)}"
            faults.append(Fault("--variant", repr(text), expected, nearest_choice(name, names)))
            continue
        try:
            yield EffectId(name), load_pump(Path(file))
        except InputFaults as reason:
            faults.extend(reason.faults)
