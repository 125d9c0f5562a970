"""Work in parts whose results are kept: the name of a part, and its outcome."""

import json
import os
import platform
import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, Protocol, TypeVar, runtime_checkable

from reynolds.errors import InputError, NotConverged
from system.inputs.faults import InputFaults
from system.work.processes import Attempt

Part = TypeVar("Part")
Result = TypeVar("Result")
GivenPart = TypeVar("GivenPart", contravariant=True)

Record = Mapping[str, Any]
"""Result of a part: finite numbers and texts, as JSON."""


class PartStatus(Enum):
    """Status of a part."""

    SOLVED = "solved"
    FAULTY = "faulty"
    NOT_CONVERGED = "not converged"
    WORKER_DIED = "worker died"
    INTERNAL = "internal error"


@dataclass(frozen=True)
class PartOutcome:
    """A part's record, or the reason for its absence; seconds of processor time, and the process that took them.

    `key` names the part's content; it is empty for a faulty part.
    """

    key: str
    status: PartStatus
    reason: str
    record: Record
    seconds: float
    worker: str


class Work(Protocol[GivenPart]):
    """The computation of each part; frozen data that can be sent to another process."""

    def key(self, part: GivenPart) -> str:
        """Name of all inputs of the part's result; raises InputFaults for an invalid part."""

    def solve(self, part: GivenPart) -> Record:
        """The part's record; raises NotConverged, FilmNotConverged, InputError or InputFaults."""


@runtime_checkable
class WorkInRows(Protocol):
    """Work whose parts, one after the other in one process, may start from each other's results."""

    def row(self) -> Work[Any]:
        """The work of one such row."""


class Executor(Protocol):
    """Executor of parts: `processes.ProcessPool` on this machine, `cluster.Cluster` on others."""

    @property
    def workers(self) -> int:
        """Number of parts that run at a time."""

    @property
    def here(self) -> bool:
        """True if parts run on this machine, whose files they see."""

    def attempts(
        self, task: Callable[[Part], Result], parts: Sequence[Part], meanwhile: Callable[[], None] | None = None
    ) -> Iterator[Attempt[Part, Result]]:
        """Result of each part, in the order of completion; `meanwhile` is called now and then, where parts run here."""


def done_part(work: Work[Part], part: Part) -> PartOutcome:
    """Outcome of a part done here; any exception is its reason, also an error of the program itself."""
    key, began = "", time.process_time()

    def ended(status: PartStatus, reason: str, record: Record | None = None) -> PartOutcome:
        seconds, worker = time.process_time() - began, f"{platform.node()}:{os.getpid()}"
        return PartOutcome(key, status, reason, record or {}, seconds, worker)

    try:
        key = work.key(part)
        record = work.solve(part)
        json.dumps(record, allow_nan=False)
    except (InputFaults, InputError) as reason:
        return ended(PartStatus.FAULTY, _line(reason))
    except NotConverged as reason:
        return ended(PartStatus.NOT_CONVERGED, str(reason))
    except Exception as error:  # an error of the program: it must not lose the valid parts
        return ended(PartStatus.INTERNAL, internal_reason(error))
    return ended(PartStatus.SOLVED, "", record)


def internal_reason(error: BaseException) -> str:
    """An error of the program itself in a line: kind, text and its line of code."""
    frames = traceback.extract_tb(error.__traceback__)
    return f"{type(error).__name__}: {error}" + (f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else "")


def _line(reason: InputFaults | InputError) -> str:
    if isinstance(reason, InputFaults):
        return "; ".join(fault.line for fault in reason.faults)
    return str(reason)
