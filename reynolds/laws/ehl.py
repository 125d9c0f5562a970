"""Film thickness of elastohydrodynamic point contacts by formula: Hamrock-Dowson, and the groups of Moes.

Dimensionless groups: speed U = mu0 u/(E' R), load W = F/(E' R^2), material G = alpha E', film H = h/R, with u the
mean speed of the walls, R the reduced radius along the motion and, other than in `contact`, E' = 2/[(1 - nu1^2)/E1
+ (1 - nu2^2)/E2]. Validity: fully flooded, isothermal, Newtonian, elastic-piezoviscous; ellipticity 1 .. 8.
"""

import numpy as np
from numpy.typing import ArrayLike

from reynolds.laws.law import within
from reynolds.numerics.arrays import Array


def hamrock_dowson_minimum(speed: ArrayLike, material: ArrayLike, load: ArrayLike, ellipticity: ArrayLike) -> Array:
    """Hmin = 3.63 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k)). Source: Hamrock and Dowson 1977, part III.

    Raises FilmInputError for an ellipticity outside 1 .. 8 (the fit's own range).
    """
    u, g, w = (np.asarray(group, dtype=float) for group in (speed, material, load))
    k = within("Hamrock-Dowson, ellipticity", ellipticity, 1.0, 8.0, "1")
    return np.asarray(3.63 * u**0.68 * g**0.49 * w**-0.073 * (1.0 - np.exp(-0.68 * k)))


def hamrock_dowson_central(speed: ArrayLike, material: ArrayLike, load: ArrayLike, ellipticity: ArrayLike) -> Array:
    """Hc = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k)). Source: Hamrock and Dowson 1977, part III.

    Raises FilmInputError for an ellipticity outside 1 .. 8 (the fit's own range).
    """
    u, g, w = (np.asarray(group, dtype=float) for group in (speed, material, load))
    k = within("Hamrock-Dowson, ellipticity", ellipticity, 1.0, 8.0, "1")
    return np.asarray(2.69 * u**0.67 * g**0.53 * w**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k)))


def moes(speed: ArrayLike, material: ArrayLike, load: ArrayLike) -> tuple[Array, Array]:
    """The two groups on which a point contact's film depends: M = W (2U)^(-3/4), L = G (2U)^(1/4).

    Source: Moes 1992, Venner 1991. The film in these groups is H (2U)^(-1/2).
    """
    twice = 2.0 * np.asarray(speed, dtype=float)
    load_group = np.asarray(load, dtype=float) * twice**-0.75
    return np.asarray(load_group), np.asarray(np.asarray(material, dtype=float) * twice**0.25)
