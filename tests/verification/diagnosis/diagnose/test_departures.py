"""Departures of a law over the map: families of shapes, and which inputs matter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from toy_maps import CHANNELS, SIGMA, toy_observations, toy_recording

from diagnosis.recording.model import Recording
from diagnosis.study.departures import departure_columns, departure_evidence, departure_shapes
from diagnosis.study.map_axes import scaled_axes, smooth_shapes
from reynolds import Array
from system import ChannelName
from system.estimation.evidence import multiplier_evidence, taken_up
from system.estimation.function_simulator import FunctionSimulator
from system.estimation.parameters import Parameter, Role, Scale
from system.estimation.posterior import Posterior, linear_posterior

N = ChannelName
WIDTHS = (0.001, 0.003, 0.01, 0.03, 0.1, 0.3)
GRID = list(product((100.0, 160.0, 220.0), np.linspace(5e6, 35e6, 24), (0.4, 1.0)))
POINTS = len(GRID)
SIZE = 100.0 * SIGMA[2]
"""N m, the torque that departs."""


@pytest.fixture(scope="module")
def recording() -> Recording:
    return toy_recording(POINTS, GRID, 3)


def _law() -> Array:
    """Torque (N, 3) of the same size at all points."""
    found = np.zeros((POINTS, len(CHANNELS)))
    found[:, 2] = SIZE
    return found


def _fit(departure: Array) -> Posterior:
    """A linear fit of a torque's level to readings without noise, of a torque that departs by a share (N,)."""
    level = Parameter("level", Role.BASE, Scale.NORMAL, 1.0, 0.01, 0.0, 2.0, None, "")
    model = FunctionSimulator(lambda values: values["level"] * _law(), (level,))
    return linear_posterior(model, toy_observations(_law() * (1.0 + departure[:, None])))


def _bump(recording: Recording) -> Array:
    pressure = recording.steady.column(N.P_OUT)
    return np.exp(-(((pressure - 20e6) / 2e6) ** 2))


def test_the_shares_of_the_families_make_one(recording: Recording) -> None:
    """Four inputs: 15 polynomials by their inputs and four courses; each kind has a fifth."""
    families = departure_shapes(recording).families
    assert len(families) == 19
    assert sum(np.exp(each.log_prior) for each in families) == pytest.approx(1.0)
    kinds = {count: 0.0 for count in range(1, 5)}
    for each in families[:15]:
        kinds[len(each.inputs)] += float(np.exp(each.log_prior))
        assert len(each.columns) == (len(each.inputs) + 1) * (len(each.inputs) + 2) // 2
    assert kinds == pytest.approx(dict.fromkeys(range(1, 5), 0.2))


def test_all_axes_together_are_the_smooth_shapes(recording: Recording) -> None:
    shapes = departure_shapes(recording)
    whole = next(each for each in shapes.families if len(each.inputs) == 4)
    assert shapes.values[:, whole.columns] == pytest.approx(smooth_shapes(scaled_axes(recording)))


def test_levels_bound_a_course(recording: Recording) -> None:
    """Three speeds leave two cosines beside the constant, pressures that have no levels twelve."""
    courses = {each.inputs[0]: len(each.columns) for each in departure_shapes(recording).families[15:]}
    assert courses[N.SPEED] == 3
    assert courses[N.P_OUT] == 13


def test_inlet_and_case_pressure_are_inputs_where_they_move(recording: Recording) -> None:
    values = recording.steady.values.copy()
    values[:, list(ChannelName).index(N.P_CASE)] = np.linspace(1e5, 3e5, POINTS)
    moved = replace(recording, steady=replace(recording.steady, values=values))
    known = {name for each in departure_shapes(moved).families for name in each.inputs}
    assert known == {N.SPEED, N.P_OUT, N.DISPLACEMENT_RATIO, N.T_CASE, N.P_CASE}


def test_a_map_on_which_nothing_moves_leaves_a_share(recording: Recording) -> None:
    still = replace(recording, steady=recording.steady.at(np.zeros(6, dtype=int)))
    shapes = departure_shapes(still)
    assert [each.inputs for each in shapes.families] == [()]
    assert shapes.values == pytest.approx(np.ones((6, 1)))


@pytest.mark.parametrize(
    ("of", "inputs"),
    [
        (lambda axes: 0.1 * axes[:, 1] ** 2, (N.P_OUT,)),
        (lambda axes: 0.1 * axes[:, 0] * axes[:, 2], (N.SPEED, N.DISPLACEMENT_RATIO)),
    ],
)
def test_the_inputs_that_matter_are_found(
    recording: Recording, of: Callable[[Array], Array], inputs: tuple[ChannelName, ...]
) -> None:
    """And the evidence is more than that of all smooth shapes together, which costs fifteen columns."""
    fit, shapes = _fit(of(scaled_axes(recording))), departure_shapes(recording)
    found = departure_evidence(fit, _law(), shapes, WIDTHS)
    assert found.family.inputs == inputs
    whole = next(each for each in shapes.families if len(each.inputs) == 4)
    columns = departure_columns(fit, _law(), shapes)
    assert found.log_evidence > multiplier_evidence(fit, columns[:, whole.columns], WIDTHS) + 5.0
    assert found.taken == pytest.approx(taken_up(fit, columns[:, found.family.columns], WIDTHS))
    assert 0.95 < found.taken / (0.5 * fit.objective) <= 1.0


def test_a_bump_over_one_input_is_a_course(recording: Recording) -> None:
    """A tenth of the torque amid the pressures: no polynomial has it."""
    fit, shapes = _fit(0.1 * _bump(recording)), departure_shapes(recording)
    found = departure_evidence(fit, _law(), shapes, WIDTHS)
    assert found.family is next(each for each in shapes.families[15:] if each.inputs == (N.P_OUT,))


def test_noise_alone_costs_evidence(recording: Recording) -> None:
    rng = np.random.default_rng(5)
    shares = rng.normal(size=POINTS) * SIGMA[2] / SIZE
    assert departure_evidence(_fit(shares), _law(), departure_shapes(recording), WIDTHS).log_evidence < 1.0
