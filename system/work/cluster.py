"""Parts done by the workers of a Dask cluster: the same task and parts as by processes of this machine."""

from __future__ import annotations

import logging
import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeVar

from system.inputs.faults import Fault, InputFaults
from system.work.processes import Attempt, WorkerDied

if TYPE_CHECKING:
    from distributed import Client

Part = TypeVar("Part")
Result = TypeVar("Result")
IN_FLIGHT = 4
"""Parts sent to a worker: enough to keep it busy, few enough for a scheduler."""
CONNECT = 30.0  # s
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
RECIPE = "docs/cluster.md"


class Cluster:
    """The workers that a scheduler has; some may join and leave while parts are done."""

    def __init__(self, client: Client) -> None:
        self._client = client

    @property
    def workers(self) -> int:
        """Threads of all workers now: parts done at a time."""
        return max(1, sum(self._client.nthreads().values()))

    @property
    def here(self) -> bool:
        """False: workers are anywhere."""
        return False

    def attempts(
        self, task: Callable[[Part], Result], parts: Sequence[Part], meanwhile: Callable[[], None] | None = None
    ) -> Iterator[Attempt[Part, Result]]:
        """Result of each part, in the order of completion; no part's failure ends the others.

        `meanwhile` is not called: parts do not run here.

        The scheduler gives a part whose worker dies to another. After the fourth death (Dask's own
        `allowed-failures`, 3) the part is tried alone, since Dask also blames other parts that waited on the same
        workers. If workers die of it again its fault is WorkerDied.
        """
        from distributed import KilledWorker

        suspects = []
        for attempt in self._together(task, parts, IN_FLIGHT * self.workers):
            if isinstance(attempt.fault, KilledWorker):
                suspects.append(attempt.part)
            else:
                yield attempt
        for attempt in self._together(task, suspects, 1):
            if isinstance(attempt.fault, KilledWorker):
                died = WorkerDied("workers of the cluster died of it, by itself too: out of memory, or killed")
                yield Attempt(attempt.part, None, died)
            else:
                yield attempt

    def _together(
        self, task: Callable[[Part], Result], parts: Sequence[Part], most: int
    ) -> Iterator[Attempt[Part, Result]]:
        """The parts, `most` of them sent at a time."""
        from distributed import as_completed

        waiting, flying = iter(parts), as_completed(())
        own: dict[str, Part] = {}

        def send(count: int) -> None:
            for _, part in zip(range(count), waiting, strict=False):
                future = self._client.submit(task, part, pure=False)
                own[future.key] = part
                flying.add(future)

        send(most)
        for future in flying:
            part, fault = own.pop(future.key), future.exception()
            result = None if fault else future.result()
            future.release()
            send(1)
            yield Attempt(part, result, fault)


@contextmanager
def cluster(address: str) -> Iterator[Cluster]:
    """The cluster of a scheduler, as long as it is needed; it keeps running afterwards.

    Raises InputFaults where Dask is not installed, no scheduler answers, there is no worker, or a worker has other
    versions than this process, or threads of its own in its libraries.
    """
    if find_spec("distributed") is None:
        expected = "the extra [cluster]: make install, or pip install '.[cluster]' in the checkout"
        fault = Fault("--cluster", "no package 'distributed'", expected, RECIPE)
        raise InputFaults("command line", [fault])
    from distributed import Client

    for name in ("distributed", "distributed.core", "distributed.comm"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # heartbeats that break as workers leave are not logged
    try:
        client = Client(address, timeout=CONNECT)
    except (OSError, TimeoutError, ValueError) as reason:
        expected = "the address of a scheduler that answers, such as tcp://host:8786"
        raise InputFaults("command line", [Fault("--cluster", f"{address}: {reason}", expected, RECIPE)]) from None
    with client:
        try:
            versions = client.run(about_worker)
        except ImportError as reason:
            fault = Fault("workers", f"one that fails: {reason}", "swashfilm installed on every worker", RECIPE)
            raise InputFaults(f"cluster {address}", [fault]) from None
        if faults := [*worker_faults(versions, about_worker())]:
            raise InputFaults(f"cluster {address}", faults)
        yield Cluster(client)


def about_worker() -> dict[str, str]:
    """Properties that must be equal on every worker: versions, and one thread per library."""
    import os

    import numpy

    found = {"python": ".".join(platform.python_version_tuple()[:2]), "numpy": numpy.__version__}
    found["swashfilm"] = version("swashfilm")
    return found | {name: os.environ.get(name, "not set") for name in THREADS}


def worker_faults(workers: Mapping[str, Mapping[str, Any]], own: Mapping[str, str]) -> Iterator[Fault]:
    """Every worker that has another version than this process, or uses several threads in libraries."""
    if not workers:
        yield Fault("workers", "none", "one at least", f"{RECIPE} says how they are started")
    for name, found in workers.items():
        for key in own.keys() - set(THREADS):
            if found.get(key) != own[key]:
                yield Fault(f"{key} of worker {name}", str(found.get(key)), f"{own[key]}, as here", "install the same")
        wrong = [key for key in THREADS if found.get(key) != "1"]
        if wrong:
            expected = "1: several threads a library make every point slower"
            yield Fault(f"{', '.join(wrong)} of worker {name}", str(found.get(wrong[0])), expected, RECIPE)
