"""Checks of the meshes that users state for parts: that each is a body and fits its gap.

Each mesh is compared with the place of its film in the part's own axes: a cylinder about z, or rings in z = 0.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from gaps.walls.user_mesh import OwnMesh
from reynolds.bodies.chart import Chart, Cylinder, OnSphere, Side
from reynolds.bodies.space import BodySpace, Face, body_space
from reynolds.bodies.transfer import transfer
from reynolds.errors import InputError
from reynolds.fem.mesh import Cell, annulus, rectangle
from reynolds.fem.space import FilmSpace, film_space
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.numerics.arrays import Array
from system.description.parts import BodySection, MeshUnit
from system.description.pump import PumpDescription
from system.films.walls import by_names
from system.inputs.faults import Fault, nearest_choice
from system.pump_file.check import CheckWarning, Finding, length, needs

AROUND = 24  # cells of the film for the check of a mesh
ALIKE = 0.05  # of a face's size: two of one size
FEWEST_AROUND, FEWEST_ACROSS = 12, 2  # facets of a face that still bends as its body does


@dataclass(frozen=True)
class _Place:
    """Place of a part's film: chart, film over the whole turn, shape in words, width and circumference (m)."""

    chart: Chart
    film: FilmSpace
    shape: str
    width: float
    turn: float

    @property
    def points(self) -> Array:
        """Its corners in the part's axes, (n, 3) m."""
        return self.chart.places(self.film.vertices)


def _cylinder(diameter: float, reach: float, side: Side) -> _Place:
    radius, turn = 0.5 * diameter, math.pi * diameter
    film = film_space(rectangle((turn, reach), (AROUND, 8), cell=Cell.QUADRILATERAL, periodic_x=True))
    shape = f"radius {length(radius)} about z, z 0 to {length(reach)}, the body "
    shape += "within" if side is Side.SHAFT else "around it"
    return _Place(Cylinder(radius, side), film, shape, reach, turn)


def _ring(inner: float, outer: float, *, over: bool = False, sphere: Sphere = PLANE) -> _Place:
    shape = f"z = 0 from radius {length(inner)} to {length(outer)} about z, the body {'over' if over else 'under'} it"
    if not sphere.is_plane:
        shape = f"on a sphere of radius {length(sphere.radius)} that bulges out of the valve plate, " + shape
    inner, outer = (float(radius * sphere.stretch(radius)) for radius in (inner, outer))
    film = replace(film_space(annulus(inner, outer, (4, AROUND))), sphere=sphere)
    return _Place(OnSphere(sphere, over), film, shape, outer - inner, 2.0 * math.pi * outer)


@needs("piston.body", "pump.piston_diameter", "piston.engaged_length", "piston.overhang")
def piston_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The piston's own mesh has its face on the piston's cylinder, from the chamber's end to the ball."""
    part = pump.piston
    if part.body is not None:
        place = _cylinder(pump.pump.piston_diameter, part.engaged_length + part.overhang, Side.SHAFT)
        yield from _fits("piston.body", part.body, place, ("chamber",))


@needs("bore.body", "pump.piston_diameter", "piston.engaged_length")
def bore_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The bushing's own mesh has its face on the bore, from the guide's inner end to the case edge."""
    if pump.bore.body is not None:
        guide = pump.piston.guide_length or pump.piston.engaged_length
        yield from _fits("bore.body", pump.bore.body, _cylinder(pump.pump.piston_diameter, guide, Side.BORE), ())


@needs("slipper.body", "slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The slipper's own mesh has its face over the sealing lands."""
    part = pump.slipper
    if part.body is not None and part.land_inner_radius < part.land_outer_radius:
        place = _ring(part.land_inner_radius, part.land_outer_radius)
        yield from _fits("slipper.body", part.body, place, ("pocket", "held"))


@needs("swash_plate.body", "slipper.land_inner_radius", "slipper.land_outer_radius")
def swash_plate_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The swash plate's own mesh has its face under all of a slipper's lands."""
    part, body = pump.slipper, pump.swash_plate.body
    if body is not None and part.land_inner_radius < part.land_outer_radius:
        place = _ring(part.land_inner_radius, part.land_outer_radius, over=True)
        yield from _fits("swash_plate.body", body, place, ("pocket", "held"))


_PLATE = ("valve_plate.land_radius_1", "valve_plate.land_radius_4")


@needs("block.body", *_PLATE)
def block_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The block's own mesh has its face over the lands and pads of the valve plate."""
    yield from _plate_fits("block.body", pump, pump.block.body, over=True)


@needs("valve_plate.body", *_PLATE)
def valve_plate_mesh_fits(pump: PumpDescription) -> Iterator[Finding]:
    """The valve plate's own mesh has its face under the lands and pads."""
    yield from _plate_fits("valve_plate.body", pump, pump.valve_plate.body, over=False)


