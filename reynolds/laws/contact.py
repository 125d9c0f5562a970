"""Contact of rough walls: Greenwood and Tripp by the exact integral, boundary friction, lambda ratio."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.special import ndtr

from reynolds.errors import FilmInputError
from reynolds.laws.law import Tangent, require_positive, within
from reynolds.numerics.arrays import Array
from reynolds.numerics.lanes import WIDTH, all_lanes, lanes, put_lanes

# Walls pressed together by more than six standard deviations beyond the mean planes of their summits: solid.
LOWEST_RATIO = -6.0
_PRESSURE_FACTOR = 16.0 * np.sqrt(2.0) * np.pi / 15.0
_TERMS = 80  # of the Chebyshev series of `gaussian_moment`


@dataclass(frozen=True)
class Asperities:
    """Rough walls by Greenwood and Tripp: two sheets of parabolic summits of Gaussian height.

    density: summits per area eta, 1/m2; radius: of the summits beta, m; height: standard deviation sigma of the
    summits' heights, both walls together, m; modulus E' of both walls (`composite_modulus`), Pa; friction_coefficient
    of the boundary layer, 1; summit_height: mean plane of the summits above the mean plane of the walls, from which the
    film h is counted, m; shear_limit: greatest stress of the boundary layer, Pa. Typical: eta beta sigma 0.03 .. 0.05,
    sigma/beta 1e-4 .. 1e-2. Raises FilmInputError for a value that is not positive.
    """

    density: float
    radius: float
    height: float
    modulus: float
    friction_coefficient: float
    summit_height: float = 0.0
    shear_limit: float = np.inf

    def __post_init__(self) -> None:
        require_positive(
            "asperities", density=self.density, radius=self.radius, height=self.height, modulus=self.modulus
        )
        if not (np.isfinite(self.friction_coefficient) and self.friction_coefficient >= 0.0):
            raise FilmInputError("asperities, friction_coefficient", f"{self.friction_coefficient:g}", "0 or more")
        if not np.isfinite(self.summit_height):
            raise FilmInputError("asperities, summit_height", f"{self.summit_height:g} m", "a finite height")
        if not self.shear_limit > 0.0:
            raise FilmInputError("asperities, shear_limit", f"{self.shear_limit:g} Pa", "positive")

    @property
    def roughness_product(self) -> float:
        """eta beta sigma, 1."""
        return self.density * self.radius * self.height

    @property
    def elastic_factor(self) -> float:
        """K = (16 sqrt2 pi/15) (eta beta sigma)^2 sqrt(sigma/beta), 1: contact pressure is K E' F5/2."""
        return float(_PRESSURE_FACTOR * self.roughness_product**2 * np.sqrt(self.height / self.radius))


def composite_modulus(modulus_1: float, poisson_1: float, modulus_2: float, poisson_2: float) -> float:
    """E' (Pa) of two walls, 1/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, as Greenwood and Tripp define it.

    The E' of elastohydrodynamic formulas is twice this one.
    """
    require_positive("composite modulus", modulus_1=modulus_1, modulus_2=modulus_2)
    return 1.0 / ((1.0 - poisson_1**2) / modulus_1 + (1.0 - poisson_2**2) / modulus_2)


def contact_pressure(asperities: Asperities, h: ArrayLike) -> Tangent:
    """p_c = K E' F5/2(H) (Pa) and dp_c/dh (Pa/m, negative) at film thickness h (m), H = (h - summits)/sigma.

    Source: Greenwood and Tripp 1970-71; Gaussian summits, elastic, real area much less than the nominal one.
    Raises FilmInputError below H = -6.
    """
    ratio, scale = _ratio(asperities, h), asperities.elastic_factor * asperities.modulus
    value, slope = gaussian_moment(2.5, ratio)
    return Tangent(scale * value, scale * slope / asperities.height)


def contact_area(asperities: Asperities, h: ArrayLike) -> Tangent:
    """Share of the nominal area in real contact, pi^2 (eta beta sigma)^2 F2(H), and its slope over h (1/m).

    Source: Greenwood and Tripp 1970-71. Raises FilmInputError below H = -6.
    """
    value, slope = gaussian_moment(2.0, _ratio(asperities, h))
    scale = (np.pi * asperities.roughness_product) ** 2
    return Tangent(scale * value, scale * slope / asperities.height)


def boundary_shear(asperities: Asperities, pressure: ArrayLike) -> Tangent:
    """Shear stress of the contacts, min(mu_b p_c, shear_limit) (Pa), against the sliding, and its slope over p_c.

    Pressure in Pa per nominal area, by `contact_pressure`. Raises FilmInputError for p_c < 0.
    """
    p = within("contact pressure", pressure, 0.0, np.inf, "Pa")
    sliding = asperities.friction_coefficient * p
    slope = np.where(sliding < asperities.shear_limit, asperities.friction_coefficient, 0.0)
    return Tangent(np.minimum(sliding, asperities.shear_limit), slope)


