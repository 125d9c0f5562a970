"""Facts that a new pump file needs: by an option, or by an answer on a terminal."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from diagnosis.recording.model import Circuit
from reynolds.laws.oil import ISO_GRADES
from system.description.pump import OilSection, PumpSection
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.sections.fields import FieldType, fields_of
from system.inputs.sections.reader import Reading, Special, read_entry
from system.inputs.sections.values import broken_limit
from system.pump_file.scaled.facts import Facts, read_displacement
from system.pump_file.tables import GRADE_KEYS

Tables = Mapping[str, Mapping[str, Any]]
Answered = Callable[[str, list[Fault]], Tables]
"""Function from an answer to the entries of a pump file, by table and key; faults of the answer are added."""
CIRCUITS = [circuit.value for circuit in Circuit]
_SHORT_GRADE = re.compile(r"(?:(?:ISO )?(?:VG ?)?|(?:HL|HLP|HLPD|HM)[ -]?)(\d+)", re.IGNORECASE)
"""Names of mineral oils whose grade is ISO 3448's: DIN 51524-1, -2 and ISO 6743-4 (HVLP and HV have a higher index)."""


@dataclass(frozen=True)
class Question:
    """A value that a new pump file needs: its option, its meaning, an example, and the reader of an answer."""

    option: str
    what: str
    example: str
    read: Answered

    def answered(self, text: str, faults: list[Fault]) -> Tables:
        """Return the entries of an answer; faults are those of the option."""
        found: list[Fault] = []
        entries = self.read(text, found)
        faults += [replace(fault, path=self.option) for fault in found]
        return entries

    @property
    def missing(self) -> Fault:
        """The fault of a missing answer."""
        return Fault(self.option, "missing", self.what, f"{self.option} '{self.example}'")


def ask(question: Question) -> str:
    """Return an answer without fault; the question is repeated on the terminal until then."""
    while True:
        sys.stdout.write(f"{question.what} (such as {question.example}): ")
        sys.stdout.flush()
        line = sys.stdin.readline()
        if not line:
            raise InputFaults("terminal", [question.missing])
        faults: list[Fault] = []
        question.answered(line.strip(), faults)
        if not faults:
            return line.strip()
        for fault in faults:
            sys.stdout.write(f"  found {fault.found}; expected {fault.expected}\n")


def _hold(path: str, field: FieldType, raw: object, reading: Reading) -> None:
    """Note the fault of an entry that does not fit the field, or is beyond its limits."""
    own = reading.special.get(path)
    value = read_entry(path, field, raw, reading) if own is None else next(iter(own(raw, {}, reading).values()), None)
    if value is not None and (limit := broken_limit(field, value)):
        reading.fault(path, repr(raw), limit)


def _entry(path: str, model: type[Any], special: Mapping[str, Special]) -> Answered:
    """Return the reader of an answer that is one entry of a section."""
    key = path.rpartition(".")[2]

    def read(text: str, faults: list[Fault]) -> Tables:
        reading = Reading(special=special, faults=faults)
        raw: object = int(text) if fields_of(model)[key].whole and text.isdecimal() else text
        _hold(path, fields_of(model)[key], raw, reading)
        return {"pump": {key: raw}}

    return read


def _at_rated(path: str, key: str) -> Answered:
    """Return the reader of a rated value, the default operating point of the pump."""
    rated = _entry(path, PumpSection, {})

    def read(text: str, faults: list[Fault]) -> Tables:
        return {**rated(text, faults), "operating": {key: text}}

    return read


def _oil(text: str, faults: list[Fault]) -> Tables:
    """Return [oil] of an ISO grade, also "HLP 46" or "46", or of the viscosities at 40 and 100 degC, with a comma."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) == len(GRADE_KEYS):
        reading = Reading(faults=faults)
        for key, part in zip(GRADE_KEYS, parts, strict=True):
            _hold(f"oil.{key}", fields_of(OilSection)[key], part, reading)
        return {"oil": dict(zip(GRADE_KEYS, parts, strict=True))}
    short = _SHORT_GRADE.fullmatch(text)
    grade = f"ISO VG {short[1]}" if short else text
    if grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or the viscosities at 40 and 100 degC, '46 mm2/s, 6.8 mm2/s'"
        faults.append(Fault("oil.grade", repr(text), expected, nearest_choice(grade, ISO_GRADES)))
    return {"oil": {"grade": grade}}


def _circuit(text: str, faults: list[Fault]) -> Tables:
    """Return no entry: a pump file has no circuit."""
    if text not in CIRCUITS:
        faults.append(Fault("circuit", repr(text), f"one of {', '.join(CIRCUITS)}", nearest_choice(text, CIRCUITS)))
    return {}


QUESTIONS: Sequence[Question] = (
    Question("--displacement", "displacement of a turn", "71 cm3/rev",
             _entry("pump.displacement", Facts, {"pump.displacement": read_displacement})),
    Question("--pistons", "number of pistons", "9", _entry("pump.pistons", Facts, {})),
    Question("--oil", "ISO grade of the oil, or its viscosities at 40 and 100 degC", "ISO VG 46", _oil),
    Question("--speed", "rated speed", "2600 rpm", _at_rated("pump.rated_speed", "speed")),
    Question("--pressure", "rated pressure, gauge", "350 bar", _at_rated("pump.rated_pressure", "pressure")),
    Question("--circuit", "circuit, open or closed", "open", _circuit),
)  # fmt: skip
