"""The pump that a calibration makes: its parameters at the peak, its tolerances what the fit leaves of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from system.bench.calibration.extended_pump import extended_pump, values_by_name
from system.bench.parameters import BEARINGS, GUIDE
from system.description.pump import PumpDescription
from system.effects.extension import Extension
from system.estimation.posterior import Posterior

_OF_FRICTION: Mapping[str, str] = {
    f"friction.{GUIDE}": "guide_friction",
    **{f"friction.{pair}": "bearing_friction" for pair in BEARINGS},
}


def calibrated_pump(pump: PumpDescription, fit: Posterior, laws: Sequence[Extension] = ()) -> PumpDescription:
    """The pump with a fit's values, and with `laws` switched on; [tolerance] holds the fit's own sigmas.

    A key of [tolerance] that stands for several parameters takes the widest of them. What the fit did not have
    keeps its tolerance. Raises pydantic's ValidationError for values outside an effect's bounds.
    """
    own = extended_pump(pump, values_by_name(fit.parameters, fit.values), laws)
    sigma = np.sqrt(np.diag(fit.covariance))
    known: dict[str, float] = {}
    for parameter, width in zip(fit.parameters, sigma, strict=True):
        key = _OF_FRICTION.get(parameter.name, parameter.name.partition(".")[0])
        if key in type(own.tolerance).model_fields:
            known[key] = max(known.get(key, 0.0), float(parameter.spread * width))
    return own.model_copy(update={"tolerance": own.tolerance.model_copy(update=known)})