def lambda_ratio(h: ArrayLike, composite_roughness: float) -> Array:
    """h/sigma (1): above 3 to 4 the film carries the load, below 1 mostly the contacts (boundary lubrication)."""
    require_positive("lambda ratio", composite_roughness=composite_roughness)
    return np.asarray(h, dtype=float) / composite_roughness


def gaussian_moment(order: float, ratio: ArrayLike) -> Tangent:
    """F_n(H) = integral from H to infinity of (s - H)^n phi(s) ds, phi the standard normal density, and dF_n/dH.

    dF_n/dH = -n F_(n-1). Order n >= 1, H >= -6, else FilmInputError; relative error below 1e-11 (the half-order
    ones of scipy's parabolic cylinder functions have 1e-9, at ten times the cost).
    """
    h = within("Gaussian moment, H", ratio, LOWEST_RATIO, np.inf, "1")
    if order == 1.0:
        return Tangent(_moments(h, order)[0], -ndtr(-h))
    if order < 1.0:
        raise FilmInputError("Gaussian moment, order", f"{order:g}", "1 or more: below, it has no slope")
    value, slope = _moments(h, order, order - 1.0)
    return Tangent(value, -order * slope)


def _ratio(asperities: Asperities, h: ArrayLike) -> Array:
    return np.asarray((np.asarray(h, dtype=float) - asperities.summit_height) / asperities.height)


_MIDDLE = 6.0  # H + 6 = 6 is the middle of the mapped range


def _moments(h: Array, *orders: float) -> list[Array]:
    """F_n of some orders by their series. ln F_n + H^2/2 + (n + 1) ln(H + 12) is smooth on -6 .. infinity."""
    far = h - LOWEST_RATIO + _MIDDLE
    twice = np.zeros(-(-h.size // WIDTH) * WIDTH)
    twice[: h.size] = (2.0 - 4.0 * _MIDDLE / far).ravel()
    smooth = np.empty((len(orders), len(twice)))
    _chebyshev_sums(np.array([_series(order) for order in orders]), twice, smooth)
    square, logarithm = 0.5 * h * h, np.log(far)
    return [
        np.exp(part[: h.size].reshape(h.shape) - square - (order + 1.0) * logarithm)
        for part, order in zip(smooth, orders, strict=True)
    ]


@lru_cache(maxsize=16)
def _series(order: float) -> Array:
    """Chebyshev coefficients, from Gauss' quadrature at the nodes: t = u^2 removes the root from t^n.

    F_n e^(H^2/2) = integral of t^n e^(-t^2/2 - H t) dt/sqrt(2 pi); the part beyond t^2/2 + H t = 60 + 18 is
    below round-off (18 = H^2/2 at H = -6, where the integrand's peak is e^18).
    """
    node, weight = np.polynomial.legendre.leggauss(200)
    mapped = chebyshev.chebpts1(_TERMS)
    h = (LOWEST_RATIO + _MIDDLE * (1.0 + mapped) / (1.0 - mapped))[:, None]
    end = np.sqrt(2.0 * 60.0 / (h + np.sqrt(h**2 + 2.0 * 60.0)))
    u = 0.5 * end * (node + 1.0)
    integrand = u ** (2.0 * order + 1.0) * np.exp(-0.5 * u**4 - h * u**2)
    total = np.sum(weight * integrand, axis=1, keepdims=True) * end / np.sqrt(2.0 * np.pi)
    smooth = np.log(total) + (order + 1.0) * np.log(h - LOWEST_RATIO + _MIDDLE)
    return np.asarray(chebyshev.chebfit(mapped, smooth[:, 0], _TERMS - 1))


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def _chebyshev_sums(series: Array, twice: Array, out: Array) -> None:
    """out[s, i] = sum_k series[s, k] T_k(x_i) by Clenshaw's recurrence, `twice` = 2 x a whole number of eights."""
    for s in range(series.shape[0]):
        for i in range(0, len(twice), WIDTH):
            x = lanes(twice, i)
            one, two = all_lanes(twice, 0.0), all_lanes(twice, 0.0)
            for k in range(series.shape[1] - 1, 0, -1):
                one, two = all_lanes(twice, series[s, k]) + x * one - two, one
            put_lanes(out[s], i, all_lanes(twice, series[s, 0]) + all_lanes(twice, 0.5) * x * one - two)
