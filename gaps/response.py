"""A response: the outputs of a costly computation over a box of inputs, learnt from points, its error from others.

Learnt are the corners of the box and the first points of Sobol's sequence (Sobol 1967), held out those that continue
it. Between learnt points runs a cubic radial basis interpolant with a linear tail (Duchon 1977; scipy's
RBFInterpolator), in inputs scaled to the unit box. Its error is measured at the held-out points alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

ROUND_OFF = 1e-9
"""Of an axis' length: distance that a point may lie outside its ends, the round-off of a conversion of units."""


class Spacing(Enum):
    """Scaling of an axis to the unit box."""

    LINEAR = "linear"
    LOGARITHMIC = "logarithmic"


class Measure(Enum):
    """Measure in which an output is learnt and its error is stated.

    Positive values by logarithm, with relative error; others directly: with the error itself for an output of order
    one, else over the largest magnitude of all learnt values.
    """

    RELATIVE = "relative"
    ABSOLUTE = "absolute"
    OF_LARGEST = "of the largest"


@dataclass(frozen=True)
class Axis:
    """One input over [lower, upper], SI. Raises FilmInputError for ends that are no interval."""

    name: str
    lower: float
    upper: float
    spacing: Spacing = Spacing.LINEAR

    def __post_init__(self) -> None:
        least = 0.0 if self.spacing is Spacing.LOGARITHMIC else -np.inf
        if not least < self.lower < self.upper < np.inf:
            expected = "a lower end below the upper one" + (", both above 0" if least == 0.0 else "")
            raise FilmInputError(f"range of {self.name}", f"{self.lower:.6g} .. {self.upper:.6g}", expected)

    def to_unit(self, values: Array) -> Array:
        """Values of the input as places in 0 .. 1."""
        bend = self._bend
        lower, upper = bend(self.lower), bend(self.upper)
        return np.asarray((bend(values) - lower) / (upper - lower))

    def from_unit(self, places: Array) -> Array:
        """Places in 0 .. 1 as values of the input."""
        if self.spacing is Spacing.LOGARITHMIC:
            return np.asarray(self.lower * (self.upper / self.lower) ** places)
        return np.asarray(self.lower + (self.upper - self.lower) * places)

    @property
    def _bend(self) -> Any:
        return np.log if self.spacing is Spacing.LOGARITHMIC else np.asarray


@dataclass(frozen=True)
class Output:
    """One output by its name, the measure of its error, and the least reference of errors, of the largest value.

    powers: of positive inputs by name, with whose product it is learnt: an output that goes as their inverse is then a
    constant.
    """

    name: str
    measure: Measure
    least: float = 0.0
    powers: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, eq=False)
class Samples:
    """n points (n, d) of the inputs, SI, and the outputs (n, m) found there; equal where their numbers are."""

    points: Array
    values: Array

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Samples):
            return NotImplemented
        return np.array_equal(self.points, other.points) and np.array_equal(self.values, other.values)

    def __hash__(self) -> int:
        return hash((self.points.tobytes(), self.values.tobytes()))


@dataclass(frozen=True)
class HeldOutError:
    """Error of each of the m outputs over the held-out points, as the output's measure says.

    rms, largest (m,); worst (m,): held-out point of the largest.
    """

    rms: Array
    largest: Array
    worst: np.ndarray


@dataclass(frozen=True)
class ErrorRegion:
    """The box around the held-out points with an error above a limit: their number, lower and upper ends (d,), SI."""

    count: int
    lower: Array
    upper: Array


