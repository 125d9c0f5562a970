"""Free multipliers over the map on the law of one part of the pump."""

from __future__ import annotations

from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.posterior import Posterior


def multiplier_columns(study: Study, posterior: Posterior, component: Component) -> Array:
    """Whitened columns (n, 15) of one component's law times each smooth shape of the map."""
    shapes = smooth_shapes(study.axes)
    return posterior.whitening.whiten(study.components[component][:, :, None] * shapes[:, None, :])
