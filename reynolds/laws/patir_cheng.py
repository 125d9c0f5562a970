"""The published factors of Patir and Cheng (1978, 1979) as functions of H = h/sigma, each with its slope over H.

gamma, Peklenik's number, is the ratio of correlation lengths of the roughness along x and across: gamma > 1 ridges
along x, < 1 across, 1 isotropic. Between the rows of the table the factors (not their coefficients, whose formulas
differ) are interpolated in log gamma. Below a row's range every factor changes exponentially, with the value and slope
it has at the limit. That continuation is assumed: smooth and positive for the solver, but not measured. FilmInputError
for gamma outside 1/9 .. 9.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.laws import roughness_kernels
from reynolds.laws.law import Tangent
from reynolds.numerics.arrays import Array

LOWEST_PEKLENIK, HIGHEST_PEKLENIK = 1.0 / 9.0, 9.0


@dataclass(frozen=True)
class Row:
    """Coefficients of Patir and Cheng for one Peklenik number: phi_x (c, r), Phi_s (a1, a2, p1, p2, p3),
    Phi_fs (a3, p4, p5, p6), phi_fp (d, s); they hold from `lowest` = h/sigma on."""

    peklenik: float
    c: float
    r: float
    a1: float
    p1: float
    p2: float
    p3: float
    a2: float
    a3: float
    p4: float
    p5: float
    p6: float
    d: float
    s: float

    @property
    def lowest(self) -> float:
        """Least h/sigma that the row is published for."""
        return 1.0 if self.peklenik < 1.0 else 0.5

    @property
    def lowest_fp(self) -> float:
        """phi_fp of isotropic roughness holds from 0.75 on: at 0.5 its formula is negative."""
        return max(self.lowest, 0.75) if self.peklenik == 1.0 else self.lowest


TABLE = (
    Row(1 / 9, 1.48, 0.42, 2.046, 1.12, 0.78, 0.03, 1.856, 14.1, 2.45, 2.30, 0.10, 1.51, 0.52),
    Row(1 / 6, 1.38, 0.42, 1.962, 1.08, 0.77, 0.03, 1.754, 13.4, 2.42, 2.30, 0.10, 1.51, 0.54),
    Row(1 / 3, 1.18, 0.42, 1.858, 1.01, 0.76, 0.03, 1.561, 12.3, 2.32, 2.30, 0.10, 1.47, 0.58),
    Row(1.0, 0.90, 0.56, 1.899, 0.98, 0.92, 0.05, 1.126, 11.1, 2.31, 2.38, 0.11, 1.40, 0.66),
    Row(3.0, 0.225, 1.5, 1.560, 0.85, 1.13, 0.08, 0.556, 9.8, 2.25, 2.80, 0.18, 0.98, 0.79),
    Row(6.0, 0.520, 1.5, 1.290, 0.62, 1.09, 0.08, 0.388, 10.1, 2.25, 2.90, 0.18, 0.97, 0.91),
    Row(9.0, 0.870, 1.5, 1.011, 0.54, 1.07, 0.08, 0.295, 8.7, 2.15, 2.97, 0.18, 0.73, 0.91),
)
_LOG_PEKLENIK = np.log([row.peklenik for row in TABLE])


def phi_x(ratio: ArrayLike, peklenik: float) -> Tangent:
    """Pressure flow factor along x and its slope over H = h/sigma: 1 - C e^(-rH), gamma <= 1; 1 + C H^-r above.

    Source: Patir and Cheng 1978, H >= 1 (gamma < 1), >= 0.5 (gamma >= 1); continued below (module docstring).
    """

    def law(row: Row, h: Array) -> Tangent:
        if row.peklenik <= 1.0:
            lost = row.c * np.exp(-row.r * h)
            return Tangent(1.0 - lost, row.r * lost)
        gained = row.c * h**-row.r
        return Tangent(1.0 + gained, -row.r * gained / h)

    return _interpolated(law, lambda row: row.lowest, ratio, peklenik)


def phi_y(ratio: ArrayLike, peklenik: float) -> Tangent:
    """Pressure flow factor along y: phi_y(H, gamma) = phi_x(H, 1/gamma). Source: Patir and Cheng 1978."""
    return phi_x(ratio, 1.0 / peklenik)


def phi_s(ratio: ArrayLike, peklenik: float) -> Tangent:
    """Shear flow factor Phi_s of one rough wall and its slope over H; the formulas meet at H = 5 within 0.1 %.

    A1 H^al1 e^(-al2 H + al3 H^2), H <= 5; A2 e^(-H/4) above. Source: Patir and Cheng 1979.
    """

    def law(row: Row, h: Array) -> Tangent:
        near = np.minimum(h, 5.0)
        thick = row.a2 * np.exp(-0.25 * h)
        thin = row.a1 * near**row.p1 * np.exp(-row.p2 * near + row.p3 * near**2)
        value = np.where(h > 5.0, thick, thin)
        steepness = np.where(h > 5.0, -0.25, row.p1 / near - row.p2 + 2.0 * row.p3 * near)
        return Tangent(value, value * steepness)

    return _interpolated(law, lambda row: row.lowest, ratio, peklenik)


def phi_fs(ratio: ArrayLike, peklenik: float) -> Tangent:
    """Sliding shear stress factor Phi_fs of one rough wall and its slope over H.

    A3 H^al4 e^(-al5 H + al6 H^2) for H < 7, zero above. Source: Patir and Cheng 1979.
    """

    def law(row: Row, h: Array) -> Tangent:
        near = np.minimum(h, 7.0)
        value = np.where(h < 7.0, row.a3 * near**row.p4 * np.exp(-row.p5 * near + row.p6 * near**2), 0.0)
        return Tangent(value, value * (row.p4 / near - row.p5 + 2.0 * row.p6 * near))

    return _interpolated(law, lambda row: row.lowest, ratio, peklenik)


def phi_fp(ratio: ArrayLike, peklenik: float) -> Tangent:
    """Pressure shear stress factor 1 - D e^(-sH) and its slope over H. Source: Patir and Cheng 1979."""

    def law(row: Row, h: Array) -> Tangent:
        lost = row.d * np.exp(-row.s * h)
        return Tangent(1.0 - lost, row.s * lost)

    return _interpolated(law, lambda row: row.lowest_fp, ratio, peklenik)


def require_peklenik(gamma: float) -> None:
    """FilmInputError unless gamma lies in the table's range."""
    if not LOWEST_PEKLENIK * (1.0 - 1e-9) <= gamma <= HIGHEST_PEKLENIK * (1.0 + 1e-9):
        raise FilmInputError("Peklenik number of the roughness", f"{gamma:g}", "1/9 .. 9 (Patir and Cheng)")


