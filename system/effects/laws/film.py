"""Laws of the films: viscosity over pressure, temperature and shear rate; walls that deform or expand."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import GAPS, unchanged, warmed
from system.pump.film_thickness import LEAST_FILM
from system.pump.land_losses import slipper_way

THROTTLING_HEAT = 0.75
"""Of the work of throttling, that warms the oil: 1 - alpha T, alpha 6 to 8e-4 1/K of oils and of water in glycol.

0.45 K/MPa of a mineral oil.
"""
WARM_PASSES = 8
"""Rounds between a film's heat and its temperature: within 1 % of rises up to 30 K, and 5 % up to 60 K.

Always as many, so that a fit by differences sees a smooth law.
"""
THINNING = 0.04
"""1/K, of viscosity: mineral oils at 20 to 80 degC have .03 to .06."""
SMALL = 1e-9

Courses = Mapping[Gap, GapCourse]


def barus_flow(exponent: Array) -> Array:
    """(1 - exp(-a p))/(a p): flow through a film of falling pressure p .. 0 over that of constant viscosity.

    Barus 1893, mu = mu0 exp(a p); exact for plane and annular films. `exponent` a p, 0 or more; up to about 100
    MPa, beyond it Roelands' law rises less.
    """
    return np.asarray(np.where(exponent > SMALL, -np.expm1(-exponent) / np.maximum(exponent, SMALL), 1.0))


def barus_shear(exponent: Array) -> Array:
    """(exp(a p) - 1)/(a p): shear of a film whose pressure falls linearly from p to 0, over that without."""
    return np.asarray(np.where(exponent > SMALL, np.expm1(exponent) / np.maximum(exponent, SMALL), 1.0))


def opening_flow(opening: Array) -> Array:
    """((1 + c)^4 - 1)/(4 c): flow through a film that opens by the share c at full pressure.

    The mean of (h/h0)^3 along a pressure that falls linearly and lifts the wall in proportion.
    """
    return np.asarray(np.where(opening > SMALL, ((1.0 + opening) ** 4 - 1.0) / np.maximum(4.0 * opening, SMALL), 1.0))


def cross_ratio(shear_rate: Array, drop: float, rate: float) -> Array:
    """Viscosity at a shear rate (1/s) over that at rest: Cross 1965 with exponent 1, `drop` lost at high rates."""
    relative = shear_rate / rate
    return np.asarray(1.0 - drop * relative / (1.0 + relative))


def viscosity_pressure(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Barus' law in all three films: `coefficient` 1/Pa. Less leakage at high pressure, more shear under it."""
    exponents = [values["coefficient"] * np.maximum(courses[gap].pressure, 0.0) for gap in GAPS]
    return _in_films(courses, state, [barus_flow(own) for own in exponents], [barus_shear(own) for own in exponents])


@dataclass(frozen=True)
class ElasticOpening:
    """The law of one gap that opens under its pressure: `opening` 1/Pa, of the film's thickness."""

    gap: Gap

    def __call__(self, values: Values, courses: Courses, state: BenchState) -> Effects:
        """The effects with these values."""
        share = values["opening"] * np.maximum(courses[self.gap].pressure, 0.0)
        return in_one_film(self.gap, courses, state, opening_flow(share), 1.0 / (1.0 + 0.5 * share))


@dataclass(frozen=True)
class ThermalClearance:
    """The law of one gap whose walls expand differently: `rate` 1/K of the film, from the pump's own temperature on."""

    gap: Gap

    def __call__(self, values: Values, courses: Courses, state: BenchState) -> Effects:
        """The effects with these values."""
        warmer = state.temperature - state.geometry.operating.temperature
        film = np.maximum(1.0 + values["rate"] * warmer, LEAST_FILM)[:, None] * np.ones_like(courses[self.gap].film)
        return in_one_film(self.gap, courses, state, film**3, 1.0 / film)


