"""Checks of the valve plate's ports: do kidneys and relief grooves open and shut one after the other?"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import wraps
from itertools import pairwise
from operator import itemgetter

from system.description.ports import PortsSection
from system.description.pump import PumpDescription
from system.inputs.faults import Fault
from system.inputs.sections.reader import with_values
from system.inputs.units import Dimension, format_quantity
from system.pump.ports.described import groove_faults, throats
from system.pump.ports.flow_coefficients import MOST_OPENINGS
from system.pump.ports.webs import MOST_WEBS
from system.pump_file.check import CheckWarning, Finding, angle, needs

PORT_TOLERANCE = math.radians(1.0)
_KIDNEY_ANGLES = ("groove_end", "kidney_full_start", "kidney_full_end", "kidney_end")
_KIDNEY = tuple(f"ports.{name}" for name in _KIDNEY_ANGLES)


def of_sides(findings: Callable[[PumpDescription], Iterator[Finding]]) -> Callable[..., Iterator[Finding]]:
    """The findings of a port, of suction and delivery side where these differ; each at its own keys."""

    @wraps(findings)
    def of_both(pump: PumpDescription) -> Iterator[Finding]:
        suction, delivery = (with_values(pump, ports=side) for side in pump.ports.sides)
        found = list(findings(suction))
        yield from found
        if pump.ports.delivery is not None:
            yield from (_at_delivery(pump, finding) for finding in findings(delivery) if finding not in found)

    return of_both


def _at_delivery(pump: PumpDescription, finding: Finding) -> Finding:
    """A finding of the delivery side at the path of the table that gives its value."""
    return replace(finding, path=_path_of("delivery", finding.path, pump))


def _path_of(side: str, path: str, pump: PumpDescription) -> str:
    """Path of a side's value: in [ports.delivery] for the delivery side if that states it, else in [ports]."""
    key = path.removeprefix("ports.").partition(".")[0]
    if side != "delivery" or getattr(pump.ports.delivery, key, None) in (None, ()):
        return path
    return path.replace("ports.", "ports.delivery.", 1)


@needs("ports.coefficient_file")
@of_sides
def coefficients_are_of_few_openings(pump: PumpDescription) -> Iterator[Finding]:
    """A file of a port has no more openings than the chamber's table of it."""
    table = pump.ports.coefficient_file
    if table is not None and table.opening.size > MOST_OPENINGS:
        yield Fault("ports.coefficient_file", f"{table.opening.size} openings", f"at most {MOST_OPENINGS}")


@needs("ports.delivery.coefficient_file")
def delivery_coefficients_are_beside_those_of_ports(pump: PumpDescription) -> Iterator[Finding]:
    """A file of the delivery port's own needs one of [ports]."""
    delivery = pump.ports.delivery
    if delivery is not None and delivery.coefficient_file is not None and pump.ports.coefficient_file is None:
        key = "ports.delivery.coefficient_file"
        yield Fault(key, "without ports.coefficient_file", "one of [ports] too, or of [ports] alone")


def _angles(ports: PortsSection) -> dict[str, float]:
    """Angles of a port that grow, by key."""
    start = {} if ports.groove_start is None else {"groove_start": ports.groove_start}
    return start | {name: getattr(ports, name) for name in _KIDNEY_ANGLES}


def _last(ports: PortsSection) -> tuple[str, float]:
    """Key and angle at which a port shuts."""
    ends = {f"grooves.{n}.end": groove.end for n, groove in enumerate(ports.grooves, start=1)}
    return max(({"kidney_end": ports.kidney_end} | ends).items(), key=itemgetter(1))


def _first(ports: PortsSection) -> tuple[str, float]:
    """Key and angle at which a port begins to open."""
    starts = {f"grooves.{n}.start": groove.start for n, groove in enumerate(ports.grooves, start=1)}
    return min((_angles(ports) | starts).items(), key=itemgetter(1))


@needs(*_KIDNEY)
@of_sides
def ports_open_in_order(pump: PumpDescription) -> Iterator[Finding]:
    """The angles of a port grow."""
    angles = _angles(pump.ports)
    for before, after in pairwise(angles):
        if angles[before] >= angles[after]:
            yield Fault(f"ports.{after}", angle(angles[after]), f"more than {before}, {angle(angles[before])}")


