"""Tolerances of a pump that its file states."""

from dataclasses import dataclass
from enum import Enum
from typing import Annotated

from system.inputs.sections.fields import Limits, Positive, Spread, Text
from system.inputs.units import Dimension

_Key = Annotated[str, Text.KEY]
_Quantity = Annotated[str, Text.QUANTITY]
_Parts = Annotated[int, Limits(least=1, most=99)]


class Shape(Enum):
    """Distribution of a dimension over the pumps of a series."""

    NORMAL = "normal"
    UNIFORM = "uniform"
    TRIANGULAR = "triangular"


@dataclass(frozen=True, kw_only=True)
class DrawnSection:
    """[[tolerance.dimension]]: one key of the pump file and how it scatters; `system.variation.drawing` reads it.

    Stated by `sigma` (normal), by `plus_minus` about the file's value, or by `least` and `most`.
    """

    key: _Key  # table and key of the pump file
    shape: Shape  # over the pumps of a series
    sigma: _Quantity | None = None  # one standard deviation, a quantity or a share in %
    plus_minus: _Quantity | None = None  # half of the tolerance, about the stated value
    least: _Quantity | None = None  # limit of the drawing
    most: _Quantity | None = None  # limit of the drawing
    parts: _Parts = 1  # of a pump, each of its own size


@dataclass(frozen=True, kw_only=True)
class FitSection:
    """[[tolerance.fit]]: a radial clearance as half of the difference of two diameters, of parts sorted in classes."""

    key: _Key  # a length of the pump file: the radial clearance
    shape: Shape  # of both diameters
    hole_least: _Quantity
    hole_most: _Quantity
    shaft_least: _Quantity
    shaft_most: _Quantity
    classes: Annotated[int, Limits(least=1, most=99)] = 1  # of equal width; hole and shaft of one class are paired
    parts: _Parts = 1  # pairs of a pump, each of its own clearance


@dataclass(frozen=True, kw_only=True)
class CorrelationSection:
    """[[tolerance.correlation]]: two dimensions that scatter together."""

    one: _Key  # of [[tolerance.dimension]]
    other: _Key  # of [[tolerance.dimension]]
    coefficient: Annotated[float, Limits(above=-1.0, below=1.0)]  # of their normal scores


@dataclass(frozen=True, kw_only=True)
class ToleranceSection:
    """[tolerance]: one sigma of what is uncertain, relative but where said, and tolerances of single dimensions.

    `system.description.tolerances` takes the sigmas that are left out.
    """

    film_thickness: Spread | None = None
    eccentricity_ratio: Spread | None = None  # absolute
    bulk_modulus: Spread | None = None
    viscosity: Spread | None = None
    viscosity_slope: Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, Positive] | None = None  # of its logarithm
    friction: Spread | None = None
    guide_friction: Spread | None = None  # ball guide and retainer
    bearing_friction: Spread | None = None
    displacement: Spread | None = None
    dead_volume: Spread | None = None
    flow_coefficient: Spread | None = None
    stand_out_share: Spread | None = None  # absolute
    inlet_share: Spread | None = None  # absolute; of the inlet's temperature in that of the films
    dimension: tuple[DrawnSection, ...] = ()  # tolerances of the drawing
    fit: tuple[FitSection, ...] = ()  # clearances of two parts
    correlation: tuple[CorrelationSection, ...] = ()  # of these
