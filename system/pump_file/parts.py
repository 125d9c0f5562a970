"""Checks of the parts' own shapes and holds, where a pump file states them, and of single parts."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import TypeVar

from system.description.lines import LineKind, line_faults
from system.description.parts import ReliefSection, RetainerKind
from system.description.pump import SINGLE_PARTS, PumpDescription
from system.inputs.faults import Fault
from system.pump.lumped import block_spring
from system.pump_file.check import Check, CheckReport, CheckWarning, Finding, angle, length, needs, run_checks

_Found = TypeVar("_Found", Fault, CheckWarning)

Rows = tuple[tuple[float, ...], ...]
STEEPEST = 0.01  # depth of a shape over its width; above it the film is no thin film
DEEPEST = 100e-6  # m, of wear; more than any film that bears a load

_BORE = ("piston.engaged_length", "pump.dead_volume", "pump.piston_diameter")


def _bore_depth(pump: PumpDescription) -> float:
    """Depth of a bore from its case edge (m), the dead volume modelled as its straight prolongation."""
    area = math.pi * pump.pump.piston_diameter**2 / 4
    return pump.piston.engaged_length + pump.pump.dead_volume / area


@needs("piston.guide_length", *_BORE)
def guide_lies_in_the_bore(pump: PumpDescription) -> Iterator[Finding]:
    """The guiding land is no longer than the bore; one shorter than a piston diameter lets the piston tilt."""
    guide, depth = pump.piston.guide_length, _bore_depth(pump)
    if guide is None:
        return
    if guide > depth:
        yield Fault(
            "piston.guide_length",
            length(guide),
            f"at most {length(depth)}, the bore's depth (engaged_length, and dead_volume over the piston's area)",
        )
    elif guide < pump.pump.piston_diameter:
        yield CheckWarning(
            "piston.guide_length",
            length(guide),
            f"one piston diameter, {length(pump.pump.piston_diameter)} (side forces grow with the lever)",
            "lengthen the guide",
        )


@needs("piston.centre_of_mass", "piston.overhang", "piston.engaged_length")
def centre_of_mass_lies_in_the_piston(pump: PumpDescription) -> Iterator[Finding]:
    """The piston's centre of mass is not beyond its inner end."""
    place, whole = pump.piston.centre_of_mass, pump.piston.overhang + pump.piston.engaged_length
    if place is not None and place > whole:
        yield Fault("piston.centre_of_mass", length(place), f"at most {length(whole)}, the piston's inner end")


@needs("piston.profile", "piston.radial_clearance", "piston.engaged_length")
def piston_profile_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The piston's measured shape reaches all along its engaged part, and leaves a clearance everywhere."""
    rows = pump.piston.profile or ()
    yield from _places("piston.profile", rows, 0.0, pump.piston.engaged_length)
    yield from _leaves_clearance("piston.profile", rows, pump.piston.radial_clearance)


@needs("bore.profile", "piston.radial_clearance", "piston.engaged_length")
def bore_profile_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The bore's measured shape reaches all along the guide, and leaves a clearance everywhere."""
    rows, part = pump.bore.profile or (), pump.piston
    yield from _places("bore.profile", rows, 0.0, part.guide_length or part.engaged_length)
    yield from _leaves_clearance("bore.profile", rows, pump.piston.radial_clearance)


