"""Validity of a gap over the turn: warnings, each with its number, limit and remedy."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from gaps.films.physics import Effect
from gaps.films.slipper import retainer_force
from gaps.revolution.march import GapRevolution
from swashfilm.case.gap.revolution import GapOverTurn
from swashfilm.output.data.gap_names import LARGEST_RIGID_PRESSURE
from swashfilm.runs.film.checks.validity import LARGEST_OIL_PRESSURE, beyond_oil
from swashfilm.runs.film.solve.profiles import unresolved_profiles
from system.description.gap import Gap
from system.films.drives import slipper_retainer
from system.films.parts import FloatingParts
from system.inputs.shown import pressure_text, quantity_text
from system.inputs.units import Dimension
from system.pump_file.check import run_checks
from system.pump_file.floating import block_tips, slipper_has_a_wedge

LARGEST_OVERLAP = 3.0  # standard deviations of the summits; beyond, asperities flatten completely
LARGEST_RUBBING = 0.1  # of a gap's friction; contact has ten times the friction of oil: it bears about 1 % of the load
LARGEST_STEP_ERROR = 2.0  # relative to the tolerance of a step
LARGEST_BALANCE_ERROR = 0.01
LONGEST_WHIRL = 100.0  # turns once round; slower ones lead straight away
_SHAPES = {
    Gap.PISTON: "an edge_relief, barrel or run-in profile of piston or bore, or another radial_clearance",
    Gap.SLIPPER: "a crown, rim_relief or run-in profile of the slipper",
    Gap.VALVE_PLATE: "a waviness, run-in profile or pads of the valve plate",
}
_CHECKS = {Gap.SLIPPER: (slipper_has_a_wedge,), Gap.VALVE_PLATE: (block_tips,), Gap.PISTON: ()}


def revolution_warnings(
    case: GapOverTurn, parts: FloatingParts, found: GapRevolution[Any], balance: float, friction: float
) -> list[dict[str, str]]:
    """Return name and text of each warning; `balance`: mass balance error of the turn, `friction`: its power (W)."""
    warnings = [
        (check.name, str(warning))
        for check in _CHECKS[case.gap]
        for warning in run_checks((check,), case.rotor.pump).warnings
    ]
    warnings += [*_contact(case, parts, found, friction), *_pressures(case, found), *_motion(case, found, balance)]
    if case.gap is Gap.SLIPPER:
        warnings += pulled_together(case, parts, found)
    if case.gap is Gap.PISTON:
        warnings += unresolved_profiles(case.rotor, parts, next(iter(found.turn.films.values())))
    return [{"name": name, "text": text} for name, text in warnings]


def _contact(
    case: GapOverTurn, parts: FloatingParts, found: GapRevolution[Any], friction: float
) -> Iterator[tuple[str, str]]:
    """Yield warnings of a film replaced by contact, and of mean planes that overlap beyond the roughness."""
    laws = {
        Gap.PISTON: parts.piston.laws, Gap.SLIPPER: parts.slipper.laws, Gap.VALVE_PLATE: parts.block.laws,
    }[case.gap]  # fmt: skip
    if laws.asperities is None or Effect.ROUGHNESS in case.options.physics.left_out:
        return
    yield from _rubbing(case.gap, found, laws.asperities.height, friction)
    least = min(instant.least_gap for instant in found.turn.instants)
    limit = LARGEST_OVERLAP * laws.asperities.height
    if least < -limit:
        yield (
            "contact_beyond_roughness",
            f"the mean planes of the walls overlap by {-least * 1e6:.2g} um (limit {limit * 1e6:.2g} um, "
            f"{LARGEST_OVERLAP:g} times the composite roughness): such contact wears or deforms the parts; "
            "use elastic walls, or a run-in shape",
        )


def _rubbing(gap: Gap, found: GapRevolution[Any], roughness: float, friction: float) -> Iterator[tuple[str, str]]:
    """Yield a warning where contact makes a notable part of the gap's friction power (W) over the turn."""
    rubbing = float(np.mean([instant.passed.heat.rubbing for instant in found.turn.instants]))
    if rubbing <= LARGEST_RUBBING * abs(friction):
        return
    hardest, thinnest = max(found.turn.instants, key=lambda at: at.report.contact_load), found.least_film
    borne = quantity_text(hardest.report.contact_load, Dimension.FORCE, digits=3)
    yield (
        "boundary_lubrication",
        f"contact makes {rubbing:.3g} W of {friction:.3g} W of the friction over the turn, "
        f"{rubbing / abs(friction):.0%} (limit {LARGEST_RUBBING:.0%}); it bears up to "
        f"{borne} at {np.degrees(hardest.angle):.0f} deg, and the least film is "
        f"{thinnest.film_thickness_min / roughness:.2g} of the composite roughness at "
        f"{np.degrees(thinnest.angle):.0f} deg: friction follows the contact's coefficient, and the parts wear; "
        f"use {_SHAPES[gap]}, smoother surfaces, or an oil of higher viscosity",
    )


