"""Iterates of the film solver: states, their balance, and steps between them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.balance import Balance, FilmState, Operators, flow_balance, operators
from reynolds.equation.deformation import deformation
from reynolds.errors import FilmInputError, FilmNotConverged, InputError
from reynolds.fem import kernels
from reynolds.laws.fluid import CONSTANT
from reynolds.numerics.array_kernels import all_finite, largest_share
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem
from reynolds.solve.boundary import BoundaryValues

MOST_HALVINGS = 10
LEAST_GAIN = 1e-4  # of the balance, by a full step


@dataclass(frozen=True)
class Iterate:
    """A state, its cavity and the balance there.

    `signed` (size,) Pa: pressure above cavitation pressure where it is positive, else the cavity's lack of oil as
    a pressure (see `newton.signed_after`).
    """

    signed: Array
    state: FilmState
    cavity: NDArray[np.bool_]
    parts: Operators
    balance: Balance


def is_linear(problem: FilmProblem) -> bool:
    """True if the balance is linear in pressures and film fractions, with constant operators."""
    return problem.fluid is CONSTANT and problem.walls is None


def deformed(problem: FilmProblem, pressure: Array, fraction: Array, near: Array | None = None) -> FilmState:
    """The state of nodal pressures and film fractions with the deformation (`near`: a guess of it)."""
    return FilmState(pressure, fraction, deformation(problem, pressure, near))


def iterate_of(
    problem: FilmProblem, state: FilmState, cavity: NDArray[np.bool_], signed: Array | None = None
) -> Iterate:
    """The iterate at a state, its operators and balance computed; `signed` where it is known."""
    parts = operators(problem, state)
    if signed is None:
        signed = state.pressure - problem.cavitation_pressure
        if problem.cavitation is Cavitation.JFO and cavity.any():
            signed = np.where(cavity, (state.film_fraction - 1.0) * parts.lack, signed)
    return Iterate(signed, state, cavity, parts, flow_balance(problem, parts, state))


def iterate_at(problem: FilmProblem, setting: BoundaryValues, before: Iterate, signed: Array) -> Iterate:
    """The iterate of signed unknowns: each a pressure where positive, else a cavity."""
    if not all_finite(signed):
        raise FilmNotConverged("pressures that grow without bound", "stiffer walls, or a thicker film")
    level = problem.cavitation_pressure
    pressure, fraction = signed + level, setting.film_fraction
    cavity = np.zeros(len(signed), dtype=bool)
    if problem.cavitation is not Cavitation.NONE:
        cavity = (signed < 0.0) & ~setting.held
        pressure = np.maximum(pressure, level)
    if problem.cavitation is Cavitation.JFO and cavity.any():
        fraction = np.where(cavity, 1.0 + signed / before.parts.lack, fraction)
    pressure = np.where(setting.held, setting.pressure, pressure)
    if is_linear(problem):
        state = FilmState(pressure, fraction, before.state.deformation)
        return Iterate(signed, state, cavity, before.parts, flow_balance(problem, before.parts, state))
    return iterate_of(problem, deformed(problem, pressure, fraction, before.state.deformation), cavity, signed)


def advanced(problem: FilmProblem, setting: BoundaryValues, at: Iterate, signed: Array, *, downhill: bool) -> Iterate:
    """The iterate after a step, cut where no film would be left or a law would not hold.

    `downhill` cuts it further until it reduces the imbalance; where no share does, the best of those tried. Raises
    as the laws do where even the shortest step leaves their range.
    """

    def rest(there: Iterate) -> float:
        return float(np.abs(with_pockets(setting, there)[0][~setting.held]).sum())

    before, best, fault = rest(at) if downhill else np.inf, None, None
    for halvings in range(MOST_HALVINGS):
        share = 0.5**halvings
        try:
            new = iterate_at(problem, setting, at, at.signed + share * (signed - at.signed))
        except (InputError, FilmNotConverged) as reason:
            fault = reason
            continue
        if not downhill:
            return new
        left = rest(new)
        if left < (1.0 - LEAST_GAIN * share) * before:
            return new
        if best is None or left < best[0]:
            best = left, new
    if best is None:
        assert fault is not None
        raise fault
    return best[1]


def imbalance_of(problem: FilmProblem, setting: BoundaryValues, at: Iterate) -> float:
    """Largest residual of a free unknown over the flows that meet there."""
    rest, slope = with_pockets(setting, at)
    size = at.balance.flow_scale
    if setting.pockets:
        size = size + np.abs(at.balance.net - rest) + kernels.ROUNDING * np.abs(slope * at.state.pressure)
    if problem.cavitation is Cavitation.JFO and at.cavity.any():
        # A film fraction near zero is one minus nearly one, exact to the last place of one.
        size = size + np.where(at.cavity, kernels.ROUNDING * at.parts.brim, 0.0)
    # Round-off of a solve is that of its largest flows, and counts where next to nothing flows.
    return largest_share(rest, size, kernels.ROUNDING, fixed_in(problem, setting, at))


def fixed_in(problem: FilmProblem, setting: BoundaryValues, at: Iterate) -> NDArray[np.bool_]:
    """Unknowns without a step: held ones, and those that Reynolds' condition holds."""
    return setting.held | at.cavity if problem.cavitation is Cavitation.REYNOLDS else setting.held


def with_pockets(setting: BoundaryValues, at: Iterate) -> tuple[Array, Array]:
    """The balance less the pockets' feeds, and their part of the diagonal."""
    return pocket_feeds(setting, at.balance.net, at.state.pressure)


def pocket_feeds(setting: BoundaryValues, net: Array, pressure: Array) -> tuple[Array, Array]:
    """A balance (size,) m3/s less the pockets' feeds at pressures (size,) Pa, and their part of the diagonal."""
    rest, gain = net.copy() if setting.pockets else net, np.zeros(len(net))
    for node, pocket in setting.pockets:
        inflow, slope = pocket.feed(pressure[node])
        if not (np.isfinite(inflow) and np.isfinite(slope)):
            found = f"{inflow:g} m3/s, slope {slope:g}, at {pressure[node]:.4g} Pa"
            raise FilmInputError("feed of a pocket", found, "finite numbers at any pressure")
        rest[node] -= inflow
        gain[node] = -slope
    return rest, gain