@needs("slipper.profile", "slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_profile_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The face's measured shape reaches all over the sealing land."""
    rows, part = pump.slipper.profile or (), pump.slipper
    yield from _places("slipper.profile", rows, part.land_inner_radius, part.land_outer_radius)


@needs("valve_plate.profile", "valve_plate.land_radius_1", "valve_plate.land_radius_4")
def valve_plate_profile_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The plate's measured shape reaches all over both sealing lands, and its pads."""
    rows, part = pump.valve_plate.profile or (), pump.valve_plate
    yield from _places("valve_plate.profile", rows, part.land_radius_1, part.outer_radius)


@needs("block.profile", "valve_plate.land_radius_1", "valve_plate.land_radius_4")
def block_profile_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The block face's measured shape reaches as far, and is the same all around."""
    rows, part = pump.block.profile or (), pump.valve_plate
    yield from _places("block.profile", rows, part.land_radius_1, part.outer_radius)
    if rows and len(rows[0]) == 3:
        expected = "rows of radius, material taken off: a face that turns has the same shape all around in the film"
        yield Fault("block.profile", "rows with angles", expected)


def _places(path: str, rows: Rows, start: float, end: float) -> Iterator[Finding]:
    """Places of a profile grow, and reach from `start` to `end`: nothing is extrapolated.

    Of a profile with angles each place has each angle once, within less than a turn. Depths are those of a film.
    """
    places = [row[0] for row in rows]
    if rows and len(rows[0]) == 3:
        yield from _net(path, rows)
    else:
        for row, (before, after) in enumerate(pairwise(places), start=2):
            if before >= after:
                found = f"{length(after)} after {length(before)} in row {row}"
                yield Fault(path, found, "places that grow from row to row")
    if places and (min(places) > start or max(places) < end):
        found = f"places from {length(min(places))} to {length(max(places))}"
        yield Fault(path, found, f"places from {length(start)} or less to {length(end)} or more")
    within = [row for row in rows if start <= row[0] <= end]
    deepest = max(within, key=lambda row: abs(row[-1]), default=(0.0, 0.0))
    if abs(deepest[-1]) > DEEPEST:
        found, limit = f"{length(deepest[-1])} taken off at {length(deepest[0])}", f"{length(DEEPEST)} of wear"
        yield CheckWarning(path, found, limit, "check the unit: um, not mm? A groove belongs into its own key")


@needs("piston.grooves", "piston.engaged_length")
def piston_grooves_lie_apart(pump: PumpDescription) -> Iterator[Finding]:
    """Ring grooves lie on the piston in order, with land between them."""
    grooves = pump.piston.grooves or ()
    for middle, width, depth in grooves:
        if width <= 0.0 or depth <= 0.0:
            yield Fault("piston.grooves", f"{length(width)} wide, {length(depth)} deep", "both more than 0")
        elif middle - width / 2 <= 0.0 or middle + width / 2 >= pump.piston.engaged_length:
            found = f"a groove {length(width)} wide at {length(middle)}"
            yield Fault("piston.grooves", found, f"between 0 and engaged_length, {length(pump.piston.engaged_length)}")
    for (first, wide, _), (second, wider, _) in pairwise(grooves):
        if second - first <= (wide + wider) / 2:
            found = f"grooves at {length(first)} and {length(second)}"
            yield Fault("piston.grooves", found, f"more than {length((wide + wider) / 2)} apart, in growing order")


def _net(path: str, rows: Rows) -> Iterator[Finding]:
    places, angles = sorted({row[0] for row in rows}), sorted({row[1] for row in rows})
    known = Counter(row[:2] for row in rows)
    for place, turned in ((place, turned) for place in places for turned in angles):
        if known[place, turned] != 1:
            found = f"{known[place, turned]} rows at {length(place)}, {angle(turned)}"
            yield Fault(path, found, "each place with each angle once")
            break
    if len(places) < 2 or len(angles) < 2:
        yield Fault(path, f"{len(places)} places, {len(angles)} angles", "two or more of both")
    elif angles[-1] - angles[0] >= 2.0 * math.pi:
        found = f"angles from {angle(angles[0])} to {angle(angles[-1])}"
        yield Fault(path, found, "less than a turn; the profile closes by itself")


def _leaves_clearance(path: str, rows: Rows, clearance: float) -> Iterator[Finding]:
    least = min((row[-1] for row in rows), default=0.0)
    if least <= -clearance:
        yield Fault(
            path,
            f"{length(least)} taken off: material that protrudes by more than the clearance",
            f"more than {length(-clearance)} (minus radial_clearance)",
        )


@needs("piston.edge_relief", "piston.engaged_length")
def piston_edge_leaves_a_land(pump: PumpDescription) -> Iterator[Finding]:
    """The relieved edge of the piston is shorter than half of its length in the bore."""
    relief = pump.piston.edge_relief
    yield from _relief("piston.edge_relief", relief, pump.piston.engaged_length / 2, "half of engaged_length")


@needs("bore.edge_relief", "piston.engaged_length")
def bore_edge_leaves_a_land(pump: PumpDescription) -> Iterator[Finding]:
    """The relieved edge of the bore is shorter than half of the guide."""
    guide = pump.piston.guide_length or pump.piston.engaged_length
    yield from _relief("bore.edge_relief", pump.bore.edge_relief, guide / 2, "half of the guide")


@needs("slipper.rim_relief", "slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_rim_lies_on_the_land(pump: PumpDescription) -> Iterator[Finding]:
    """The relieved rim is no wider than the sealing land."""
    land = pump.slipper.land_outer_radius - pump.slipper.land_inner_radius
    if land > 0.0:
        yield from _relief("slipper.rim_relief", pump.slipper.rim_relief, land, "the land's width")


@needs("piston.barrel", "piston.engaged_length")
def barrel_is_shallow(pump: PumpDescription) -> Iterator[Finding]:
    """The crown of a piston is small over its half length."""
    yield from _steep("piston.barrel", pump.piston.barrel, pump.piston.engaged_length / 2)


def _relief(path: str, relief: ReliefSection | None, widest: float, name: str) -> Iterator[Finding]:
    if relief is None:
        return
    if relief.width > widest * (1.0 + 1e-9):
        yield Fault(f"{path}.width", length(relief.width), f"at most {name}, {length(widest)}")
    yield from _steep(f"{path}.depth", relief.depth, relief.width)


@needs("slipper.crown", "slipper.land_outer_radius")
def crown_is_shallow(pump: PumpDescription) -> Iterator[Finding]:
    """A crowned or dished face differs little from a plane."""
    yield from _steep("slipper.crown", pump.slipper.crown, pump.slipper.land_outer_radius)


@needs("valve_plate.waviness", "valve_plate.land_radius_1")
def waves_are_shallow(pump: PumpDescription) -> Iterator[Finding]:
    """The valve plate's waves are long against their height."""
    waves = pump.valve_plate.waviness
    if waves is not None:
        half_wave = math.pi * pump.valve_plate.land_radius_1 / waves.waves
        yield from _steep("valve_plate.waviness.amplitude", waves.amplitude, half_wave)


@needs("valve_plate.sphere_radius", "valve_plate.land_radius_4")
def sphere_reaches_over_the_face(pump: PumpDescription) -> Iterator[Finding]:
    """A spherical face has its lands and pads before the equator; results that treat it as plane state so."""
    radius, path = pump.valve_plate.sphere_radius, "valve_plate.sphere_radius"
    if radius is None:
        return
    reach = pump.valve_plate.outer_radius
    if radius <= reach:
        yield Fault(path, length(radius), f"more than {length(reach)}, the outermost land or pad")
        return
    yield CheckWarning(
        path,
        f"a plate that bulges into a hollow block, {length(radius)}",
        "a plane one: so lumped laws take the shear of its lands",
        "films and floating for shear on the sphere; leakage is that of the sphere in every fidelity",
    )


@needs("retainer.kind", "ball_guide.spring_preload", "ball_guide.spring_stiffness", "ball_guide.spring_compression")
def a_spring_presses_the_retainer(pump: PumpDescription) -> Iterator[Finding]:
    """A retainer pressed by a spring has a spring."""
    part = pump.retainer
    if part.kind is RetainerKind.SPRING and not block_spring(pump) > 0.0:
        found = "'spring' with a ball guide whose spring does not press"
        yield Fault("retainer.kind", found, "a spring_preload above zero, or kind = 'clearance'")


def _steep(path: str, depth: float | None, width: float) -> Iterator[Finding]:
    if depth is not None and width > 0.0 and abs(depth) > STEEPEST * width:
        limit = f"{length(STEEPEST * width)} (1 % of {length(width)}: above it the film is no thin film)"
        yield CheckWarning(path, length(depth), limit, "check the unit: um, not mm?")


@needs()
def lines_have_the_keys_of_their_kinds(pump: PumpDescription) -> Iterator[Finding]:
    """Each kind of line has its own keys; a suction orifice has an area, or lies between two pressures."""
    yield from line_faults("delivery_line", pump.delivery_line)
    yield from line_faults("suction_line", pump.suction_line)
    suction = pump.suction_line
    if suction.kind is LineKind.ORIFICE and suction.orifice_area is None and suction.tank_pressure is None:
        expected = "the area, such as '200 mm2', or the tank_pressure with which inlet_pressure gives it"
        yield Fault("suction_line.orifice_area", "missing", expected)


@needs("swash_plate.angle_min", "pump.swash_angle_max")
def stops_are_apart(pump: PumpDescription) -> Iterator[Finding]:
    """The swash plate's lower stop is below the upper one, and no farther over centre than that."""
    low, high = pump.swash_plate.angle_min, pump.pump.swash_angle_max
    if low is not None and not -high <= low < high:
        yield Fault("swash_plate.angle_min", angle(low), f"{angle(-high)} to below {angle(high)}, swash_angle_max")


def single_parts_checked(checks: Iterable[Check], pump: PumpDescription, report: CheckReport) -> CheckReport:
    """Return the report of a pump with the findings of its single parts: the same checks, the part in all chambers.

    Paths name the single part: `piston.3.radial_clearance`.
    """
    faults, warnings = list(report.faults), list(report.warnings)
    for table in SINGLE_PARTS:
        concerned = [check for check in checks if any(path.startswith(f"{table}.") for path in check.needs)]
        for chamber, _ in getattr(pump, f"single_{table}s"):
            single = f"{table}.{chamber}"
            if not 1 <= chamber <= pump.pump.pistons:
                faults.append(Fault(single, f"chamber {chamber}", f"1 to {pump.pump.pistons}, the pump's pistons"))
                continue
            found = run_checks(concerned, pump.of_chamber(chamber))
            faults += [_renamed(f, table, single) for f in found.faults if f not in report.faults]
            warnings += [_renamed(w, table, single) for w in found.warnings if w not in report.warnings]
            warnings.append(_not_alike(single))
    return CheckReport(tuple(faults), tuple(warnings))


def _renamed(finding: _Found, table: str, single: str) -> _Found:
    return replace(finding, path=finding.path.replace(f"{table}.", f"{single}.", 1))


def _not_alike(single: str) -> CheckWarning:
    return CheckWarning(
        single,
        "a part unlike the others",
        "alike parts in the fidelity table, diagnose, calibrate and transient, which refuse this pump",
        "run the fidelity lumped, fixed or floating; or give every chamber that part to see what it does",
    )
