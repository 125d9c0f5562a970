"""Formats of an exported map, their faults, and the files on disk."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from shlex import quote

from reynolds.numerics.files import created
from swashfilm.console.inputs import COMMAND_LINE
from swashfilm.runs.export.amesim import amesim_files
from swashfilm.runs.export.content import Content
from swashfilm.runs.export.fmu.archive import fmu_files
from swashfilm.runs.export.long_csv import csv_files
from swashfilm.runs.export.matlab import matlab_files
from swashfilm.runs.export.modelica import PACKAGE, modelica_files, package_name
from swashfilm.runs.export.numbers import first_hole, wide
from swashfilm.runs.map.files import map_file, read_map
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.maps.data import MapData


@dataclass(frozen=True)
class Format:
    """A format: the ending for -o, its description, and its files by ending.

    holes: whether it can hold a point without a result; single: whether it can hold a map of one point.
    """

    ending: str
    words: str
    files: Callable[[MapData, str], Content]
    holes: bool
    single: bool = False


FORMATS = {
    "modelica": Format(".mo", "model and tables for the Modelica Standard Library", modelica_files, holes=False),
    "matlab": Format(".mat", "breakpoints and arrays for MATLAB, Simulink, Simscape", matlab_files, holes=True),
    "amesim": Format(".data", "a table for each number for Amesim", amesim_files, holes=False),
    "fmu": Format(".fmu", "co-simulation unit by FMI 3.0", fmu_files, holes=False),
    "csv": Format(".csv", "a line for each point", csv_files, holes=True, single=True),
}


@dataclass(frozen=True)
class Written:
    """Files that an export has written, and warnings."""

    paths: tuple[Path, ...]
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Export:
    """A map to export: its data, its format, and the path of the files without their endings."""

    data: MapData
    to: Format
    stem: Path

    def write(self) -> Written:
        """Write the files; raise InputFaults where one exists or cannot be written."""
        content = self.to.files(self.data, self.stem.name)
        files, hole = content.files, first_hole(self.data)
        there = _existing(self.stem, files)
        if there:
            free = next(stem for n in count(2) if not _existing(stem := _path(self.stem, f"_{n}"), files))
            fault = Fault(
                "-o", f"{', '.join(map(str, there))}, which exists", "a new name: nothing is overwritten",
                f"-o {_path(free, self.to.ending)}",
            )  # fmt: skip
            raise InputFaults(COMMAND_LINE, [fault])
        contents = {_path(self.stem, ending): content for ending, content in files.items()}
        try:
            self.stem.parent.mkdir(parents=True, exist_ok=True)
            _write_all(contents)
        except OSError as reason:
            fault = Fault("-o", f"{reason.filename}: {reason.strerror}", "a file that can be created and written")
            raise InputFaults(COMMAND_LINE, [fault]) from None
        return Written(tuple(contents), (*content.warnings, *([f"{hole}; written as nan"] if hole else [])))


def _write_all(contents: Mapping[Path, bytes]) -> None:
    """Write new files, or none; raise OSError."""
    done: list[Path] = []
    try:
        for path, own in contents.items():
            with created(path) as beside:
                beside.write_bytes(own)
            done.append(path)
    except OSError:
        for path in done:
            path.unlink()
        raise


def export_of(place: Path, to: str, output: Path | None) -> Export:
    """Return the export of a map, by its run folder or map.nc; raise InputFaults with every fault.

    output: the file, with the ending of its format; several files differ after its stem. Without it, the pump's name in
    the working folder.
    """
    faults = [*_word_faults(to, output)]
    try:
        data, _ = read_map(map_file(place))
    except InputFaults as reason:
        raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None
    if not faults:
        faults = [*_map_faults(data, to, place)]
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    usual = Path(package_name(data.name) if to == "modelica" else re.sub(r"[^\w.-]+", "-", data.name))
    return Export(data, FORMATS[to], usual if output is None else output.with_suffix(""))


def _word_faults(to: str, output: Path | None) -> Iterator[Fault]:
    """Yield the faults of format and file name."""
    if to not in FORMATS:
        yield Fault("--to", repr(to), f"one of {', '.join(FORMATS)}", nearest_choice(to, FORMATS))
        return
    if output is None:
        return
    ending = FORMATS[to].ending
    if output.suffix != ending:
        near = f"-o {output.with_suffix(ending)}" if output.name else ""
        yield Fault("-o", f"'{output}'", f"a file name that ends in {ending}", near)
    elif to == "modelica" and not PACKAGE.fullmatch(output.stem):
        expected = "letters, digits and _, a capital first: it names the package"
        yield Fault("-o", f"'{output.stem}'", expected, f"-o {output.with_stem(package_name(output.stem))}")


def _map_faults(data: MapData, to: str, place: Path) -> Iterator[Fault]:
    """Yield the faults of a map that the format cannot hold."""
    if not FORMATS[to].single and not wide(data):
        yield Fault("map", "a single point", "two levels of an input, or --to csv")
    if not FORMATS[to].holes and (hole := first_hole(data)):
        able = " or ".join(name for name, one in FORMATS.items() if one.holes)
        remedy = f"swashfilm map .. --resume {quote(str(place))} without those levels; --to {able} writes nan"
        yield Fault("map", hole, f"a whole map: a table of {to} has no holes", remedy)


def _path(stem: Path, ending: str) -> Path:
    return stem.with_name(stem.name + ending)


def _existing(stem: Path, endings: Iterable[str]) -> list[Path]:
    return [path for ending in endings if os.path.lexists(path := _path(stem, ending))]
