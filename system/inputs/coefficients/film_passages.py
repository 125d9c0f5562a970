"""Extra length and loss factor of a step or groove of a film, from a computed flow through it.

    dp = 12 mu u (L + extra_length h)/h^2 + loss_factor rho u^2/2

with h the thinner film, u the mean velocity in it, and L the length of the films between the patches, as of h. The
extra length is that of Stokes flow: a flow of Re = u h/nu of CREEPING at most gives it, with the loss factor of
first order in Re: 54/35 (1 - r^2) into a film r times as thick as the one before it, less that out of it.
"""

from __future__ import annotations

from dataclasses import dataclass

from system.inputs.coefficients.edge_losses import KINETIC
from system.inputs.coefficients.openfoam_case import CaseFlow
from system.inputs.faults import Fault, InputFaults

CREEPING = 1.0
"""Largest Re of a flow that gives the extra length: the neglected part is of second order."""


@dataclass(frozen=True)
class FilmPassage:
    """A film, m, that meets one film_ratio times as thick, or a groove so deep and width_ratio films wide.

    area m2: section of the thinner film. before, behind (m): from the inlet to the step or groove's edge, and from
    there, or from its other edge, to the outlet.
    """

    film: float
    area: float
    film_ratio: float
    before: float
    behind: float
    width_ratio: float | None = None

    @property
    def length(self) -> float:
        """L in m, by the film equation."""
        if self.width_ratio is not None:
            return self.before + self.behind + self.film * self.width_ratio / self.film_ratio**3
        wide = max(self.film_ratio, 1.0 / self.film_ratio) ** 3
        return self.before + self.behind / wide if self.film_ratio > 1.0 else self.before / wide + self.behind

    @property
    def first_order_loss(self) -> float:
        """The loss factor as Re goes to zero: of the change of kinetic energy."""
        if self.width_ratio is not None:
            return 0.0
        return KINETIC * (1.0 - self.film_ratio**2 if self.film_ratio < 1.0 else 1.0 / self.film_ratio**2 - 1.0)


@dataclass(frozen=True)
class FilmLoss:
    """Extra length in films and loss factor at one Reynolds number."""

    reynolds: float
    extra_length: float
    loss_factor: float


def film_loss(
    passage: FilmPassage, flow: CaseFlow, density: float, kinematic_viscosity: float, extra_length: float | None
) -> FilmLoss:
    """Loss of a passage by the pressure drop (Pa) of a flow of oil of kg/m3 and m2/s.

    With the passage's extra length known the flow gives the loss factor, without it the extra length. Raises
    InputFaults for an extra length from a flow faster than CREEPING.
    """
    speed = flow.flow / passage.area
    reynolds = speed * passage.film / kinematic_viscosity
    head, viscous = 0.5 * density * speed**2, 12.0 * density * kinematic_viscosity * speed / passage.film
    rest = flow.pressure_drop - viscous * passage.length / passage.film
    if extra_length is not None:
        return FilmLoss(reynolds, extra_length, (rest - viscous * extra_length) / head)
    if reynolds > CREEPING:
        wanted = f"{CREEPING:g} at most: the first flow of a passage gives its extra length"
        raise InputFaults("case", [Fault("Reynolds number", f"{reynolds:.4g}", wanted, "a slower flow first")])
    loss = passage.first_order_loss
    return FilmLoss(reynolds, (rest - loss * head) / viscous, loss)
