"""Flow coefficients of a file for the chamber's kernel: a factor on the plain orifice law.

Over the logarithms of the flow number lambda = d_h/nu sqrt(2 dp/rho) = Re/Cd (McCloy, Martin 1980, Control of Fluid
Power) and of the opening. It is explicit in the pressure drop, so that the flow remains one equation; a factor of one
is the plain law at any drop. Beyond the file's openings the values at its edges apply; below its least flow number flow
is laminar (Cd grows with lambda), above its largest Cd stays.
"""

from dataclasses import dataclass
from functools import lru_cache

import numba
import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.coefficients.flow_files import FlowCoefficients

MOST_OPENINGS = 12
NODES = 40
HEAD = 3
"""Numbers ahead of a table's areas: number of openings, first logarithm of the flow number, step."""
FLOW_SIZE = HEAD + MOST_OPENINGS * (1 + 2 * NODES)
DECADE = float(np.log(10.0))
"""Factor by which a table extends below its file: there the plain law is laminar to 1e-4."""


@dataclass(frozen=True)
class PlainLaw:
    """The orifice law of `ports.orifice_flow`: Cd = flow_coefficient/(1 + (lambda_cr/lambda)^4)^(1/4)."""

    flow_coefficient: float
    critical_reynolds: float

    @property
    def critical_flow_number(self) -> float:
        """lambda_cr = Re_cr/flow_coefficient."""
        return self.critical_reynolds / self.flow_coefficient

    def log_coefficient(self, log_number: Array) -> tuple[Array, Array]:
        """ln Cd and its slope by ln lambda, at ln lambda."""
        fourth = np.exp(4.0 * (np.log(self.critical_flow_number) - log_number))
        return np.log(self.flow_coefficient) - 0.25 * np.log1p(fourth), fourth / (1.0 + fourth)


@dataclass(frozen=True)
class FlowTable:
    """The factor at K openings and NODES flow numbers, as compiled code reads it: `row` (FLOW_SIZE,).

    The empty tuple: no file, the unchanged plain law.
    """

    numbers: tuple[float, ...] = ()

    @property
    def row(self) -> Array:
        """The table as compiled code reads it."""
        found = np.zeros(FLOW_SIZE)
        found[: len(self.numbers)] = self.numbers
        return found


def file_law(coefficients: FlowCoefficients) -> PlainLaw:
    """The plain law nearest to a file: its last coefficient at its largest opening, laminar as its first one."""
    first, last = coefficients.flow_coefficient[-1, [0, -1]]
    critical = last * coefficients.flow_number[-1, 0] / first
    return PlainLaw(float(last), float(critical * last))


def flow_table(coefficients: FlowCoefficients, law: PlainLaw) -> FlowTable:
    """The file's coefficients over those of a law. Raises ValueError for more than MOST_OPENINGS."""
    count = coefficients.opening.size
    if count > MOST_OPENINGS:
        raise ValueError(f"coefficients of a port: found {count} openings, expected at most {MOST_OPENINGS}")
    numbers = coefficients.flow_number
    start = np.log(min(numbers.min(), law.critical_flow_number)) - DECADE
    end = max(np.log(numbers.max()), np.log(law.critical_flow_number) + DECADE)
    grid = np.linspace(start, end, NODES)
    plain, bend = law.log_coefficient(grid)
    found = np.zeros((count, NODES, 2))
    for own, number, reynolds in zip(found, numbers, coefficients.reynolds, strict=True):
        value, slope = log_reynolds_over(np.log(number), np.log(reynolds), grid)
        own[:] = np.stack([value - grid - plain, slope - 1.0 - bend], axis=-1)
    areas = np.zeros(MOST_OPENINGS)
    areas[:count] = np.log(coefficients.opening)
    return FlowTable((float(count), float(grid[0]), float(grid[1] - grid[0]), *areas, *found.ravel()))


