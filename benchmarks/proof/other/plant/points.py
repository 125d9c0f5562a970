"""Operating points of the second plant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RATED_SPEED = 219.91148575128553  # rad/s, 2100 r/min
RATED_FLOW = 3.145e-3  # m3/s, 188.7 L/min
KELVIN = 273.15
BODY = 50.0 + KELVIN  # K at which clearances are those of the drawing


@dataclass(frozen=True)
class Points:
    """N operating points, (N,) each: rad/s, share of the full stroke, Pa absolute, K."""

    speed: Array
    ratio: Array
    p_out: Array
    p_in: Array
    p_case: Array
    T_in: Array
    T_case: Array
