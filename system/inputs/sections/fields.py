"""Fields of sections: the kinds of values of a file. A section is a frozen dataclass, one field a key.

A quantity, a choice, rows of quantities, a text, a file that is read, or a section of its own. The annotation of a
field states which: Annotated[float, Dimension.LENGTH, Limits(above=0.0)].
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, Literal, Protocol, TypeVar, Union, get_args, get_origin, get_type_hints

from reynolds.laws.oil import CONTINUUM
from system.inputs.body_file import BodyFile, read_body_file
from system.inputs.coefficients.flow_files import FlowCoefficients, read_flow_coefficients
from system.inputs.coefficients.loss_files import LossFactors, read_groove_losses, read_step_losses
from system.inputs.faults import Fault
from system.inputs.units import Dimension


class Section(Protocol):
    """A table of a file: any dataclass."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


AnySection = TypeVar("AnySection", bound=Section)


@dataclass(frozen=True)
class Limits:
    """Marks a field whose number is bounded, in SI; fewest: rows of a list; why: the reason, if not obvious."""

    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None
    fewest: int = 0
    why: str = ""


@dataclass(frozen=True)
class Points:
    """Marks a field that is a list of rows, one quantity a column, with an example row.

    A field may have several: rows are all of one of these layouts. `opposite`: a head that a file may have in place
    of the last one, for the same quantity with the opposite sign.
    """

    columns: tuple[Dimension, ...]
    heads: tuple[str, ...]
    example: tuple[str, ...]
    opposite: str = ""


@dataclass(frozen=True)
class Format:
    """Marks a whole number that is the version of a kind of file: "recording"."""

    number: int
    kind: str


@dataclass(frozen=True)
class UnitOf:
    """Marks a field that is the text of a unit; without a dimension that of a pure number."""

    dimension: Dimension | None


class Span(Enum):
    """Marks a quantity that is a difference of two: its unit's zero does not count ("0.3 degC" is 0.3 K)."""

    OF_TWO = "difference"


@dataclass(frozen=True)
class Example:
    """Marks a quantity whose usual values have another unit than the example of its dimension: "14 um"."""

    text: str


@dataclass(frozen=True)
class Several:
    """Marks a field that is a tuple of values, each within the limits: a list of `count`; of 0 any list, or one."""

    count: int = 0


@dataclass(frozen=True)
class FormulaOf:
    """Marks a field that is a quantity (None: a number) or a formula of place and time; read by `Reading.formula`."""

    dimension: Dimension | None
    place: bool = True
    time: bool = True


class Text(Enum):
    """Marks a field that is text; its value describes which: an existing file, a name, .."""

    FILE = "the path of a file beside this one, such as 'part.msh'"
    NAME = "a name, such as 'film'"
    NAMES = "a list of names, such as ['bottom', 'rim']"
    COLUMN = "the name of a column"
    KEY = "table and key of a number of this file, such as 'piston.radial_clearance'"
    QUANTITY = "a quantity with its unit, or a share of the stated value in %, such as '3 um' or '4 %'"
    WORDS = "a text"


@dataclass(frozen=True)
class FromFile:
    """Marks a field whose entry names a file: its reader, which raises InputFaults. The value has its `path`."""

    read: Callable[[Path], Any]


@dataclass(frozen=True)
class Check:
    """A check of several keys of a table together: where all of them are good, their faults, by key."""

    keys: tuple[str, ...]
    faults: Callable[[Any], Iterable[Fault]]


@dataclass(frozen=True)
class FromTable:
    """Marks a field whose entry may be a table: its section, the checks of its keys, and its value without faults."""

    section: type[Any]
    checks: tuple[Check, ...]
    value: Callable[[Any], Any]


Positive = Limits(above=0.0)
NotNegative = Limits(least=0.0)
Micrometres = Example("14 um")

