"""Ends of fits on a kink, where slopes promise a fall that no step brings: how much of it is given up.

One reading is off by r at x = 0 and by more on either side, 2 x and -0.4 x: slopes by differences are 0.8 there, and
promise that the objective falls by (0.8 r)^2/(1 + 0.8^2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from toy_maps import LIMITS, SIGMA, ToySimulator, toy_observations, toy_recording

from diagnosis import Study
from diagnosis.explain.hypotheses import hypotheses
from diagnosis.explain.refit import refit
from diagnosis.study.map_axes import scaled_axes
from diagnosis.study.model import study_of
from diagnosis.study.scaled.null_place import null_place
from reynolds import Array, NotConverged
from system import Component, Extension, Parameter, Role, Scale

MAP = toy_recording(12, [(n, p, 1.0) for n in (80, 160) for p in (5e6, 15e6)], 50)
STEEP, FLAT = 2.0, 0.4
SLOPE = 0.5 * (STEEP - FLAT)
PARAMETER = Parameter("viscosity", Role.BASE, Scale.NORMAL, 0.0, 1.0, -np.inf, np.inf, None, "toy")


@dataclass(frozen=True)
class Kinked(ToySimulator):
    """A pump whose first delivery flow falls on both sides of x = 0."""

    parameters: tuple[Parameter, ...] = (PARAMETER,)

    def predict(self, values: Array) -> Array:
        found = np.zeros((12, 3))
        found[0, 0] = -SIGMA[0] * (STEEP * max(values[0], 0.0) + FLAT * max(-values[0], 0.0))
        return found

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        found = np.zeros((12, 3, len(names)))
        found[0, 0] = -SIGMA[0] * SLOPE
        return found

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Kinked:
        return replace(self, parameters=parameters)

    def with_extensions(self, extensions: tuple[Extension, ...]) -> Kinked:
        return self

    def components(self, values: Array) -> Mapping[Component, Array]:
        return {}


def _study(promised: float, scant: bool) -> Study:
    """A study whose fit ends with a fall of so many nats promised."""
    off = np.zeros((12, 3))
    off[0, 0] = SIGMA[0] * np.sqrt(2.0 * promised * (1.0 + SLOPE**2)) / SLOPE
    return replace(study_of(MAP, Kinked(), toy_observations(off), scaled_axes(MAP), (), LIMITS), scant=scant)


def _ends(study: Study) -> bool:
    try:
        found = refit(study, hypotheses(study, LIMITS)[0], LIMITS)
    except NotConverged:
        return False
    assert found.posterior is not None
    assert abs(found.posterior.xi[0]) < 0.05
    return True


@pytest.mark.parametrize("share", [0.5, 0.9, 1.1, 2.0])
def test_of_a_scaled_pump_a_fit_ends_where_less_than_the_odds_of_a_name_is_promised(share: float) -> None:
    """With 3 nats promised and more it has not converged; its own place is one under the same rule."""
    study = _study(share * LIMITS.name.odds, scant=True)
    assert _ends(study) is (share < 1.0)
    assert bool(null_place(study, LIMITS)) is (share < 1.0)


@pytest.mark.parametrize(("promised", "ends"), [(0.4, True), (0.6, False), (2.0, False)])
def test_of_a_pump_in_full_it_ends_where_half_a_nat_is_promised(promised: float, ends: bool) -> None:
    """The last nats of a pump whose laws are known are no noise of the solver."""
    assert _ends(_study(promised, scant=False)) is ends
