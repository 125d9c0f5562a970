"""Run folders: a new one for every run, nothing overwritten, an interrupted run marked as partial.

A run writes into `<folder>.partial`, which is renamed to `<folder>` when the run is complete.
"""

import json
import math
import os
import re
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from shlex import quote
from typing import Any

from reynolds.errors import NotConverged
from reynolds.numerics.files import REFUSED_BY_DISK
from system.inputs.faults import Fault, InputFaults

RUNS = Path("runs")
LEAST_ROOM = 1_000_000
"""Free bytes on a disk below which a failed write is attributed to a full disk."""
FAILED = "failed.json"
"""File of the rounds and gaps that a stopped run has solved, in its `.partial` folder."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a run: `kept` is the folder of the finished part, None without one.

    `again`: instruction to continue where the finished part is kept elsewhere.
    """

    def __init__(self, kept: Path | None, again: str = "") -> None:
        super().__init__(kept)
        self.kept = kept
        self.again = again


@contextmanager
def run_folder(name: str, wanted: Path | None = None, *, workbook: bool = False) -> Iterator[Path]:
    """Yield a folder for a run's files; at the end it becomes `wanted`, or `runs/<name>-<n>` with the next free n.

    workbook: the folder's tables are written as <folder>.xlsx into it, too. After an error or Interrupted the
    `.partial` folder is kept if it holds solved points or FAILED; the error has a note that names it. After Ctrl-C
    it is kept if it holds results, and Interrupted names it. Raises InputFaults for a `wanted` that holds files or
    cannot be created, and where another run has filled it meanwhile (the results then remain in the `.partial`
    folder).
    """
    final, partial = _claim(name, wanted)
    try:
        yield partial
        if workbook:
            from swashfilm.output.data.workbook import write_workbook

            write_workbook(partial, partial / f"{final.name}.xlsx")
    except Interrupted:
        shutil.rmtree(partial)
        raise
    except KeyboardInterrupt:
        if any(_is_result(path) for path in partial.iterdir()):
            raise Interrupted(partial) from None
        shutil.rmtree(partial)
        raise Interrupted(None) from None
    except BaseException as reason:
        from system.work.kept_results import POINTS

        if any((partial / POINTS).glob("*.json")):
            reason.add_note(f"Solved points are kept in {partial}: --resume {quote(str(partial))}")
        elif (partial / FAILED).is_file():
            reason.add_note(f"What was solved until then is kept in {partial} ({FAILED}).")
        else:
            shutil.rmtree(partial, ignore_errors=True)
        if isinstance(reason, OSError) and _full(reason, partial):
            raise _disk_faults(reason, final) from None
        raise
    _give_its_name(partial, final)


def _is_result(path: Path) -> bool:
    """Return whether an entry of an unfinished folder is more than its input: not its schema, nor an empty folder."""
    if path.is_dir():
        return any(path.iterdir())
    return path.suffix != ".toml" and not path.name.endswith(".schema.json")


def _full(reason: OSError, partial: Path) -> bool:
    """Return True where a file could not be written; libraries do not always state the cause."""
    return reason.errno in REFUSED_BY_DISK or (
        reason.errno is None and shutil.disk_usage(partial.parent).free < LEAST_ROOM
    )


def _disk_faults(reason: OSError, final: Path) -> InputFaults:
    """Return the fault of a folder that a run could not write to, with the notes of the error."""
    words = reason.strerror or "No space left on device"
    fault = Fault(
        "-o", f"{reason.filename or final}: {words}", "a folder that can be written to, with room for the run"
    )
    found = InputFaults("command line", [fault])
    for note in getattr(reason, "__notes__", ()):
        found.add_note(note)
    return found


def _give_its_name(partial: Path, final: Path) -> None:
    """Rename a complete run's folder; raise InputFaults where another run has filled the final one meanwhile."""
    try:
        if final.is_dir():
            final.rmdir()  # empty: `_claim` refused any other
        partial.rename(final)
    except OSError:
        found = f"{final}, which another run has filled meanwhile"
        fault = Fault("-o", found, "a separate folder for every run", f"the results are in {partial}")
        raise InputFaults("command line", [fault]) from None


def final_folder(partial: Path) -> Path:
    """Return the name that a partial folder gets when its run is complete."""
    return partial.with_name(partial.name.rpartition(".partial")[0])


def write_json(path: Path, values: Mapping[str, Any]) -> None:
    """Write values as JSON; raise NotConverged for nan and inf, which are not allowed in a summary, with their key."""
    if void := next(_not_finite(values), None):
        raise NotConverged(f"{void}: the input lies beyond the range of the model")
    path.write_text(json.dumps(values, indent=2, allow_nan=False) + "\n", encoding="utf-8")


def _not_finite(value: Any, key: str = "") -> Iterator[str]:
    """Yield the key of each number that is not finite, and the number."""
    if isinstance(value, Mapping):
        for name, one in value.items():
            yield from _not_finite(one, f"{key}.{name}" if key else str(name))
    elif isinstance(value, (list, tuple)):
        for one in value:
            yield from _not_finite(one, key)
    elif isinstance(value, float) and not math.isfinite(value):
        yield f"{key} is {value}"


def _claim(name: str, wanted: Path | None) -> tuple[Path, Path]:
    """Return the final folder and its partial one, which is created and belongs to this run alone."""
    try:
        if wanted is not None:
            _refuse_filled(wanted)
            wanted.parent.mkdir(parents=True, exist_ok=True)
            for number in count(1):
                partial = wanted.with_name(f"{wanted.name}.partial{'' if number == 1 else f'-{number}'}")
                if _made(partial):
                    return wanted, partial
        RUNS.mkdir(exist_ok=True)
        name = re.sub(r"[^\w.-]+", "-", name).strip("-.") or "run"
        for number in count(1):
            final = RUNS / f"{name}-{number}"
            if not final.exists() and _made(partial := RUNS / f"{name}-{number}.partial"):
                return final, partial
    except OSError as reason:
        fault = Fault("-o", f"{reason.filename}: {reason.strerror}", "a folder that can be created and written")
        raise InputFaults("command line", [fault]) from None
    raise AssertionError("count() does not end")


def _refuse_filled(wanted: Path) -> None:
    if wanted.name in ("", ".."):
        fault = Fault("-o", f"'{wanted}', not a folder name", "the name of a new or an empty folder")
        raise InputFaults("command line", [fault])
    if wanted.is_dir() and not any(wanted.iterdir()):
        return
    if os.path.lexists(wanted):
        found = "a folder that holds files" if wanted.is_dir() else "a file"
        free = next(path for n in count(2) if not (path := wanted.with_name(f"{wanted.name}-{n}")).exists())
        fault = Fault("-o", f"{wanted}, {found}", "a new or an empty folder: nothing is overwritten", f"-o {free}")
        raise InputFaults("command line", [fault])


def _made(folder: Path) -> bool:
    try:
        folder.mkdir()
    except FileExistsError:
        return False
    return True
