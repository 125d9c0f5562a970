"""One channel of a `recording.toml`: its table, and column, unit, noise and calibration in SI."""

from __future__ import annotations

from dataclasses import dataclass, field, make_dataclass
from enum import Enum
from typing import Annotated

from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.inputs.sections.fields import Coefficient, Limits, NotNegative, Span, Text, UnitOf
from system.inputs.sections.values import PURE_UNITS
from system.inputs.units import STANDARD_ATMOSPHERE, Dimension, unit_scale

Column = Annotated[str, Text.COLUMN]
Lag = Annotated[float, Dimension.TIME, NotNegative]


class PressureReference(Enum):
    """Zero of a pressure."""

    ABSOLUTE = "absolute"
    GAUGE = "gauge"


class AccuracyClass(Enum):
    """Classes of measurement after ISO 4409; `channel_noise` states the reliability of their limits."""

    A = "A"
    B = "B"
    C = "C"


@dataclass(frozen=True, kw_only=True)
class CalibrationSection:
    """calibration: one sigma of gain and zero."""

    gain: Coefficient | None = None  # relative
    zero: Coefficient | None = None  # of a quantity a difference with its unit


@dataclass(frozen=True, kw_only=True)
class ChannelSection:
    """A channel of one dimension: sigma and quantum in the channel's unit; None is not stated."""

    column: Column
    unit: str  # of the numbers in the column
    sigma: Coefficient | None = None  # one sigma of repeatability, in the channel's unit
    sigma_relative: Coefficient | None = None  # share of the reading that adds to it
    quantum: Coefficient | None = None  # step of the reading, in the channel's unit
    lag: Lag | None = None  # time constant of the sensor
    accuracy_class: AccuracyClass | None = None  # after ISO 4409
    calibration: CalibrationSection = CalibrationSection()


def channel_section(name: ChannelName) -> type[ChannelSection]:
    """Return the table of a channel: unit and calibration of its dimension, `reference` of a pressure."""
    dimension = name.dimension
    parts: list[tuple[str, object, object]] = [("unit", Annotated[str, UnitOf(dimension)], field(kw_only=True))]
    if dimension is not None:
        zero = Annotated[float, dimension, Span.OF_TWO, NotNegative]
        own = ("zero", zero | None, None)
        calibration = make_dataclass("Calibration", [own], bases=(CalibrationSection,), frozen=True)
        parts.append(("calibration", calibration, field(default=calibration(), kw_only=True)))
    if dimension is Dimension.PRESSURE:
        parts.append(("reference", PressureReference | None, None))  # where it differs from the file's
    if dimension is Dimension.TEMPERATURE:
        none = Limits(least=0.0, most=0.0, why="a share of a temperature has no meaning; state sigma")
        parts.append(("sigma_relative", Annotated[float, none] | None, None))
    words = {"__doc__": f"[{name.value}]: {dimension.noun if dimension else 'a pure number'}"}
    return make_dataclass(name.value, parts, bases=(ChannelSection,), frozen=True, namespace=words)


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

    @property
    def repeatability(self) -> tuple[float, float]:
        """One sigma as stated: a part in SI, and a share of the SI reading that adds to it; 0 where not stated.

        A stated share is of the reading in the file, which of a pressure may be absolute.
        """
        sigma, relative = self.sigma or 0.0, self.sigma_relative or 0.0
        return (sigma - relative * self.offset if self.is_pressure else sigma), relative

    def si(self, numbers: Array) -> Array:
        """Numbers of the file in SI, pressures gauge."""
        return self.factor * numbers + self.offset


def channel_form(name: ChannelName, stated: ChannelSection, reference: PressureReference) -> ChannelForm:
    """Return one channel in SI; `reference` is that of a pressure that states none."""
    factor, offset = unit_scale(stated.unit, name.dimension) if name.dimension else (PURE_UNITS[stated.unit], 0.0)
    own = getattr(stated, "reference", None) or reference
    if name.dimension is Dimension.PRESSURE and own is PressureReference.ABSOLUTE:
        offset -= STANDARD_ATMOSPHERE
    gain, zero = stated.calibration.gain, stated.calibration.zero
    sigma, quantum = (None if one is None else one * factor for one in (stated.sigma, stated.quantum))
    if name.dimension is None and zero is not None:
        zero *= factor
    return ChannelForm(
        name, stated.column, stated.unit, factor, offset, sigma, stated.sigma_relative, quantum, stated.lag, gain,
        zero, stated.accuracy_class,
    )  # fmt: skip
