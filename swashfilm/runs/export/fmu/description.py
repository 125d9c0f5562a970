"""modelDescription.xml and buildDescription.xml of the unit, by FMI 3.0."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from importlib.metadata import version
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from swashfilm.runs.export.fmu.variables import TIME, Input, Output, inputs, outputs
from swashfilm.runs.export.numbers import display, held
from system.maps.data import MapData

FMI = "3.0"
COMPILED = "fmi3.c"
"""The source file that includes the others."""
CATEGORIES = {"logStatusWarning": "an input beyond the map", "logStatusError": "a call that the unit refuses"}


@dataclass(frozen=True)
class SiUnit:
    """An SI unit: its name in the description, and its exponents of the base units."""

    name: str
    exponents: dict[str, int]


UNITS = {
    "rad/s": SiUnit("rad/s", {"s": -1, "rad": 1}),
    "Pa": SiUnit("Pa", {"kg": 1, "m": -1, "s": -2}),
    "K": SiUnit("K", {"K": 1}),
    "m": SiUnit("m", {"m": 1}),
    "N m": SiUnit("N.m", {"kg": 1, "m": 2, "s": -2}),
    "m3/s": SiUnit("m3/s", {"m": 3, "s": -1}),
    "W": SiUnit("W", {"kg": 1, "m": 2, "s": -3}),
    "1": SiUnit("1", {}),
}
"""Units of the variables, by SI unit of the map."""


def model_description(data: MapData, identifier: str, token: str) -> bytes:
    """Return modelDescription.xml: capabilities, units with their display units, variables and their dependencies."""
    given, found = inputs(data), outputs(data)
    constant = held(data)
    root = Element(
        "fmiModelDescription",
        fmiVersion=FMI,
        modelName=data.name,
        instantiationToken=token,
        description=f"{data.name} by its operating map, {data.words}" + (f"; constant: {constant}" if constant else ""),
        generationTool=f"swashfilm {version('swashfilm')}",
        variableNamingConvention="structured",
    )
    SubElement(
        root,
        "CoSimulation",
        modelIdentifier=identifier,
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
    )
    _add_units(SubElement(root, "UnitDefinitions"), [*(one.axis.input.unit for one in given), *(o.unit for o in found)])
    categories = SubElement(root, "LogCategories")
    for name, words in CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=words)
    _add_variables(SubElement(root, "ModelVariables"), given, found)
    structure = SubElement(root, "ModelStructure")
    on = " ".join(str(one.reference) for one in given if not one.constant)
    for kind in ("Output", "InitialUnknown"):
        for one in found:
            SubElement(structure, kind, valueReference=str(one.reference), dependencies=on)
    return _document(root)


def build_description(identifier: str) -> bytes:
    """Return buildDescription.xml: one file in C99, for a shared library."""
    root = Element("fmiBuildDescription", fmiVersion=FMI)
    build = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    sources = SubElement(build, "SourceFileSet", language="C99")
    SubElement(sources, "SourceFile", name=COMPILED)
    SubElement(
        sources,
        "PreprocessorDefinition",
        name="FMI3_OVERRIDE_FUNCTION_PREFIX",
        optional="true",
        value="1",
        description="for a shared library: functions without prefix",
    )
    return _document(root)


def _add_units(definitions: Element, used: Iterable[str]) -> None:
    for si_unit in dict.fromkeys(used):
        known, shown = UNITS[si_unit], display(si_unit)
        unit = SubElement(definitions, "Unit", name=known.name)
        SubElement(unit, "BaseUnit", {base: str(power) for base, power in known.exponents.items()})
        if shown.name != si_unit:
            SubElement(unit, "DisplayUnit", name=shown.name, factor=repr(shown.factor), offset=repr(shown.offset))


def _add_variables(variables: Element, given: Iterable[Input], found: Iterable[Output]) -> None:
    time = {"name": "time", "valueReference": str(TIME), "causality": "independent", "variability": "continuous"}
    SubElement(variables, "Float64", time)
    for one in given:
        kind = {"start": repr(one.start), "causality": "local", "variability": "constant"}
        if not one.constant:
            ends = {"min": repr(one.axis.values[0]), "max": repr(one.axis.values[-1])}
            kind |= {"causality": "input", "variability": "continuous"} | ends
        _add_variable(variables, one.axis.input.value, one.axis.input.unit, one.words, one.reference, kind)
    for number in found:
        kind = {"causality": "output", "variability": "continuous"}
        _add_variable(variables, number.name, number.unit, number.words, number.reference, kind)


def _add_variable(
    variables: Element, name: str, si_unit: str, words: str, reference: int, about: dict[str, str]
) -> None:
    shown = display(si_unit).name
    unit = {"unit": UNITS[si_unit].name} | ({"displayUnit": shown} if shown != si_unit else {})
    given = {"name": name, "valueReference": str(reference), "description": words}
    SubElement(variables, "Float64", given | about | unit)


def _document(root: Element) -> bytes:
    indent(root)
    return tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
