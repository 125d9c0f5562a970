"""The lands of a pump with losses of edges and feeding bores by files: [slipper] and [valve_plate] .._file.

Pockets, kidneys, grooves and the case are deep beside films: of steps the deepest of the file are used, of grooves
those of the deepest film ratio, at their own width. The thickness of films is film_thickness.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from gaps.shapes.orifice_table import OrificeTable
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription, SlipperSection
from system.inputs.coefficients.edge_losses import Edge, Excess, LandPath, LossCourse, secant_conductance
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.inputs.coefficients.loss_files import LossFactors
from system.inputs.units import TURN
from system.pump.chamber.problem import LeakTable
from system.pump.ports.flow_coefficients import log_reynolds_over

NODES = 200
"""Of a bore's table, over the range of its file."""


@dataclass(frozen=True)
class LandLosses:
    """The paths of slipper and valve plate, inner and outer land; the slipper's bore, None: by its sizes."""

    slipper: LandPath
    inner: LandPath
    outer: LandPath
    bore: OrificeTable | None

    @property
    def any(self) -> bool:
        """True if a file gives any loss."""
        return bool(self.slipper.edges or self.inner.edges or self.bore)


def land_losses(pump: PumpDescription) -> LandLosses:
    """Losses of a pump's lands by the tables of its files."""
    plate, pitch = pump.valve_plate, TURN / pump.pump.pistons
    inner = outer = LandPath(pitch, plate.film_thickness)
    if plate.kidney_file is not None:
        steps = plate.kidney_file
        r1, r2, r3, r4 = _plate_radii(pump)
        inner = LandPath(pitch, plate.film_thickness, _edges_of((r2, r1), steps), ((r2, r1),))
        outer = LandPath(pitch, plate.film_thickness, _edges_of((r3, r4), steps), ((r3, r4),))
    return LandLosses(slipper_path(pump.slipper), inner, outer, bore_table(pump.slipper))


def _plate_radii(pump: PumpDescription) -> tuple[float, ...]:
    """Radii in m of the valve plate's lands, (4,), along its face."""
    plate = pump.valve_plate
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    return tuple(float(radius * plate.sphere.stretch(radius)) for radius in radii)


def creeping_film_leaks(pump: PumpDescription, leaks: LeakTable, viscosity: float) -> LeakTable:
    """Leaks of solved films with edges in creeping flow, in series with lands; the drag flow is unchanged."""
    losses, shares = land_losses(pump), _plate_shares(pump)
    piston, slipper, plate = leaks.conductance
    slipper = slipper / (1.0 + slipper * losses.slipper.resistance(viscosity))
    parts = (
        share * plate / (1.0 + share * plate * path.resistance(viscosity))
        for share, path in zip(shares, (losses.inner, losses.outer), strict=True)
    )
    return LeakTable(np.stack([piston, slipper, sum(parts)]), leaks.drag_flow)


def with_inertia(pump: PumpDescription, leaks: LeakTable, drop: Array, viscosity: float, *, bore: bool) -> LeakTable:
    """Leaks of creeping flow with the losses by inertia at pressures over the case's, drop (N,) in Pa.

    Conductances are those of chords: flow over pressure. `bore`: of the slipper's bore too, where the leaks do not
    include it from a film fed through it. Raises InputError as `secant_conductance`.
    """
    losses, density = land_losses(pump), pump.oil.density

    def through_bore(flow: Array) -> Array:
        if losses.bore is None or not bore:
            return np.zeros_like(flow)
        size = pump.slipper.orifice_diameter
        laminar = flow / losses.bore.conductance(size, viscosity)
        return losses.bore.drop(flow, size, viscosity, density) - laminar

    def by(path: LandPath) -> Excess:
        return lambda flow: path.inertia(flow, density, viscosity / density)

    piston, slipper, plate = leaks.conductance
    inner, outer = (share * plate for share in _plate_shares(pump))
    of_lands = by(losses.slipper)
    slipper = secant_conductance(slipper, lambda flow: of_lands(flow) + through_bore(flow), drop, "slipper.pocket_file")
    inner, outer = (
        secant_conductance(one, by(path), drop, "valve_plate.kidney_file")
        for one, path in ((inner, losses.inner), (outer, losses.outer))
    )
    return LeakTable(np.stack([piston, slipper, inner + outer]), leaks.drag_flow)


