"""A new pump file: the stated facts of the pump, and for the rest REF90's values at its size, marked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from shlex import quote
from textwrap import wrap

from diagnosis.recording.model import Circuit
from swashfilm.cli.new.file import NewFile
from swashfilm.cli.new.questions import QUESTIONS, ask
from system.inputs.faults import Fault, InputFaults
from system.pump_file.file import check_pump
from system.pump_file.scaled.completed import Completed, completed
from system.pump_file.scaled.written import written_pump
from system.pump_file.tables import pump_of_tables

USUAL = "pump.toml"
_WIDTH = 116
_HEAD = """A value marked "assumed" is not known of this pump: it is that of the built-in pump ref90, or goes with the
size ("scaled"). Behind +- is one sigma of it, as [tolerance] states. Replace it by the drawing's value and delete the
mark; narrow [tolerance] with it. Any unit of the kind will do; pressures are gauge."""


def new_pump(given: Mapping[str, str | None], path: Path, faults: list[Fault], asks: bool) -> NewFile | None:
    """Return the pump file of the options; None with faults added. asks: missing ones are requested on a terminal."""
    answers: dict[str, str] = {}
    stated: dict[str, dict[str, object]] = {}
    option_of: dict[str, str] = {}
    asks = asks and not faults
    for question in QUESTIONS:
        text = given[question.option]
        if text is None and asks:
            text = ask(question)
        if text is None:
            faults.append(question.missing)
            continue
        answers[question.option] = text
        for table, entries in question.answered(text, faults).items():
            stated.setdefault(table, {}).update(entries)
            option_of |= {f"{table}.{key}": question.option for key in entries}
    if faults:
        return None
    try:
        pump, doubts = _sound(path, stated, answers["--circuit"])
    except InputFaults as reason:
        faults += [replace(fault, path=option_of.get(fault.path, fault.path)) for fault in reason.faults]
        return None
    return NewFile(path, "pump", written_pump(pump, _head(path, answers)), _told(path, pump, doubts))


def _sound(path: Path, stated: Mapping[str, object], circuit: str) -> tuple[Completed, list[str]]:
    """Return the completed pump of a circuit, with what is doubtful of it; raise InputFaults for no pump."""
    pump = completed(str(path), stated, path.stem)
    if circuit == Circuit.OPEN.value:
        pump = pump.in_open_circuit()
    return pump, [str(one) for one in check_pump(pump_of_tables(str(path), pump.tables)).warnings]


def _head(path: Path, answers: Mapping[str, str]) -> list[str]:
    """Return the comments above the file."""
    known = ", ".join(f"{option[2:]} {text}" for option, text in answers.items())
    return [
        *wrap(f"{path.stem}: a pump of which this is known: {known}.", _WIDTH),
        *wrap(_HEAD, _WIDTH),
        f"swashfilm check {quote(path.name)}; swashfilm run {quote(path.name)} --fidelity lumped",
    ]


def _told(path: Path, pump: Completed, doubts: list[str]) -> tuple[str, ...]:
    """Return what the command prints."""
    count = len(pump.assumptions)
    told = [f"{count} values are assumed: those of ref90, scaled; {path} marks each"]
    return (*told, *(f"warning: {one}" for one in doubts), f"next: swashfilm run {quote(str(path))} --fidelity lumped")
