"""Response tables on disk: kept in one folder, found by the content of their pump."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from gaps.response import Axis, HeldOutError, Measure, Output, Response, Samples, Spacing
from reynolds.numerics.cache import content_key
from reynolds.numerics.files import read_json, replaced
from reynolds.numerics.npz import read_npz, write_npz
from system.description.keys import pump_keys, with_values
from system.description.pump import PumpDescription
from system.description.tolerance import ToleranceSection
from system.inputs.faults import Fault, InputFaults, nearest_path
from system.inputs.units import Dimension
from system.inputs.versions import version_fault
from system.points.table.means import MEANINGS, OLDEST_TABLE, TABLE_FORMAT
from system.points.table.pump_numbers import NUMBERS, NumbersError
from system.points.table.response_table import Failed, ResponseTable, TableOrigin, axis_dimension, box_text, point_text
from system.points.table.sources import Source, films_alone, left_out
from system.pump.operating import OperatingPoint
from system.pump_file.file import resolved_toml
from system.work.sampled_points import tables_folder

KEY_LENGTH = 24


def pump_key(pump: PumpDescription) -> str:
    """Hash of all inputs of a pump's gaps besides the axes.

    Without its name, its tolerances, its lines and laws outside its films.
    """
    # A clearance that grows with temperature starts from the pump's own, which is then not only an axis.
    own = pump.operating.temperature if pump.physics.thermal_clearance else 0.0
    stated = replace(pump.operating, speed=0.0, pressure=0.0, displacement_ratio=1.0, temperature=own)
    bare = replace(films_alone(pump), name="", operating=stated, tolerance=ToleranceSection())
    made_of = TABLE_FORMAT, resolved_toml(bare), pump.file_contents
    return content_key("pump of a response table", *made_of)[:KEY_LENGTH]


def keep_table(table: ResponseTable, place: Path) -> None:
    """Write `place`.npz, the points with their values, and `place`.json, their record."""
    write_response(place, table.response, table_record(table))


def write_response(place: Path, response: Response, record: Mapping[str, Any]) -> None:
    """Write `place`.npz, the points of a response with values, and `place`.json, the record of the response."""
    place.parent.mkdir(parents=True, exist_ok=True)
    arrays = {
        "learnt_points": response.learnt.points,
        "learnt_values": response.learnt.values,
        "held_out_points": response.held_out.points,
        "held_out_values": response.held_out.values,
    }
    write_npz(place.with_suffix(".npz"), arrays)
    with replaced(place.with_suffix(".json")) as beside:
        beside.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


Read = TypeVar("Read")


def read_response(
    path: Path, newest: int, made: Callable[[Mapping[str, Any], Response], Read], oldest: int = 1
) -> Read:
    """Result of `made` for the record and response written by `write_response`, from its .json or .npz.

    Raises InputFaults where it is absent, or of a format outside `oldest` to `newest`.
    """
    try:
        record = read_json(path.with_suffix(".json"))
        version = record["table_format"]
        if fault := version_fault("table_format", version, newest, "response table", oldest):
            raise InputFaults(str(path.with_suffix(".json")), [fault])
        arrays = read_npz(path.with_suffix(".npz"))
        learnt = Samples(arrays["learnt_points"], arrays["learnt_values"])
        held_out = Samples(arrays["held_out_points"], arrays["held_out_values"])
        return made(record, _response(_axes(record), _outputs(record), learnt, held_out))
    except (ArithmeticError, AttributeError, LookupError, OSError, TypeError, ValueError) as reason:
        expected = "the .json and .npz that `swashfilm table` wrote, side by side"
        near = nearest_path(path.with_suffix(".json"))
        raise InputFaults("response table", [Fault(str(path), repr(reason), expected, near)]) from None


def _response(axes: tuple[Axis, ...], outputs: tuple[Output, ...], learnt: Samples, held_out: Samples) -> Response:
    """The response; raises ValueError for points or values of another shape than inputs and outputs."""
    for samples in (learnt, held_out):
        count = len(samples.points)
        if not count or samples.points.shape != (count, len(axes)) or samples.values.shape != (count, len(outputs)):
            raise ValueError(f"points of {samples.points.shape} with values of {samples.values.shape}")
    return Response(axes, outputs, learnt, held_out)


def read_table(path: Path) -> ResponseTable:
    """The table that `keep_table` wrote, by its .json or .npz; raises InputFaults for any other file."""
    return read_response(path, TABLE_FORMAT, _pump_table, OLDEST_TABLE)


def _pump_table(record: Mapping[str, Any], response: Response) -> ResponseTable:
    if [output.name for output in response.outputs] != list(MEANINGS):
        raise ValueError(f"outputs {', '.join(output.name for output in response.outputs)}")
    return ResponseTable(_origin(record), response, _numbers(record["numbers"], response))


def _numbers(rows: Sequence[Mapping[str, Any]], response: Response) -> NumbersError:
    if [row["name"] for row in rows] != list(NUMBERS):
        raise ValueError(f"numbers {', '.join(row['name'] for row in rows)}")
    rms, largest = (np.array([_number(row[key]) for row in rows]) for key in ("held_out_rms", "held_out_largest"))
    points = response.held_out.points.tolist()
    worst = np.array([points.index(row["held_out_worst_at"]) for row in rows])
    return NumbersError(tuple(Measure(row["measure"]) for row in rows), HeldOutError(rms, largest, worst))


def find_table(pump: PumpDescription, point: OperatingPoint, folder: Path | None = None) -> ResponseTable:
    """The kept table of a pump whose box contains a point: of the last source in `Source`, then with the least film
    physics left out, then with the most points.

    Raises InputFaults without such a table, with the boxes of the other tables.
    """
    tables = [read_table(path) for path in sorted(tables_folder(folder).glob(f"{pump_key(pump)}-*.json"))]
    fit = [table for table in tables if table.holds(pump, point)]
    if fit:
        return max(fit, key=_fitness)
    boxes = " or ".join(dict.fromkeys(box_text(table) for table in tables))
    if tables:
        fault = Fault("--fidelity table", point_text(point), f"a point in the box of a table: {boxes}")
    else:
        fault = Fault(
            "--fidelity table",
            f"no table of this pump at its inlet and case pressure in {tables_folder(folder)}",
            "one built before",
            "swashfilm table PUMP, with the same inlet and case pressure",
        )
    raise InputFaults("response table", [fault])


def _fitness(table: ResponseTable) -> tuple[int, int, int]:
    """A table's place among those of one box: larger is better."""
    origin = table.origin
    return list(Source).index(origin.source), -len(left_out(origin.stated)), len(table.response.learnt.points)


