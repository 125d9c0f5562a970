"""Files of an operating map: one NetCDF file with units and provenance, and tables derived from it."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.data.files import Column, read_netcdf, write_columns, write_netcdf
from system.inputs.faults import Fault, InputFaults, nearest_path, one_line
from system.inputs.units import Dimension, parse_quantity
from system.maps.data import MapData, best_points, objects
from system.maps.interpolation import MapError
from system.maps.plan import MapAxis, MapInput
from system.maps.point import QUANTITIES, Members
from system.pump.efficiency import EfficiencyDefinition
from system.work.kept_results import POINTS
from system.work.tasks import PartStatus

if TYPE_CHECKING:
    import xarray

MAP = "map.nc"
MAP_SUFFIX = ".nc"
_AT_EACH_POINT = ("delivery_flow", "inlet_flow", "shaft_power", "hydraulic_power", "shaft_torque")
PARTS = ("overall", "volumetric", "hydromechanical")
ERRORS = ("rms", "largest")
_DIMENSIONS = {Members.PAIR: "pair", Members.GAP: "gap"}
_IN_FILES = {"m3/rev": "m^3", "m3/s": "m^3/s"}
"""Units that both UDUNITS and pint read; a revolution is not a unit."""


def write_map(path: Path, data: MapData, error: MapError | None, summary: Mapping[str, Any]) -> None:
    """Write a map as NetCDF: all five axes as dimensions, every variable with units, provenance in attributes."""
    dataset = map_dataset(data, error)
    dataset.attrs = {
        "Conventions": "CF-1.11",
        "title": f"operating map of {data.name}, {data.words}",
        "source": f"swashfilm {version('swashfilm')}",
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "pump": data.name,
        "solver": data.words,
        "stated": json.dumps(summary["stated"]),
        "resolved_toml": summary["resolved_toml"],
        "assumptions": "\n".join(summary["assumptions"]),
        "interpolation_error": f"{error.count} {error.shown_by}" if error else "",
        "bulk_modulus": data.bulk_modulus,
    }
    write_netcdf(dataset, path, "map")


def map_dataset(data: MapData, error: MapError | None) -> xarray.Dataset:
    """Return the map as labelled arrays, SI."""
    import xarray

    dims = [axis.input.value for axis in data.axes]
    coordinates: dict[str, Any] = {
        axis.input.value: (axis.input.value, np.array(axis.values), _about(axis.input.unit, axis.input.words))
        for axis in data.axes
    }
    coordinates |= {dim: (dim, _texts(members.value)) for members, dim in _DIMENSIONS.items()}
    coordinates["definition"] = ("definition", _texts([one.value for one in EfficiencyDefinition]))
    variables = _numbers(data, dims) | _efficiencies(data, dims)
    variables["toet_displacement"] = (
        dims[2:], _toet(data), _about("m^3", "derived displacement a revolution by Toet (ISO 8426-1)"),
    )  # fmt: skip
    variables["status"] = (dims, _texts(data.status), {"long_name": "status of the point"})
    variables["reason"] = (dims, _texts(data.reason), {"long_name": "why there is no result"})
    texts = objects([json.dumps([list(one) for one in remarks]) for remarks in data.warnings.flat], data.shape)
    variables["warnings"] = (dims, texts, {"long_name": "warnings of the point: names and texts, JSON"})
    return xarray.Dataset(variables | _error_variables(error), coords=coordinates)


def _numbers(data: MapData, dims: Sequence[str]) -> dict[str, Any]:
    found = {}
    for quantity in QUANTITIES:
        arrays = [data.values[column] for column in quantity.columns]
        about = _about(_IN_FILES.get(quantity.unit, quantity.unit), quantity.words)
        dim = _DIMENSIONS.get(quantity.members)
        found[quantity.name] = ([dim, *dims], np.stack(arrays), about) if dim else (dims, arrays[0], about)
    return found


def _efficiencies(data: MapData, dims: Sequence[str]) -> dict[str, Any]:
    """Return the three efficiencies over the definitions, with the formulas in the attributes."""
    found = [data.efficiency(definition) for definition in EfficiencyDefinition]
    formulas = "; ".join(f"{one.value}: {one.formula}" for one in EfficiencyDefinition)
    return {
        f"{part}_efficiency": (
            ["definition", *dims],
            np.stack([getattr(one, part) for one in found]),
            _about("1", f"{part} efficiency by definition") | {"formula": formulas},
        )
        for part in PARTS
    }


def _toet(data: MapData) -> np.ndarray:
    found = np.full(data.shape[2:], np.nan)
    for index, derived in data.toet.items():
        found[index] = derived.value
    return found


def _error_variables(error: MapError | None) -> dict[str, Any]:
    """Return rms and largest error of each number between levels; empty where it is not known."""
    if error is None:
        return {}
    found: dict[str, Any] = {}
    for quantity in QUANTITIES:
        values = np.array([[getattr(error, kind)[column] for kind in ERRORS] for column in quantity.columns])
        dim = _DIMENSIONS.get(quantity.members)
        about = _about(_IN_FILES.get(quantity.unit, quantity.unit), f"error between levels: {quantity.words}")
        found[f"error_{quantity.name}"] = ([dim, "error"], values, about) if dim else (["error"], values[0], about)
    return found | {"error": ("error", _texts(ERRORS))}


def map_file(place: Path) -> Path:
    """Return the file of a map, given directly or by its run folder; raise InputFaults without one."""
    if place.suffix == MAP_SUFFIX and place.is_file():
        return place
    if (place / MAP).is_file():
        return place / MAP
    what = f"a folder without {MAP}" if place.is_dir() else "a file of another kind"
    found = f"'{place}', {what if place.exists() else 'no such file or folder'}"
    near = _makes_a_map(place) if place.exists() else nearest_path(place)
    fault = Fault("map", found, f"the run folder of a `swashfilm map`, or its {MAP}", near)
    raise InputFaults("command line", [fault])


def _makes_a_map(place: Path) -> str:
    """Return the command that makes a map of an interrupted run or a pump file; empty for anything else."""
    if (place / POINTS).is_dir():
        return f"swashfilm map .. --resume {quote(str(place))} completes it"
    pump = place if place.suffix == ".toml" else place / "resolved.toml"
    return f"swashfilm map {quote(str(pump))} computes one" if pump.is_file() else ""


def read_map(path: Path) -> tuple[MapData, MapError | None]:
    """Return the map of a file of `write_map`, with its error; raise InputFaults for any other file."""
    dataset = read_netcdf(path)
    try:
        data = map_of(dataset)
        _expect_whole(data)
        return data, _error(dataset)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as reason:
        found = f"not a map of swashfilm ({type(reason).__name__}: {reason})"
        raise InputFaults(str(path), [Fault("map", found, f"the {MAP} of a run of `swashfilm map`")]) from None


def _expect_whole(data: MapData) -> None:
    """Raise ValueError for levels that do not rise, a number of another shape, and a solved point without results."""
    for axis in data.axes:
        levels = np.asarray(axis.values)
        if not (levels.size and np.isfinite(levels).all() and (np.diff(levels) > 0.0).all()):
            raise ValueError(f"the levels of {axis.input.value} do not rise")
    known = {status.value for status in PartStatus}
    if not known.issuperset(data.status.flat):
        raise ValueError(f"a status that is none of {', '.join(sorted(known))}")
    for name, values in data.values.items():
        if values.shape != data.shape or values.dtype.kind != "f":
            raise ValueError(f"{name} has no number at each point")
        if np.isinf(values).any() or (name in _AT_EACH_POINT and np.isnan(values[data.solved]).any()):
            raise ValueError(f"{name} is not finite at a solved point")


def map_of(dataset: xarray.Dataset) -> MapData:
    """Return the map of a data set of `map_dataset`."""
    axes = tuple(MapAxis(given, tuple(map(float, dataset[given.value].values))) for given in MapInput)
    shape = tuple(len(axis.values) for axis in axes)
    warnings = [tuple(tuple(one) for one in json.loads(str(text))) for text in dataset["warnings"].values.flat]
    return MapData(
        name=one_line(dataset.attrs["pump"]),
        words=one_line(dataset.attrs["solver"]),
        bulk_modulus=float(dataset.attrs["bulk_modulus"]),
        axes=axes,
        values=dict(_columns(dataset, "")),
        status=objects([str(text) for text in dataset["status"].values.flat], shape),
        reason=objects([str(text) for text in dataset["reason"].values.flat], shape),
        warnings=objects(warnings, shape),
        rated=_rated(str(dataset.attrs["resolved_toml"])),
    )


def _rated(resolved: str) -> dict[MapInput, float]:
    """Return the rated speed and pressure of a resolved pump file, SI."""
    pump = tomllib.loads(resolved)["pump"]
    return {
        MapInput.SPEED: parse_quantity(pump["rated_speed"], Dimension.ANGULAR_SPEED),
        MapInput.PRESSURE: parse_quantity(pump["rated_pressure"], Dimension.PRESSURE),
    }


def _error(dataset: xarray.Dataset) -> MapError | None:
    if not dataset.attrs["interpolation_error"]:
        return None
    count, _, shown_by = dataset.attrs["interpolation_error"].partition(" ")
    found = dict(_columns(dataset, "error_"))
    rms, largest = ({name: float(values[k]) for name, values in found.items()} for k in range(len(ERRORS)))
    return MapError(rms, largest, int(count), shown_by)


def _columns(dataset: xarray.Dataset, before: str) -> Any:
    """Yield (column, values) of every number of the map."""
    for quantity in QUANTITIES:
        values = dataset[before + quantity.name].values
        several = quantity.members in _DIMENSIONS
        yield from zip(quantity.columns, values if several else [values], strict=True)


def write_tables(folder: Path, data: MapData) -> None:
    """Write map.csv (one line per point), shares.csv (of each loss) and best.csv, units in the heads."""
    inputs = _inputs(data)
    numbers = [
        Column(column, data.values[column].ravel(), quantity.unit)
        for quantity in QUANTITIES
        for column in quantity.columns
    ]
    for definition in EfficiencyDefinition:
        found = data.efficiency(definition)
        numbers += [Column(f"{definition.value}.{part}", getattr(found, part).ravel(), "1") for part in PARTS]
    texts = [Column("status", data.status.ravel()), Column("reason", data.reason.ravel())]
    write_columns(folder / "map.csv", [*inputs, *numbers, *texts])
    losses, whole = data.losses, data.loss
    shares = [Column(words, (100.0 * loss / whole).ravel(), "%") for words, loss in losses.items()]
    write_columns(folder / "shares.csv", [*inputs, Column("loss", whole.ravel(), "W"), *shares])
    best = best_points(data)
    at = [np.ravel_multi_index(one.index, data.shape) for one in best]
    definitions = Column("definition", [one.definition.value for one in best])
    overall = Column("overall efficiency", [100.0 * one.overall for one in best], "%")
    places = [Column(one.name, np.asarray(one.values)[at], one.unit) for one in inputs]
    write_columns(folder / "best.csv", [definitions, overall, *places])


def _inputs(data: MapData) -> list[Column]:
    """Return the inputs at every point."""
    found = []
    for k, axis in enumerate(data.axes):
        shape = [1] * len(data.axes)
        shape[k] = len(axis.values)
        values = np.broadcast_to(np.reshape(axis.values, shape), data.shape).ravel()
        found.append(Column(axis.input.words, values, axis.input.unit))
    return found


def _about(unit: str, words: str) -> dict[str, str]:
    return {"units": unit, "long_name": words}


def _texts(values: Any) -> np.ndarray:
    return np.array(values, dtype=object)
