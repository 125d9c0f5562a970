"""Results of parts kept in a folder, one file per part, named by content, so that no part is solved twice."""

import json
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeVar

from reynolds.errors import InputError
from reynolds.numerics.cache import content_key
from reynolds.numerics.files import is_file, read_json, replaced
from system.inputs.faults import Fault, InputFaults, nearest_path
from system.work.processes import WorkerDied
from system.work.progress import Report, silent
from system.work.tasks import Executor, PartOutcome, PartStatus, Work, WorkInRows, done_part, internal_reason

FORMAT = 1
SEAL = "seal"
"""Key of the hash of all others in a file."""
POINTS = "points"
"""Folder of a run's points inside the run's."""
LOG = logging.getLogger(__name__)
Part = TypeVar("Part")


@dataclass(frozen=True)
class KeptPoints:
    """A folder of outcomes; `keeps`: of which kinds. Others may differ at another time."""

    folder: Path
    keeps: frozenset[PartStatus] = frozenset({PartStatus.SOLVED, PartStatus.NOT_CONVERGED})

    def get(self, key: str) -> PartOutcome | None:
        """The outcome of that name, None if absent; a broken file counts as absent and is logged."""
        place = self.folder / f"{key}.json"
        if not is_file(place):
            return None
        try:
            values = read_json(place)
            if values["format"] != FORMAT:
                return None
            seal = _seal(values)
            if values.get(SEAL, seal) != seal:  # points of earlier checkouts have none
                raise ValueError("its content is not what was written")
            fields = (values[name] for name in ("reason", "record", "seconds", "worker"))
            return PartOutcome(key, PartStatus(values["status"]), *fields)
        except (OSError, ValueError, KeyError, TypeError) as fault:
            LOG.warning("%s is broken (%r): done anew", place, fault)
            return None

    @property
    def count(self) -> int:
        """Number of outcomes in the folder."""
        return sum(1 for _ in self.folder.glob("*.json"))

    def put(self, outcome: PartOutcome) -> None:
        """Keep an outcome of a kind that is kept. The file is written elsewhere and moved, so no reader finds a part of
        it.

        Raises InputError where the folder cannot be written.
        """
        if outcome.status not in self.keeps:
            return
        record = {"format": FORMAT, **asdict(outcome), "status": outcome.status.value}
        values = json.loads(json.dumps(record | {"package": version("swashfilm")}, allow_nan=False))
        text = json.dumps(values | {SEAL: _seal(values)})
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with replaced(self.folder / f"{outcome.key}.json") as beside:
                beside.write_text(text + "\n", encoding="utf-8")
        except OSError as fault:
            raise InputError("kept points", f"{self.folder}: {fault.strerror}", "a folder to write in") from fault


def _seal(values: Mapping[str, Any]) -> str:
    """The hash of an outcome's content, as it comes back from its file."""
    return content_key(json.dumps({key: values[key] for key in sorted(values) if key != SEAL}))


def points_of_run(folder: Path) -> KeptPoints:
    """The points of another run, finished or interrupted; raises InputFaults where the folder has none."""
    if not (folder / POINTS).is_dir():
        found, near = f"{folder}, which holds no {POINTS}", nearest_path(folder)
        fault = Fault("--resume", found, "the folder of a run in points that was begun", near)
        raise InputFaults("command line", [fault])
    return KeptPoints(folder / POINTS)


@dataclass(frozen=True)
class KeptOutcomes:
    """All outcomes in the order of the parts, and the number of those kept before."""

    outcomes: tuple[PartOutcome, ...]
    known: int


