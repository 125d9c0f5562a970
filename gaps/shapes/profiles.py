"""Shapes of faces and pistons: material removed from a plain face or cylinder, as a sum of simple shapes.

`place` is the length along the profile (m): from its chamber's end on a piston, from the case edge in a bore, the
radius on a face. `angle` (rad) goes round the part. Positive depths open the film, negative ones close it. A film
samples depth and slopes at the quadrature points of its mesh, which does not resolve waves shorter than a cell.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.laws.law import require_positive, within
from reynolds.numerics.arrays import Array


class Relief(NamedTuple):
    """Material removed (m), and its slopes along the profile (m/m) and around (m/rad), arrays of one shape."""

    depth: Array
    along: Array
    around: Array


class ProfileShape(Protocol):
    """A shape of a profile."""

    def __call__(self, place: Array, angle: Array) -> Relief:
        """Relief at places (m) and angles (rad), arrays of one shape."""


@dataclass(frozen=True)
class Profile:
    """The sum of shapes; without any, a plain face or cylinder."""

    shapes: tuple[ProfileShape, ...] = ()

    def __call__(self, place: Array, angle: Array) -> Relief:
        """Depth and slopes of all shapes together."""
        total = _level(place)
        for shape in self.shapes:
            total = Relief(*(a + b for a, b in zip(total, shape(place, angle), strict=True)))
        return total


PLAIN = Profile()
"""No material removed."""


@dataclass(frozen=True)
class Barrel:
    """A parabola over a length (m) from place 0, `height` (m) removed at both ends, zero in the middle."""

    length: float
    height: float

    def __post_init__(self) -> None:
        require_positive("barrel", length=self.length)

    def __call__(self, place: Array, angle: Array) -> Relief:
        from_middle = 2.0 * place / self.length - 1.0
        flat = _level(place)
        return Relief(self.height * from_middle**2, 4.0 * self.height / self.length * from_middle, flat.around)


@dataclass(frozen=True)
class Crown:
    """A face domed as a parabola: `height` (m) removed at `radius` (m), zero in the centre.

    A negative height makes it dished.
    """

    radius: float
    height: float

    def __post_init__(self) -> None:
        require_positive("crown", radius=self.radius)

    def __call__(self, place: Array, angle: Array) -> Relief:
        share = place / self.radius
        return Relief(self.height * share**2, 2.0 * self.height / self.radius * share, np.zeros(np.shape(place)))


@dataclass(frozen=True)
class EdgeRelief:
    """An edge at a place (m) taken back by `depth` (m), falling to zero at `end` (m) as a parabola.

    depth ((x - end)/(edge - end))^2 from `end` to the edge and beyond it: depth and slope are continuous at `end`,
    where the curvature jumps. `end` lies on the part's side of the edge, either way.
    """

    edge: float
    end: float
    depth: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.edge) and np.isfinite(self.end) and self.edge != self.end):
            raise FilmInputError("edge relief", f"from {self.end:g} to {self.edge:g} m", "two places apart")

    def __call__(self, place: Array, angle: Array) -> Relief:
        share = np.maximum((place - self.end) / (self.edge - self.end), 0.0)
        slope = 2.0 * self.depth / (self.edge - self.end) * share
        return Relief(self.depth * share**2, slope, np.zeros(np.shape(place)))


@dataclass(frozen=True)
class RingGroove:
    """A groove with upright sides around a part: its middle, width and depth (m). Its depth jumps at its sides."""

    middle: float
    width: float
    depth: float

    def __post_init__(self) -> None:
        require_positive("ring groove", width=self.width, depth=self.depth)

    def __call__(self, place: Array, angle: Array) -> Relief:
        flat = _level(place)
        within_it = np.abs(place - self.middle) < 0.5 * self.width
        return Relief(np.where(within_it, self.depth, 0.0), flat.along, flat.around)


@dataclass(frozen=True)
class Waviness:
    """Waves around a part: amplitude cos(waves (angle - crest)), m, half of peak to peak; mean depth zero.

    `crest` (rad) is an angle of the largest depth.
    """

    waves: int
    amplitude: float
    crest: float = 0.0

    def __post_init__(self) -> None:
        require_positive("waviness", waves=self.waves)

    def __call__(self, place: Array, angle: Array) -> Relief:
        phase = self.waves * (np.broadcast_to(angle, np.shape(place)) - self.crest)
        flat = np.zeros(np.shape(place))
        return Relief(self.amplitude * np.cos(phase), flat, -self.waves * self.amplitude * np.sin(phase))


@dataclass(frozen=True)
class DepthPoints:
    """Measured depths (m) at rising places (m), straight in between: the slope jumps at each.

    Raises FilmInputError for places that do not rise, and, if set, beyond the first and last of them: nothing is
    extrapolated.
    """

    places: tuple[float, ...]
    depths: tuple[float, ...]

    def __post_init__(self) -> None:
        _check_rising("profile, places", np.array(self.places))
        _check_table("profile, depths", np.array(self.depths), (len(self.places),))

    def __call__(self, place: Array, angle: Array) -> Relief:
        places, depths = np.array(self.places), np.array(self.depths)
        cell, share = _cell_of("profile, place", places, place)
        slope = np.diff(depths) / np.diff(places)
        return Relief(depths[cell] + share * np.diff(depths)[cell], slope[cell], np.zeros(np.shape(place)))


@dataclass(frozen=True)
class PointsAround:
    """Measured depths (m) on a net of rising places (m) and rising angles (rad) within one turn: a worn surface.

    depths[i][j] at place i and angle j; bilinear in between and closed around. Raises as `DepthPoints`, and for
    angles that span a turn or more.
    """

    places: tuple[float, ...]
    angles: tuple[float, ...]
    depths: tuple[tuple[float, ...], ...]

    def __post_init__(self) -> None:
        _check_rising("profile, places", np.array(self.places))
        _check_rising("profile, angles", np.array(self.angles))
        if self.angles[-1] - self.angles[0] >= 2.0 * np.pi:
            span = f"{np.degrees(self.angles[-1] - self.angles[0]):g} deg"
            raise FilmInputError("profile, angles", span, "less than a turn; it closes by itself")
        _check_table("profile, depths", np.array(self.depths), (len(self.places), len(self.angles)))

    def __call__(self, place: Array, angle: Array) -> Relief:
        places = np.array(self.places)
        angles = np.append(self.angles, self.angles[0] + 2.0 * np.pi)
        depths = np.array(self.depths)[:, [*range(len(self.angles)), 0]]
        turned = angles[0] + (np.broadcast_to(angle, np.shape(place)) - angles[0]) % (2.0 * np.pi)
        i, u = _cell_of("profile, place", places, place)
        j, v = _cell_of("profile, angle", angles, np.minimum(turned, angles[-1]))
        one, two, three, four = depths[i, j], depths[i + 1, j], depths[i, j + 1], depths[i + 1, j + 1]
        depth = (1 - u) * ((1 - v) * one + v * three) + u * ((1 - v) * two + v * four)
        along = ((1 - v) * (two - one) + v * (four - three)) / np.diff(places)[i]
        around = ((1 - u) * (three - one) + u * (four - two)) / np.diff(angles)[j]
        return Relief(depth, along, around)


def measured(rows: Sequence[Sequence[float]]) -> DepthPoints | PointsAround:
    """The shape of measured rows: (place, depth), or (place, angle, depth) of every pair of place and angle.

    Raises as `DepthPoints` and `PointsAround`, and FilmInputError for a net with holes or with places given twice.
    """
    if len(rows[0]) == 2:
        return DepthPoints(tuple(row[0] for row in rows), tuple(row[1] for row in rows))
    places, angles = (tuple(sorted({row[column] for row in rows})) for column in (0, 1))
    depths = {(row[0], row[1]): row[2] for row in rows}
    if not len(depths) == len(rows) == len(places) * len(angles):
        found = f"{len(rows)} rows at {len(places)} places and {len(angles)} angles"
        raise FilmInputError("profile", found, f"{len(places) * len(angles)} rows, each place with each angle once")
    return PointsAround(places, angles, tuple(tuple(depths[i, j] for j in angles) for i in places))


@dataclass(frozen=True)
class OverPart:
    """A shape from start to end of a part (m), beyond them as there: polygons stray from a part's circles."""

    shape: ProfileShape
    start: float
    end: float

    def __call__(self, place: Array, angle: Array) -> Relief:
        return self.shape(np.clip(place, self.start, self.end), angle)


