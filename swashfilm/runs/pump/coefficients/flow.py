"""Files of flow coefficients in a run: source, range, and warnings beyond the range."""

from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.inputs.units import Dimension, format_quantity
from system.pump.assembly import PumpPoint

LARGEST_SHARE_BEYOND = 0.01
"""Fraction of a port's open time beyond a file's range above which a warning is given."""


def coefficient_records(pump: PumpDescription) -> list[dict[str, Any]]:
    """Return key, path, source and range of each file of coefficients."""
    ports, own = pump.ports, pump.ports.delivery.coefficient_file if pump.ports.delivery else None
    stated = {"ports.coefficient_file": ports.coefficient_file, "ports.delivery.coefficient_file": own}
    found = []
    for key, table in stated.items():
        if table is not None:
            record = {"file": str(table.path), "source": table.source, "range": _range(table)}
            found.append({"key": key, **record})
    return found


def coefficient_warnings(pump: PumpDescription, point: PumpPoint) -> list[str]:
    """Return a warning for each port beyond its file for longer than LARGEST_SHARE_BEYOND of its open time."""
    found = []
    sides = zip(
        ("suction", "delivery"),
        pump.ports.sides,
        (point.suction_area, point.delivery_area),
        (point.suction.pressure, point.delivery.pressure),
        strict=True,
    )
    for name, side, area, behind in sides:
        table = side.coefficient_file
        if table is None:
            continue
        share = share_beyond(table, area, point.cycle.pressure - behind, pump.oil.density, point.point.viscosity)
        if share > LARGEST_SHARE_BEYOND:
            found.append(
                f"coefficients_beyond_file: {name} port: {share:.0%} of the time in which it is open lies beyond "
                f"{table.path.name} ({_range(table)}), where its end value is used (limit "
                f"{LARGEST_SHARE_BEYOND:.0%}); add rows for it"
            )
    return found


def share_beyond(table: FlowCoefficients, area: Array, pressure_drop: Array, density: float, viscosity: float) -> float:
    """Return the fraction of angles with an open port (areas (N,) m2, drops (N,) Pa) beyond a file's rows.

    Laminar flow below its least flow number does not count. 0 where the port is never open.
    """
    is_open = area > 0.0
    size, drop = area[is_open], np.abs(pressure_drop[is_open])
    if not size.size:
        return 0.0
    number = np.sqrt(8.0 * size / np.pi * density * drop) / viscosity
    largest = np.interp(np.log(size), np.log(table.opening), np.log(table.flow_number[:, -1]))
    outside = (size < table.opening[0]) | (size > table.opening[-1])
    if table.opening.size == 1:
        outside = np.zeros_like(outside)  # such a file is independent of the opening
    return float(np.mean(outside | (number > np.exp(largest))))


def _range(table: FlowCoefficients) -> str:
    """Return the openings and Reynolds numbers of a file, in words."""
    ends = [format_quantity(float(size), Dimension.AREA, digits=4) for size in table.opening[[0, -1]]]
    opening = " .. ".join(ends) if ends[0] != ends[1] else f"{ends[0]} for all"
    return f"opening {opening}, Re {table.reynolds.min():.3g} .. {table.reynolds.max():.3g}"