def run_kept(
    work: Work[Part],
    parts: Sequence[Part],
    store: KeptPoints,
    executor: Executor,
    *,
    earlier: KeptPoints | None = None,
    batch: int = 1,
    described: Callable[[Part, PartOutcome], str] = lambda part, outcome: outcome.status.value,
    report: Report = silent,
) -> KeptOutcomes:
    """Every part's outcome. Each is in `store` as soon as it is known here: an interruption loses only the parts
    under way.

    Outcomes in `store` or `earlier` are read from there. At most `batch` parts go to a process at a time, as a row
    where the work has rows; on this machine each is kept as soon as it is solved. No part's failure ends the others;
    parts of a batch whose process dies are tried one by one.
    """
    found = {index: outcome for index, part in enumerate(parts) if (outcome := _known(work, part, store, earlier))}
    known, todo = len(found), [index for index in range(len(parts)) if index not in found]
    report(0, len(todo), f"{known} points kept" if known else "solving")
    keeper, shared = store if executor.here else None, max(1, -(-len(todo) // executor.workers))
    before = store.count
    told = 0

    def tell(done: int, what: str) -> None:
        nonlocal told
        if done > told:
            told = done
            report(done, len(todo), what)

    def look() -> None:
        tell(store.count - before, "solving")  # points of rows under way are in the store already

    for index, outcome in _outcomes(work, parts, todo, executor, min(batch, shared), keeper, look):
        found[index] = outcome
        if keeper is None:
            store.put(outcome)
        tell(len(found) - known, described(parts[index], outcome))
    return KeptOutcomes(tuple(found[index] for index in range(len(parts))), known)


def _known(work: Work[Part], part: Part, store: KeptPoints, earlier: KeptPoints | None) -> PartOutcome | None:
    """The outcome of a part that is kept somewhere, afterwards in `store`; unnamed without a store."""
    if not store.folder.is_dir() and earlier is None:
        return None
    try:
        key = work.key(part)
    except (InputFaults, InputError):
        return None  # raised again when the part is tried
    if (own := store.get(key)) is not None or earlier is None:
        return own
    if (taken := earlier.get(key)) is not None:
        store.put(taken)
    return taken


def _outcomes(
    work: Work[Part],
    parts: Sequence[Part],
    todo: Sequence[int],
    executor: Executor,
    batch: int,
    keeper: KeptPoints | None,
    meanwhile: Callable[[], None],
) -> Iterator[tuple[int, PartOutcome]]:
    """Index and outcome of the remaining parts, as they are done and, with a keeper, kept."""
    groups = [[(k, parts[k]) for k in todo[at : at + batch]] for at in range(0, len(todo), batch)]
    if executor.here and executor.workers == 1:  # in this process, which reports every part of a row
        for group in groups:
            yield from _row(work, keeper, group)
        return
    again: list[list[tuple[int, Part]]] = []
    for single in (False, True):
        for attempt in executor.attempts(partial(_done, work, keeper), again if single else groups, meanwhile):
            if attempt.result is not None:
                yield from attempt.result
            elif isinstance(attempt.fault, WorkerDied) and len(attempt.part) > 1:
                again.extend([one] for one in attempt.part)
            else:
                for index, _ in attempt.part:
                    lost = _lost(attempt.fault)
                    if keeper is not None:
                        keeper.put(lost)
                    yield index, lost


def _done(work: Work[Part], keeper: KeptPoints | None, group: list[tuple[int, Part]]) -> list[tuple[int, PartOutcome]]:
    return list(_row(work, keeper, group))


def _row(
    work: Work[Part], keeper: KeptPoints | None, group: list[tuple[int, Part]]
) -> Iterator[tuple[int, PartOutcome]]:
    """Outcomes of parts one after the other, each kept at once by the keeper, if any.

    Its outcomes of a row whose process died are used.
    """
    own = work.row() if isinstance(work, WorkInRows) else work
    for index, part in group:
        outcome = None if keeper is None else _known(work, part, keeper, None)
        if outcome is None:
            outcome = done_part(own, part)
            if keeper is not None:
                keeper.put(outcome)
        yield index, outcome


def _lost(fault: Exception | None) -> PartOutcome:
    """The outcome of a part that has come back without one."""
    died = isinstance(fault, WorkerDied)
    reason = str(fault) if died or fault is None else internal_reason(fault)
    return PartOutcome("", PartStatus.WORKER_DIED if died else PartStatus.INTERNAL, reason, {}, 0.0, "")
