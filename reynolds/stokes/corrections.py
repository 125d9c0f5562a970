"""Corrections of the film equation at jumps of the section: extra film length and loss factor, from solved flows.

Where a film meets a step, a groove or a pipe the pressure falls by more than by the film equation,

    dp = c mu u (L + extra_length h)/h^2 + loss_factor rho u^2/2,   c = 12 (film, slot), 32 (bore: h its diameter)

with h the thinner film's thickness and u the mean velocity there. The extra length is Stokes flow's, the loss
factor is inertia's at one Reynolds number Re = u h/nu. All are ratios: flows are solved with h, u and mu of one,
where the density is Re. dp is between static pressures: energy recovered in a wider film behind is a gain.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.stokes.flow import (
    Flow,
    FlowProblem,
    HeldVelocities,
    held,
    solve_navier_stokes,
    solve_stokes,
    straight,
    together,
)
from reynolds.stokes.meshes import groove_mesh, orifice_mesh, step_mesh
from reynolds.stokes.results import mean_pressure
from reynolds.stokes.space import StokesSpace, Symmetry, taylor_hood

FILM, BORE = 12.0, 32.0
"""The c of a developed flow between planes (Reynolds 1886) and in a pipe (Poiseuille 1846)."""
SETTLED = 3.0
"""Film thicknesses in which Stokes flow is a film's again: the remainder falls by exp(-4.2 x/h) (Fadle 1940)."""
SETTLED_BY_INERTIA = 0.15
"""Further film thicknesses behind an edge for each unit of Re."""
REACHES = 1.0, 4.0
"""Lengths of the pipes before and behind an orifice over their half width."""
CREEPING = 0.01
"""Reynolds number at which the loss factor's limit at zero is read: large enough to be free of round-off."""


@dataclass(frozen=True)
class Correction:
    """Extra length and the loss factors (K,) at Reynolds numbers (K,).

    `resistance` is c, `length` L/h of the passage, `flow` that of the last Reynolds number, lengths in h.
    """

    resistance: float
    length: float
    extra_length: float
    reynolds: Array
    loss_factor: Array
    flow: Flow

    @property
    def drop(self) -> Array:
        """The whole pressure drop over the passage, (K,), over mu u/h."""
        return self.resistance * (self.length + self.extra_length) + 0.5 * self.loss_factor * self.reynolds

    @property
    def flow_coefficient(self) -> Array:
        """Cd of u = Cd sqrt(2 dp/rho), (K,), of an orifice; zero at Re = 0."""
        return np.sqrt(0.5 * self.reynolds / self.drop)


def step_correction(film_ratio: float, reynolds: Sequence[float], cells: int = 6) -> Correction:
    """Correction of a flow from a film into one of film_ratio times its thickness, both on one plane wall.

    `cells` across the thinner film; `length` is zero. Raises FilmInputError for a ratio of one, FilmNotConverged
    where no steady flow is found. Laminar and plane: gaps as wide as many films, Re up to some hundred.
    """
    before, behind = (1.0, film_ratio) if film_ratio > 1.0 else (1.0 / film_ratio, 1.0)
    lengths = SETTLED * before, (SETTLED + SETTLED_BY_INERTIA * max(reynolds)) * behind
    space = taylor_hood(step_mesh((before, behind), lengths, cells))
    rest = FILM * (lengths[0] / before**3 + lengths[1] / behind**3)
    return _correction(space, _between_walls(space, before), reynolds, FILM, 0.0, rest)


def groove_correction(film_ratio: float, width_ratio: float, reynolds: Sequence[float], cells: int = 6) -> Correction:
    """Correction of a flow across a groove of width_ratio films, where the film is film_ratio times as thick.

    `length` is the groove's in the film equation, width_ratio/film_ratio^3. Raises and valid as `step_correction`.
    """
    behind = SETTLED + SETTLED_BY_INERTIA * max(reynolds)
    space = taylor_hood(groove_mesh(1.0, film_ratio - 1.0, width_ratio, (SETTLED, behind), cells))
    rest, length = FILM * (SETTLED + behind), width_ratio / film_ratio**3
    return _correction(space, _between_walls(space, 1.0), reynolds, FILM, length, rest)


def orifice_correction(
    length_ratio: float, pipe_ratio: float, reynolds: Sequence[float], symmetry: Symmetry, cells: int = 4
) -> Correction:
    """Correction of a sharp bore (axial) or slot (plane) length_ratio h long, between pipes pipe_ratio h wide.

    `cells` across half the passage. The pressure behind is that at the end (REACHES): beyond it a jet may
    recover some 2/pipe_ratio^2 of rho u^2/2 (a slot's 2/pipe_ratio). Steady and even about the axis: a bore's jet
    wavers from Re of some hundreds, a slot's leans to a wall from Re of some tens. Raises as `step_correction`.
    """
    outer = 0.5 * pipe_ratio
    reaches = REACHES[0] * outer, REACHES[1] * outer
    space = taylor_hood(orifice_mesh(0.5, length_ratio, outer, reaches, cells), symmetry)
    axial = symmetry is Symmetry.AXIAL
    resistance, middle, power = (BORE, 2.0 / pipe_ratio**2, 4) if axial else (FILM, 1.5 / pipe_ratio, 3)
    inlet = held(space, "inlet", lambda x: np.stack([middle * (1.0 - (x[1] / outer) ** 2), 0.0 * x[1]]))
    ends = together([held(space, "wall"), inlet, straight(space, "axis"), straight(space, "outlet")])
    rest = resistance * sum(reaches) / pipe_ratio**power
    return _correction(space, ends, reynolds, resistance, length_ratio, rest)


def _between_walls(space: StokesSpace, height: float) -> HeldVelocities:
    """Walls at rest and the parabola of a film of given thickness at the inlet, for a flow of one."""
    inlet = held(space, "inlet", lambda x: np.stack([6.0 * x[1] * (height - x[1]) / height**3, 0.0 * x[1]]))
    return together([held(space, "wall"), inlet, straight(space, "outlet")])


def _correction(
    space: StokesSpace, ends: HeldVelocities, reynolds: Sequence[float], resistance: float, length: float, rest: float
) -> Correction:
    """Correction from flows of viscosity one at each Reynolds number; `rest`: drop of its films or pipes."""
    problem = FlowProblem(space, 1.0, ends)
    densities = [max(number, CREEPING) for number in reynolds]
    creeping = solve_stokes(problem)
    flows = solve_navier_stokes(problem, densities, creeping)
    drops = np.array([mean_pressure(flow, "inlet") - mean_pressure(flow, "outlet") for flow in [creeping, *flows]])
    loss = (drops[1:] - drops[0]) / (0.5 * np.array(densities))
    return Correction(
        resistance, length, (drops[0] - rest) / resistance - length, np.array(reynolds, dtype=float), loss, flows[-1]
    )
