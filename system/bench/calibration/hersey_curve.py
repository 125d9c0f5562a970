"""Friction of the films over their Hersey number, by a fit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.simulator import LumpedBench
from system.description.gap import Gap
from system.effects.extension import Extension, Values
from system.effects.gap_states import bench_state, gap_courses
from system.effects.laws.contact import hersey, mixed_friction, stribeck_share
from system.estimation.posterior import Posterior
from system.pump.laws.friction_pairs import Pair
from system.pump.lumped import lumped_pairs

PAIRS: Mapping[Gap, Pair] = {
    Gap.PISTON: Pair.PISTON_CYLINDER,
    Gap.SLIPPER: Pair.SLIPPER_SWASH_PLATE,
    Gap.VALVE_PLATE: Pair.VALVE_PLATE_CYLINDER,
}
ENDS = (5.0, 95.0)  # percentiles of the numbers met under load that a curve runs between
STEP = 1e-4  # in xi, of slopes


@dataclass(frozen=True)
class HerseyCurve:
    """A pair's coefficient (K,) over the Hersey number mu v w/N (K,), with one sigma (K,); all pure numbers."""

    gap: Gap
    number: Array
    friction: Array
    sigma: Array


def hersey_curves(
    bench: LumpedBench, posterior: Posterior, laws: Sequence[Extension] = (), samples: int = 40
) -> tuple[HerseyCurve, ...]:
    """f = f_c + f_b exp(-(H/H0)^d) of the three films over the numbers met at a bench's points under load.

    `posterior` is a fit of the bench with `laws` on: `mixed_friction`, or without laws (f = f_c). Mixed friction by the
    pump's own [physics] adds to either. A chamber above half the delivery pressure is under load.
    """
    solved = bench.solved(posterior.values[: len(bench.parameters)])
    at, courses = solved.setting, solved.courses
    found = lumped_pairs(at.pump, at.point, at.motion, courses)
    gaps = gap_courses(at.pump, at.point, at.motion, courses, found)
    viscosity = bench_state(at.pump, at.point, bench.points.hours).viscosity
    stated = [values for law, values in bench.own_laws if law is mixed_friction]
    curves = []
    for gap in Gap:
        numbers = hersey(viscosity, gaps[gap])[courses.pressure > 0.5 * at.point.delivery_pressure]
        low, high = np.percentile(numbers[numbers > 0.0], ENDS)
        number = np.geomspace(low, high, samples)
        fixed = sum((_boundary(values, gap, number) for values in stated), np.zeros(samples))
        friction = fixed + _coefficient(posterior, laws, gap, number, posterior.xi)
        slopes = np.stack(
            [
                (fixed + _coefficient(posterior, laws, gap, number, posterior.xi + STEP * one) - friction) / STEP
                for one in np.eye(posterior.xi.size)
            ],
            axis=-1,
        )
        variance = np.einsum("ki,ij,kj->k", slopes, posterior.covariance, slopes)
        curves.append(HerseyCurve(gap, number, friction, np.sqrt(variance)))
    return tuple(curves)


def _coefficient(posterior: Posterior, laws: Sequence[Extension], gap: Gap, number: Array, xi: Array) -> Array:
    named = {one.name: one.value(float(at)) for one, at in zip(posterior.parameters, xi, strict=True)}
    found = np.full_like(number, named.get(f"friction.{PAIRS[gap].value}", 0.0))
    for law in laws:
        found = found + _boundary(law.stated(named), gap, number)
    return found


def _boundary(values: Values, gap: Gap, number: Array) -> Array:
    """Coefficient f_b exp(-(H/H0)^d) of a film by the values of `mixed_friction`."""
    return values[gap.value] * stribeck_share(number, values["hersey_scale"], values["exponent"])
