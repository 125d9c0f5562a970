"""Other methods on the same study: usual practice, and this diagnosis without one of its parts.

All are linear, at the prior mean, so that they are judged alike; "screen" is this diagnosis as linear as they.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.special import log_softmax
from scipy.stats import chi2

from diagnosis.detect.multiplicity import family_chance, log_chances
from diagnosis.explain.hypotheses import Hypothesis, hypotheses
from diagnosis.explain.screen import screen
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind
from system.estimation.evidence import Sign, project, score
from system.estimation.parameters import Role
from system.estimation.posterior import Posterior, laplace
from system.estimation.whitening import Whitening, whitener

from .baselines import gaussian_process, sparse_regression
from .outcome import Rival

USUAL_NAME = {
    "Q_case": "film_thickness", "torque": "friction_coefficient", "Q_out": "displacement", "Q_in": "Q_in_gain",
}  # fmt: skip
"""The usual first suspect of a channel with a mismatch."""
SURE = 0.01  # p below which the usual methods report a mismatch
DRAWS = 1999
LEAST = 1e-6  # share of a column's square that must be its own to be judged
STEPS = 3  # effects that are added one after the other at most


def rivals(study: Study, thresholds: Thresholds) -> dict[str, Rival]:
    """Each way's finding, by its name."""
    residual = study.base.whitening.unwhiten(study.base.residual) / study.base.whitening.sigma
    known = [each for each in hypotheses(study, thresholds) if each.component is None]
    return {
        "screen": _screened(study, thresholds),
        "no input noise": _screened(_anew(study, _without_inputs(study), ()), thresholds),
        "fluid law held": _screened(_anew(study, study.base.whitening, _fluid(study)), thresholds),
        "no unknown physics": _screened(study, thresholds, known),
        "no signs": _screened(_unsigned(study), thresholds),
        "largest residual": _largest(study, residual),
        "stepwise BIC": _stepwise(study),
        "sparse regression": sparse_regression(study, residual),
        "Gaussian process": gaussian_process(study, residual),
    }


def _screened(study: Study, thresholds: Thresholds, single: list[Hypothesis] | None = None) -> Rival:
    """The verdict of the linear screen: a mismatch by both tests, and its likeliest explanation."""
    found = screen(study, study.base, single or hypotheses(study, thresholds), thresholds)
    logs = log_softmax(np.array([each.log_weight for each in found]))
    null = next(k for k, each in enumerate(found) if each.hypothesis.kind is Kind.NO_MISMATCH)
    alarm = bool(
        _chance(study, thresholds) < thresholds.mismatch.chance
        and np.exp(logs[null]) < thresholds.mismatch.null_probability
    )
    best = max((each for each in found if each is not found[null]), key=lambda each: each.log_weight)
    return Rival(alarm, tuple(effect.value for effect in best.hypothesis.effects) if alarm else ())


def _chance(study: Study, thresholds: Thresholds) -> float:
    """As in `diagnosis.detect.mismatch`, with fewer draws."""
    found = np.array([score(study.base, each.column).z for each in study.candidates])
    strongest = log_chances(found, study.candidates)
    return family_chance(study.base, study.candidates, strongest, DRAWS, thresholds.seeds.detect)


def _without_inputs(study: Study) -> Whitening:
    """The whitening of readings with exactly known inputs."""
    exact = replace(study.observations, input_sigma=np.zeros_like(study.observations.input_sigma))
    count, channels = study.observations.values.shape
    return whitener(exact, np.zeros((count, channels, exact.input_sigma.shape[1])))


def _fluid(study: Study) -> tuple[str, ...]:
    return tuple(each.name for each in study.base.parameters if each.role is Role.FLUID)


def _unsigned(study: Study) -> Study:
    return replace(study, candidates=tuple(replace(each, sign=Sign.EITHER) for each in study.candidates))


def _anew(study: Study, whitening: Whitening, held: tuple[str, ...]) -> Study:
    """The study with another noise, and with parameters held at their prior mean."""
    old = study.base

    def whitened(columns: Array) -> Array:
        return whitening.whiten(old.whitening.unwhiten(columns))

    offset = whitened(old.residual + old.slopes @ old.xi)
    slopes = whitened(old.slopes) * np.array([each.name not in held for each in old.parameters])
    base = _posterior(old, offset, slopes, whitening)
    kept = tuple(replace(each, column=whitened(each.column)) for each in study.candidates if each.parameter not in held)
    return replace(study, base=base, candidates=kept)


def _posterior(old: Posterior, offset: Array, slopes: Array, whitening: Whitening) -> Posterior:
    precision = slopes.T @ slopes + np.eye(old.xi.size)
    xi = cho_solve(cho_factor(precision), slopes.T @ offset)
    residual = offset - slopes @ xi
    objective = float(residual @ residual + xi @ xi)
    evidence = laplace(objective, precision) + whitening.log_determinant
    return replace(old, xi=xi, residual=residual, slopes=slopes, precision=precision, objective=objective,
                   log_evidence=evidence, whitening=whitening)  # fmt: skip


def _largest(study: Study, residual: Array) -> Rival:
    """The channel with the largest mismatch after a fit, and its usual suspect."""
    squares = np.where(study.observations.measured, residual**2, 0.0)
    alarm = bool(chi2.sf(squares.sum(), int(study.observations.measured.sum())) < SURE)
    worst = study.channels[int(np.argmax(squares.mean(axis=0)[: len(study.channels)]))].value
    return Rival(alarm, (USUAL_NAME[worst],) if alarm else ())


def _stepwise(study: Study) -> Rival:
    """Columns of the catalogue added while Schwarz' criterion (1978) falls, of either sign, without priors.

    With g = V^T r and G = V^T P V of all columns (`diagnosis.explain.screen`), a column's score beside the chosen ones.
    """
    base = study.base
    columns = np.stack([each.column for each in study.candidates], axis=1)
    agreement, content = columns.T @ base.residual, columns.T @ project(base, columns)
    taken: list[int] = []
    for _ in range(STEPS):
        onto = np.linalg.solve(content[np.ix_(taken, taken)], content[taken]) if taken else content[taken]
        left = np.diag(content) - (content[taken] * onto).sum(axis=0)
        usable = left > LEAST * (columns**2).sum(axis=0)
        strength = (agreement - onto.T @ agreement[taken]) / np.sqrt(np.where(usable, left, np.inf))
        best = int(np.argmax(np.abs(strength)))
        if strength[best] ** 2 < np.log(base.residual.size):
            break
        taken.append(best)
    return Rival(bool(taken), tuple(dict.fromkeys(study.candidates[one].entry.id.value for one in taken)))
