"""Mismatch by an explanation: its addition to the readings, and the residual."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from diagnosis.detect.component_evidence import likeliest_multiplier
from diagnosis.explain.hypotheses import Hypothesis, simulator_of
from diagnosis.explain.ranked import Explanation
from diagnosis.recording.model import TraceBlock
from diagnosis.study.model import Study, TraceMisfit
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import project
from system.estimation.posterior import Posterior, values_at


@dataclass(frozen=True)
class ExplainedMismatch:
    """added: addition of the explanation to the predictions; left: reading less prediction; (N, C) in SI."""

    added: Array
    left: Array

    @property
    def mismatch(self) -> Array:
        """(N, C), sum of both; nan where nothing was measured."""
        return self.added + self.left


def explained_mismatch(study: Study, explanation: Explanation, thresholds: Thresholds) -> ExplainedMismatch:
    """The addition of a refitted explanation, or of a component whose law departs. Raises NotConverged."""
    if explanation.hypothesis.component is not None:
        return _by_multiplier(study, explanation.hypothesis.component, thresholds)
    posterior, own = explanation.posterior, explanation.hypothesis
    if posterior is None:
        nothing = np.zeros_like(study.base.predictions)
        return ExplainedMismatch(nothing, study.observations.values - study.base.predictions)
    simulator = simulator_of(study, own, thresholds)
    without = simulator.predict(_closed(posterior, own))
    return ExplainedMismatch(posterior.predictions - without, study.observations.values - posterior.predictions)


def unexplained_traces(study: Study, explanation: Explanation, thresholds: Thresholds) -> tuple[TraceMisfit, ...]:
    """The study's traces less those of an explanation's refit without the explanation itself.

    Raises NotConverged.
    """
    posterior, own = explanation.posterior, explanation.hypothesis
    if posterior is None:
        return study.traces
    simulator = simulator_of(study, own, thresholds)
    values = _closed(posterior, own)

    def left(block: TraceBlock) -> Array:
        return block.mean - np.asarray(simulator.traces(values, (block.point,), block.angle)[0])

    return tuple(replace(trace, residual=left(trace.block)) for trace in study.traces)


def _closed(posterior: Posterior, own: Hypothesis) -> Array:
    """Values (k,) of a refit with the free parameters of its hypothesis at 0."""
    free = np.array([each.name in own.open_names for each in posterior.parameters])
    return values_at(posterior.parameters, np.where(free, 0.0, posterior.xi))


def _by_multiplier(study: Study, component: Component, thresholds: Thresholds) -> ExplainedMismatch:
    """The component's law times its likeliest departure in the linear model."""
    base = study.base
    added = study.components[component] * likeliest_multiplier(study, component, thresholds)[:, None]
    left = base.whitening.unwhiten(base.residual - project(base, base.whitening.whiten(added)))
    return ExplainedMismatch(added, np.where(study.observations.measured, left, np.nan))