def _plate_shares(pump: PumpDescription) -> tuple[float, float]:
    """Shares of the valve plate's inner and outer land in its leakage, by the parallel film's logarithms."""
    (r1, r2, r3, r4), losses = _plate_radii(pump), land_losses(pump)
    inner = 1.0 / (np.log(r2 / r1) + losses.inner.extra_log)
    outer = 1.0 / (np.log(r4 / r3) + losses.outer.extra_log)
    return float(inner / (inner + outer)), float(outer / (inner + outer))


def bore_table(slipper: SlipperSection) -> OrificeTable | None:
    """The slipper's bore by its file at its own opening; None without a file."""
    if slipper.orifice_file is None:
        return None
    return orifice_table(slipper.orifice_file, 0.25 * np.pi * slipper.orifice_diameter**2)


@lru_cache(maxsize=32)
def orifice_table(coefficients: FlowCoefficients, opening: float) -> OrificeTable:
    """The flow of a bore of given opening (m2): a monotone cubic along the rows, linear in ln of the opening."""
    numbers = np.log(coefficients.flow_number)
    grid = np.linspace(numbers.min(), numbers.max(), NODES)
    rows = [
        log_reynolds_over(number, np.log(reynolds), grid)[0]
        for number, reynolds in zip(numbers, coefficients.reynolds, strict=True)
    ]
    areas = np.log(coefficients.opening)
    course = [np.interp(np.log(opening), areas, column) for column in np.array(rows).T]
    return OrificeTable(tuple(map(float, grid)), tuple(map(float, course)))


def slipper_way(slipper: SlipperSection) -> tuple[float, float]:
    """From a slipper's chamber to the case in creeping flow: ln(r_out/r_in) of its lands with that of their edges, and
    the length (m) of its bore, of one by a file that of the capillary with as much laminar resistance.
    """
    bore = bore_table(slipper)
    length = slipper.orifice_length if bore is None else bore.equal_length(slipper.orifice_diameter)
    return slipper.lands.log_ratio + slipper_path(slipper).extra_log, length


def slipper_path(slipper: SlipperSection) -> LandPath:
    """From a slipper's pocket across its sealing lands to the case."""
    if slipper.pocket_file is None and slipper.groove_file is None:
        return LandPath(TURN, slipper.film_thickness)
    lands = slipper.lands.sealing
    steps = slipper.pocket_file
    edges: list[Edge] = []
    for land in lands:
        edges += [] if steps is None else _edges_of(land, steps)
    if slipper.groove_file is not None:
        losses, film = slipper.groove_file, slipper.film_thickness
        grooves = [(one[1], two[0]) for one, two in pairwise(lands)]
        own = [_groove(losses, groove, film) for groove in grooves]
        edges = [*edges[:1], *own, *edges[-1:]]
        lands = ((lands[0][0], lands[-1][1]),)
    return LandPath(TURN, slipper.film_thickness, tuple(edges), () if steps is None else lands)


def deepest(losses: LossFactors) -> tuple[int, int]:
    """Rows of the deepest step into a thin film and of that out of it."""
    return 0, len(losses.sizes) - 1


def _edges_of(land: tuple[float, float], steps: LossFactors) -> tuple[Edge, Edge]:
    """The edge at which the flow enters a land, and that at which it leaves it."""
    inward, outward = (LossCourse(steps.reynolds, steps.loss_factor[row]) for row in deepest(steps))
    into, out_of = (float(steps.extra_length[row]) for row in deepest(steps))
    return Edge(land[0], into, inward, outward), Edge(land[1], out_of, outward, inward)


def _groove(losses: LossFactors, groove: tuple[float, float], film: float) -> Edge:
    """A groove between two radii (m): its file's deepest, at its width in films, straight in its logarithm.

    The film equation's own length of the groove, width/film_ratio^3, is in it: lands end at grooves.
    """
    ratio, width = losses.sizes.T
    rows = np.flatnonzero(ratio == ratio.max())
    own = losses.extra_length[rows] + width[rows] / ratio[rows] ** 3
    place, places = np.log((groove[1] - groove[0]) / film), np.log(width[rows])
    course = [float(np.interp(place, places, column)) for column in losses.loss_factor[rows].T]
    losing = LossCourse(losses.reynolds, np.array(course))
    return Edge(0.5 * sum(groove), float(np.interp(place, places, own)), losing, losing)