Length = Annotated[float, Dimension.LENGTH, Positive]
Film = Annotated[
    float, Dimension.LENGTH, Limits(least=CONTINUUM, why="oil thinner than 10 nm is no continuum"), Micrometres
]
Height = Annotated[float, Dimension.LENGTH, Positive, Micrometres]  # of roughness, relief and the like
AnyLength = Annotated[float, Dimension.LENGTH]
Area = Annotated[float, Dimension.AREA, Positive]
Volume = Annotated[float, Dimension.VOLUME, Positive]
Displacement = Annotated[float, Dimension.DISPLACEMENT, Positive]
Angle = Annotated[float, Dimension.ANGLE]
AcuteAngle = Annotated[float, Dimension.ANGLE, Limits(above=0.0, below=math.pi / 2)]
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
Fraction = Annotated[float, Limits(least=0.0, most=1.0)]
Coefficient = Annotated[float, NotNegative]
Spread = Annotated[float, Limits(above=0.0, most=2.0)]  # one sigma, a pure number

ImpedanceRows = Annotated[
    tuple[tuple[float, float, float], ...],
    Points(
        (Dimension.FREQUENCY, Dimension.HYDRAULIC_IMPEDANCE, Dimension.HYDRAULIC_IMPEDANCE),
        ("frequency", "real", "imaginary"),
        ("315 Hz", "1e9 Pa s/m3", "-2e9 Pa s/m3"),
    ),
    Limits(fewest=2),
]
Grooves = Annotated[
    tuple[tuple[float, float, float], ...],
    Points((Dimension.LENGTH,) * 3, ("middle", "width", "depth"), ("10 mm", "0.5 mm", "0.3 mm")),
    Limits(fewest=1),
]
SlipperGrooves = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.LENGTH,) * 2, ("inner radius", "outer radius"), ("10 mm", "11 mm")),
    Limits(fewest=1),
]
MeshFile = Annotated[BodyFile, FromFile(read_body_file)]
FlowFile = Annotated[FlowCoefficients, FromFile(read_flow_coefficients)]
StepFile = Annotated[LossFactors, FromFile(read_step_losses)]
GrooveFile = Annotated[LossFactors, FromFile(read_groove_losses)]
FaceName = Annotated[str, Text.NAME]
FaceNames = Annotated[tuple[str, ...], Text.NAMES]

_Mark = TypeVar("_Mark")


@dataclass(frozen=True)
class FieldType:
    """One field of a section: its plain types, its marks, and whether a file must have the key.

    listed: a list of sections; named: the value of any name, in a table of such; meaning: the comment behind the field.
    """

    types: tuple[type, ...]
    marks: tuple[object, ...]
    listed: bool
    named: FieldType | None
    required: bool
    meaning: str

    @property
    def dimension(self) -> Dimension | None:
        """Dimension of the field's quantity; None for another field."""
        return self._mark(Dimension)

    @property
    def example(self) -> str:
        """A usual value of the field's quantity with its unit; empty for another field."""
        own = self._mark(Example)
        return own.text if own else self.dimension.example if self.dimension else ""

    @property
    def layouts(self) -> tuple[Points, ...]:
        """Layouts of the rows of a list of rows; none for another field."""
        return tuple(mark for mark in self.marks if isinstance(mark, Points))

    @property
    def several(self) -> Several | None:
        """Number of values of a list of them; None for a single value."""
        return self._mark(Several)

    @property
    def formula(self) -> FormulaOf | None:
        """Dimension and names of a formula, None for another field."""
        return self._mark(FormulaOf)

    @property
    def format(self) -> Format | None:
        """Version of a file that the field must have, None for another field."""
        return self._mark(Format)

    @property
    def unit(self) -> UnitOf | None:
        """Dimension of a field that is a unit, None for another."""
        return self._mark(UnitOf)

    @property
    def difference(self) -> bool:
        """True for a quantity that is a difference."""
        return self._mark(Span) is not None

    @property
    def may_be_absolute(self) -> bool:
        """True for a pressure, which a file may state as gauge or absolute."""
        return self.dimension is Dimension.PRESSURE and not self.difference

    @property
    def limits(self) -> Limits:
        """Bounds of the number."""
        return self._mark(Limits) or Limits()

    @property
    def text(self) -> Text | None:
        """Kind of a text, None for another field."""
        return Text.FILE if self.file else self._mark(Text)

    @property
    def file(self) -> FromFile | None:
        """Reader of a file that the entry names, None for another field."""
        return self._mark(FromFile)

    @property
    def from_table(self) -> FromTable | None:
        """Table that may stand in place of the entry, None for another field."""
        return self._mark(FromTable)

    @property
    def choices(self) -> tuple[Enum, ...]:
        """Choices of a field that is one of them, none for another."""
        kind = next((part for part in self.types if issubclass(part, Enum)), None)
        return () if kind is None else tuple(mark for mark in self.marks if isinstance(mark, kind)) or tuple(kind)

    @property
    def table(self) -> type[Any] | None:
        """Section of a field that is a table, None for another."""
        return None if self.listed or self.forms else next(iter(self._sections), None)

    @property
    def tables(self) -> type[Any] | None:
        """Section of a field that is a list of tables, None for another."""
        return next(iter(self._sections), None) if self.listed else None

    @property
    def forms(self) -> tuple[type[Any], ...]:
        """Sections of a field that is one of several, or beside a choice or a file; none for another."""
        return self._sections if len(self._sections) > 1 or self.file or self.choices else ()

    @property
    def whole(self) -> bool:
        """True for a whole number."""
        return int in self.types

    @property
    def _sections(self) -> tuple[type[Any], ...]:
        return tuple(part for part in self.types if is_dataclass(part))

    def _mark(self, kind: type[_Mark]) -> _Mark | None:
        return next((mark for mark in self.marks if isinstance(mark, kind)), None)


