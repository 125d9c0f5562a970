"""The loss model after Zarotti and Nevegna (1981, 6th BHRA Fluid Power Symposium).

The regressors are as later authors cite them; the original was not at hand.
"""

from collections.abc import Callable

from reynolds.numerics.arrays import Array
from system.bench.loss_models.model import LossModel, LossModelName, Term, constant
from system.bench.loss_models.points import LossPoints


def _product(speed: int, pressure: int, ratio: int) -> Callable[[LossPoints], Array]:
    """x^speed y^pressure eps^ratio, x = w/w_rated and y = dp/p_rated."""

    def column(points: LossPoints) -> Array:
        x, y, z = points.scaled
        return x**speed * y**pressure * z**ratio

    return column


def _term(name: str, unit: str, *powers: int) -> Term:
    return Term(name, unit, _product(*powers))


ZAROTTI_NEVEGNA = LossModel(
    LossModelName.ZAROTTI_NEVEGNA,
    "after Zarotti-Nevegna",
    flow=(
        _term("C1", "m3/s", 0, 1, 0),
        _term("C2", "m3/s", 0, 2, 0),
        _term("C3", "m3/s", 1, 1, 0),
        _term("C4", "m3/s", 1, 1, 1),
        _term("C5", "m3/s", 1, 0, 2),
        _term("C6", "m3/s", 1, 0, 0),
    ),
    torque=(
        _term("C1", "N m", 0, 1, 0),
        _term("C2", "N m", 0, 1, 1),
        _term("C3", "N m", 1, 0, 0),
        _term("C4", "N m", 1, 0, 1),
        _term("C5", "N m", 2, 0, 2),
        _term("C6", "N m", 1, 1, 0),
        Term("C7", "N m", constant),
    ),
    source="after Zarotti and Nevegna 1981",
)
"""Q_L = C1 y + C2 y^2 + C3 x y + C4 eps x y + C5 eps^2 x + C6 x,
T_L = C1 y + C2 eps y + C3 x + C4 eps x + C5 eps^2 x^2 + C6 x y + C7; x = w/w_rated, y = dp/p_rated."""
