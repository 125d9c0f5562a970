"""Component of the pump in which a mismatch lies, without a catalogue.

The law of one component at a time is given a free smooth multiplier 1 + Phi(n, p, eps, T) beta, and the
evidences are compared: the mismatch is assigned to the component whose own pattern explains it best.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from math import log

import numpy as np
from scipy.special import logsumexp

from diagnosis.study.model import Study
from diagnosis.study.multipliers import multiplier_columns
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import multiplier_evidence, project

Ranking = tuple[tuple[Component, float], ...]


class ComponentGroup(Enum):
    """Components that a bench map rarely separates."""

    FILM_LEAKAGE = "leakage of the films"
    CROSS_FLOW = "flow from delivery to inlet"
    DRAIN_FLOW = "flow to the case beside the films"
    DISPLACEMENT = "displacement and compression"
    FRICTION = "friction"
    COMMUTATION = "commutation"
    CASE_DRAG = "drag in the case"
    THERMAL_STATE = "thermal state"
    SENSOR = "a sensor"


MEMBERS: Mapping[ComponentGroup, tuple[Component, ...]] = {
    ComponentGroup.FILM_LEAKAGE: (Component.PISTON_LEAKAGE, Component.SLIPPER_LEAKAGE, Component.PLATE_LEAKAGE),
    ComponentGroup.CROSS_FLOW: (Component.CROSS_FLOW,),
    ComponentGroup.DRAIN_FLOW: (Component.DRAIN_FLOW,),
    ComponentGroup.DISPLACEMENT: (Component.DISPLACEMENT, Component.COMPRESSION),
    ComponentGroup.FRICTION: (
        Component.PISTON_FRICTION,
        Component.SLIPPER_FRICTION,
        Component.SOCKET_FRICTION,
        Component.PLATE_FRICTION,
        Component.GUIDE_FRICTION,
        Component.BEARINGS,
    ),
    ComponentGroup.COMMUTATION: (Component.COMMUTATION,),
    ComponentGroup.CASE_DRAG: (Component.CASE_DRAG,),
    ComponentGroup.THERMAL_STATE: (Component.THERMAL_STATE,),
    ComponentGroup.SENSOR: (
        Component.Q_OUT_SENSOR,
        Component.Q_IN_SENSOR,
        Component.Q_CASE_SENSOR,
        Component.TORQUE_SENSOR,
        Component.T_OUT_SENSOR,
        Component.ELECTRIC_POWER_SENSOR,
    ),
}


def component_evidences(study: Study, thresholds: Thresholds) -> Ranking:
    """ln evidence of each component over none, best first: multipliers up to second order in the scaled axes.

    The size of the multiplier is averaged over prior widths from .1 % to 30 %.
    """
    widths = thresholds.locate.multiplier_widths
    found = [
        (component, multiplier_evidence(study.base, multiplier_columns(study, study.base, component), widths))
        for component in study.components
    ]
    return tuple(sorted(found, key=lambda each: -each[1]))


def likeliest_multiplier(study: Study, component: Component, thresholds: Thresholds) -> Array:
    """(15,), the mean of N(0, w^2) multipliers given the readings, at the width w of greatest evidence."""
    base = study.base
    columns = multiplier_columns(study, base, component)
    width = max(thresholds.locate.multiplier_widths, key=lambda width: multiplier_evidence(base, columns, [width]))
    content = columns.T @ project(base, columns)
    precision = content + np.eye(len(content)) / width**2
    return np.asarray(np.linalg.solve(precision, columns.T @ base.residual), dtype=float)


def missing_pattern(study: Study, component: Component, thresholds: Thresholds) -> Array:
    """(N, C), in sigma: addition of the likeliest smooth multiplier of one component's law to the readings.

    The mismatch without noise, and without the part that the fitted parameters explain.
    """
    whitening = study.base.whitening
    columns = multiplier_columns(study, study.base, component)
    sigma = np.where(whitening.measured, whitening.sigma, 1.0)
    pattern: Array = whitening.unwhiten(columns @ likeliest_multiplier(study, component, thresholds)) / sigma
    return pattern


def group_evidences(ranking: Ranking) -> tuple[tuple[ComponentGroup, float], ...]:
    """ln evidence of each group that has members in the ranking, best first: the mean over its members."""
    known = dict(ranking)
    found = []
    for group, members in MEMBERS.items():
        own = [known[member] for member in members if member in known]
        if own:
            found.append((group, float(logsumexp(own)) - log(len(own))))
    return tuple(sorted(found, key=lambda each: -each[1]))


def tied(ranking: Ranking, odds: float) -> tuple[Component, ...]:
    """The components within `odds` nats of the best; none where the best is not that far ahead of nothing."""
    if not ranking or ranking[0][1] < odds:
        return ()
    return tuple(component for component, evidence in ranking if ranking[0][1] - evidence < odds)
