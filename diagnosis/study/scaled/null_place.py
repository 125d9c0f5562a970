"""Place of a scaled pump's own fit, about which its study is linear.

Films of a pump known by its type plate may be several spreads from where the scaling puts them. There, slopes at the
prior mean indicate effects that are only the curvature of leakage over a film. About the fit of the model without any
effect a linear model of the priors, which stay as wide, is right without a concealed effect.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.errors import NotConverged
from system.estimation.fit import maximum_posterior


def null_place(study: Study, thresholds: Thresholds) -> Mapping[str, float]:
    """Standard numbers by name at which the model without any effect fits from the study's own, within `tolerated`.

    Empty where the fit does not converge, and where it is grossly wrong: such a fit is not near the pump's parameters.
    """
    limits = thresholds.fit
    held = tuple(each.held(limits.tolerated) for each in study.simulator.parameters)
    simulator = study.simulator.with_parameters(held)
    wrong = limits.gross * study.base.residual.size
    ends = replace(thresholds.fit_limits(scant=True), hopeless=wrong, patience=limits.gross_patience)
    try:
        fit = maximum_posterior(simulator, study.observations, study.place, ends)
    except NotConverged:
        return {}
    if fit.objective > wrong:
        return {}
    return {one.name: float(xi) for one, xi in zip(fit.parameters, fit.xi, strict=True)}
