"""Work in parts whose results are kept: what a part is named by, and what became of it."""

from __future__ import annotations

import json
import os
import platform
import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, Protocol, TypeVar

from reynolds.errors import FilmInputError, FilmNotConverged
from system.inputs.errors import NotConverged
from system.inputs.faults import InputFaults
from system.work.processes import Attempt

Part = TypeVar("Part")
Result = TypeVar("Result")
Asked = TypeVar("Asked", contravariant=True)

Record = Mapping[str, Any]
"""What a part gives: numbers and texts as JSON holds them, no number that is none."""


class Status(Enum):
    """What has become of a part."""

    SOLVED = "solved"
    FAULTY = "faulty"
    NOT_CONVERGED = "not converged"
    WORKER_DIED = "worker died"
    INTERNAL = "internal error"


@dataclass(frozen=True)
class Outcome:
    """A part's record, or the reason why there is none; seconds of processor time, and the process that took them.

    `key` names the part's content; it is empty where the part has none, being faulty.
    """

    key: str
    status: Status
    reason: str
    record: Record
    seconds: float
    worker: str


class Work(Protocol[Asked]):
    """What is done to each part; frozen data that can be sent to another process."""

    def key(self, part: Asked) -> str:
        """Name of all that the part's result depends on; raises InputFaults for a part that is none."""
        ...

    def solve(self, part: Asked) -> Record:
        """The part's record; raises NotConverged, FilmNotConverged, FilmInputError or InputFaults."""
        ...


class Hands(Protocol):
    """Who does parts: `side_by_side.Crew` on this machine, `cluster.Cluster` on others."""

    @property
    def workers(self) -> int:
        """How many parts are done at a time."""
        ...

    def attempts(self, task: Callable[[Part], Result], parts: Sequence[Part]) -> Iterator[Attempt[Part, Result]]:
        """What comes of each part, in the order in which they are done."""
        ...


def done_part(work: Work[Part], part: Part) -> Outcome:
    """What becomes of a part done here; whatever is raised is its reason, an error of the program's own too."""
    key, began = "", time.process_time()

    def ended(status: Status, reason: str, record: Record | None = None) -> Outcome:
        seconds, worker = time.process_time() - began, f"{platform.node()}:{os.getpid()}"
        return Outcome(key, status, reason, record or {}, seconds, worker)

    try:
        key = work.key(part)
        record = work.solve(part)
        json.dumps(record, allow_nan=False)
    except (InputFaults, FilmInputError) as reason:
        return ended(Status.FAULTY, _line(reason))
    except (FilmNotConverged, NotConverged) as reason:
        return ended(Status.NOT_CONVERGED, str(reason))
    except Exception as error:  # an error of the program: it must not cost the parts that are good
        return ended(Status.INTERNAL, internal_reason(error))
    return ended(Status.SOLVED, "", record)


def internal_reason(error: BaseException) -> str:
    """An error of the program's own in a line: kind, text and the line of code it came from."""
    frames = traceback.extract_tb(error.__traceback__)
    return f"{type(error).__name__}: {error}" + (f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else "")


def _line(reason: InputFaults | FilmInputError) -> str:
    if isinstance(reason, InputFaults):
        return "; ".join(f"{fault.path}: {fault.found}, expected {fault.expected}" for fault in reason.faults)
    return str(reason)