def over_part(profile: Profile, start: float, end: float) -> Profile:
    """The profile of a face from one radius to another (m): its measured points need not reach beyond them."""
    points = DepthPoints, PointsAround
    return Profile(tuple(OverPart(one, start, end) if isinstance(one, points) else one for one in profile.shapes))


def missed_rise(profile: Profile, edges: Array) -> float:
    """Largest error (m) of the rise of measured points over a cell between edges (n,) m, 0.0 without points.

    A film has the rise by slopes at its quadrature points; the error, times the part's speed, is a spurious flow into
    it. Three points along a cell, twelve angles around.
    """
    points = Profile(tuple(shape for shape in profile.shapes if isinstance(shape, (DepthPoints, PointsAround))))
    nodes, weights = np.polynomial.legendre.leggauss(3)
    half = 0.5 * np.diff(edges)
    within_cells = (edges[:-1] + half)[:, None] + half[:, None] * nodes
    around = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)[:, None]
    depth = points(*np.broadcast_arrays(edges, around)).depth
    slope = points(*np.broadcast_arrays(within_cells, around[:, :, None])).along
    return float(np.max(np.abs(np.diff(depth) - half * (slope @ weights))))


def ring_grooves(grooves: Iterable[tuple[float, float, float]]) -> Profile:
    """A profile of ring grooves given by middle, width and depth (m)."""
    return Profile(tuple(RingGroove(*groove) for groove in grooves))


def _level(place: Array) -> Relief:
    return Relief(*(np.zeros(np.shape(place)) for _ in range(3)))


def _cell_of(where: str, knots: Array, found: Array) -> tuple[NDArray[np.int64], Array]:
    """Number of the interval of each value, and the place in it (0 .. 1); raises beyond the ends."""
    unit = "m" if "place" in where else "rad"
    slack = 1e-9 * (knots[-1] - knots[0])  # a mesh's last line, not another place
    values = within(where, found, knots[0] - slack, knots[-1] + slack, unit, "measured points over all of the part")
    cell = np.clip(np.searchsorted(knots, values, side="right") - 1, 0, len(knots) - 2)
    return cell, (values - knots[cell]) / np.diff(knots)[cell]


def _check_rising(where: str, knots: Array) -> None:
    if len(knots) < 2 or not np.isfinite(knots).all() or not (np.diff(knots) > 0.0).all():
        raise FilmInputError(where, f"{knots.tolist()}", "two or more that rise")


def _check_table(where: str, table: Array, shape: tuple[int, ...]) -> None:
    if table.shape != shape or not np.isfinite(table).all():
        raise FilmInputError(where, f"an array of shape {table.shape}", f"{shape} numbers of metres")
