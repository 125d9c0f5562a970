"""The unit as a zip archive: model description, sources, and a binary for each available target platform."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from importlib.metadata import version
from importlib.resources import as_file, files
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from reynolds.numerics.cache import content_key
from swashfilm.runs.export.content import Content
from swashfilm.runs.export.fmu.compiler import NONE, CompilerFault, compiled, targets
from swashfilm.runs.export.fmu.description import build_description, model_description
from swashfilm.runs.export.fmu.table import channels, table_header
from system.maps.data import MapData

SOURCES = "sources/"
KEPT = files("swashfilm.runs.export.fmu").joinpath("sources")
HEADERS = files("swashfilm.runs.export.fmu").joinpath("headers")
"""The header files of FMI 3.0, by the Modelica Association (BSD licence). They are no part of a unit."""
DATE = (1980, 1, 1, 0, 0, 0)
"""Of every file in the archive: the same map gives the same bytes."""
READABLE = 0o644
"""Permissions of every unpacked file."""


def fmu_files(data: MapData, name: str) -> Content:
    """Return the archive by its ending, with a warning for each binary that is missing; `name` gives the identifier."""
    identifier = model_identifier(name)
    token = _token(data, identifier)
    texts = {entry.name: entry.read_bytes() for entry in KEPT.iterdir()}
    texts["map.h"] = table_header(data, identifier, token).encode()
    binaries, warnings = _binaries(texts, identifier)
    entries = {"modelDescription.xml": model_description(data, identifier, token)}
    entries[f"{SOURCES}buildDescription.xml"] = build_description(identifier)
    entries |= {f"{SOURCES}{file}": text for file, text in sorted(texts.items())}
    return Content({".fmu": _archive(entries | binaries)}, warnings)


def model_identifier(name: str) -> str:
    """Return the nearest valid name in C to a text."""
    word = re.sub(r"\W", "_", name, flags=re.ASCII)
    return word if re.match(r"[A-Za-z]", word) else f"map_{word}"


def _token(data: MapData, identifier: str) -> str:
    """Return the instantiation token: name of the unit's content."""
    levels = [(axis.input.value, axis.values) for axis in data.axes]
    return content_key("fmu", version("swashfilm"), identifier, data.name, levels, channels(data))[:32]


def _binaries(texts: Mapping[str, bytes], identifier: str) -> tuple[dict[str, bytes], tuple[str, ...]]:
    """Return the binaries by their place in the archive, and warnings."""
    found, warnings = {}, []
    with TemporaryDirectory() as folder, as_file(HEADERS) as headers:
        for file, text in texts.items():
            Path(folder, file).write_bytes(text)
        for target in targets():
            place = Path(folder, identifier + target.ending)
            try:
                binary = compiled(target, Path(folder), headers, place)
            except CompilerFault as reason:
                warnings.append(f"no binary for {target.platform}: {reason}")
                continue
            found[f"binaries/{target.platform}/{place.name}"] = binary
            place.unlink()
    return found, tuple(warnings) or (() if found else (NONE,))


def _archive(entries: Mapping[str, bytes]) -> bytes:
    file = io.BytesIO()
    with ZipFile(file, "w", ZIP_DEFLATED) as archive:
        for place, content in entries.items():
            entry = ZipInfo(place, DATE)
            entry.external_attr = READABLE << 16
            archive.writestr(entry, content, ZIP_DEFLATED)
    return file.getvalue()
