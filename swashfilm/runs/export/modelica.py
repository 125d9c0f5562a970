"""A map as Modelica model: tables as text for `CombiTable2Ds` of the Modelica Standard Library 4, and a model of them.

The library has tables of two inputs: speed and pressure. Each level of the other inputs is a table of its own, and the
model is linear between them.
"""

import re
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from itertools import product

import numpy as np

from swashfilm.runs.export.content import Content
from swashfilm.runs.export.numbers import TABLES, Number, held, tables
from system.maps.data import MapData
from system.maps.plan import MapAxis, MapInput

UNITS = {"N m": "N.m"}
"""Units as Modelica writes them, where they differ."""
SHAFT = TABLES[0]
PACKAGE = re.compile(r"(?!(Modelica|Real|Integer|Boolean|String)$)[A-Z]\w*", re.ASCII)
"""Name of a package: the language's words begin with a small letter, except for its types."""


def package_name(text: str) -> str:
    """Return the nearest valid name of a package to a text."""
    name = re.sub(r"\W+", "_", text, flags=re.ASCII).strip("_").capitalize()
    return name if PACKAGE.fullmatch(name) else f"Map_{name}".rstrip("_")


def modelica_files(data: MapData, name: str) -> Content:
    """Return the text of the tables (.txt) and the package (.mo) by their endings; `name` is that of the package."""
    text = "\n".join(_table_lines(data))
    model = "\n".join(_package_lines(data, name))
    return Content({".mo": model.encode() + b"\n", ".txt": text.encode() + b"\n"})


def _table_lines(data: MapData) -> Iterator[str]:
    """Yield the file of tables: first row pressures, first column speeds, all digits, SI."""
    speeds, pressures = (np.array(axis.values) for axis in data.axes[:2])
    yield "#1"
    yield f"# {data.name}, {data.words}; swashfilm {version('swashfilm')}"
    yield "# u1 (first column) shaft speed, rad/s; u2 (first row) delivery pressure, Pa gauge"
    for number in tables(data):
        for at, index in enumerate(np.ndindex(*data.shape[2:]), start=1):
            place = ", ".join(
                f"{axis.input.words} {axis.input.text(axis.values[k])}"
                for axis, k in zip(data.axes[2:], index, strict=True)
            )
            yield f"double {number.identifier}_{at}({len(speeds) + 1},{len(pressures) + 1}) # {number.unit}; {place}"
            yield _row([0.0, *pressures])
            yield from (_row([speed, *row]) for speed, row in zip(speeds, number.values[:, :, *index], strict=True))


def _row(values: Sequence[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _package_lines(data: MapData, name: str) -> Iterator[str]:
    yield f'package {name} "{_quoted(data.name)} by its operating map, {_quoted(data.words)}"'
    yield from WEIGHTS.splitlines()
    yield from (f"  {line}" for line in _model_lines(data, name))
    yield f'  annotation (uses(Modelica(version="4.0.0")), version="{version("swashfilm")}");'
    yield f"end {name};"


def _model_lines(data: MapData, name: str) -> Iterator[str]:
    """Yield the model: a shaft, inputs, an output for each number but the torque, and the tables behind them."""
    between = [axis for axis in data.axes[2:] if len(axis.values) > 1]
    found = tables(data)
    yield 'model Pump "Torque, flows, loss and least films over speed and pressure"'
    yield f'  parameter String fileName = "{name}.txt" "Tables; with its folder where that is not the working one";'
    yield "  parameter Modelica.Blocks.Types.Extrapolation extrapolation ="
    yield '    Modelica.Blocks.Types.Extrapolation.NoExtrapolation "Beyond the map in speed and pressure";'
    yield '  Modelica.Mechanics.Rotational.Interfaces.Flange_a shaft "Drives the pump at positive speed";'
    for given in (MapInput.PRESSURE, *(axis.input for axis in between)):
        gauge = ", gauge" if given.unit == "Pa" else ""
        yield f'  Modelica.Blocks.Interfaces.RealInput {given.value}(unit="{given.unit}") "{given.words}{gauge}";'
    for number in found:
        if number.name != SHAFT:
            yield f"  {_output(number)}"
    yield '  Modelica.Units.SI.AngularVelocity shaft_speed "Speed of the shaft";'
    yield "protected"
    for axis in between:
        yield f"  Real {axis.input.value}_weight[{len(axis.values)}];"
    count = int(np.prod(data.shape[2:]))
    yield f"  Real weight[{count}];"
    yield from (f"  {_block(number, count)}" for number in found)
    yield "equation"
    yield "  shaft_speed = der(shaft.phi);"
    yield from (f"  {line}" for line in _equations(data, between, found, count))
    yield f'  annotation (Documentation(info="Constant: {_quoted(held(data)) or "nothing"}."));'
    yield "end Pump;"


def _output(number: Number) -> str:
    unit = UNITS.get(number.unit, number.unit)
    return f'Modelica.Blocks.Interfaces.RealOutput {number.identifier}(unit="{unit}") "{number.words}";'


def _block(number: Number, count: int) -> str:
    names = ", ".join(f'"{number.identifier}_{k}"' for k in range(1, count + 1))
    return (
        f"Modelica.Blocks.Tables.CombiTable2Ds {number.identifier}_table[{count}](each tableOnFile=true, "
        f"each fileName=fileName, tableName={{{names}}}, each extrapolation=extrapolation);"
    )


def _equations(data: MapData, between: Sequence[MapAxis], found: Sequence[Number], count: int) -> Iterator[str]:
    for axis in between:
        levels = ", ".join(repr(value) for value in axis.values)
        yield f"{axis.input.value}_weight = weights({axis.input.value}, {{{levels}}});"
    factors = [[f"{axis.input.value}_weight[{k + 1}]" for k in range(len(axis.values))] for axis in between]
    yield f"weight = {{{', '.join('*'.join(parts) or '1' for parts in product(*factors))}}};"
    yield f"for k in 1:{count} loop"
    for number in found:
        yield f"  {number.identifier}_table[k].u1 = shaft_speed;"
        yield f"  {number.identifier}_table[k].u2 = {MapInput.PRESSURE.value};"
    yield "end for;"
    for number in found:
        left = "shaft.tau" if number.name == SHAFT else number.identifier
        yield f"{left} = weight*{number.identifier}_table.y;"


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


WEIGHTS = """\
  function weights "Weight of each level for linear interpolation between them"
    input Real value;
    input Real levels[:] "Rising";
    output Real weight[size(levels, 1)];
  algorithm
    assert(value >= levels[1] and value <= levels[end], "a value beyond the levels of the map");
    weight := zeros(size(levels, 1));
    for k in 1:size(levels, 1) - 1 loop
      if value >= levels[k] and value <= levels[k + 1] then
        weight[k] := (levels[k + 1] - value)/(levels[k + 1] - levels[k]);
        weight[k + 1] := (value - levels[k])/(levels[k + 1] - levels[k]);
      end if;
    end for;
  end weights;"""
