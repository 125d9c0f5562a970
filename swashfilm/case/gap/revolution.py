"""Film case of one pump gap over the turn: chamber pressure, physics, steps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Protocol

from gaps.revolution.schedule import Accuracy
from swashfilm.case.gap.chamber_pressure import ChamberPressure, read_chamber_pressure
from swashfilm.case.gap.instant import FORMAT
from swashfilm.case.gap.physics import SwitchesSection, choices
from swashfilm.case.gap.pump import CasePump, own_rows, read_case_pump
from system.description.assumptions import Assumption
from system.description.gap import Gap
from system.films.parts import floating_parts
from system.films.rotor import Rotor
from system.inputs.sections.fields import Limits
from system.inputs.sections.reader import table_section
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table, quoted
from system.points.film_effects import floating_effects
from system.points.floating_gaps import MARCHED, FloatingOptions, usual_options

FILMS, RING_FILMS = 36, 180  # kept films of a turn; those of the valve plate repeat with the pitch
MOST = 7200  # steps or films of a turn
FINER = (0.25, 8.0)
STEPS_FINER = 4.0
"""Factor by which the allowed error of a step falls with each halving of cells and angles: steps are of order two."""


@dataclass(frozen=True, kw_only=True)
class RevolutionSection(SwitchesSection):
    """[revolution]: steps, accuracy, mesh and physics of a gap over the turn."""

    steps: Annotated[int, Limits(least=24, most=MOST)] | None = None  # of a turn
    tolerance: Annotated[float, Limits(above=0.0, most=0.1)] = MARCHED.step  # error of a step over the least film
    finer: Annotated[float, Limits(least=FINER[0], most=FINER[1])] | None = None  # times the usual cells each way
    films: Annotated[int, Limits(least=1, most=MOST)] | None = None  # kept of a turn


class GapOverTurn(Protocol):
    """A gap over the turn: of a case, or of a pump with all gaps floating."""

    @property
    def name(self) -> str:
        """Name of the case or pump."""

    @property
    def gap(self) -> Gap:
        """One of the three gaps."""

    @property
    def rotor(self) -> Rotor:
        """The pump at its operating point."""

    @property
    def options(self) -> FloatingOptions:
        """Physics, steps, accuracy and mesh."""


@dataclass(frozen=True)
class RevolutionCase:
    """A validated case of a gap over the turn: name, text of the file, resolved text, and its data (SI).

    chamber_pressure: of one chamber over its angle; options: physics, steps, accuracy and mesh; assumptions: for the
    values that the pump file leaves out.
    """

    name: str
    text: str
    resolved: str
    gap: Gap
    rotor: Rotor
    chamber_pressure: ChamberPressure
    options: FloatingOptions
    assumptions: tuple[Assumption, ...]

    def refined(self) -> RevolutionCase:
        """Return the same gap on a mesh twice finer, with finer steps."""
        return replace(self, options=refined_options(self.options))


def refined_options(options: FloatingOptions) -> FloatingOptions:
    """Return cells and angles of half the size, and steps of a fourth of the error."""
    exact = options.accuracy
    finer = replace(exact, step=exact.step / STEPS_FINER, closed=exact.closed / STEPS_FINER)
    return replace(
        options, steps=2 * options.steps, keep=2 * options.keep, finer=2.0 * options.finer, accuracy=finer
    )  # fmt: skip


def read_revolution_case(name: str, text: str, top: Table, film: Table, folder: Path) -> RevolutionCase | None:
    """Return the case of a file whose [film] has `gap` and `revolution = true`; None with its faults listed.

    Defaults: the pump's operating point, the lumped cycle of its chamber, all physics, 360 steps per turn (or the
    nearest multiple of the pistons). Films solve their effects of the pump's [physics].
    """
    gap = film.choice("gap", Gap)
    if film.get("revolution") is not True:
        film.fault("revolution", repr(film.get("revolution")), "true, or false for a single instant")
    if film is top:
        top.fault("gap", "a revolution outside a table", "gap, pump and revolution in a table [film]")
        return None
    pump = read_case_pump(top, film, folder)
    pressure = read_chamber_pressure(film, folder)
    _refuse_instants(top, film)
    options = _options(top, gap, pump)
    film.close()
    if gap is None or pump is None or pressure is None or options is None:
        return None
    of_pump = floating_effects(pump.rotor, floating_parts(pump.rotor.pump), pump.rotor.pump, options.physics)
    options = replace(options, physics=getattr(of_pump.physics, gap.value))
    case = RevolutionCase(name, text, "", gap, pump.rotor, pressure, options, pump.assumptions)
    return replace(case, resolved=_resolved(case, pump))


def _refuse_instants(top: Table, film: Table) -> None:
    """List a fault for each key that only a single instant has."""
    for table, keys in ((film, ("shaft_angle",)), (top, ("position", "load"))):
        for key in keys:
            if table.get(key) is not None:
                table.fault(
                    key, f"'{key}' beside revolution = true", "none: the forces over the turn determine the film"
                )


def _options(top: Table, gap: Gap | None, pump: CasePump | None) -> FloatingOptions | None:
    stated = table_section(top, "revolution", RevolutionSection, left_out=True)
    if stated is None:
        return None
    pistons = pump.rotor.pump.pump.pistons if pump else 1
    usual, ring = usual_options(pistons), gap is Gap.VALVE_PLATE
    physics = stated.physics(usual.physics)
    finer = usual.finer if stated.finer is None else stated.finer
    steps = usual.steps if stated.steps is None else stated.steps
    if ring and steps % pistons:
        nearest = max(1, round(steps / pistons)) * pistons
        top.fault("revolution.steps", str(steps), f"a multiple of the {pistons} pistons", str(nearest))
        return None
    distinct = steps // pistons if ring else steps
    keep = max(1, steps // (stated.films or (RING_FILMS if ring else FILMS)))
    return FloatingOptions(physics, steps, Accuracy(step=stated.tolerance), finer, min(keep, distinct))


def _resolved(case: RevolutionCase, pump: CasePump) -> str:
    """Return the text of this case."""
    options = case.options
    turn = RevolutionSection(
        steps=options.steps, tolerance=options.accuracy.step, finer=options.finer,
        films=options.steps // options.keep, **choices(options.physics),
    )  # fmt: skip
    rows = [
        f"format = {FORMAT}", "", "[film]", f'gap = "{case.gap.value}"', f"pump = {quoted(pump.source)}",
        "revolution = true", f"chamber_pressure = {case.chamber_pressure.text}", *own_rows(pump.stated),
        *section_rows("operating", pump.rotor.pump.operating), *section_rows("revolution", turn),
    ]  # fmt: skip
    return "\n".join(rows) + "\n"
