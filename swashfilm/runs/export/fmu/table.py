"""The map as C: names, axes and spline coefficients, as sources/pump.h reads them."""

from collections.abc import Iterator, Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.runs.export.fmu.variables import EFFICIENCY, Input, inputs
from swashfilm.runs.export.numbers import TABLES, display
from system.maps.data import MapData
from system.maps.interpolation import CUBIC, MapInterpolant, axis_spline, slack

PORTS = ("geometric_displacement", "port_delivery_pressure", "port_inlet_pressure")
"""Numbers that determine the lossless part of torque and flows."""
LOSS = "loss"
AXIS = """\
typedef struct {
    const char *name, *unit;           /* unit that people read */
    double factor, offset;             /* from SI to that unit */
    double lower, upper, slack, start; /* SI; slack: round-off by which an input may lie outside */
    size_t levels, degree;
    const double *knots;               /* levels + degree + 1, over 0..1 */
} Axis;"""


def table_header(data: MapData, identifier: str, token: str) -> str:
    """Return map.h: the model's identifier and token, the inputs, and the coefficients over all five inputs."""
    return "\n".join(_lines(data, identifier, token)) + "\n"


def channels(data: MapData) -> Array:
    """Return the spline coefficients (points, channels) of `TABLES` and `PORTS`, the last axis changing first."""
    interpolant = MapInterpolant(data)
    found = [
        interpolant.coefficients("shaft_power") - interpolant.coefficients("hydraulic_power")
        if name == LOSS
        else interpolant.coefficients(name)
        for name in (*TABLES, *PORTS)
    ]
    return np.stack([np.ravel(one) for one in found], axis=-1)


def _lines(data: MapData, identifier: str, token: str) -> Iterator[str]:
    given, rows = inputs(data), channels(data)
    yield "/* The map of a pump, by `swashfilm export --to fmu`. */"
    yield "#include <stddef.h>"
    yield f"#define MODEL_PREFIX {identifier}_"
    yield f'#define TOKEN "{token}"'
    yield f"#define MOST_WEIGHTS {CUBIC + 1}"
    yield f"enum {{ {_names([one.axis.input.value for one in given])}, INPUTS }};"
    yield f"enum {{ {_names([*TABLES, EFFICIENCY])}, OUTPUTS }};"
    first, *others = PORTS
    yield f"enum {{ {_names([first])} = {_names([EFFICIENCY])}, {_names(others)}, CHANNELS }};"
    yield AXIS
    for one in given:
        knots = ", ".join(repr(float(knot)) for knot in axis_spline(one.axis).knots)
        yield f"static const double KNOTS_{one.reference}[] = {{{knots}}};"
    yield "static const Axis AXIS[INPUTS] = {"
    yield from (f"    {{{_axis(one)}}}," for one in given)
    yield "};"
    yield f"static const double COEFFICIENTS[{len(rows)}][CHANNELS] = {{"
    yield from (f"    {{{', '.join(repr(float(value)) for value in row)}}}," for row in rows)
    yield "};"


def _names(names: Sequence[str]) -> str:
    return ", ".join(name.replace(".", "_").upper() for name in names)


def _axis(one: Input) -> str:
    """Return the fields of an `Axis`."""
    given, levels = one.axis.input, one.axis.values
    unit = display(given.unit)
    fields = (
        f'"{given.value}"', f'"{unit.name}"', repr(unit.factor), repr(unit.offset),
        *(repr(float(value)) for value in (levels[0], levels[-1], slack(one.axis), one.start)),
        str(len(levels)), str(axis_spline(one.axis).degree), f"KNOTS_{one.reference}",
    )  # fmt: skip
    return ", ".join(fields)