def fields_of(model: type[Any]) -> Mapping[str, FieldType]:
    """Fields of a section by key, in the order of their declaration."""
    if model not in _KNOWN:
        _KNOWN[model] = _fields_of(model)
    return _KNOWN[model]


_KNOWN: dict[type[Any], Mapping[str, FieldType]] = {}


def _fields_of(model: type[Any]) -> Mapping[str, FieldType]:
    hints, comments = get_type_hints(model, include_extras=True), _comments(model)
    required = {own.name: own.default is MISSING and own.default_factory is MISSING for own in fields(model)}
    return {name: field_type(hints[name], needed, comments.get(name, "")) for name, needed in required.items()}


def field_type(annotation: Any, required: bool = True, meaning: str = "") -> FieldType:
    """Return the field of an annotation."""
    origin = get_origin(annotation)
    named = field_type(get_args(annotation)[1]) if origin is Mapping else None
    types, marks = tuple(_types(annotation)), tuple(_marks(annotation))
    return FieldType(types, marks, origin is tuple, named, required, meaning)


def _types(annotation: Any) -> list[type]:
    """Return the plain types of an annotation, inside Annotated, unions and lists; none of types read separately."""
    if get_origin(annotation) is Annotated:
        apart = any(isinstance(mark, (FromFile, FormulaOf)) for mark in annotation.__metadata__)
        return [] if apart else _types(get_args(annotation)[0])
    if get_origin(annotation) is Literal:
        return [type(one) for one in get_args(annotation)]
    if get_origin(annotation) in (Union, UnionType):
        return [one for part in get_args(annotation) if part is not NoneType for one in _types(part)]
    if get_origin(annotation) is tuple:
        return _types(get_args(annotation)[0])
    return [annotation] if isinstance(annotation, type) else []


def _marks(annotation: Any) -> list[object]:
    """Return the marks of an annotation, also of one that may be None; of a Literal the choices in it."""
    if get_origin(annotation) is Literal:
        return list(get_args(annotation))
    if get_origin(annotation) is Annotated:
        return list(annotation.__metadata__)
    if get_origin(annotation) in (Union, UnionType):
        return [mark for part in get_args(annotation) for mark in _marks(part)]
    return []


_COMMENTED = re.compile(r"^    (\w+): .*?  # (.+)$", re.MULTILINE)


def _comments(model: type[Any]) -> dict[str, str]:
    """Return the comments behind the fields of a class and its bases; none for a class without source."""
    found: dict[str, str] = {}
    for one in filter(is_dataclass, reversed(model.__mro__)):
        with suppress(OSError):
            found |= _COMMENTED.findall(inspect.getsource(one))
    return found