@needs(*_KIDNEY)
def ports_shut_before_the_other_opens(pump: PumpDescription) -> Iterator[Finding]:
    """Each port is shut before the other, half a turn later, opens."""
    names, sides = ("suction", "delivery"), pump.ports.sides
    reported = set()
    for k, side in enumerate(sides):
        other = sides[1 - k]
        last, first = _last(side), _first(other)
        shut, opens = last[1], math.pi + first[1]
        if shut >= opens and (last, first) not in reported:
            reported.add((last, first))
            shuts_at = _path_of(names[k], f"ports.{last[0]}", pump)
            opens_at = _path_of(names[1 - k], f"ports.{first[0]}", pump)
            yield Fault(
                shuts_at,
                f"{angle(shut)}: {names[k]} is still open when {names[1 - k]} opens",
                f"less than {angle(opens)} (180 deg + {opens_at}), else the ports are short-circuited",
                f"a smaller {shuts_at} or a larger {opens_at}",
            )


@needs("valve_plate.kidney_arc", *_KIDNEY)
@of_sides
def ports_belong_to_the_kidney(pump: PumpDescription) -> Iterator[Finding]:
    """A kidney opens and shuts over its own arc, with an open port between."""
    arc, ports = pump.valve_plate.kidney_arc, pump.ports
    if ports.kidney_end - ports.groove_end <= arc:
        yield Fault(
            "ports.kidney_end",
            f"{angle(ports.kidney_end)} for a kidney of {angle(arc)} that opens at {angle(ports.groove_end)}",
            f"more than {angle(ports.groove_end + arc)} (groove_end + kidney_arc), so that a port is left",
        )
        return
    for key, follows in (("kidney_full_start", ports.groove_end + arc), ("kidney_full_end", ports.kidney_end - arc)):
        stated = getattr(ports, key)
        if abs(stated - follows) > PORT_TOLERANCE:
            yield CheckWarning(
                f"ports.{key}",
                f"{angle(stated)}, where the kidney's arc of {angle(arc)} gives {angle(follows)}",
                f"{angle(PORT_TOLERANCE)} apart (the film's ports follow groove_end and kidney_end)",
                f"{key} = '{angle(follows)}', or another kidney_arc",
            )


@needs(*_KIDNEY)
@of_sides
def grooves_fit_the_port(pump: PumpDescription) -> Iterator[Finding]:
    """Grooves have the keys of their shapes and lie ahead of the kidney or behind it."""
    yield from groove_faults(pump.ports)


@needs("ports.kidney_area", "valve_plate.kidney_pitch_radius", *_KIDNEY)
@of_sides
def grooves_are_smaller_than_the_kidney(pump: PumpDescription) -> Iterator[Finding]:
    """The relief grooves on either side open less than the kidney does."""
    ports = pump.ports
    if any(groove_faults(ports)) or ports.groove_start == ports.groove_end:  # `ports_open_in_order` reports the latter
        return
    largest, kidney = max(throats(ports, pump.valve_plate.kidney_pitch_radius)), ports.kidney_area
    if largest >= kidney:
        yield Fault(
            "ports.grooves" if ports.grooves else "ports.groove_area",
            format_quantity(largest, Dimension.AREA, digits=4),
            f"less than kidney_area, {format_quantity(kidney, Dimension.AREA, digits=4)}",
        )


@needs("ports.webs", "valve_plate.kidney_arc", "ports.groove_end", "ports.kidney_end")
@of_sides
def webs_part_the_port(pump: PumpDescription) -> Iterator[Finding]:
    """Webs lie inside the port with kidneys between them, each narrower than the kidney of the block."""
    arc, spans = pump.valve_plate.kidney_arc, pump.ports.web_spans
    last, end = pump.ports.groove_end + 0.5 * arc, pump.ports.kidney_end - 0.5 * arc
    if len(spans) > MOST_WEBS:
        yield Fault("ports.webs", f"{len(spans)} webs", f"at most {MOST_WEBS} a port")
    for number, (start, stop) in enumerate(spans, start=1):
        if not 0.0 < stop - start < arc:
            found = f"web {number}, {angle(stop - start)} wide"
            yield Fault("ports.webs", found, f"more than 0 and less than kidney_arc, {angle(arc)}")
        elif start <= last or stop >= end:
            found = f"web {number} from {angle(start)} to {angle(stop)}"
            within = f"within {angle(last)} to {angle(end)}, in growing order, with port on both sides"
            yield Fault("ports.webs", found, within)
        last = max(last, stop)