def _plate_fits(path: str, pump: PumpDescription, body: BodySection | None, *, over: bool) -> Iterator[Finding]:
    plate = pump.valve_plate
    if body is None or plate.land_radius_1 >= plate.outer_radius:
        return
    if plate.sphere.radius <= plate.outer_radius:
        return
    # Webs between kidneys pass over all of the face between the lands, and over its ports.
    place = _ring(plate.land_radius_1, plate.outer_radius, over=over, sphere=plate.sphere)
    yield from _fits(path, body, replace(place, shape=f"{place.shape}, kidneys and ports filled"), ("held",))


def _fits(path: str, body: BodySection, place: _Place, wanted: tuple[str, ...]) -> Iterator[Finding]:
    """All faults of a mesh at its place; `wanted`: faces without which a load or a support is missing."""
    own = by_names(body)
    names = own.body.face_names
    yield from _names(path, body, own, names)
    try:
        space = body_space(own.body)
    except InputError as reason:
        yield Fault(f"{path}.mesh", reason.found, reason.expected)
        return
    yield from _missing(path, own, wanted)
    if own.film in names:
        face = space.face(own.film)
        yield from _lies(path, body, space, face, place)


def _names(path: str, body: BodySection, own: OwnMesh, names: tuple[str, ...]) -> Iterator[Finding]:
    """Named faces that do not exist."""
    keys = [("film", own.film), *((key, name) for key in ("held", "sliding") for name in getattr(own, key))]
    for key, name in [*keys, *own.pressed]:
        if name not in names:
            stated = f"'{name}'" if getattr(body, key) is not None else f"no face '{name}'"
            expected = f"a face of the mesh: {', '.join(names)}"
            yield Fault(f"{path}.{key}", stated, expected, nearest_choice(name, names))


def _missing(path: str, own: OwnMesh, wanted: tuple[str, ...]) -> Iterator[Finding]:
    """Faces without which the part has other loads or supports than in the pump."""
    pressed = [name for name, _ in own.pressed]
    for name in wanted:
        if name == "held":
            if not (own.held or own.sliding):
                limit = "one at least: held nowhere, the part only bends about its own mean position"
                yield CheckWarning(path, "no face held", limit, "name the faces in held or sliding")
        elif name not in pressed:
            limit = f"one, on which the {name} presses beside the film"
            yield CheckWarning(path, f"no face '{name}'", limit, f"name it in {name}")


def _lies(path: str, body: BodySection, space: BodySpace, face: Face, place: _Place) -> Iterator[Finding]:
    """Yield the findings of a face off its film: a wrong unit, another place, or cells that are too coarse."""
    found, wanted = np.ptp(face.places, axis=0).max(), np.ptp(place.points, axis=0).max()
    if unit := _likely_unit(body.unit, float(wanted / found)):
        expected = f"a face about as large as the film on it, {length(float(wanted))}"
        yield Fault(f"{path}.unit", f"a face {length(float(found))} wide", expected, f"unit = '{unit.value}'")
        return
    try:
        transfer(place.film, face, place.chart)
    except InputError as reason:
        where = f"a face over {_box(face.places)}; {reason.found}"
        yield Fault(f"{path}.film", where, place.shape, _remedy(face, place))
        return
    yield from _coarse(path, face, place)


def _likely_unit(stated: MeshUnit, ratio: float) -> MeshUnit | None:
    """The unit in which a face that is too small by a ratio would have the film's size; None near a ratio of one."""
    if 0.1 < ratio < 10.0:
        return None
    return min(MeshUnit, key=lambda unit: abs(math.log(ratio * stated.metres / unit.metres)))


def _remedy(face: Face, place: _Place) -> str:
    """The change that would bring the face under the film; empty without an obvious one."""
    outward = face.area.sum(axis=1)
    middles = face.places[face.facets].mean(axis=1)
    if (outward * place.chart.normals(middles)).sum() < 0.0:
        return "a mesh on the other side of the film (the face looks away from it)"
    low, high = face.places.min(axis=0), face.places.max(axis=0)
    wanted_low, wanted_high = place.points.min(axis=0), place.points.max(axis=0)
    if np.abs((high - low) - (wanted_high - wanted_low)).max() < ALIKE * (wanted_high - wanted_low).max():
        by = ", ".join(length(float(way)) for way in 0.5 * (wanted_low + wanted_high - low - high))
        return f"the mesh moved by ({by})"
    return ""


def _coarse(path: str, face: Face, place: _Place) -> Iterator[Finding]:
    """Facets so large that the face cannot bend as the body does."""
    size = float(np.median(np.sqrt(np.linalg.norm(face.area.sum(axis=1), axis=1))))
    limit = min(place.turn / FEWEST_AROUND, place.width / FEWEST_ACROSS)
    if size > limit * (1.0 + ALIKE):
        yield CheckWarning(
            f"{path}.mesh",
            f"facets of {length(size)} under the film",
            f"{length(limit)} ({FEWEST_AROUND} around, {FEWEST_ACROSS} across: a film's dents are as long)",
            "a finer mesh of that face",
        )


def _box(places: Array) -> str:
    low, high = places.min(axis=0), places.max(axis=0)
    return ", ".join(
        f"{axis} {length(float(a))} to {length(float(b))}" for axis, a, b in zip("xyz", low, high, strict=True)
    )