def _interpolated(
    law: Callable[[Row, Array], Tangent], lowest: Callable[[Row], float], ratio: ArrayLike, peklenik: float
) -> Tangent:
    """A law of the table's rows at any Peklenik number: linear in its logarithm between two rows."""
    require_peklenik(peklenik)
    h = np.asarray(ratio, dtype=float)
    place = float(np.interp(np.log(peklenik), _LOG_PEKLENIK, np.arange(len(TABLE))))
    # Round-off of the logarithm must not mix a table's own number with its neighbour.
    place = round(place) if abs(place - round(place)) < 1e-9 else place
    low = int(place)
    first = _continued(law, TABLE[low], lowest(TABLE[low]), h)
    if place == low:
        return first
    share = place - low
    second = _continued(law, TABLE[low + 1], lowest(TABLE[low + 1]), h)
    value, slope = ((1.0 - share) * a + share * b for a, b in zip(first, second, strict=True))
    return Tangent(value, slope)


def _continued(law: Callable[[Row, Array], Tangent], row: Row, lowest: float, ratio: Array) -> Tangent:
    """The law from `lowest` on; below, the exponential with its value and slope there."""
    value, slope = law(row, np.maximum(ratio, lowest))
    at = law(row, np.asarray(lowest))
    decay = np.exp(at.slope / at.value * np.minimum(ratio - lowest, 0.0))
    return Tangent(value * decay, slope * decay)


def phi_f(ratio: ArrayLike) -> Tangent:
    """Couette shear stress factor h E[1/hT] and its slope over H > 0, any Peklenik number.

    Heights of density (35/32)(1 - s^2)^3 on +-3 sigma; a film thinner than sigma/100 is not in the mean. Source: Patir
    and Cheng 1979, in closed form; from H = 9 on, where that loses digits, by its moments.
    """
    given = np.asarray(ratio, dtype=float, order="C")
    value, slope = np.empty(given.shape), np.empty(given.shape)
    roughness_kernels.sliding_stress(given.ravel(), value.ravel(), slope.ravel())
    return Tangent(value, slope)
