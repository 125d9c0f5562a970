"""Contacts of the swash plate with its stops: begin and end, number of lift-offs between, and the impact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from system.inputs.units import TURN
from system.multibody.transient import kernels as kernel
from system.multibody.transient.solver import Transient

LYING = 0.75
"""Share of a contact in touch from which the plate lies against the stop; below it, it bounces."""


@dataclass(frozen=True)
class StopContact:
    """A contact with a stop, without interruptions of a turn: `stop` is lower or upper.

    begin, end: s, of the first and last touch. from_start, to_end: it lasts from the start, or to the last turn, of the
    transient. share: of its time in touch. turns: of the shaft meanwhile. lifts: number of times that the plate leaves
    the stop meanwhile; lift: the highest, rad. impact: N m s, the largest on the stop.
    """

    stop: str
    begin: float
    end: float
    from_start: bool
    to_end: bool
    share: float
    turns: float
    lifts: int
    lift: float
    impact: float


def stop_contacts(found: Transient) -> tuple[StopContact, ...]:
    """Return the contacts with both stops in the order in which they begin."""
    plate, angle = found.mechanism.plate, found.swash_angle
    impacts = np.concatenate([[0.0], np.abs(found.impulses)])
    touches = (found.rows[:, kernel.MOMENT_STOP] != 0.0) | (impacts > 0.0)
    lower = np.abs(angle - plate.angle_min) < np.abs(angle - plate.angle_max)
    turn = TURN / found.case.point.shaft_speed
    contacts = []
    for name, stop, side in (("lower", plate.angle_min, lower), ("upper", plate.angle_max, ~lower)):
        touched = np.flatnonzero(touches & side)
        parted = np.flatnonzero(np.diff(found.time[touched]) > turn) + 1
        for own in np.split(touched, parted) if touched.size else ():
            contacts.append(_contact(found, name, stop, own, impacts, turn))
    return tuple(sorted(contacts, key=lambda one: one.begin))


def _contact(
    found: Transient, name: str, stop: float, own: np.ndarray, impacts: np.ndarray, turn: float
) -> StopContact:
    """Return the contact that touches at the instants `own`."""
    first, last = int(own[0]), int(own[-1])
    begin, end = float(found.time[first]), float(found.time[last])
    during = slice(first, last + 1)
    near_end = float(found.time[-1]) - turn
    return StopContact(
        stop=name,
        begin=begin,
        end=end,
        from_start=first == 0,
        to_end=end > near_end,
        share=own.size / (last + 1 - first),
        turns=(end - begin) / turn,
        lifts=int(np.count_nonzero(np.diff(own) > 1)),
        lift=float(np.abs(found.swash_angle[during] - stop).max()),
        impact=float(impacts[during].max()),
    )


def contact_words(contacts: list[Mapping[str, Any]]) -> Iterator[str]:
    """Yield a sentence on each contact of a summary."""
    for one in contacts:
        stop, begin, end = f"the {one['stop']} stop", _ms(one["from_s"]), _ms(one["to_s"])
        bounces = one["lifts"] and one["share"] < LYING
        does = "bounces on" if bounces else "lies against"
        if one["from_start"]:
            told = f"The plate {does} {stop} {'the whole time' if one['to_end'] else f'until {end}'}"
        elif one["to_end"]:
            told = f"It meets {stop} at {begin} and {'bounces on it from then on' if bounces else 'stays there'}"
        elif one["to_s"] > one["from_s"]:
            told = f"It {does} {stop} from {begin} to {end}"
        else:
            told = f"It strikes {stop} at {begin}"
        yield f"{told}, {_touch(one)} that time, and lifts {_lifts(one)}." if bounces else f"{told}{_but_lifts(one)}."


def contact_rows(contacts: list[Mapping[str, Any]]) -> Iterator[tuple[str, str]]:
    """Yield (name, time, share and impact) of each contact of a summary."""
    if not contacts:
        yield "contact with a stop", "none"
    for one in contacts:
        impact = f"impact up to {one['impact_max_Nms']:.2g} N m s" if one["impact_max_Nms"] else "no impact"
        begin, end = _ms(one["from_s"]), _ms(one["to_s"])
        share = f", {_touch(one)} this time" if one["share"] < 1.0 else ""
        when = f"at {begin}" if begin == end else f"{begin} to {end}{share}{_but_lifts(one)}"
        yield f"contact with the {one['stop']} stop", f"{when}; {impact}"


def contact_summary(one: StopContact) -> dict[str, Any]:
    """Return a contact for the summary, SI with units in keys."""
    return {
        "stop": one.stop,
        "from_s": one.begin,
        "to_s": one.end,
        "from_start": one.from_start,
        "to_end": one.to_end,
        "share": one.share,
        "turns": one.turns,
        "lifts": one.lifts,
        "lift_max_rad": one.lift,
        "impact_max_Nms": one.impact,
    }


def _ms(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms"


def _touch(one: Mapping[str, Any]) -> str:
    return f"in touch {100.0 * one['share']:.0f} % of"


def _but_lifts(one: Mapping[str, Any]) -> str:
    return f", but lifts {_lifts(one)}" if one["lifts"] else ""


def _lifts(one: Mapping[str, Any]) -> str:
    """Return number and height of the plate's lift-offs from the stop meanwhile."""
    count, turns = one["lifts"], one["turns"]
    often = "once" if count == 1 else f"{count / turns:.0f} times a turn" if turns >= 2.0 else f"{count} times"
    return f"{often} by up to {np.degrees(one['lift_max_rad']):.2g} deg"