def pulled_together(case: GapOverTurn, parts: FloatingParts, found: GapRevolution[Any]) -> Iterator[tuple[str, str]]:
    """Yield a warning of slippers whose common pull tips the retainer."""
    retainer, z = slipper_retainer(case.rotor, parts), case.rotor.pump.pump.pistons
    angles, span = found.angles, float(found.angles[-1])
    pulls = [-float(retainer_force(retainer, instant.position).force[0]) for instant in found.turn.instants]
    together = sum(np.interp(angles + k * span / z, angles, pulls, period=span) for k in range(z))
    if (most := float(np.max(together))) > retainer.limit:
        yield (
            "retainer_gives_way",
            f"slippers that lift pull the retainer with {most:.4g} N beyond their parts of the spring force "
            f"(limit {retainer.limit:.4g} N, at which the retainer tips): the spring supports less than assumed; "
            "use a stiffer spring, or retainer.kind = 'clearance'",
        )


def _pressures(case: GapOverTurn, found: GapRevolution[Any]) -> Iterator[tuple[str, str]]:
    """Yield warnings of pressures beyond rigid walls and constant viscosity, and of those below a cavity's."""
    left_out, turn = case.options.physics.left_out, found.turn
    peak = max(instant.pressure_max for instant in turn.instants)
    if peak > LARGEST_OIL_PRESSURE:
        yield beyond_oil(peak, elastic=Effect.ELASTIC_WALLS not in left_out)
    elif Effect.ELASTIC_WALLS in left_out and peak > LARGEST_RIGID_PRESSURE:
        yield (
            "film_pressure_beyond_rigid",
            f"film pressure up to {pressure_text(peak)} (limit {pressure_text(LARGEST_RIGID_PRESSURE)} for rigid "
            "walls: they deform by micrometres); use elastic walls",
        )
    lowest = min(float(film.pressure.min()) for film in turn.films.values())
    cavity = next(iter(turn.films.values())).problem.cavitation_pressure
    if Effect.CAVITATION in left_out and lowest < cavity:
        yield (
            "pressure_below_cavitation",
            f"the film is pulled down to {pressure_text(lowest)} (limit {pressure_text(cavity)}, its cavitation "
            "pressure): oil would cavitate; choose cavitation = 'jfo'",
        )


def _motion(case: GapOverTurn, found: GapRevolution[Any], balance: float) -> Iterator[tuple[str, str]]:
    """Yield warnings of unstable motion, of too long steps, and of oil lost between reported angles."""
    if (grows := found.closing.largest_multiplier) > 1.0:
        turned = abs(float(np.angle(max(found.closing.multipliers, key=abs)))) / (2.0 * np.pi)  # in a turn
        other = "another, stable one may exist"
        if turned * LONGEST_WHIRL > 1.0:
            turns = f"{1.0 / turned:.2g} turns"
            other = f"the part whirls about it, once round in {turns}; more load or less spin steadies it"
        yield (
            "motion_unstable",
            f"a small disturbance grows {grows:.3g} times per turn (limit 1): the motion is unstable; {other}",
        )
    if (error := found.turn.step_error) > LARGEST_STEP_ERROR:
        yield (
            "steps_too_long",
            f"the error of a step is {error:.2g} times its tolerance (limit {LARGEST_STEP_ERROR:g}; tolerance "
            f"{case.options.accuracy.step:g} of the least film); use more steps",
        )
    if balance > LARGEST_BALANCE_ERROR:
        yield (
            "coarse_angles",
            f"at the reported angles {balance:.2%} of the oil is lost over the turn (limit "
            f"{LARGEST_BALANCE_ERROR:.0%}; the time steps themselves lose none); use more steps",
        )
