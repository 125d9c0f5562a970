"""One step of Newton's method: the balance linearised for the change of every pressure or film fraction."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds.equation.balance import NOTHING, by_deformation, flow_balance, slopes
from reynolds.equation.deformation import deformation_slope
from reynolds.equation.deformation_sparsity import ElasticPatterns
from reynolds.fem import kernels
from reynolds.linear.elastic import Answer, NearFactor, WallBalance, compliant_answer
from reynolds.numerics.array_kernels import scaled_free
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem
from reynolds.solve.boundary import BoundaryValues
from reynolds.solve.iterate import Iterate, fixed_in, with_pockets

TIE = 1e-9  # of the flow scale of an unknown


def symmetric_step(
    problem: FilmProblem, setting: BoundaryValues, at: Iterate, fixed: NDArray[np.bool_]
) -> tuple[csc_array, Array]:
    """Upper triangle and right-hand side for the change of pressure, identity where fixed."""
    rest, gain = with_pockets(setting, at)
    # Conductances are 1e-15 to 1e-9: scaled to order one they stay above any pivot threshold.
    scale = float(at.parts.stiffness.max()) or float(gain.max()) or 1.0  # a film of pockets alone has no conductance
    data = np.empty_like(at.parts.stiffness)
    pattern = problem.space.pattern
    kernels.hold(pattern.indptr, pattern.indices, at.parts.stiffness, 1.0 / scale, fixed, gain, data)
    return problem.space.matrix(data), scaled_free(rest, -1.0 / scale, fixed)


def general_step(problem: FilmProblem, setting: BoundaryValues, at: Iterate) -> tuple[Array, Array, Array, float]:
    """Upper triangle, mirror and right-hand side for the change of pressure or, in the cavity, film fraction.

    Scaled to order one; the last value turns an unknown of the cavity into a film fraction.
    """
    rest, gain = with_pockets(setting, at)
    fixed = fixed_in(problem, setting, at)
    by = slopes(problem, at.parts, at.state)
    f_upper, f_lower, f_gain = by.by_fraction
    p_upper, p_lower, p_gain = by.by_pressure
    unit = _largest(at.parts.stiffness) or 1.0
    largest = max(_largest(f_upper), _largest(f_gain))
    scale = unit / largest if largest > 0.0 else 1.0
    # Without wall motion a cavity's film fraction stays constant.
    least = NOTHING * (largest if largest > 0.0 else unit)
    pattern = problem.space.pattern
    f_gain = f_gain + np.where(f_upper[pattern.diagonal] + f_gain < least, least, 0.0)
    upper, lower = np.empty_like(p_upper), np.empty_like(p_upper)
    kernels.choose_columns(
        pattern.indptr, pattern.indices, p_upper, p_lower, f_upper, f_lower, p_gain + gain, f_gain,
        fixed, at.cavity, 1.0 / unit, scale / unit, upper, lower,
    )  # fmt: skip
    return upper, lower, scaled_free(rest, -1.0 / unit, fixed), scale


def _largest(values: Array) -> float:
    """Largest magnitude."""
    return float(max(values.max(), -values.min()))


def compliant(
    problem: FilmProblem,
    setting: BoundaryValues,
    at: Iterate,
    upper: Array,
    lower: Array,
    patterns: ElasticPatterns,
    near: NearFactor,
) -> Answer:
    """The general step between elastic walls, dR/dp + dR/dh dh/dp, for any load.

    `patterns` are those of the mesh, `near` keeps a factor for later steps. Raises FilmNotConverged where
    the step is singular.
    """
    free = (~fixed_in(problem, setting, at)).astype(float)
    rows = free / np.abs(at.parts.stiffness).max()
    slope = by_deformation(problem, at.parts, at.state, rows, patterns.deformation)
    rigid, wider = patterns.full_matrix(upper, lower), deformation_slope(problem, at.state.deformation)
    return compliant_answer(WallBalance(rigid, slope, wider, free * ~at.cavity), near)


def signed_after(problem: FilmProblem, at: Iterate, change: Array, scale: float) -> Array:
    """The signed unknowns (size,) Pa after a step.

    In the cavity the lack of oil 1 - theta, or the oil that Reynolds' condition creates, as the pressure that
    would move as much: slopes of the balance by a signed unknown are then alike on both sides of zero.
    """
    level = problem.cavitation_pressure
    if not at.cavity.any():
        return at.state.pressure + change - level
    pressure = at.state.pressure + np.where(at.cavity, 0.0, change)
    if problem.cavitation is Cavitation.JFO:
        lack = at.state.film_fraction + scale * change - 1.0
        return np.where(at.cavity, lack * at.parts.lack, pressure - level)
    balance = flow_balance(problem, at.parts, replace(at.state, pressure=pressure))
    # A node of zero balance (except for round-off) would otherwise enter and leave the cavity indefinitely.
    made = (balance.net + TIE * balance.flow_scale) / at.parts.stiffness[problem.space.pattern.diagonal]
    return np.where(at.cavity, -made, pressure - level)
