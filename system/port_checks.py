"""Checks of the valve plate's ports: do kidneys and relief grooves open and shut one after the other?"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from system.checks import CheckWarning, Finding, angle, needs
from system.description import PumpDescription
from system.faults import Fault
from system.port_description import groove_faults, throats
from system.port_webs import MOST_WEBS
from system.units import Dimension, format_quantity

PORT_TOLERANCE = math.radians(1.0)
_KIDNEY_ANGLES = ("groove_end", "kidney_full_start", "kidney_full_end", "kidney_end")
_KIDNEY = tuple(f"ports.{name}" for name in _KIDNEY_ANGLES)


@needs(*_KIDNEY)
def ports_open_in_order(pump: PumpDescription) -> Iterator[Finding]:
    """The angles of a port grow, and it is shut before the other port, half a turn later, opens."""
    ports = pump.ports
    angles = {} if ports.groove_start is None else {"groove_start": ports.groove_start}
    angles |= {name: getattr(ports, name) for name in _KIDNEY_ANGLES}
    for before, after in pairwise(angles):
        if angles[before] >= angles[after]:
            yield Fault(f"ports.{after}", angle(angles[after]), f"more than {before}, {angle(angles[before])}")
    listed = list(enumerate(ports.grooves, start=1))
    ends = {"kidney_end": ports.kidney_end} | {f"grooves.{n}.end": groove.end for n, groove in listed}
    starts = angles | {f"grooves.{n}.start": groove.start for n, groove in listed}
    last, first = max(ends, key=ends.__getitem__), min(starts, key=starts.__getitem__)
    shut, opens = ends[last], math.pi + starts[first]
    if shut >= opens:
        yield Fault(
            f"ports.{last}",
            f"{angle(shut)}: suction is still open when delivery opens",
            f"less than {angle(opens)} (180 deg + {first}), else the ports are short-circuited",
            f"a smaller {last} or a larger {first}",
        )


@needs("valve_plate.kidney_arc", *_KIDNEY)
def ports_belong_to_the_kidney(pump: PumpDescription) -> Iterator[Finding]:
    """A kidney opens and shuts over its own arc, and that leaves a port between."""
    arc, ports = pump.valve_plate.kidney_arc, pump.ports
    if ports.kidney_end - ports.groove_end <= arc:
        yield Fault(
            "ports.kidney_end",
            f"{angle(ports.kidney_end)} for a kidney of {angle(arc)} that opens at {angle(ports.groove_end)}",
            f"more than {angle(ports.groove_end + arc)} (groove_end + kidney_arc), so that a port is left",
        )
        return
    for key, follows in (
        ("kidney_full_start", ports.groove_end + arc),
        ("kidney_full_end", ports.kidney_end - arc),
    ):
        stated = getattr(ports, key)
        if abs(stated - follows) > PORT_TOLERANCE:
            yield CheckWarning(
                f"ports.{key}",
                f"{angle(stated)}, where the kidney's arc of {angle(arc)} gives {angle(follows)}",
                f"{angle(PORT_TOLERANCE)} apart (the film's ports follow groove_end and kidney_end)",
                f"{key} = '{angle(follows)}', or another kidney_arc",
            )


@needs(*_KIDNEY)
def grooves_fit_the_port(pump: PumpDescription) -> Iterator[Finding]:
    """Grooves have the keys of their shapes and lie ahead of the kidney or behind it."""
    yield from groove_faults(pump.ports)


@needs("ports.kidney_area", "valve_plate.kidney_pitch_radius", *_KIDNEY)
def grooves_are_smaller_than_the_kidney(pump: PumpDescription) -> Iterator[Finding]:
    """The relief grooves on either side open less than the kidney does."""
    ports = pump.ports
    if any(groove_faults(ports)):
        return
    largest, kidney = max(throats(ports, pump.valve_plate.kidney_pitch_radius)), ports.kidney_area
    if largest >= kidney:
        yield Fault(
            "ports.grooves" if ports.grooves else "ports.groove_area",
            format_quantity(largest, Dimension.AREA, digits=4),
            f"less than kidney_area, {format_quantity(kidney, Dimension.AREA, digits=4)}",
        )


@needs("ports.webs", "valve_plate.kidney_arc", "ports.groove_end", "ports.kidney_end")
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


PORT_CHECKS = (
    ports_open_in_order,
    ports_belong_to_the_kidney,
    grooves_fit_the_port,
    grooves_are_smaller_than_the_kidney,
    webs_part_the_port,
)
