"""A map as Amesim tables: a text file for each number.

The form is that of tables in public repositories, `# Table format: ND` with N axes; Siemens' own description was not
available, and no Amesim has read these files. Remarks begin with `#`. Two or more axes: their numbers of levels, a line
each; their levels, a line each; the values, the first axis along a line, the second down the lines, then the others.
One axis: level and value on each line.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.runs.export.content import Content
from swashfilm.runs.export.numbers import Number, held, in_unit, tables, wide
from system.maps.data import MapData

UNITS = {
    "rad/s": ("rpm", "rev/min"), "Pa": ("bar", "bar"), "K": ("degC", "degC"), "m": ("mm", "mm"),
    "N m": ("N m", "Nm"), "m3/s": ("L/min", "L/min"), "W": ("W", "W"),
}  # fmt: skip
"""Unit in the file by SI unit, and Amesim's name of it; a bare number has none."""


def amesim_files(data: MapData, name: str) -> Content:
    """Return a file for each of `TABLES` by its ending `_NUMBER.data`, in Amesim's usual units, twelve digits."""
    files = {f"_{number.identifier}.data": "\n".join(_lines(data, number)).encode() + b"\n" for number in tables(data)}
    return Content(files)


def _lines(data: MapData, number: Number) -> Iterator[str]:
    axes = wide(data)
    yield f"# Table format: {len(axes)}D"
    yield f"# {number.words}, of {data.name}, {data.words}"
    if constant := held(data):
        yield f"# constant: {constant}"
    yield from _unit_line("table_unit", number.unit)
    for k, axis in enumerate(axes, start=1):
        yield f"# axis {k}: {axis.input.words}"
        yield from _unit_line(f"axis{k}_unit", axis.input.unit)
    levels = [_converted(np.array(axis.values), axis.input.unit) for axis in axes]
    values = _converted(np.squeeze(number.values), number.unit)
    if len(axes) == 1:
        yield from (_line(pair) for pair in zip(*levels, values, strict=True))
        return
    yield from (str(len(one)) for one in levels)
    yield from (_line(one) for one in levels)
    yield from (_line(row) for row in values.reshape(len(levels[0]), -1, order="F").T)


def _unit_line(key: str, si_unit: str) -> Iterator[str]:
    if si_unit in UNITS:
        yield f"# {key} = {UNITS[si_unit][1]}"


def _converted(values: Array, si_unit: str) -> Array:
    return in_unit(values, si_unit, UNITS[si_unit][0]) if si_unit in UNITS else values


def _line(values: Sequence[float] | Array) -> str:
    return " ".join(f"{value:.12g}" for value in values)