def log_reynolds_over(log_number: Array, log_reynolds: Array, grid: Array) -> tuple[Array, Array]:
    """ln Re and its slope over ln lambda: between the rows a monotone cubic (Fritsch, Carlson 1980).

    Below them Re grows with lambda^2, above them with lambda; so more pressure drop is more flow throughout.
    """
    from scipy.interpolate import PchipInterpolator

    below, above = min(grid[0], log_number[0] - DECADE) - 1.0, max(grid[-1], log_number[-1] + DECADE) + 1.0
    ends = [below, log_number[0] - 0.5 * DECADE], [log_number[-1] + DECADE, above + DECADE]
    places = np.concatenate([ends[0], log_number, ends[1]])
    values = np.interp(places, log_number, log_reynolds)
    values += 2.0 * np.minimum(places - log_number[0], 0.0) + np.maximum(places - log_number[-1], 0.0)
    course = PchipInterpolator(places, values)
    return np.asarray(course(grid)), np.asarray(course(grid, 1))


@lru_cache(maxsize=32)
def port_table(base: FlowCoefficients, own: FlowCoefficients, critical_reynolds: float) -> FlowTable:
    """Table of a port's own file over the law of the pump's, `base`, at the pump's critical Reynolds number."""
    return flow_table(own, PlainLaw(file_law(base).flow_coefficient, critical_reynolds))


@numba.njit("UniTuple(f8,2)(f8,f8,f8[:])", cache=True)
def log_factor(log_number, log_area, row):  # type: ignore[no-untyped-def]
    """ln of the factor, and its slope by ln lambda; cubic along ln lambda, linear in ln area."""
    count = int(row[0])
    place = (log_number - row[1]) / row[2]
    inside = 0.0 < place < NODES - 1
    place = min(max(place, 0.0), NODES - 1.0)
    cell = min(int(place), NODES - 2)
    x = place - cell
    low = 0
    while low < count - 1 and row[HEAD + low + 1] < log_area:
        low += 1
    high = min(low + 1, count - 1)
    share = 0.0
    if high > low:
        width = row[HEAD + high] - row[HEAD + low]
        share = min(max((log_area - row[HEAD + low]) / width, 0.0), 1.0)
    value, slope = 0.0, 0.0
    for opening, weight in ((low, 1.0 - share), (high, share)):
        at = HEAD + MOST_OPENINGS + 2 * (opening * NODES + cell)
        y0, y1 = row[at], row[at + 2]
        d0, d1 = row[at + 1] * row[2], row[at + 3] * row[2]
        bend, twist = 3.0 * (y1 - y0) - 2.0 * d0 - d1, d0 + d1 - 2.0 * (y1 - y0)
        value += weight * (y0 + x * (d0 + x * (bend + x * twist)))
        slope += weight * (d0 + x * (2.0 * bend + 3.0 * x * twist))
    return value, slope / row[2] if inside else 0.0


@numba.njit("UniTuple(f8,2)(f8,f8,f8,f8,f8,f8[:])", cache=True)
def with_factor(flow, slope, pressure_drop, log_scale, area, row):  # type: ignore[no-untyped-def]
    """Flow and slope of the plain law converted to the table's; log_scale: a `flow_scale`, 0 for the plain law."""
    if log_scale == 0.0:
        return flow, slope
    size = max(abs(pressure_drop), 1e-30)
    value, bend = log_factor(log_scale + 0.5 * np.log(size), np.log(area), row)
    factor = np.exp(value)
    steeper = 0.5 * bend * flow / pressure_drop if pressure_drop != 0.0 else 0.0
    return factor * flow, factor * (slope + steeper)


@numba.njit("f8(f8,f8,f8,f8[:])", cache=True)
def flow_scale(area, density, kinematic_viscosity, row):  # type: ignore[no-untyped-def]
    """ln of the flow number at a pressure drop of 1 Pa; 0 without a table or an opening."""
    if row[0] == 0.0 or area <= 0.0:
        return 0.0
    return 0.5 * np.log(8.0 * area / (np.pi * density)) - np.log(kinematic_viscosity)
