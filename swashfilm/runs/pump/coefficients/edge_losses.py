"""Files of edge losses of lands and bores in a run: source, range, and warnings beyond the range."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription, SlipperSection
from system.inputs.coefficients.file_table import FileTable
from system.inputs.coefficients.loss_files import LossFactors
from system.inputs.units import Dimension, format_quantity
from system.pump.assembly import PumpPoint
from system.pump.land_losses import deepest, land_losses

LARGEST_SHARE_BEYOND = 0.01
"""Fraction of the turn beyond a file's last row above which a warning is given."""


def loss_records(pump: PumpDescription) -> list[dict[str, Any]]:
    """Return key, path, source and range of each file of losses, with those of single slippers."""
    stated = [("slipper", pump.slipper), *((f"slipper.{n}", part) for n, part in pump.single_slippers)]
    found: list[dict[str, Any]] = []
    listed: set[tuple[str, Path]] = set()
    for table, part in stated:
        for key, own, words in _of_slipper(part):
            if (key, own.path) not in listed:
                listed.add((key, own.path))
                found.append({"key": f"{table}.{key}", "file": str(own.path), "source": own.source, "range": words})
    plate = pump.valve_plate.kidney_file
    if plate is not None:
        record = {"file": str(plate.path), "source": plate.source, "range": _steps(plate)}
        found.append({"key": "valve_plate.kidney_file", **record})
    return found


def _of_slipper(part: SlipperSection) -> Iterator[tuple[str, FileTable, str]]:
    """Return keys of a slipper's files, their tables and ranges."""
    if part.orifice_file is not None:
        table = part.orifice_file
        own = format_quantity(0.25 * np.pi * part.orifice_diameter**2, Dimension.AREA, digits=4)
        words = f"opening {own} of {table.opening.size} in the file, Re {_ends(table.reynolds)}"
        yield "orifice_file", table, words
    if part.pocket_file is not None:
        yield "pocket_file", part.pocket_file, _steps(part.pocket_file)
    if part.groove_file is not None:
        losses = part.groove_file
        ratio, width = losses.sizes.T
        ends = _ends(width[ratio == ratio.max()])
        words = f"film_ratio {ratio.max():g} used, width_ratio {ends}, Re {_ends(losses.reynolds)}"
        yield "groove_file", losses, words


def _steps(losses: LossFactors) -> str:
    """Return range of a file of steps, in words."""
    into, out = deepest(losses)
    lengths = f"extra length {losses.extra_length[into]:.3g} and {losses.extra_length[out]:.3g}"
    ratios = f"film_ratio {losses.sizes[into, 0]:g} and {losses.sizes[out, 0]:g} used"
    return f"{ratios}, {lengths}, Re {_ends(losses.reynolds)}"


def _ends(values: Array) -> str:
    return f"{values.min():.3g} .. {values.max():.3g}"


def loss_warnings(pump: PumpDescription, point: PumpPoint) -> list[str]:
    """Return a warning for each file whose range the Reynolds number exceeds longer than LARGEST_SHARE_BEYOND.

    Valid for the first chamber and those identical to it. Floating gaps read no files of lands: `losses_left_out`.
    """
    losses = land_losses(pump)
    _, slipper, plate = _flows(point)
    kinematic = point.point.viscosity / pump.oil.density
    stated = [
        ("slipper.pocket_file", pump.slipper.pocket_file, losses.slipper, slipper),
        ("slipper.groove_file", pump.slipper.groove_file, losses.slipper, slipper),
        # Half of a kidney's flow for each land, accurate enough for the check of a range.
        ("valve_plate.kidney_file", pump.valve_plate.kidney_file, losses.inner, 0.5 * plate),
    ]
    found = []
    for key, own, lands, flow in stated:
        if own is not None:
            number = np.array([lands.largest_reynolds(one, kinematic) for one in np.atleast_1d(flow)])
            found += _beyond(key, own.path, number, float(own.reynolds[-1]))
    if (bore := pump.slipper.orifice_file) is not None:
        number = 4.0 * np.abs(slipper) / (np.pi * pump.slipper.orifice_diameter * kinematic)
        found += _beyond("slipper.orifice_file", bore.path, number, float(bore.reynolds.max()))
    return found


def losses_left_out(pump: PumpDescription) -> list[str]:
    """Return a warning with the files that floating gaps do not use."""
    stated = {
        "slipper.pocket_file": pump.slipper.pocket_file,
        "slipper.groove_file": pump.slipper.groove_file,
        "valve_plate.kidney_file": pump.valve_plate.kidney_file,
    }
    keys = [key for key, table in stated.items() if table is not None]
    if not keys:
        return []
    listed = ", ".join(keys)
    return [f"losses_left_out: {listed}: floating gaps have no edge losses; run --fidelity lumped or fixed"]


def _flows(point: PumpPoint) -> Array:
    """Return the pressure flow (m3/s) of one chamber into each gap, (3, N), at the angles of its leakage."""
    every = point.cycle.pressure.size // point.leaks.conductance.shape[-1]
    return point.leaks.conductance * (point.cycle.pressure[::every] - point.point.case_pressure)


def _beyond(key: str, path: Path, reynolds: Array, largest: float) -> list[str]:
    share = float(np.mean(reynolds > largest))
    if share <= LARGEST_SHARE_BEYOND:
        return []
    return [
        f"coefficients_beyond_file: {key}: {share:.0%} of the turn lies at Reynolds numbers up to "
        f"{reynolds.max():.3g}, beyond {path.name} (Re {largest:.3g}), whose last row is used (limit "
        f"{LARGEST_SHARE_BEYOND:.0%} of the turn); add rows for it"
    ]
