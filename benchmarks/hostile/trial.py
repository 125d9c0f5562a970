"""One case: a mutated copy of a sample, the command in a child with limits, and its outcome."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import subprocess
import sys
import time
import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from .doors import Door
from .judged import RAISED, Ended, Outcome, judged
from .mutations import MARK

PROCESSOR, WALL, STILL = 60, 300, 10
"""Seconds of processor time and of the clock that a case may take, and for which it may wait."""
MORE_MEMORY = 3_000_000_000
"""Bytes that a case may take beyond those of its parent."""
SECRET = f"precious {MARK} secret\n"


@dataclass(frozen=True)
class Told:
    """A case and its outcome; how: the mutation in words; told: end of the command's output."""

    door: str
    kind: str
    number: int
    how: str
    outcome: Outcome
    told: str
    seconds: float
    memory: float


def tried(door: Door, number: int, samples: Path, place: Path) -> Told:
    """Return the outcome of a case; its folder is kept if the outcome is bad."""
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    secret = place / "secret.txt"
    secret.write_text(SECRET, "utf-8")
    folder = place / "case"
    shutil.copytree(samples / door.sample, folder)
    listed = sorted(folder.glob(door.file))
    how = door.mutate(listed[number % len(listed)], number, secret)
    start = time.perf_counter()
    whole = door.whole and number % door.whole == 0 and door.words[0] != "cached"
    ended = _process(door.words, folder) if whole else _child(door.words, folder)
    found, why = judged(folder, ended, secret.read_text("utf-8") == SECRET)
    seconds = time.perf_counter() - start
    if found.good:
        shutil.rmtree(place)
    return Told(door.name, door.kind, number, how, found, why, round(seconds, 2), round(ended.memory / 1e6))


def _child(words: tuple[str, ...], folder: Path) -> Ended:
    """Run the command in a child of this process, which has all modules."""
    sys.stdout.flush()
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    pid = os.fork()
    if pid == 0:
        _in_child(words, folder)
    status, used, hung = _waited(pid)
    code = None if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    ended_by = os.WTERMSIG(status) if code is None else 0
    return Ended(code, ended_by, hung, max(used.ru_maxrss * 1024 - own, 0), _said(folder))


def _in_child(words: tuple[str, ...], folder: Path) -> NoReturn:
    code = RAISED
    try:
        os.setsid()
        os.chdir(folder)
        with open("../said.txt", "wb", buffering=0) as said:
            os.dup2(said.fileno(), 1)
            os.dup2(said.fileno(), 2)
        sys.stdout = os.fdopen(1, "w", encoding="utf-8", errors="backslashreplace")
        sys.stderr = os.fdopen(2, "w", encoding="utf-8", errors="backslashreplace")
        with open("/proc/self/statm", encoding="ascii") as pages:
            size = int(pages.read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (size + MORE_MEMORY,) * 2)
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR, PROCESSOR + 5))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        code = _command(words)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def _command(words: tuple[str, ...]) -> int:
    if words[0] == "cached":
        import numpy as np

        from reynolds.errors import InputError
        from reynolds.numerics.cache import kept

        try:
            found = kept(words[1], lambda: {"compliance": np.eye(40), "weights": np.ones(40)}, Path())
        except InputError as reason:
            print(f"swashfilm: {reason}")
            return 2
        return 0 if {"compliance", "weights"} <= set(found.arrays) else RAISED
    from swashfilm.__main__ import main

    return main(list(words))


def _waited(pid: int) -> tuple[int, resource.struct_rusage, bool]:
    """Return status and use of a child, and whether it had to be ended."""
    start = moved = time.monotonic()
    spent, hung = -1, False
    while True:
        done, status, used = os.wait4(pid, os.WNOHANG)
        if done:
            return status, used, hung
        now = time.monotonic()
        if (ticks := _ticks(pid)) != spent:
            spent, moved = ticks, now
        if now > start + WALL or now > moved + STILL:
            hung = True
            os.killpg(pid, signal.SIGKILL)
        time.sleep(0.02)


def _ticks(pid: int) -> int:
    """Return the processor time of a process, in ticks of the clock."""
    text = Path(f"/proc/{pid}/stat").read_text("ascii", "replace")
    return sum(map(int, text.rpartition(")")[2].split()[11:15]))


def _process(words: tuple[str, ...], folder: Path) -> Ended:
    """Run the command as a process of its own."""
    with (folder.parent / "said.txt").open("wb") as said:
        child = subprocess.Popen(
            [sys.executable, "-m", "swashfilm", *words], cwd=folder, stdout=said, stderr=said, start_new_session=True
        )
        status, used, hung = _waited(child.pid)
    child.returncode = 0
    code = None if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    return Ended(code, os.WTERMSIG(status) if code is None else 0, hung, used.ru_maxrss * 1024, _said(folder))


def _said(folder: Path) -> str:
    return (folder.parent / "said.txt").read_text("utf-8", errors="replace")
