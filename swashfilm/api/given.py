"""Arguments of a function as files of the command: descriptions, tables and results are written to one."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from system.inputs.faults import InputFaults

if TYPE_CHECKING:
    from swashfilm.runs.map.result import MapRun
    from system.description.pump import PumpDescription

Case = str | Path | Mapping[str, Any]
"""Path of a case file, its text, or its tables, numbers in SI."""


@contextmanager
def pump_path(pump: str | Path | PumpDescription) -> Iterator[str]:
    """Yield the name or path of a pump; a description is written to a temporary file."""
    if isinstance(pump, (str, Path)):
        yield str(pump)
        return
    from system.pump_file.file import resolved_toml

    with _written(f"{pump.name}.toml", resolved_toml(pump)) as path:
        yield str(path)


@contextmanager
def case_path(case: Case) -> Iterator[Path]:
    """Yield the path of a case; text and tables are written to a temporary file.

    Relative paths in them count from the working directory; numbers of tables are in SI. Faults are those of "case",
    of tables without lines.
    """
    if isinstance(case, Path) or (isinstance(case, str) and "\n" not in case):
        yield Path(case)
        return
    import tomli_w

    from swashfilm.api.tables import tables_of_file, text_of_file

    here, is_text = Path.cwd(), isinstance(case, str)
    text = text_of_file(case, here) if isinstance(case, str) else tomli_w.dumps(tables_of_file(case, here))
    with _written("case.toml", text) as path:
        try:
            yield path
        except InputFaults as reason:
            raise _of_case(reason, str(path), with_lines=is_text) from None


def _of_case(reason: InputFaults, path: str, *, with_lines: bool) -> InputFaults:
    """Return faults of a temporary case file as those of the case."""
    if reason.source != path:
        return reason
    faults = [
        replace(one, found=one.found.replace(path, "case"), nearest=one.nearest.replace(path, "CASE.toml"))
        for one in reason.faults
    ]
    return InputFaults("case", faults, reason.lines if with_lines else {})


@contextmanager
def map_path(of: MapRun | str | Path) -> Iterator[Path]:
    """Yield the path of a map; a result is written to a temporary folder."""
    if isinstance(of, (str, Path)):
        yield Path(of)
        return
    with tempfile.TemporaryDirectory(prefix="swashfilm-") as place:
        of.write(Path(place))
        yield Path(place)


@contextmanager
def map_or_pump_path(of: MapRun | str | Path | PumpDescription) -> Iterator[str]:
    """Yield the path of a map, or the name or path of a pump; results and descriptions are written to one."""
    from system.description.pump import PumpDescription

    with pump_path(of) if isinstance(of, PumpDescription) else map_path(of) as place:
        yield str(place)


@contextmanager
def _written(name: str, text: str) -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="swashfilm-") as place:
        path = Path(place) / re.sub(r"[^\w.-]+", "-", name)
        path.write_text(text, encoding="utf-8")
        yield path