def shear_thinning(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Cross' law at the shear rate speed/film of sliding: `drop`, and `rate` 1/s at which half of it is lost.

    Reduces the viscosity of shear alone: leakage flows at rates a tenth as high, and across the sliding.
    """
    shear = [
        cross_ratio(courses[gap].sliding_speed / courses[gap].film, values["drop"], values["rate"]) for gap in GAPS
    ]
    return _in_films(courses, state, [np.ones_like(own) for own in shear], shear)


def film_heating(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Films warmer than the case: heat of loss and throttling, less the heat to walls and oil.

    `piston`, `slipper`, `valve_plate` R (m2 K/W): resistance through the gap's walls to the case;
    `carried_share`, `throttled_share`, `carry_over`: `HeatShares`. Mean rise of a film over the turn by
    `film_rise`; viscosity at that temperature holds for leakage and shear, both in balance with it.
    """
    shares = HeatShares(values["carried_share"], values["throttled_share"], values["carry_over"])
    ratios = []
    for gap in GAPS:
        ratio = warmed(state, film_rise(values[gap.value], shares, courses[gap], state))
        ratios.append(ratio[:, None] * np.ones_like(courses[gap].film))
    return _in_films(courses, state, [1.0 / ratio for ratio in ratios], ratios)


@dataclass(frozen=True)
class HeatShares:
    """Shares of a film's heat by path, each 0 to 1; the defaults are those of films solved with heat.

    carried: share of the heat that leaves with the oil before it reaches a wall; throttled: share of the heat of
    throttling that warms the film above the case: 1 where oil enters at the case's temperature, less from cooler
    chambers; carry_over: share of the film's own warm oil in the oil that sliding draws in (Ettles 1969: .7 to .9 of
    pads).
    """

    carried: float = 0.0
    throttled: float = 1.0
    carry_over: float = 0.0


def film_rise(resistance: float, shares: HeatShares, own: GapCourse, state: BenchState) -> Array:
    """Kelvin (N,) by which a film is warmer than the case: heat P over G = A/R to the walls and C with the oil.

    P: the pair's loss, Coulomb and shear, and q THROTTLING_HEAT of the work of throttling; C = rho c (leakage + (1 - k)
    h U w/2, the cool oil that sliding draws in over the width w). theta = P/(G + C), of which s P leaves with the oil
    alone: theta = P (1 + s G/C)/(G + C). s, q, k of `shares`. Solved by Newton's method with viscosity falling by
    THINNING a kelvin.
    """
    oil, area = state.geometry.oil, own.land_area
    heat = oil.density * oil.specific_heat
    drawn = (1.0 - shares.carry_over) * heat * 0.5 * own.width * (own.film * own.sliding_speed).mean(axis=1)
    leaked = heat * np.abs(own.leakage).mean(axis=1)
    throttled = shares.throttled * THROTTLING_HEAT * (own.leakage * own.pressure).mean(axis=1)
    rubbed, sheared = own.coulomb.mean(axis=1), own.viscous.mean(axis=1)
    rise = np.zeros_like(area)
    for _ in range(WARM_PASSES):
        ratio = warmed(state, rise)
        carried = drawn + leaked / ratio
        kept = (resistance + shares.carried * area / carried) / (area + resistance * carried)
        image = (rubbed + ratio * sheared + throttled / ratio) * kept
        rise = rise + (image - rise) / (1.0 + THINNING * image)
    return rise


def in_one_film(gap: Gap, courses: Courses, state: BenchState, flow: Array, shear: Array) -> Effects:
    """Effects of a factor on one gap's flow and one on its shear."""
    ones = np.ones_like(flow)
    return _in_films(
        courses, state, [flow if own is gap else ones for own in GAPS], [shear if own is gap else ones for own in GAPS]
    )


def _in_films(courses: Courses, state: BenchState, flows: list[Array], shears: list[Array]) -> Effects:
    """Effects of factors (N, M) on the flow through each gap's lands and on its shear.

    The slipper's orifice has its share of the pressure as before; the ring's shear is that of all chambers, so it
    uses the turn's mean.
    """
    behind = GAPS.index(Gap.SLIPPER)
    ring = GAPS.index(Gap.VALVE_PLATE)
    flows[behind] = through_orifice(flows[behind], state)
    shears[ring] = np.broadcast_to(shears[ring].mean(axis=1, keepdims=True), shears[ring].shape)
    return replace(unchanged(courses), conductance=np.stack(flows), viscous=np.stack(shears))


def through_orifice(lands: Array, state: BenchState) -> Array:
    """Factor on a slipper's leakage for `lands` times the flow through its lands: Eq. (16).

    With edges and bore by files (`land_losses.slipper_way`).
    """
    slipper = state.geometry.slipper
    log_ratio, bore = slipper_way(slipper)
    d4, h3 = slipper.orifice_diameter**4, slipper.film_thickness**3
    share = 128.0 * h3 * bore
    share /= share + 6.0 * d4 * log_ratio
    return np.asarray(1.0 / ((1.0 - share) / lands + share))
