"""Parameters that the readings feel: the others keep their stated values and cost no slopes."""

from __future__ import annotations

import numpy as np

from diagnosis.study.model import Study
from system.estimation.parameters import Parameter


def felt(study: Study, least: float) -> tuple[Parameter, ...]:
    """Parameters of which one sigma moves all readings together by at least `least` sigma, in their order.

    No fit depends on the others: a friction where no torque is measured, the stand-out share at full displacement.
    """
    size = np.linalg.norm(study.base.slopes, axis=0)
    return tuple(one for one, moved in zip(study.base.parameters, size, strict=True) if moved >= least)
