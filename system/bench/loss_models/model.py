"""A loss model: terms of a flow and of a torque loss, each a coefficient times a column over the points."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.loss_models.points import LossPoints


class LossModelName(Enum):
    """The models by name."""

    WILSON = "wilson"
    SCHLOSSER = "schlosser"
    MCCANDLISH_DOREY = "mccandlish_dorey"
    ZAROTTI_NEVEGNA = "zarotti_nevegna"
    IVANTYSYN = "ivantysyn"
    POLYMOD = "polymod"


@dataclass(frozen=True)
class Term:
    """One term: its coefficient's name and unit, its column (N,), and whether the coefficient can only be >= 0."""

    name: str
    unit: str
    column: Callable[[LossPoints], Array]
    positive: bool = False


@dataclass(frozen=True)
class LossModel:
    """Q_2 = eps D w - sum of flow terms, T = eps D dp + sum of torque terms; `source` names author and year."""

    name: LossModelName
    label: str
    flow: tuple[Term, ...]
    torque: tuple[Term, ...]
    source: str


def columns(terms: Sequence[Term], points: LossPoints) -> Array:
    """(N, k), the terms' columns side by side, in the unit of the loss over that of each coefficient."""
    return np.stack([np.broadcast_to(term.column(points), points.speed.shape) for term in terms], axis=-1)


def laminar_slip(points: LossPoints) -> Array:
    """D dp/mu in m3/s: leakage through gaps of constant thickness."""
    return points.per_radian * points.pressure_difference / points.viscosity


def viscous_drag(points: LossPoints) -> Array:
    """D mu w in N m: shear of films of constant thickness."""
    return points.per_radian * points.viscosity * points.speed


def coulomb_drag(points: LossPoints) -> Array:
    """D dp in N m: friction in proportion to the load."""
    return points.per_radian * points.pressure_difference


def constant(points: LossPoints) -> Array:
    """1."""
    return np.ones_like(points.speed)
