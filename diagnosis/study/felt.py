"""Parameters that a fit needs: the others keep their stated values and need no slopes.

A parameter without influence on the readings has no effect on a fit. One that others replace has none either: where
these are free within their tolerances, the readings leave its prior variance as it is,

    var(xi_k | y) = (A^T A + 1)^-1_kk > redundant,   A: slopes of the readings by xi, in sigma

Eccentricity and clearance of the pistons are such a pair. Parameters that a hypothesis may find wrong stay. So does the
lag of the case's thermometer: a bench without it would have none, instead of that of its prior.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from diagnosis.study.model import SUBJECTS, Study, concerned
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.sensors import THERMOMETER_LAG
from system.estimation.parameters import Parameter


def felt(study: Study, thresholds: Thresholds) -> tuple[Parameter, ...]:
    """Parameters of a study with influence on its readings that no others replace, in their order."""
    parameters, slopes = study.base.parameters, study.base.slopes
    questioned = {name for effect in SUBJECTS for name in concerned(effect, parameters)}
    stays = np.array([one.name == THERMOMETER_LAG for one in parameters], dtype=bool)
    kept = stays | (np.linalg.norm(slopes, axis=0) >= thresholds.fit.felt)
    removable = ~stays & np.array([one.name not in questioned for one in parameters], dtype=bool)
    while (least := _most_open(slopes, kept, removable, thresholds.fit.redundant)) is not None:
        kept[least] = False
    return tuple(one for one, own in zip(parameters, kept, strict=True) if own)


def _most_open(slopes: Array, kept: NDArray[np.bool_], removable: NDArray[np.bool_], redundant: float) -> int | None:
    """The removable parameter that the readings determine least, None where they narrow all of them."""
    own = slopes[:, kept]
    variance = np.zeros(kept.size)
    variance[kept] = np.diag(np.linalg.inv(own.T @ own + np.eye(own.shape[1])))
    variance[~removable] = 0.0
    found = int(np.argmax(variance))
    return found if variance[found] > redundant else None
