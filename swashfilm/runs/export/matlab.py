"""A map as MATLAB file: breakpoints and n-D arrays as the lookup tables of Simulink and Simscape read them."""

import io
from importlib.metadata import version
from typing import Any

import numpy as np

from swashfilm.runs.export.content import Content
from swashfilm.runs.export.numbers import numbers, wide
from system.maps.data import MapData

UNITS = {"N m": "N*m", "m3/s": "m^3/s", "m3/rev": "m^3/rev"}
"""Units as Simscape writes them, where they differ."""


def matlab_files(data: MapData, name: str) -> Content:
    """Return the file by its ending: format 5, SI, pressures gauge.

    An axis with several levels is a row vector, and a dimension of every array, in the order of the cell array
    `dimensions`. The struct `held` has the other inputs, `units` and `meaning` have a field for each variable, `origin`
    has pump, solver and program. A point without a result is nan.
    """
    from scipy.io import savemat

    axes = wide(data)
    found: dict[str, Any] = {axis.input.value: np.array(axis.values) for axis in axes}
    units = {axis.input.value: _unit(axis.input.unit) for axis in data.axes}
    meaning = {axis.input.value: axis.input.words for axis in data.axes}
    for number in numbers(data):
        found[number.identifier] = np.squeeze(number.values)
        units[number.identifier], meaning[number.identifier] = _unit(number.unit), number.words
    found |= {
        "dimensions": np.array([axis.input.value for axis in axes], dtype=object),
        "held": {axis.input.value: axis.values[0] for axis in data.axes if axis not in axes},
        "units": units,
        "meaning": meaning,
        "origin": {"pump": data.name, "solver": data.words, "source": f"swashfilm {version('swashfilm')}"},
    }
    file = io.BytesIO()
    savemat(file, found, long_field_names=True, oned_as="row")
    return Content({".mat": file.getvalue()})


def _unit(si_unit: str) -> str:
    return UNITS.get(si_unit, si_unit)
