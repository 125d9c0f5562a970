"""Quantities of inputs and outputs: text with a unit to SI floats and back. SI inside, always.

The unit registry of pint costs some 0.4 s, so it is made at the first quantity, not at import.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from enum import Enum
from fractions import Fraction

from system.inputs.faults import nearest_choice
from system.inputs.unit_spellings import spelt_unit
from system.inputs.unit_text import Unit, unit_of_text

STANDARD_ATMOSPHERE = 101325.0  # Pa; gauge pressure = absolute pressure - this

TURN = 2.0 * math.pi  # rad
RPM = math.pi / 30.0  # rad/s in an r/min
LPM = 6e4  # L/min in a m3/s

LARGEST = Fraction(10) ** 30  # in SI; with its inverse the range of sizes of machines


ZERO_DIGITS = 9
"""Decimals of a number in a unit with a zero of its own, degC, that a float in K still holds."""
MOST_DIGITS = 60
"""Most characters of a number in a text; more are no number of a machine."""


class Dimension(Enum):
    """Kind of a quantity: a word for it, its SI unit, the units people read it in, and an example.

    A number is shown in the first reading unit in which it is at least one.
    """

    LENGTH = ("a length", "m", ("mm", "um"), "22 mm")
    AREA = ("an area", "m2", ("mm2",), "152 mm2")
    VOLUME = ("a volume", "m3", ("cm3",), "6 cm3")
    DISPLACEMENT = ("a displacement per revolution", "m3/rev", ("cm3/rev",), "90 cm3/rev")
    ANGLE = ("an angle", "rad", ("deg",), "16.2 deg")
    PRESSURE = ("a pressure", "Pa", ("MPa", "kPa"), "350 bar")
    MODULUS = ("a bulk modulus", "Pa", ("GPa", "MPa"), "1.6 GPa")
    ELASTICITY = ("a modulus of elasticity", "Pa", ("GPa", "MPa"), "210 GPa")
    ANGULAR_SPEED = ("a rotational speed", "rad/s", ("rpm",), "2100 rpm")
    TEMPERATURE = ("a temperature", "K", ("degC",), "50 degC")
    MASS = ("a mass", "kg", ("kg", "g"), "160 g")
    FORCE = ("a force", "N", ("N",), "1080 N")
    STIFFNESS = ("a stiffness", "N/m", ("N/mm",), "20 N/mm")
    TORQUE = ("a torque", "N m", ("N m",), "500 N m")
    INERTIA = ("a moment of inertia", "kg m2", ("kg m2",), "0.01 kg m2")
    ANGULAR_DAMPING = ("a moment per angular speed", "N m s/rad", ("N m s/rad",), "2 N m s/rad")
    HYDRAULIC_CONDUCTANCE = ("a flow per pressure", "m3/(s Pa)", ("L/(min MPa)",), "0.05 L/(min MPa)")
    POWER = ("a power", "W", ("kW", "W"), "1.2 kW")
    DENSITY = ("a density", "kg/m3", ("kg/m3",), "860 kg/m3")
    KINEMATIC_VISCOSITY = ("a kinematic viscosity", "m2/s", ("mm2/s",), "46 mm2/s")
    DYNAMIC_VISCOSITY = ("a dynamic viscosity", "Pa s", ("mPa s",), "25.8 mPa s")
    SPECIFIC_HEAT = ("a specific heat", "J/(kg K)", ("J/(kg K)",), "1950 J/(kg K)")
    VELOCITY = ("a velocity", "m/s", ("m/s", "mm/s", "um/s"), "2.9 m/s")
    VOLUME_FLOW = ("a volume flow", "m3/s", ("L/min", "mL/min"), "188 L/min")
    TIME = ("a time", "s", ("s", "ms"), "20 ms")
    PRESSURE_COEFFICIENT = ("a pressure coefficient", "1/Pa", ("1/GPa",), "20 1/GPa")
    ANGLE_COMPLIANCE = ("an angle per pressure", "rad/Pa", ("deg/GPa",), "3 deg/GPa")
    TEMPERATURE_COEFFICIENT = ("a temperature coefficient", "1/K", ("1/K",), "0.03 1/K")
    CONDUCTIVITY = ("a thermal conductivity", "W/(m K)", ("W/(m K)",), "0.13 W/(m K)")
    HEAT_TRANSFER = ("a heat transfer coefficient", "W/(m2 K)", ("W/(m2 K)",), "80 W/(m2 K)")
    THERMAL_RESISTANCE = ("a thermal resistance of an area", "m2 K/W", ("m2 K/W",), "2e-5 m2 K/W")
    SHEAR_RATE = ("a shear rate", "1/s", ("1/s",), "1e6 1/s")
    FOUNDATION = ("a stiffness per area", "Pa/m", ("GPa/m",), "1e13 Pa/m")
    FREQUENCY = ("a frequency", "Hz", ("kHz", "Hz"), "315 Hz")
    HYDRAULIC_IMPEDANCE = ("a hydraulic impedance", "Pa s/m3", ("Pa s/m3",), "1e9 Pa s/m3")
    AREAL_DENSITY = ("a number per area", "1/m2", ("1/mm2",), "2e10 1/m2")

    def __init__(self, noun: str, si_unit: str, reading_units: tuple[str, ...], example: str) -> None:
        self.noun = noun
        self.si_unit = si_unit
        self.reading_units = reading_units
        self.example = example


_MOST = {
    Dimension.LENGTH: 1_000,
    Dimension.ANGULAR_SPEED: 10**6,
    Dimension.VELOCITY: 10**5,
    Dimension.PRESSURE: 10**12,
    Dimension.FORCE: 10**12,
    Dimension.MASS: 10**7,
    Dimension.DENSITY: 10**6,
    Dimension.TEMPERATURE: 10**4,
    Dimension.DISPLACEMENT: 10**3,
    Dimension.TIME: 10**10,
}
"""In SI, above the value of any pump or oil: beyond it finite numbers are not valid."""


class QuantityError(ValueError):
    """A text that is not the requested quantity: what was found, what was expected, what may be meant."""

    def __init__(self, found: str, expected: str, nearest: str = "") -> None:
        self.found = found
        self.expected = expected
        self.nearest = nearest
        super().__init__(f"found {found}, expected {expected}" + (f"; try {nearest}" if nearest else ""))


_HINTS = {Dimension.TEMPERATURE: {"deg": "degC"}, Dimension.VOLUME_FLOW: {"l": "L/min"}}
"""Texts that are another unit, each with the unit of the quantity that is probably meant."""
_TRADE = {
    Dimension.ANGULAR_SPEED: {
        **dict.fromkeys(("1/min", "min-1", "min^-1", "U/min", "upm", "UpM"), "r/min"), "Hz": "r/s", "kHz": "kr/s",
    },
}  # fmt: skip
"""Units that catalogues write of a quantity and that mean another elsewhere, each by its full name: turns counted."""
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*(.*?)\s*")
_ABSOLUTE = re.compile(r"(bar|mbar|hPa|kPa|MPa|Pa|psi)\s*(?:a|\(a\)|\(?abs\.?\)?|absolute)", re.IGNORECASE)
"""Units of pressure with a word for absolute."""
_COMMA = re.compile(r"\s*([+-]?\d+),(\d+)(\s*[^\s,.\d].*|)")
_PERCENT = re.compile(r"\s*(\d+\.?\d*)\s*%\s*")


def parse_quantity(text: object, dimension: Dimension, *, difference: bool = False, example: str = "") -> float:
    """Return the SI value of a text such as "22 mm", rounded once: "15 um" is 1.5e-05 to the last bit.

    rpm, r/min, cm3, cm^3, cc/rev, mL/r, lpm, um, degC, cSt, mPa s and what pint knows are understood.
    Raises QuantityError for a bare number, a number that cannot be read, an unknown unit and a unit that
    measures something else; a turn or an angle is never left to be guessed ("90 cm3" is no displacement
    per revolution). Of a rotational speed 1/min and Hz count turns. A size below 1e-30 or, by its kind,
    above that of any machine is refused.
    Of a `difference` the unit's zero does not count: "0.3 degC" is 0.3 K. `example`: a usual value, whose unit a
    bare number may mean; left out: that of the dimension.
    """
    example = example or dimension.example
    expected = f"{dimension.noun} with its unit, such as '{example}'"
    if isinstance(text, bool) or not isinstance(text, (str, int, float)):
        raise QuantityError(_shown(text), expected)
    match = _QUANTITY.fullmatch(str(text))
    if comma := with_point(str(text)):
        raise QuantityError(f"{_shown(text)}, with a decimal comma", expected, comma)
    if match is None or len(match[1]) > MOST_DIGITS:
        raise QuantityError(_shown(text), expected)
    number, unit_text = match[1], match[2]
    if not unit_text:
        raise QuantityError(_shown(text), expected, f"'{_with_unit(number, dimension, example)}'")
    if gauge := _gauge_meant(number, unit_text, dimension):
        raise QuantityError(f"{_shown(text)}, an absolute pressure", f"{expected}, gauge", gauge)
    unit = _unit_for(unit_text, dimension)
    if unit is None or not _measures(unit, dimension):
        meant = _meant(unit_text, dimension)
        why = "a unit that is not known" if unit is None else f"which is not {dimension.noun}"
        raise QuantityError(f"{_shown(text)}, {why}", expected, f"'{number} {meant}'" if meant else "")
    value = _in_si(number, replace(unit, offset=Fraction(0)) if difference else unit, dimension)
    if value != 0 and not 1 / LARGEST <= abs(value) <= largest(dimension):
        raise QuantityError(_shown(text), f"{expected}, of at most {float(largest(dimension)):g} {dimension.si_unit}")
    return float(value)


def largest(dimension: Dimension) -> Fraction:
    """Return the size in SI above which a quantity of a file is refused."""
    return Fraction(_MOST.get(dimension, LARGEST))


def format_quantity(value: float, dimension: Dimension, digits: int | None = None) -> str:
    """Return an SI value as text with its unit, in the unit people read it in.

    With `digits` it is rounded to that many; without, `parse_quantity` gives back the same float to the last bit (the
    SI unit is used where no shorter decimal does so). Raises ValueError for a value that is not finite.
    """
    if not math.isfinite(value):
        raise ValueError(f"{dimension.noun} of {value} {dimension.si_unit} cannot be shown")
    name = reading_unit(value, dimension)
    shown = in_unit(value, name, dimension)
    if digits is not None:
        # 0 degC is 273.15 K, which no float is: what is left of it is no temperature
        significant = round(shown, ZERO_DIGITS) + 0.0 if _unit_of(name).offset else shown
        return f"{_rounded(significant, digits)} {name}"
    for precision in range(1, 18):
        number = _rounded(shown, precision)
        if float(_in_si(number, _unit_of(name), dimension)) == value:
            return f"{number} {name}"
    return f"{value!r} {dimension.si_unit}"


def parse_share(text: str) -> float:
    """Return the value of a share, "0.8" or "80%"; raise QuantityError for another text."""
    percent = _PERCENT.fullmatch(text)
    try:
        value = float(Fraction(percent[1]) / 100) if percent else float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise QuantityError(repr(text), "a bare number, or a share in %", with_point(text))
    return value


def with_point(text: str) -> str:
    """Return the probable meaning of a number with a comma, with its unit, or an empty string without a comma.

    A decimal comma is a point here; before three digits it may also separate thousands.
    """
    match = _COMMA.fullmatch(text)
    if match is None:
        return ""
    whole, decimals, unit = match.groups()
    point = f"{whole}.{decimals}{unit}"
    return f"{point} or {whole}{decimals}{unit}" if len(decimals) == 3 else point


def to_gauge(absolute_pressure: float) -> float:
    """Return the gauge pressure in Pa of an absolute one, at the standard atmosphere."""
    return absolute_pressure - STANDARD_ATMOSPHERE


def to_absolute(gauge_pressure: float) -> float:
    """Return the absolute pressure in Pa of a gauge one, at the standard atmosphere."""
    return gauge_pressure + STANDARD_ATMOSPHERE


def unit_scale(name: str, dimension: Dimension) -> tuple[float, float]:
    """Return (factor, offset) with SI value = factor * number of the unit + offset.

    Raises QuantityError for a unit that is not known or measures something else.
    """
    unit = _unit_for(name, dimension)
    if unit is None or not _measures(unit, dimension):
        meant = _meant(name, dimension)
        why = "a unit that is not known" if unit is None else f"which is not of {dimension.noun}"
        expected = f"a unit of {dimension.noun}, such as '{unit_in(dimension.example)}'"
        raise QuantityError(f"{name!r}, {why}", expected, f"'{meant}'" if meant else "")
    si = _unit_of(dimension.si_unit)
    return float(unit.factor / si.factor), float(unit.offset / si.factor)


def _unit_for(text: str, dimension: Dimension) -> Unit | None:
    """Return what a unit text means of a quantity, or None when it is not known."""
    return unit_of_text(_TRADE.get(dimension, {}).get(text, text))


def _with_unit(number: str, dimension: Dimension, example: str) -> str:
    """Return a number with the unit that it may lack: the one in which it is nearest to the usual value, `example`.

    The SI unit where it is ten times nearer than those that people write: 0.01 of a length is "0.01 m", 22 is "22 mm".
    """
    usual, shown = parse_quantity(example, dimension), number.removesuffix(".0")
    written = (unit_in(example), *dimension.reading_units)

    def away(unit: str) -> float:
        value = float(_in_si(number, _unit_of(unit), dimension))
        rare = 0.0 if unit in written else math.log(10.0)
        return rare + abs(math.log(value / usual)) if value > 0.0 < usual else rare

    return f"{shown} {min((*written, dimension.si_unit), key=away)}"


def _gauge_meant(number: str, unit_text: str, dimension: Dimension) -> str:
    """Return the gauge pressure of an absolute one, such as 1 bara, as a remedy; empty for other texts."""
    match = _ABSOLUTE.fullmatch(unit_text)
    if dimension is not Dimension.PRESSURE or match is None:
        return ""
    gauge = in_unit(to_gauge(float(_in_si(number, _unit_of(match[1]), dimension))), match[1], dimension)
    return f"'{gauge:.6g} {match[1]}', which is {STANDARD_ATMOSPHERE / 1e5:g} bar less"


def without_absolute(text: object) -> object:
    """Return a pressure that is known to be absolute without the word for it: "1 bar" of "1 bar abs" or "1 bara"."""
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) else None
    unit = _ABSOLUTE.fullmatch(match[2]) if match else None
    return f"{match[1]} {unit[1]}" if match and unit else text


def _meant(unit_text: str, dimension: Dimension) -> str:
    """The unit that a bench means by a text, the text in small letters where that is one, or the one spelt most like
    it; else empty."""
    spelt = spelt_unit(unit_text) or _HINTS.get(dimension, {}).get(unit_text, "")
    if spelt and (unit := _unit_for(spelt, dimension)) is not None and _measures(unit, dimension):
        return spelt
    lowered = unit_text.lower()
    unit = None if lowered == unit_text else unit_of_text(lowered)
    if unit is not None and _measures(unit, dimension):
        return lowered
    return nearest_choice(unit_text, (*dimension.reading_units, unit_in(dimension.example)))


def _in_si(number: str, unit: Unit, dimension: Dimension) -> Fraction:
    """Return a decimal number of a unit in the SI unit of the dimension, without rounding."""
    return (Fraction(number) * unit.factor + unit.offset) / _unit_of(dimension.si_unit).factor


def _measures(unit: Unit, dimension: Dimension) -> bool:
    """True when a unit is one of the dimension; angles count, which are one in the SI."""
    si = _unit_of(dimension.si_unit)
    return unit.dimensionality == si.dimensionality and unit.counts_angle == si.counts_angle


def _unit_of(text: str) -> Unit:
    unit = unit_of_text(text)
    if unit is None:
        raise ValueError(f"{text!r} is no unit")
    return unit


def in_unit(value: float, name: str, dimension: Dimension) -> float:
    """Return an SI value of the dimension in the unit `name`."""
    unit = _unit_of(_TRADE.get(dimension, {}).get(name, name))
    return float((Fraction(value) * _unit_of(dimension.si_unit).factor - unit.offset) / unit.factor)


def reading_unit(value: float, dimension: Dimension) -> str:
    """Return the first reading unit in which the value is at least one, or the last of them."""
    for name in dimension.reading_units:
        if abs(in_unit(value, name, dimension)) >= 1.0:
            return name
    return dimension.reading_units[-1] if value != 0.0 else dimension.reading_units[0]


def _rounded(number: float, digits: int) -> str:
    """Return a number rounded to significant digits, without a decimal exponent if possible."""
    return repr(float(f"{number:.{digits}g}")).removesuffix(".0")


def unit_in(example: str) -> str:
    """Return the unit of an example: "um" of "14 um"."""
    return example.split(" ", 1)[1]


def _shown(value: object) -> str:
    return repr(value) if isinstance(value, str) else str(value)
