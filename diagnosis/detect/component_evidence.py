"""Component of the pump in which a mismatch lies, without a catalogue.

The law of one component at a time departs over the map (`diagnosis.study.departures`), and the evidences are compared:
the mismatch is assigned to the component whose own pattern explains it best.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from math import log

import numpy as np
from scipy.special import logsumexp

from diagnosis.study.departures import departure_columns, departure_evidence, departure_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import multiplier_evidence, project
from system.inputs.channels import ChannelName

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
    """ln evidence of each component over none, best first.

    The size of the departure is averaged over prior widths from .1 % to 30 %.
    """
    widths, shapes = thresholds.locate.multiplier_widths, departure_shapes(study.recording)
    found = [
        (component, departure_evidence(study.base, law, shapes, widths).log_evidence)
        for component, law in study.components.items()
    ]
    return tuple(sorted(found, key=lambda each: -each[1]))


def likeliest_multiplier(study: Study, component: Component, thresholds: Thresholds) -> Array:
    """Factor (N,) on the component's law: the mean of N(0, w^2) shapes given the readings.

    Of the family and the width w of greatest evidence.
    """
    base, law, shapes = study.base, study.components[component], departure_shapes(study.recording)
    own = departure_evidence(base, law, shapes, thresholds.locate.multiplier_widths).family.columns
    columns = departure_columns(base, law, shapes)[:, own]
    width = max(thresholds.locate.multiplier_widths, key=lambda width: multiplier_evidence(base, columns, [width]))
    content = columns.T @ project(base, columns)
    precision = content + np.eye(len(content)) / width**2
    return np.asarray(shapes.values[:, own] @ np.linalg.solve(precision, columns.T @ base.residual))


def departing_inputs(study: Study, component: Component, thresholds: Thresholds) -> tuple[ChannelName, ...]:
    """Inputs of the likeliest departure of a component's law; none where its share is constant."""
    law, shapes = study.components[component], departure_shapes(study.recording)
    return departure_evidence(study.base, law, shapes, thresholds.locate.multiplier_widths).family.inputs


def missing_pattern(study: Study, component: Component, thresholds: Thresholds) -> Array:
    """(N, C), in sigma: addition of the likeliest departure of one component's law to the readings.

    The mismatch without noise, and without the part that the fitted parameters explain.
    """
    whitening = study.base.whitening
    added = study.components[component] * likeliest_multiplier(study, component, thresholds)[:, None]
    sigma = np.where(whitening.measured, whitening.sigma, 1.0)
    return np.asarray(np.where(whitening.measured, added, 0.0) / sigma)


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
    """The components within `odds` nats of the best; none where the best is not that far ahead of no departure."""
    if not ranking or ranking[0][1] < odds:
        return ()
    return tuple(component for component, evidence in ranking if ranking[0][1] - evidence < odds)