@dataclass(frozen=True)
class Response:
    """Outputs over a box of inputs: learnt at some points, tried at others.

    Raises FilmInputError for too few points (of either sort), shapes that do not fit, and a value of a relative
    output that is not positive.
    """

    axes: tuple[Axis, ...]
    outputs: tuple[Output, ...]
    learnt: Samples
    held_out: Samples

    def __post_init__(self) -> None:
        for what, samples, least in (
            ("learnt points", self.learnt, 2 * len(self.axes) + 2),
            ("held-out points", self.held_out, 2),
        ):
            count, shapes = len(samples.points), (samples.points.shape, samples.values.shape)
            if count < least or shapes != ((count, len(self.axes)), (count, len(self.outputs))):
                expected = f"at least {least} points of {len(self.axes)} inputs and {len(self.outputs)} outputs"
                raise FilmInputError(what, f"arrays {shapes[0]} and {shapes[1]}", expected)
            for column, output in enumerate(self.outputs):
                low = float(np.min(samples.values[:, column]))
                if output.measure is Measure.RELATIVE and not low > 0.0:
                    raise FilmInputError(f"{output.name}, {what}", f"{low:.6g}", "a positive value")

    def at(self, points: Array) -> Array:
        """The outputs (k, m) at points (k, d) of the inputs.

        Raises FilmInputError for a point outside the box: nothing is extrapolated.
        """
        found = np.asarray(self._interpolant(unit_places(self.axes, points)))
        return np.where(self._logarithmic, np.exp(np.where(self._logarithmic, found, 0.0)), found) / self._scale(points)

    def errors(self, samples: Samples) -> Array:
        """Error (k, m) against samples as each output's measure says; signed."""
        off = self.at(samples.points) - samples.values
        of_largest = [output.measure is Measure.OF_LARGEST for output in self.outputs]
        least = [output.least for output in self.outputs]
        largest = np.maximum(np.abs(self.learnt.values).max(axis=0), least)
        scale = np.where(of_largest & (largest > 0.0), largest, 1.0)
        return np.asarray(off / np.where(self._logarithmic, samples.values, scale))

    @cached_property
    def held_out_error(self) -> HeldOutError:
        """Error of the interpolant at the held-out points."""
        off = np.abs(self.errors(self.held_out))
        return HeldOutError(np.sqrt(np.mean(off**2, axis=0)), np.max(off, axis=0), np.argmax(off, axis=0))

    def large_error(self, column: int, limit: float) -> ErrorRegion | None:
        """Region of large error of an output, such as a kink; None without one."""
        above = self.held_out.points[np.abs(self.errors(self.held_out)[:, column]) > limit]
        return ErrorRegion(len(above), above.min(axis=0), above.max(axis=0)) if len(above) else None

    def _scale(self, points: Array) -> Array:
        """Products (k, m) of the inputs' powers with which outputs are learnt, over those of the box's middle."""
        scale = np.ones((len(points), len(self.outputs)))
        columns = {axis.name: points[:, k] / axis.from_unit(np.array(0.5)) for k, axis in enumerate(self.axes)}
        for k, output in enumerate(self.outputs):
            for name, power in output.powers:
                if name in columns:
                    scale[:, k] *= columns[name] ** power
        return scale

    @property
    def _logarithmic(self) -> np.ndarray:
        return np.array([output.measure is Measure.RELATIVE for output in self.outputs])

    @cached_property
    def _interpolant(self) -> Any:
        from scipy.interpolate import RBFInterpolator

        values = self.learnt.values * self._scale(self.learnt.points)
        learnt = np.where(self._logarithmic, np.log(np.where(self._logarithmic, values, 1.0)), values)
        return RBFInterpolator(unit_places(self.axes, self.learnt.points), learnt, kernel="cubic", degree=1)


def fewest_learnt(inputs: int) -> int:
    """Least number of points: half of the fewest requested, and enough for a linear law."""
    return max(2**inputs, 2 * inputs + 2)


def learnt_points(axes: Sequence[Axis], count: int) -> Array:
    """The points (count, d) to learn from: the 2^d corners of the box, then Sobol's sequence.

    The corners keep the interpolant from extrapolating beyond the outermost of the others: with 120 points of four
    inputs a smooth function is learnt 1.1 to 9 times better than from Sobol points alone
    (tests/verification/gaps/gap/test_response.py). Raises FilmInputError for fewer than twice the corners.
    """
    corners = np.stack(np.meshgrid(*[(0.0, 1.0)] * len(axes), indexing="ij"), axis=-1).reshape(-1, len(axes))
    if count < 2 * len(corners):
        raise FilmInputError("points to learn", str(count), f"at least {2 * len(corners)}, half of them corners")
    return _from_places(axes, np.concatenate([corners, _sobol(len(axes), 0, count - len(corners))]))


def held_out_points(axes: Sequence[Axis], learnt: int, count: int) -> Array:
    """The points (count, d) that continue Sobol's sequence after `learnt_points(axes, learnt)`.

    More points to learn from begin with these, so that nothing solved is lost.
    """
    return _from_places(axes, _sobol(len(axes), learnt - 2 ** len(axes), count))


def _sobol(inputs: int, begin: int, count: int) -> Array:
    from scipy.stats.qmc import Sobol

    # The sequence's point 0 is the lowest corner.
    return np.asarray(Sobol(inputs, scramble=False).fast_forward(begin + 1).random(count))


def _from_places(axes: Sequence[Axis], places: Array) -> Array:
    return np.stack([axis.from_unit(places[:, k]) for k, axis in enumerate(axes)], axis=1)


def unit_places(axes: Sequence[Axis], points: Array) -> Array:
    """Points (k, d) as places in the unit box; raises FilmInputError with every input that lies outside."""
    if out := outside(axes, points):
        raise FilmInputError(
            ", ".join(axis.name for axis, _ in out),
            ", ".join(f"{value:.6g}" for _, value in out),
            ", ".join(f"{axis.lower:.6g} .. {axis.upper:.6g}" for axis, _ in out) + ": nothing is extrapolated",
        )
    return _places(axes, points)


def outside(axes: Sequence[Axis], points: Array) -> list[tuple[Axis, float]]:
    """Each input that lies outside the box at some of the points (k, d), with its value at the first of them."""
    places = _places(axes, points)
    return [
        (axis, float(points[row, k]))
        for k, axis in enumerate(axes)
        for row in np.flatnonzero(~(np.abs(places[:, k] - 0.5) <= 0.5 + ROUND_OFF))[:1]
    ]


def _places(axes: Sequence[Axis], points: Array) -> Array:
    return np.stack([axis.to_unit(points[:, k]) for k, axis in enumerate(axes)], axis=1)
