"""Slopes of the flow balance by the film's thickness at constant pressures and film fractions, and their transpose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.balance import FilmState, Operators, cavity_density, density, steep_gradient
from reynolds.equation.coefficients import along, at_points
from reynolds.equation.hourglass import hourglass_slope, signs
from reynolds.equation.thickness_kernels import levered, mixed_levered, mixed_more, thicken
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, FilmProblem


@dataclass(frozen=True)
class ThicknessSlopes:
    """dR/dh at one state, h the film at each quadrature point: between elastic walls the gap there."""

    problem: FilmProblem
    parts: Operators
    state: FilmState

    def load(self, thicker: Array) -> Array:
        """dR/dq_j of a film that grows by `thicker` (cells, points, k) per unit of q_j, (size, k) m3/s."""
        space = self.problem.space
        out = np.empty((space.size, thicker.shape[2]))
        thicken(*self._flows, thicker, *space.reference.loops, out)
        if self.mixes:
            mixed_more(*self._mixing[0], thicker, *space.reference.loops, *self._mixing[1], out)
        return out

    def lever(self, weight: Array) -> Array:
        """sum_i weight_i dR_i/dh at each quadrature point, (cells, points) m2/s; `weight` (size,) without unit."""
        space = self.problem.space
        out = np.empty(space.area.shape)
        levered(*self._flows, weight, *space.reference.loops, out)
        if self.mixes:
            mixed_levered(*self._mixing[0], weight, *space.reference.loops, *self._mixing[1], out)
        return out

    def mixing_lever(self, weight: Array) -> Array:
        """The same of the upwinding's exchange alone."""
        space = self.problem.space
        out = np.zeros(space.area.shape)
        if self.mixes:
            mixed_levered(*self._mixing[0], weight, *space.reference.loops, *self._mixing[1], out)
        return out

    def squeeze_lever(self, weight: Array) -> Array:
        """sum_i weight_i dR_i by the squeeze velocity at each quadrature point, (cells, points) m2."""
        space = self.problem.space
        return np.asarray(
            self.parts.transport.content_slope * space.area * at_points(space, weight * self._stored_filling)
        )

    @cached_property
    def _stored_filling(self) -> Array:
        """Filling of the growing volume at each unknown, (size,), as `balance.flow_balance` has it."""
        ratio = density(self.problem, self.state.pressure)[0]
        return np.where(self.parts.rate > 0.0, self.state.film_fraction * ratio, ratio)

    @cached_property
    def _flows(self) -> tuple[NDArray[Any], ...]:
        problem, state = self.problem, self.state
        space, terms, tensors = problem.space, self.parts.transport, problem.space.tensors
        filling = state.film_fraction * density(problem, state.pressure)[0]
        driven = along(terms.conductance_slope, steep_gradient(space, state.pressure))
        mode = hourglass_slope(space, terms.conductance, terms.conductance_slope, state.pressure)
        full = at_points(space, filling)
        convected = (full * part for part in terms.flux_slope)
        per_second = terms.squeeze_slope
        if problem.storage is not None:
            per_second = per_second + terms.content_slope / problem.storage.step
        fields = (space.everywhere(part) for part in (*driven, mode, *convected, per_second))
        return (
            space.dofs, tensors.shape, space.reference.value, tensors.steep_gradient, tensors.gradient, signs(space),
            space.area, *fields, self._stored_filling,
        )  # fmt: skip

    @property
    def mixes(self) -> bool:
        """True where upwinding's diffusion, which grows with the walls' flow, exchanges oil."""
        return self.problem.cavitation is Cavitation.JFO and bool(np.any(self.state.film_fraction != 1.0))

    @cached_property
    def _mixing(self) -> tuple[tuple[NDArray[Any], ...], tuple[NDArray[Any], ...]]:
        space, parts = self.problem.space, self.parts
        slope = (space.everywhere(part) for part in parts.transport.flux_slope)
        cells = space.dofs, space.pattern.slots, space.tensors.shape, space.reference.value, space.tensors.gradient
        level = cavity_density(self.problem) * self.state.film_fraction
        return (*cells, *slope), (
            space.pattern.indptr, space.pattern.indices, *parts.convection, parts.leaves, level,
        )  # fmt: skip
