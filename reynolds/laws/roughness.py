"""Roughness of the walls: the average flow model of Patir and Cheng (1978, 1979), with slopes over the film.

Mean flow per width along x, wall 1 the moving and wall 2 the fixed one (h between the mean planes):
    q = - phi_x h^3/(12 mu) dp/dx + (U1 + U2)/2 hT + (U1 - U2)/2 sigma phi_s,
    phi_s = V1 Phi_s(gamma1) - V2 Phi_s(gamma2),  V = (sigma of the wall/sigma)^2.
A moving rough wall drags oil in its valleys, so that phi_s > 0 there: with crossing ridges the flow is exactly
U/2 (2 h - E[h^-2]/E[h^-3]), that is phi_s = 3 sigma/h > 0 at first order.

Peklenik's number is counted along the principal direction of the roughness (x unless a lay is given). The factors reach
down to h/sigma = 0.5 or 1 and are continued below (`patir_cheng`); `beyond_range` gives the share of a film there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.laws import roughness_kernels
from reynolds.laws.law import Tangent, require_positive
from reynolds.laws.patir_cheng import phi_f, phi_fp, phi_fs, phi_s, phi_x, require_peklenik
from reynolds.numerics.arrays import Array

NOTHING = np.zeros(())


@dataclass(frozen=True)
class Surface:
    """Roughness of the two walls: standard deviations of height (m), Peklenik numbers, direction of the lay.

    `lay_direction` is the angle (rad) from x to the principal direction, one number or an array like the film's;
    the formulas are Patir and Cheng's along x, and are turned with it as tensors. Raises FilmInputError for a
    negative roughness, two smooth walls (no Surface then), or a Peklenik number outside 1/9 .. 9.
    """

    roughness_moving: float
    roughness_fixed: float
    peklenik_moving: float = 1.0
    peklenik_fixed: float = 1.0
    lay_direction: float | Array = 0.0

    def __post_init__(self) -> None:
        for name, value in (("moving", self.roughness_moving), ("fixed", self.roughness_fixed)):
            if not (np.isfinite(value) and value >= 0.0):
                raise FilmInputError(f"roughness of the {name} wall", f"{value:g} m", "0 or a positive height")
        require_positive("surface", composite_roughness=self.composite_roughness)
        for gamma in (self.peklenik_moving, self.peklenik_fixed):
            require_peklenik(gamma)

    @property
    def composite_roughness(self) -> float:
        """sigma = sqrt(sigma1^2 + sigma2^2), m."""
        return float(np.hypot(self.roughness_moving, self.roughness_fixed))

    @property
    def variance_shares(self) -> tuple[float, float]:
        """V1 (moving wall) and V2 (fixed wall), of sum one."""
        moving, fixed = self.roughness_moving**2, self.roughness_fixed**2
        return moving / (moving + fixed), fixed / (moving + fixed)

    @property
    def lowest_ratio(self) -> float:
        """The least h/sigma at which all flow factors of this surface are Patir and Cheng's."""
        rough = [g for g, v in zip(self.peklenik, self.variance_shares, strict=True) if v > 0.0]
        return 0.5 if all(g == 1.0 for g in rough) else 1.0

    @property
    def peklenik(self) -> tuple[float, float]:
        """Peklenik number of the moving and of the fixed wall."""
        return self.peklenik_moving, self.peklenik_fixed


class Directional(NamedTuple):
    """A symmetric tensor in the film plane, each part with its slope: flux_x = x g_x + xy g_y, and so on.

    If isotropic, y is x and xy is zero.
    """

    x: Tangent
    xy: Tangent
    y: Tangent


class FlowFactors(NamedTuple):
    """Flow factors of roughness; slopes are with respect to h (per m).

    `pressure` multiplies h^3/(12 mu); `shear` (phi_s) enters the flow as + (U_moving - U_fixed)/2 sigma phi_s;
    `content` is the mean film thickness hT in m, which replaces h in the mean sliding flow and in the storage.
    """

    pressure: Directional
    shear: Directional
    content: Tangent


class ShearFactors(NamedTuple):
    """Factors of the viscous stress of the oil on the walls (Pa); slopes with respect to h.

    moving: - mu (U1 - U2)/h (couette - sliding) - pressure h/2 dp/dx
    fixed:  + mu (U1 - U2)/h (couette + sliding) - pressure h/2 dp/dx
    The pressure on the asperities' flanks is added apart and is no viscous stress.
    """

    couette: Tangent
    sliding: Directional
    pressure: Directional


class BeyondRange(NamedTuple):
    """Share of the points below the published range, least h/sigma met, and the range's limit."""

    fraction: float
    lowest_ratio: float
    limit: float


def beyond_range(h: ArrayLike, surface: Surface) -> BeyondRange:
    """Share of a film (m, at any points) thinner than the range of Patir and Cheng's formulas."""
    ratio = np.asarray(h, dtype=float) / surface.composite_roughness
    below = float(np.mean(ratio < surface.lowest_ratio))
    return BeyondRange(below, float(np.min(ratio)), surface.lowest_ratio)


