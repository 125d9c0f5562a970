"""Checks of the files of losses of lands and bores: are they valid for this pump?"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from system.description.pump import PumpDescription, SlipperSection
from system.inputs.coefficients.loss_files import LossFactors
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity
from system.pump_file.check import CheckWarning, Finding, needs

DEEP = 10.0
"""Thickness over the film's from which a step or groove is deep: more changes its losses by some percent."""
WIDE = 10.0
"""Width over the film from which a groove is two separate edges: beyond such a last row of a file there is no doubt."""
NO_GROOVES = "grooves in the land, [slipper] grooves, that lie ahead of any vented one"


_LANDS = ("slipper.land_inner_radius", "slipper.land_outer_radius")


@needs("slipper.pocket_file")
def pocket_losses_are_of_steps(pump: PumpDescription) -> Iterator[Finding]:
    """The file of the slipper's edges has deep steps."""
    if pump.slipper.pocket_file is not None:
        yield from _shallow("slipper.pocket_file", pump.slipper.pocket_file)


@needs("valve_plate.kidney_file")
def kidney_losses_are_of_steps(pump: PumpDescription) -> Iterator[Finding]:
    """The file of the valve plate's edges has deep steps."""
    if pump.valve_plate.kidney_file is not None:
        yield from _shallow("valve_plate.kidney_file", pump.valve_plate.kidney_file)


@needs("slipper.groove_file", "slipper.film_thickness", *_LANDS)
def groove_losses_are_of_grooves(pump: PumpDescription) -> Iterator[Finding]:
    """The file of the slipper's grooves has deep grooves of their width; and the slipper has grooves."""
    part = pump.slipper
    if part.groove_file is None:
        return
    widths = groove_widths(part)
    if not widths:
        yield Fault("slipper.groove_file", "a slipper without closed grooves", NO_GROOVES)
    yield from _unlike("slipper.groove_file", part.groove_file, [width / part.film_thickness for width in widths])


@needs("slipper.orifice_file", "slipper.orifice_diameter")
def bore_coefficients_are_a_table(pump: PumpDescription) -> Iterator[Finding]:
    """The file of the slipper's bore is valid at its opening, and replaces a coefficient."""
    part, key = pump.slipper, "slipper.orifice_file"
    if part.orifice_file is None:
        return
    if part.orifice_flow_coefficient is not None:
        yield Fault(key, "orifice_flow_coefficient beside it", "one of the two")
    openings, own = part.orifice_file.opening, 0.25 * math.pi * part.orifice_diameter**2
    if len(openings) > 1 and not 0.999 * openings[0] <= own <= 1.001 * openings[-1]:
        ends = " to ".join(_area(size) for size in openings[[0, -1]])
        yield CheckWarning(key, f"a bore of {_area(own)}", ends, "its edge is taken; give rows for this opening")


def groove_widths(slipper: SlipperSection) -> tuple[float, ...]:
    """Widths in m of the closed grooves between the sealing lands."""
    return tuple(two[0] - one[1] for one, two in pairwise(slipper.lands.sealing))


def _shallow(key: str, found: LossFactors) -> Iterator[Finding]:
    """A warning where the deepest steps are not deep."""
    least, most = (float(found.sizes[row, 0]) for row in (0, -1))
    if least > 1.0 / DEEP or most < DEEP:
        sizes = f"steps of film_ratio {least:g} and {most:g} at most"
        remedy = "taken for pocket, kidney and case; give rows of deeper steps"
        yield CheckWarning(key, sizes, f"{1.0 / DEEP:g} and {DEEP:g}", remedy)


def _unlike(key: str, found: LossFactors, widths: Sequence[float]) -> Iterator[Finding]:
    """A warning where the deepest grooves are not deep, and where the pump's (widths / film) differ."""
    ratio, width = found.sizes.T
    if ratio.max() < DEEP:
        sizes = f"grooves of film_ratio {ratio.max():g} at most"
        yield CheckWarning(key, sizes, f"{DEEP:g}", "taken for the slipper's; give rows of deeper grooves")
    ends = width[ratio == ratio.max()]
    for own in widths:
        if own < ends.min() or own > ends.max() < WIDE:
            limit = f"width_ratio {ends.min():g} to {ends.max():g}"
            remedy = "the nearest is taken; give rows for it"
            yield CheckWarning(key, f"a groove {own:.3g} films wide", limit, remedy)


def _area(size: float) -> str:
    return format_quantity(size, Dimension.AREA, digits=4)
