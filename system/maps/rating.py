"""Warnings of points beyond the rated speed and pressure of a map's pump."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np

from reynolds.numerics.arrays import Array
from system.maps.data import MapData
from system.maps.plan import MapInput
from system.pump_file.check import CheckWarning
from system.pump_file.operating import beyond_rated_pressure, beyond_rated_speed

_BEYOND: Mapping[MapInput, Callable[[float, float], CheckWarning]] = {
    MapInput.SPEED: beyond_rated_speed,
    MapInput.PRESSURE: beyond_rated_pressure,
}


def rating_warnings(data: MapData, inputs: Mapping[MapInput, Array], what: str, prefix: str = "") -> Iterator[str]:
    """Yield a warning of each rating that points of a map exceed, as a map of them has it.

    inputs: of the points, SI; what: their name in the plural; prefix: what to say before the number of points.
    """
    for given, warning in _BEYOND.items():
        values, rated = np.ravel(inputs[given]), data.rated[given]
        beyond = values[values > rated]
        if beyond.size:
            found = warning(float(beyond[0]), rated)
            yield f"{found.path}: {prefix}at {beyond.size} of {values.size} {what}; at the first: {found.text}"
