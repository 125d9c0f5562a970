"""Files to start from, and finished run folders."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import Quantity, door, words_of
from system.inputs.faults import Fault, InputFaults, nearest_path

if TYPE_CHECKING:
    from swashfilm.output.result import Result

_RESULTS = (
    "pump", "pump.vary", "film", "film.revolution", "film.series", "map", "map.duty", "compare", "table", "transient",
    "plan", "reference", "reproduce", "diagnose", "calibrate", "variation.sensitivity", "variation.tolerance",
    "variation.optimise",
)  # fmt: skip
"""Rooms of `swashfilm.runs` with results."""


def new(
    kind: str,
    of: str | Path | None = None,
    *,
    displacement: Quantity | None = None,
    pistons: int | None = None,
    oil: str | None = None,
    speed: Quantity | None = None,
    pressure: Quantity | None = None,
    circuit: str | None = None,
    part: str | None = None,
    output: str | Path | None = None,
) -> Path:
    """Write a commented file to start from and return its path, as `swashfilm new`; nothing is overwritten.

    kind: "pump" (with displacement to circuit), "recording" (of: its table; part: its sheet, group or variable),
    "film" (of: its kind). Raises InputFaults.
    """
    if isinstance(displacement, float):
        displacement = f"{displacement!r} m3/rev"
    given: dict[str, object] = {
        "displacement": displacement,
        "pistons": pistons,
        "oil": oil,
        "speed": speed,
        "pressure": pressure,
        "circuit": circuit,
        "part": part,
    }
    with door("new"):
        from swashfilm.cli.new.command import new_file

        words = words_of("new", [kind] if of is None else [kind, of], given)
        words.output = None if output is None else Path(output)
        return new_file(words).write()


def open(folder: str | Path) -> Result:
    """Return the result of a finished run folder, of the class of its kind; raise InputFaults without one."""
    from swashfilm.output.page import read_summary

    place = Path(folder)
    with door("open"):
        if not (place / "summary.json").is_file():
            fault = Fault("folder", f"no {place / 'summary.json'}", "the folder of a finished run", nearest_path(place))
            raise InputFaults("command line", [fault])
        kind = read_summary(place)["kind"]
        return next(found for found in _result_classes() if kind in found.kinds).opened(place)


def _result_classes() -> Iterator[type[Result]]:
    """Yield the classes of results; one without kinds is the base of the others."""
    for room in _RESULTS:
        module = import_module(f"swashfilm.runs.{room}.result")
        yield from (one for one in vars(module).values() if isinstance(one, type) and getattr(one, "kinds", None))
