"""Component of the pump in which a mismatch lies, without a catalogue.

The law of one component at a time departs over the map (`diagnosis.study.departures`), and the evidences are compared:
the mismatch is assigned to the component whose own pattern explains it best.
"""

from __future__ import annotations

import numpy as np

from diagnosis.study.departures import departure_columns, departure_evidence, departure_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import multiplier_evidence, project
from system.inputs.channels import ChannelName

Ranking = tuple[tuple[Component, float], ...]


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


def tied(ranking: Ranking, odds: float) -> tuple[Component, ...]:
    """The components within `odds` nats of the best; none where the best is not that far ahead of no departure."""
    if not ranking or ranking[0][1] < odds:
        return ()
    return tuple(component for component, evidence in ranking if ranking[0][1] - evidence < odds)
