"""What a value of a pump file can be: a quantity, a choice, rows of quantities, a text, or a table of such.

Each is a type of a model's field: the quantity's dimension, or its columns', stands in the annotation.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated, get_origin

from pydantic import BaseModel, ConfigDict, Field
from pydantic.fields import FieldInfo

from system.inputs.units import Dimension


@dataclass(frozen=True)
class Points:
    """Marks a field that is a list of rows, one quantity a column, with an example row.

    A field may have several: rows are all of one of these layouts.
    """

    columns: tuple[Dimension, ...]
    heads: tuple[str, ...]
    example: tuple[str, ...]


class Text(Enum):
    """Marks a field that is text: the path of a file, one name, or a list of names; its value says so in words."""

    FILE = "the path of a file beside the pump file, such as 'part.msh'"
    NAME = "a name, such as 'film'"
    NAMES = "a list of names, such as ['bottom', 'rim']"


Positive = Field(gt=0.0)
NotNegative = Field(ge=0.0)

Length = Annotated[float, Dimension.LENGTH, Positive]
AnyLength = Annotated[float, Dimension.LENGTH]
Area = Annotated[float, Dimension.AREA, Positive]
Volume = Annotated[float, Dimension.VOLUME, Positive]
Displacement = Annotated[float, Dimension.DISPLACEMENT, Positive]
Angle = Annotated[float, Dimension.ANGLE]
AcuteAngle = Annotated[float, Dimension.ANGLE, Field(gt=0.0, lt=math.pi / 2)]
Pressure = Annotated[float, Dimension.PRESSURE]
Modulus = Annotated[float, Dimension.MODULUS, Positive]
Elasticity = Annotated[float, Dimension.ELASTICITY, Positive]
AngularSpeed = Annotated[float, Dimension.ANGULAR_SPEED, Positive]
Temperature = Annotated[float, Dimension.TEMPERATURE, Positive]
Mass = Annotated[float, Dimension.MASS, Positive]
Force = Annotated[float, Dimension.FORCE, NotNegative]
Stiffness = Annotated[float, Dimension.STIFFNESS, NotNegative]
KinematicViscosity = Annotated[float, Dimension.KINEMATIC_VISCOSITY, Positive]
Inertia = Annotated[float, Dimension.INERTIA, Positive]
Damping = Annotated[float, Dimension.ANGULAR_DAMPING, NotNegative]
Torque = Annotated[float, Dimension.TORQUE, NotNegative]
Leakage = Annotated[float, Dimension.HYDRAULIC_CONDUCTANCE, NotNegative]
Density = Annotated[float, Dimension.DENSITY, Positive]
SpecificHeat = Annotated[float, Dimension.SPECIFIC_HEAT, Positive]
Conductivity = Annotated[float, Dimension.CONDUCTIVITY, Positive]
Expansion = Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, NotNegative]
PressureCoefficient = Annotated[float, Dimension.PRESSURE_COEFFICIENT, NotNegative]
ArealDensity = Annotated[float, Dimension.AREAL_DENSITY, Positive]
Fraction = Annotated[float, Field(ge=0.0, le=1.0)]
Coefficient = Annotated[float, NotNegative]
Spread = Annotated[float, Field(gt=0.0, le=2.0)]  # one sigma, a pure number

Profile = Annotated[
    tuple[tuple[float, ...], ...],
    Points((Dimension.LENGTH, Dimension.LENGTH), ("place", "material taken off"), ("3 mm", "2 um")),
    Points(
        (Dimension.LENGTH, Dimension.ANGLE, Dimension.LENGTH),
        ("place", "angle", "material taken off"),
        ("3 mm", "90 deg", "2 um"),
    ),
    Field(min_length=2),
]
ImpedanceRows = Annotated[
    tuple[tuple[float, float, float], ...],
    Points(
        (Dimension.FREQUENCY, Dimension.HYDRAULIC_IMPEDANCE, Dimension.HYDRAULIC_IMPEDANCE),
        ("frequency", "real", "imaginary"),
        ("315 Hz", "1e9 Pa s/m3", "-2e9 Pa s/m3"),
    ),
    Field(min_length=2),
]
Grooves = Annotated[
    tuple[tuple[float, float, float], ...],
    Points((Dimension.LENGTH,) * 3, ("middle", "width", "depth"), ("10 mm", "0.5 mm", "0.3 mm")),
    Field(min_length=1),
]
SlipperGrooves = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.LENGTH,) * 2, ("inner radius", "outer radius"), ("10 mm", "11 mm")),
    Field(min_length=1),
]
Webs = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.ANGLE,) * 2, ("middle", "width"), ("90 deg", "4 deg")),
    Field(min_length=1),
]
MeshFile = Annotated[Path, Text.FILE]
CoefficientFile = Annotated[Path, Text.FILE]
FaceName = Annotated[str, Text.NAME, Field(min_length=1)]
FaceNames = Annotated[tuple[str, ...], Text.NAMES, Field(min_length=1)]


def files_content(paths: Iterable[Path | None]) -> str:
    """A name for what files hold, none of them: an empty one; a file that has changed is another."""
    found = [path.read_bytes() if path.is_file() else b"absent" for path in paths if path is not None]
    return hashlib.sha256(b"\0".join(found)).hexdigest() if found else ""


class Section(BaseModel):
    """A table of the pump file; frozen, and no key beside the named ones."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


def dimension_of(field: FieldInfo) -> Dimension | None:
    """Return what a field of a table measures, or None for what is no single quantity."""
    return next((mark for mark in _marks(field) if isinstance(mark, Dimension)), None)


def layouts_of(field: FieldInfo) -> tuple[Points, ...]:
    """Return the layouts of the rows of a field that is a list of rows; none for another."""
    return tuple(mark for mark in _marks(field) if isinstance(mark, Points))


def text_of(field: FieldInfo) -> Text | None:
    """Return which text a field is, or None for another."""
    return next((mark for mark in _marks(field) if isinstance(mark, Text)), None)


def choice_of(field: FieldInfo) -> type[Enum] | None:
    """Return the choices of a field that is one of them, or None for another."""
    return next((part for part in _types(field) if issubclass(part, Enum)), None)


def table_of(field: FieldInfo) -> type[Section] | None:
    """Return the model of a field that is a table of its own, or None for another."""
    return None if get_origin(field.annotation) is tuple else _section_in(field)


def tables_of(field: FieldInfo) -> type[Section] | None:
    """Return the model of a field that is a list of tables, or None for another."""
    return _section_in(field) if get_origin(field.annotation) is tuple else None


def _section_in(field: FieldInfo) -> type[Section] | None:
    return next((part for part in _types(field) if issubclass(part, Section)), None)


def whole(field: FieldInfo) -> bool:
    """True for a field that is a whole number."""
    return int in _types(field)


def _types(field: FieldInfo) -> list[type]:
    """Return the plain types of a field, also of one that may be left out."""
    inner = getattr(field.annotation, "__args__", ())
    return [part for part in (field.annotation, *inner) if isinstance(part, type)]


def _marks(field: FieldInfo) -> list[object]:
    """Return the annotations of a field, also of one that may be left out."""
    inner = getattr(field.annotation, "__args__", ())
    return [*field.metadata, *(mark for part in inner for mark in getattr(part, "__metadata__", ()))]
