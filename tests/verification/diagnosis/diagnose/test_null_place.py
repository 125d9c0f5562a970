"""A scaled pump far from its prior mean: a study about its own fit finds nothing where the prior mean finds a mismatch.

The toy's films leak with their cube, and lie two spreads from where they are assumed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest
from toy_maps import LIMITS, SIGMA, ToySimulator, toy_observations, toy_recording

from diagnosis import Study
from diagnosis.detect.mismatch import detect
from diagnosis.study.map_axes import axis_values, scaled_axes
from diagnosis.study.model import study_of
from diagnosis.study.scaled.null_place import null_place
from reynolds import Array
from system import Component, EffectId, Extension, Kind, Parameter, Role, Scale
from system.effects.extension import Entry

POINTS = 60
MAP = toy_recording(POINTS, [(n, p, 1.0) for n in (80, 160) for p in (5e6, 15e6, 25e6, 35e6)], 50)
NARROWER, WIDER = -0.8, 0.8
OPENING = "elastic_opening.size"


def _patterns() -> Mapping[str, Array]:
    """Leakage of films of the assumed thickness, and of an opening, (N, 3); one film leaks more when hot."""
    n, p, heat = axis_values(MAP).values()
    thin, share = np.exp(0.035 * (heat - 333.0)), p / 35e6
    leaks = {"film.one": share * thin, "film.two": share * (1.5 - 0.5 * n / 160.0), OPENING: share**3}
    return {name: np.stack((-leak, leak, 0.0 * leak), axis=1) for name, leak in leaks.items()}


@dataclass(frozen=True)
class TwoFilms(ToySimulator):
    """A pump of two films with logarithmic priors, and an opening where it is switched on."""

    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        patterns = _patterns()
        powers = [1 if one.name == OPENING else 3 for one in self.parameters]
        return sum(
            value**power * patterns[one.name] for value, power, one in zip(values, powers, self.parameters, strict=True)
        )

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        steps = 1e-4 * np.eye(values.size)
        chosen = [step for step, one in zip(steps, self.parameters, strict=True) if one.name in names]
        return np.stack([(self.predict(values + s) - self.predict(values - s)) / 2e-4 for s in chosen], axis=2)

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> TwoFilms:
        return replace(self, parameters=parameters)

    def with_extensions(self, extensions: tuple[Extension, ...]) -> TwoFilms:
        return TwoFilms((*self.parameters, *(size for one in extensions for size in one.parameters)))

    def components(self, values: Array) -> Mapping[Component, Array]:
        return {Component.PISTON_LEAKAGE: _patterns()["film.one"]}


FILMS = tuple(
    Parameter(f"film.{which}", Role.BASE, Scale.LOG, 1.0, 0.4, 0.1, 10.0, None, "toy", power=3.0)
    for which in ("one", "two")
)
SIZE = Parameter(OPENING, Role.EXTENSION, Scale.HALF, 0.0, 1.0, 0.0, 10.0, None, "toy")
EXTENSION = Extension(EffectId.ELASTIC_OPENING, None, lambda values, courses, state: None, (SIZE,), ({},))  # type: ignore[arg-type, return-value]
CATALOGUE = (Entry(EffectId.ELASTIC_OPENING, Kind.MISSING_PHYSICS, (EXTENSION,), (), (), "", (), "", ""),)


def _studies(opened: float) -> tuple[Study, Study]:
    """The study about the prior mean, and that about the pump's own fit."""
    pump, axes = TwoFilms(FILMS), scaled_axes(MAP)
    truth = pump.predict(np.exp([NARROWER, WIDER])) + opened * _patterns()[OPENING]
    observed = toy_observations(truth + SIGMA * np.random.default_rng(51).normal(size=(POINTS, 3)))
    plain = study_of(MAP, pump, observed, axes, CATALOGUE, LIMITS)
    return plain, study_of(MAP, pump, observed, axes, CATALOGUE, LIMITS, null_place(plain, LIMITS))


def test_curvature_of_films_is_no_mismatch_about_the_fit() -> None:
    """The films are at their place; the fit is improbable at the prior mean only."""
    plain, settled = _studies(0.0)
    assert settled.place == pytest.approx([NARROWER / 0.4, WIDER / 0.4], abs=0.1)
    assert detect(plain, LIMITS).p_value < LIMITS.mismatch.chance
    assert detect(settled, LIMITS).p_value > LIMITS.mismatch.chance
    assert detect(settled, LIMITS).chance > LIMITS.mismatch.suspicion


def test_a_fit_that_is_grossly_wrong_is_no_place() -> None:
    """Of an opening that no films can follow the prior mean remains."""
    plain, settled = _studies(20.0)
    assert null_place(plain, LIMITS) == {}
    assert not settled.place.any()


def test_an_effect_is_found_about_the_fit() -> None:
    """An opening that films cannot follow stands out there."""
    settled = _studies(0.1)[1]
    assert settled.about
    assert detect(settled, LIMITS).chance < LIMITS.mismatch.chance
