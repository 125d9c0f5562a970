"""Film case of one pump gap over the turn: chamber pressure, physics, steps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from gaps.revolution.schedule import Accuracy
from swashfilm.case.gap.chamber_pressure import ChamberPressure, read_chamber_pressure
from swashfilm.case.gap.instant import FORMAT
from swashfilm.case.gap.physics import physics_rows, read_physics
from swashfilm.case.gap.pump import CasePump, own_rows, read_case_pump
from system.description.gap import Gap
from system.films.rotor import Rotor
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table, quoted
from system.points.floating_gaps import MARCHED, USUAL, FloatingOptions, usual_finer

STEPS = 360
FILMS, RING_FILMS = 36, 180  # kept films of a turn; those of the valve plate repeat with the pitch
_MOST = 7200  # steps or films of a turn
FINER = (0.25, 8.0)
_LARGEST_TOLERANCE = 0.1


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

    chamber_pressure: of one chamber over its angle; options: physics, steps, accuracy and mesh.
    """

    name: str
    text: str
    resolved: str
    gap: Gap
    rotor: Rotor
    chamber_pressure: ChamberPressure
    options: FloatingOptions

    def refined(self) -> RevolutionCase:
        """Return the same gap on a mesh twice finer."""
        return replace(self, options=replace(self.options, finer=2 * self.options.finer))


def read_revolution_case(name: str, text: str, top: Table, film: Table, folder: Path) -> RevolutionCase | None:
    """Return the case of a file whose [film] has `gap` and `revolution = true`; None with its faults listed.

    Defaults: the pump's operating point, the lumped cycle of its chamber, all physics, STEPS per turn.
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
    table = top.table("revolution") or Table("revolution", {}, top.faults)
    options = _options(table, gap, pump)
    for part in (film, table):
        part.close()
    if gap is None or pump is None or pressure is None or options is None:
        return None
    case = RevolutionCase(name, text, "", gap, pump.rotor, pressure, options)
    return replace(case, resolved=_resolved(case, pump))


def _refuse_instants(top: Table, film: Table) -> None:
    """List a fault for each key that only a single instant has."""
    for table, keys in ((film, ("shaft_angle",)), (top, ("position", "load"))):
        for key in keys:
            if table.get(key) is not None:
                table.fault(
                    key, f"'{key}' beside revolution = true", "none: the forces over the turn determine the film"
                )


def _options(table: Table, gap: Gap | None, pump: CasePump | None) -> FloatingOptions | None:
    faults = len(table.faults)
    steps = _whole(table, "steps", STEPS, 24, _MOST)
    films = _whole(table, "films", RING_FILMS if gap is Gap.VALVE_PLATE else FILMS, 1, _MOST)
    physics = read_physics(table, USUAL)
    tolerance, finer = table.number("tolerance", MARCHED.step), table.number("finer", usual_finer(physics))
    if tolerance is not None and not 0.0 < tolerance <= _LARGEST_TOLERANCE:
        table.fault("tolerance", repr(tolerance), f"above 0, at most {_LARGEST_TOLERANCE:g} of the least film")
    if finer is not None and not FINER[0] <= finer <= FINER[1]:
        table.fault("finer", repr(finer), f"{FINER[0]:g} to {FINER[1]:g} times the usual cells each way")
    pistons = pump.rotor.pump.pump.pistons if pump else 1
    if steps and gap is Gap.VALVE_PLATE and steps % pistons:
        nearest = max(1, round(steps / pistons)) * pistons
        table.fault("steps", str(steps), f"a multiple of the {pistons} pistons", str(nearest))
    if len(table.faults) > faults or not (steps and finer and films and tolerance):
        return None
    distinct = steps // pistons if gap is Gap.VALVE_PLATE else steps
    return FloatingOptions(physics, steps, Accuracy(step=tolerance), finer, min(max(1, steps // films), distinct))


def _whole(table: Table, key: str, usual: int, least: int, most: int) -> int | None:
    raw = table.get(key)
    if raw is None:
        return usual
    if type(raw) is int and least <= raw <= most:
        return raw
    table.fault(key, repr(raw), f"a whole number, {least} to {most}")
    return None


def _resolved(case: RevolutionCase, pump: CasePump) -> str:
    """Return the text of this case."""
    options = case.options
    rows = [
        f"format = {FORMAT}", "", "[film]", f'gap = "{case.gap.value}"', f"pump = {quoted(pump.source)}",
        "revolution = true", f"chamber_pressure = {case.chamber_pressure.text}", *own_rows(pump.stated),
        *section_rows("operating", pump.rotor.pump.operating), "", "[revolution]", f"steps = {options.steps}",
        f"tolerance = {options.accuracy.step!r}  # error of a step over the least film",
        f"finer = {options.finer!r}  # times the usual cells each way",
        f"films = {options.steps // options.keep}", *physics_rows(options.physics),
    ]  # fmt: skip
    return "\n".join(rows) + "\n"
