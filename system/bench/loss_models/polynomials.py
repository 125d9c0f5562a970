"""Loss models that are polynomials of speed, pressure and displacement: after Ivantysyn, and Polymod.

Written in shifted Legendre polynomials of w/w_rated, dp/p_rated and eps, which span the same functions as powers
do and lose no digits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

from numpy.polynomial.legendre import legval

from reynolds.numerics.arrays import Array
from system.bench.loss_models.model import LossModel, LossModelName, Term
from system.bench.loss_models.points import LossPoints


@dataclass(frozen=True)
class Orders:
    """Highest power of speed, pressure difference and displacement ratio."""

    speed: int
    pressure: int
    ratio: int

    @property
    def powers(self) -> tuple[tuple[int, int, int], ...]:
        """All triples of powers up to these."""
        ranges = (range(order + 1) for order in (self.speed, self.pressure, self.ratio))
        return tuple((i, j, k) for i, j, k in product(*ranges))


def polynomial(name: LossModelName, label: str, flow: Orders, torque: Orders, source: str) -> LossModel:
    """The model whose losses are full tensor polynomials of these orders."""
    return LossModel(name, label, _terms(flow, "m3/s"), _terms(torque, "N m"), source)


def ivantysyn() -> LossModel:
    """After Ivantysyn and Ivantysynova (2001): all products of powers 0 to 2, 27 coefficients a loss."""
    second = Orders(2, 2, 2)
    source = "after Ivantysyn and Ivantysynova 2001"
    return polynomial(LossModelName.IVANTYSYN, "after Ivantysyn", second, second, source)


def polymod(flow: Orders, torque: Orders) -> LossModel:
    """After Mikeska and Ivantysynova (2002, Bath workshop): orders as the readings support them."""
    return polynomial(LossModelName.POLYMOD, "after Polymod", flow, torque, "after Mikeska and Ivantysynova 2002")


def _terms(orders: Orders, unit: str) -> tuple[Term, ...]:
    return tuple(Term(f"k{i}{j}{k}", unit, _legendre(i, j, k)) for i, j, k in orders.powers)


def _legendre(*degrees: int) -> Callable[[LossPoints], Array]:
    def column(points: LossPoints) -> Array:
        x, y, z = (
            legval(2.0 * scaled - 1.0, [0.0] * degree + [1.0])
            for scaled, degree in zip(points.scaled, degrees, strict=True)
        )
        return x * y * z

    return column