def flow_factors(surface: Surface, h: ArrayLike) -> FlowFactors:
    """Flow factors of a film h (m, positive) between rough walls. Source: Patir and Cheng 1978, 1979.

    Where the walls' Peklenik numbers differ, phi_x is the mean weighted with the variances: exact to the second
    order in sigma/h, in which the two roughnesses act apart. Raises FilmInputError for h not above zero.
    """
    ratio = _ratio(surface, h)
    moving, fixed = surface.variance_shares
    return FlowFactors(
        pressure=pressure_factors(surface, h),
        shear=_directed(phi_s, surface, ratio, (moving, -fixed)),
        content=mean_thickness(surface.composite_roughness, h),
    )


def pressure_factors(surface: Surface, h: ArrayLike) -> Directional:
    """Factor of h^3/(12 mu) alone, see `flow_factors`."""
    return _directed(phi_x, surface, _ratio(surface, h), surface.variance_shares)


def sliding_factor(surface: Surface, h: ArrayLike) -> Tangent:
    """Factor of mu (U1 - U2)/h alone, see `shear_factors`."""
    couette = phi_f(_ratio(surface, h))
    return Tangent(couette.value, couette.slope / surface.composite_roughness)


def shear_factors(surface: Surface, h: ArrayLike) -> ShearFactors:
    """Shear stress factors of a film h (m, positive) between rough walls. Source: Patir and Cheng 1979."""
    ratio = _ratio(surface, h)
    moving, fixed = surface.variance_shares
    return ShearFactors(
        couette=sliding_factor(surface, h),
        sliding=_directed(phi_fs, surface, ratio, (moving, -fixed)),
        pressure=_directed(phi_fp, surface, ratio, (moving, fixed)),
    )


def mean_thickness(composite_roughness: float, h: ArrayLike) -> Tangent:
    """hT = sigma [H N(H) + n(H)] (m) and the contact factor phi_c = dhT/dh = N(H): Gaussian heights, exact.

    The mean distance of the walls with overlapping asperities cut off; any h, even < 0.
    """
    gap = np.asarray(h, dtype=float, order="C")
    mean, share = np.empty(gap.shape), np.empty(gap.shape)
    roughness_kernels.cut_off(gap.ravel(), composite_roughness, mean.ravel(), share.ravel())
    return Tangent(mean, share)


def mean_thickness_curvature(composite_roughness: float, h: ArrayLike) -> Array:
    """d2hT/dh2 = n(H)/sigma (1/m), the slope of the contact factor: Gaussian heights, exact."""
    ratio = np.asarray(h, dtype=float) / composite_roughness
    return np.asarray(np.exp(-0.5 * ratio**2) / (np.sqrt(2.0 * np.pi) * composite_roughness))


def _ratio(surface: Surface, h: ArrayLike) -> Array:
    ratio = np.asarray(h, dtype=float) / surface.composite_roughness
    if not np.all(ratio > 0.0):
        raise FilmInputError("film thickness between rough walls", f"{np.min(h):.4g} m", "positive everywhere")
    return ratio


def _directed(
    factor: Callable[[ArrayLike, float], Tangent], surface: Surface, ratio: Array, weights: tuple[float, float]
) -> Directional:
    """Weighted sum of both walls' factors along and across the lay, turned to x and y; slopes over h."""
    along, sigma = _weighted(factor, ratio, weights, surface.peklenik), surface.composite_roughness
    if surface.peklenik == (1.0, 1.0):
        same = Tangent(along.value, along.slope / sigma)
        return Directional(same, Tangent(NOTHING, NOTHING), same)
    inverse = (1.0 / surface.peklenik_moving, 1.0 / surface.peklenik_fixed)
    across = _weighted(factor, ratio, weights, inverse)
    cosine, sine = np.cos(surface.lay_direction), np.sin(surface.lay_direction)
    parts = ((cosine**2, sine**2), (cosine * sine, -cosine * sine), (sine**2, cosine**2))
    x, xy, y = (
        Tangent(a * along.value + b * across.value, (a * along.slope + b * across.slope) / sigma) for a, b in parts
    )
    return Directional(x, xy, y)


def _weighted(
    factor: Callable[[ArrayLike, float], Tangent],
    ratio: Array,
    weights: tuple[float, float],
    peklenik: tuple[float, float],
) -> Tangent:
    """Sum over the walls; walls of one Peklenik number are evaluated once, a smooth wall not at all."""
    if peklenik[0] == peklenik[1]:
        weights = (weights[0] + weights[1], 0.0)
    value, slope = np.zeros_like(ratio), np.zeros_like(ratio)
    for weight, gamma in zip(weights, peklenik, strict=True):
        if weight != 0.0:
            part = factor(ratio, gamma)
            value, slope = value + weight * part.value, slope + weight * part.slope
    return Tangent(value, slope)
