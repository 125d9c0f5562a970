"""One channel of a `recording.toml`: column, unit, noise, calibration."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.inputs.faults import stated
from system.inputs.toml_table import Table
from system.inputs.units import STANDARD_ATMOSPHERE, Dimension, QuantityError, unit_scale


class PressureReference(Enum):
    """Zero of a pressure."""

    ABSOLUTE = "absolute"
    GAUGE = "gauge"


class AccuracyClass(Enum):
    """Classes of measurement after ISO 4409; `channel_noise` states how well their limits are known."""

    A = "A"
    B = "B"
    C = "C"


@dataclass(frozen=True)
class TimeForm:
    """A time column: its name, and s per unit."""

    column: str
    factor: float


@dataclass(frozen=True)
class ChannelForm:
    """One channel as stated; None is not stated. SI value = factor x number + offset, pressures then gauge.

    sigma, quantum, zero in SI; gain relative; lag in s; sigma_relative of the reading in the file.
    """

    name: ChannelName
    column: str
    unit: str
    factor: float
    offset: float
    sigma: float | None
    sigma_relative: float | None
    quantum: float | None
    lag: float | None
    gain: float | None
    zero: float | None
    accuracy: AccuracyClass | None

    @property
    def is_pressure(self) -> bool:
        """True for a pressure, which is absolute or gauge."""
        return self.name.dimension is Dimension.PRESSURE

    def si(self, numbers: Array) -> Array:
        """Numbers of the file in SI, pressures gauge."""
        return self.factor * numbers + self.offset


def read_channel(table: Table, name: ChannelName, reference: PressureReference) -> ChannelForm | None:
    """Return one channel's form; None with its faults added."""
    before = len(table.faults)
    column, unit = table.get("column"), table.get("unit")
    if not isinstance(column, str) or not column:
        table.fault("column", stated(column), "the name of a column")
    own = (
        table.choice("reference", PressureReference, reference)
        if name.dimension is Dimension.PRESSURE
        else reference
    )
    factor, offset = _scale(table, unit, name, own or reference)
    numbers = {key: _not_negative(table, key) for key in ("sigma", "sigma_relative", "quantum")}
    if numbers["sigma_relative"] and name.dimension is Dimension.TEMPERATURE:
        table.fault("sigma_relative", repr(numbers["sigma_relative"]), "sigma alone: no share of a temperature")
    lag = table.quantity("lag", Dimension.TIME) if "lag" in table.values else None
    accuracy = table.choice("accuracy_class", AccuracyClass) if "accuracy_class" in table.values else None
    table.asked.extend(key for key in ("lag", "accuracy_class") if key not in table.asked)
    gain, zero = _calibration(table, name, factor)
    table.close()
    if len(table.faults) > before:
        return None
    sigma, quantum = (None if (s := numbers[key]) is None else s * factor for key in ("sigma", "quantum"))
    return ChannelForm(
        name, str(column), str(unit), factor, offset,
        sigma, numbers["sigma_relative"], quantum, lag, gain, zero, accuracy,
    )  # fmt: skip


def read_time(table: Table, *, needed: bool) -> TimeForm | None:
    """Return the form of a table's time column, `time = { column, unit }`; None where there is none."""
    time = table.table("time", needed="with column and unit" if needed else "")
    if time is None:
        return None
    column, unit = time.get("column"), time.get("unit")
    if not isinstance(column, str) or not column:
        time.fault("column", stated(column), "the name of a column")
    factor = 1.0
    try:
        factor, _ = unit_scale(unit if isinstance(unit, str) else "", Dimension.TIME)
    except QuantityError as reason:
        time.fault("unit", reason.found, reason.expected)
    time.close()
    return TimeForm(str(column), factor)


def _scale(table: Table, unit: object, name: ChannelName, reference: PressureReference) -> tuple[float, float]:
    """Factor and offset from the file's number to SI; (1, 0) with its fault added."""
    if name.dimension is None:
        if unit not in ("1", "%"):
            table.fault("unit", stated(unit), "'1' or '%'")
        return (0.01 if unit == "%" else 1.0), 0.0
    try:
        factor, offset = unit_scale(unit if isinstance(unit, str) else "", name.dimension)
    except QuantityError as reason:
        table.fault("unit", "missing" if unit is None else reason.found, reason.expected, reason.nearest)
        return 1.0, 0.0
    absolute = name.dimension is Dimension.PRESSURE and reference is PressureReference.ABSOLUTE
    return factor, offset - STANDARD_ATMOSPHERE if absolute else offset


def _not_negative(table: Table, key: str) -> float | None:
    """A number not below zero; None if it is left out, or with its fault added."""
    if table.get(key) is None:
        return None
    number = table.number(key)
    if number is not None and number < 0.0:
        table.fault(key, repr(number), "a number not below zero")
        return None
    return number


def _calibration(table: Table, name: ChannelName, factor: float) -> tuple[float | None, float | None]:
    """One sigma of gain (relative) and zero (SI) of `calibration = { gain = 0.001, zero = "0.1 N m" }`."""
    known = table.table("calibration")
    if known is None:
        return None, None
    gain, zero = _not_negative(known, "gain"), None
    raw = known.get("zero")
    if isinstance(raw, str) and name.dimension is not None:
        zero = _difference(known, raw, name.dimension)
    elif raw is not None and name.dimension is not None:
        known.fault("zero", repr(raw), f"{name.dimension.noun} with its unit, such as '{name.dimension.example}'")
    elif raw is not None:
        zero = _not_negative(known, "zero")
        zero = None if zero is None else zero * factor
    known.close()
    return gain, zero


def _difference(table: Table, text: str, dimension: Dimension) -> float | None:
    """A difference such as "0.3 degC" in SI: the unit's factor alone."""
    number, _, unit = text.strip().partition(" ")
    try:
        value = float(number) * unit_scale(unit.strip(), dimension)[0]
    except (ValueError, QuantityError):
        value = math.nan
    if not value >= 0.0 or math.isinf(value):
        table.fault(
            "zero", repr(text), f"a difference not below zero with its unit, such as '0.3 {_unit(dimension)}'"
        )
        return None
    return value


def _unit(dimension: Dimension) -> str:
    return dimension.example.split(" ", 1)[1]
