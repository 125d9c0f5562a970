"""Slopes of the dissipation: of the flow that pressure drives, of sliding and of mixing at the ends of a cavity."""

from __future__ import annotations

import numpy as np

from reynolds.adjoint.solved import OutputSlopes, SolvedFilm, slopes_of
from reynolds.equation.balance import cavity_density, steep_gradient, stiffness
from reynolds.equation.coefficients import Tensor, along, isotropic, times
from reynolds.equation.hourglass import hourglass_slope, signs
from reynolds.equation.thickness_kernels import levered
from reynolds.fem import kernels
from reynolds.laws.contact import boundary_shear, contact_pressure
from reynolds.laws.roughness import pressure_factors, sliding_factor
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import dissipated


def heat_slopes(film: SolvedFilm) -> OutputSlopes:
    """Heat of the film, W, as `Loads.dissipation`, and its slopes."""
    solution = film.solution
    driven, sliding = dissipated(solution)
    value = float(np.sum((driven + sliding) * film.weight)) + float(
        np.sum(solution.pressure * solution.upwind_exchange)
    )
    by_pressure, by_film = _driven(film)
    of_sliding, more = _sliding(film)
    by_fraction = film.on_unknowns(of_sliding)
    by_pressure += film.on_unknowns(film.filled * of_sliding * film.thickening) + solution.upwind_exchange
    by_gap = film.widening * (by_film + more) + _rubbing(film) + film.balance.mixing_lever(solution.pressure)
    if film.balance.mixes:
        by_fraction += cavity_density(film.problem) * _exchanged(film, film.parts.diffusion, solution.pressure)
    return slopes_of(film, value, by_pressure=by_pressure, by_fraction=by_fraction, by_gap=by_gap)


def _driven(film: SolvedFilm) -> tuple[Array, Array]:
    """Slopes of p . K p, K of the conductance at local density: by pressure (size,), by film (cells, points)."""
    pressure, (tensor, steeper) = film.solution.pressure, _conductance(film)
    weighted = times(tensor, film.weight)
    by_pressure = 2.0 * _exchanged(film, stiffness(film.space, weighted), pressure)
    if film.thickening.any():
        less = times(weighted, np.broadcast_to(-film.thickening, film.space.area.shape))
        by_pressure += film.on_unknowns(_heat_of(film, weighted, less))
    return by_pressure, _heat_of(film, weighted, times(steeper, film.weight))


def _conductance(film: SolvedFilm) -> tuple[Tensor, Tensor]:
    """Conductance (m3/(Pa s)) without the density ratio, and its slope by the film."""
    oil, surface = film.film, film.problem.surface
    smooth, steeper = oil.thickness**3 / (12.0 * oil.viscosity), 3.0 / oil.thickness
    if surface is None:
        return isotropic(smooth), isotropic(smooth * steeper)
    factor = pressure_factors(surface, oil.thickness)
    if factor.x is factor.y:
        return (isotropic(smooth * factor.x.value), isotropic(smooth * (factor.x.slope + steeper * factor.x.value)))
    x, xy, y = (smooth * part.value for part in factor)
    x_slope, xy_slope, y_slope = (smooth * (part.slope + steeper * part.value) for part in factor)
    return (x, y, xy), (x_slope, y_slope, xy_slope)


def _heat_of(film: SolvedFilm, conductance: Tensor, slope: Tensor) -> Array:
    """Growth of p . K p by a growth `slope` of the conductance at each point, (cells, points)."""
    space, tensors, pressure = film.space, film.space.tensors, film.solution.pressure
    driven = along(slope, steep_gradient(space, pressure))
    mode = hourglass_slope(space, conductance, slope, pressure)
    nothing, out = np.zeros(space.area.shape), np.empty(space.area.shape)
    levered(
        space.dofs, tensors.shape, space.reference.value, tensors.steep_gradient, tensors.gradient, signs(space),
        space.area, *(space.everywhere(part) for part in (*driven, mode)), nothing, nothing, nothing,
        np.zeros(space.size), pressure, *space.reference.loops, out,
    )  # fmt: skip
    return out


def _sliding(film: SolvedFilm) -> tuple[Array, Array]:
    """Heat of sliding at each point of a full film, (cells, points) W, and its slope by the film, W/m."""
    oil, surface = film.film, film.problem.surface
    square = (film.slip[0] ** 2 + film.slip[1] ** 2) * film.space.area * film.weight
    heat = oil.sliding_viscosity * square / oil.thickness
    if surface is None:
        return heat, -film.filled * heat / oil.thickness
    factor = sliding_factor(surface, oil.thickness)
    return heat * factor.value, film.filled * heat * (factor.slope - factor.value / oil.thickness)


def _rubbing(film: SolvedFilm) -> Array | float:
    """Slope of the contact's heat by the gap at the points."""
    asperities = film.problem.asperities
    if asperities is None:
        return 0.0
    bears = contact_pressure(asperities, film.solution.gap)
    rubs = boundary_shear(asperities, bears.value).slope * bears.slope
    return rubs * np.hypot(*film.slip) * film.space.area * film.weight


def _exchanged(film: SolvedFilm, coupling: Array, level: Array) -> Array:
    """A level for a symmetric matrix A with rows of sum zero, (size,)."""
    pattern, out, size = film.space.pattern, np.zeros(film.space.size), np.zeros(film.space.size)
    kernels.exchange(pattern.indptr, pattern.indices, coupling, level, out, size)
    return out