def own_table(path: Path, pump: PumpDescription) -> ResponseTable:
    """The table of a file, which must be this pump's except for the dimensions of its box.

    Raises InputFaults where it is another's.
    """
    table = read_table(path)
    if table.origin.pump_key != pump_key(as_built(table, pump)):
        found = f"{path}, a table of {table.origin.pump} as it was then"
        fault = Fault("--table", found, "a table of this very pump, inlet and case pressure", "swashfilm table PUMP")
        raise InputFaults("response table", [fault])
    return table


def as_built(table: ResponseTable, pump: PumpDescription) -> PumpDescription:
    """The pump with the dimensions of the table's box as they were when it was built."""
    known = pump_keys(pump)
    made = with_values(pump, {path: value for path, value in table.origin.dimensions.items() if path in known})
    return replace(made, pump=replace(made.pump, displacement=pump.pump.displacement))


def table_name(table: ResponseTable) -> str:
    """Hash of all that a table holds: its record, and its points."""
    learnt = table.response.learnt
    return content_key(table_record(table), learnt.points, learnt.values)[:KEY_LENGTH]


def table_record(table: ResponseTable) -> dict[str, Any]:
    """Content of the .json: origin, box, outputs with their errors."""
    origin = table.origin
    return {
        "kind": "response_table_data",
        "table_format": TABLE_FORMAT,
        **{key: value for key, value in asdict(origin).items() if key not in ("source", "failed")},
        "source": origin.source.value,
        "units": "SI, pressures gauge; outputs 1",
        **response_record(table.response, {axis.name: axis_dimension(axis.name) for axis in table.response.axes}),
        "numbers": _numbers_record(table),
        "failed": [{"at": list(one.at), "reason": one.reason} for one in origin.failed],
    }


def _numbers_record(table: ResponseTable) -> list[dict[str, Any]]:
    """The rows of errors of runs by the table, none before the runs."""
    if table.numbers is None:
        return []
    return [
        {"name": name, "measure": measure.value} | _errors(table.response, table.numbers.error, k)
        for k, (name, measure) in enumerate(zip(NUMBERS, table.numbers.measures, strict=True))
    ]


def _errors(response: Response, error: HeldOutError, k: int) -> dict[str, Any]:
    """The error of one column, and where it is largest."""
    return {
        "held_out_rms": float(error.rms[k]),
        "held_out_largest": float(error.largest[k]),
        "held_out_worst_at": response.held_out.points[error.worst[k]].tolist(),
    }


def response_record(response: Response, dimensions: Mapping[str, Dimension | None]) -> dict[str, Any]:
    """Content of the .json for a response: its box (axes of these dimensions), its outputs and their errors."""
    error = response.held_out_error
    return {
        "axes": [
            asdict(axis)
            | {"spacing": axis.spacing.value, "dimension": own.name if (own := dimensions.get(axis.name)) else None}
            for axis in response.axes
        ],
        "outputs": [
            asdict(output) | {"measure": output.measure.value} | _errors(response, error, k)
            for k, output in enumerate(response.outputs)
        ],
        "points": {"learnt": len(response.learnt.points), "held_out": len(response.held_out.points)},
    }


def _origin(record: Mapping[str, Any]) -> TableOrigin:
    return TableOrigin(
        pump=_text(record["pump"]),
        pump_key=_text(record["pump_key"]),
        source=Source(record["source"]),
        stated={name: _text(value) for name, value in record["stated"].items()},
        package=_text(record["package"]),
        inlet_pressure=_number(record["inlet_pressure"]),
        case_pressure=_number(record["case_pressure"]),
        held={name: _number(value) for name, value in record["held"].items()},
        dimensions={name: _number(value) for name, value in record.get("dimensions", {}).items()},
        failed=tuple(Failed(tuple(map(_number, one["at"])), _text(one["reason"])) for one in record["failed"]),
        seconds=_number(record["seconds"]),
    )


def _number(value: object) -> float:
    """A number of a record; raises TypeError for anything else."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise TypeError(f"{value!r} in place of a number")
    return float(value)


def _text(value: object) -> str:
    """A text of a record; raises TypeError for anything else."""
    if not isinstance(value, str):
        raise TypeError(f"{value!r} in place of a text")
    return value


def _axes(record: Mapping[str, Any]) -> tuple[Axis, ...]:
    return tuple(
        Axis(_text(row["name"]), _number(row["lower"]), _number(row["upper"]), Spacing(row["spacing"]))
        for row in record["axes"]
    )


def _outputs(record: Mapping[str, Any]) -> tuple[Output, ...]:
    return tuple(
        Output(
            _text(row["name"]),
            Measure(row["measure"]),
            _number(row["least"]),
            tuple((_text(name), _number(power)) for name, power in row.get("powers", ())),
        )
        for row in record["outputs"]
    )
