"""One mutation: the edit is made in a copy of the checkout, and the default tests run until one fails."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from .compiled_code import anew
from .edits import Edit

HANGS = 400.0  # s, in which one test of the default suite ends even on a loaded machine
CRASH = "the interpreter, by"
SHARED = 8.0  # seconds of the clock for one of a processor, at most
LEFT_OUT = ".git", ".venv", "build", ".hypothesis", ".mypy_cache", ".import_linter_cache", "runs"
FAILED = re.compile(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", re.MULTILINE)


class Fate(StrEnum):
    """Outcome of a mutation."""

    KILLED = "killed"
    HANGS = "one test does not end"
    SURVIVED = "survived"
    UNDECIDED = "time is over"


@dataclass(frozen=True)
class Trial:
    """An edit, its outcome, the test that noticed it, the largest number of test files that ran, and seconds.

    at_first: its outcome at the first trial, before a test was written for it.
    """

    name: str
    file: str
    function: str
    kind: str
    before: str
    after: str
    fate: Fate
    noticed_by: str
    files: int
    seconds: float
    at_first: Fate


class Copy:
    """A copy of the present checkout, with its compiled code; each mutation is undone afterwards."""

    def __init__(self, root: Path, place: Path):
        self.place = place
        self._sound: dict[str, bool] = {}
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(root, place, ignore=lambda folder, _: LEFT_OUT if Path(folder) == root else ())

    def tried(self, edit: Edit, tests: Sequence[str], limit: float) -> Trial:
        """Run `tests` in order until one fails, for `limit` seconds of a processor at most."""
        begin, unsound = time.monotonic(), list[str]()
        while True:
            fate, noticed = self._edited(edit, [*tests, *(f"--deselect={test}" for test in unsound)], limit)
            if fate is not Fate.KILLED or self._is_sound(noticed, limit):
                break
            unsound.append(noticed)
        told = edit.name, edit.file, edit.function, edit.kind, edit.before, edit.after
        return Trial(*told, fate, noticed, len(tests), time.monotonic() - begin, fate)

    def _edited(self, edit: Edit, tests: Sequence[str], limit: float) -> tuple[Fate, str]:
        path = self.place / edit.file
        source, stamp = path.read_bytes(), path.stat()
        with anew(self.place, edit.file):
            try:
                path.write_bytes(edit.applied(source))
                return self._run(tests, limit)
            finally:
                path.write_bytes(source)
                os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))

    def _is_sound(self, test: str, limit: float) -> bool:
        """Whether a test passes without any mutation; a failing one has not noticed the mutation."""
        if test.startswith(CRASH):
            return True
        if test not in self._sound:
            self._sound[test] = self._run([test], limit)[0] is Fate.SURVIVED
        return self._sound[test]

    def _run(self, tests: Sequence[str], limit: float) -> tuple[Fate, str]:
        environment = os.environ | {"PYTHONPATH": str(self.place), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        ends = ["-o", f"faulthandler_timeout={HANGS}", "-o", "faulthandler_exit_on_timeout=true"]
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-rfE", "--tb=no", *ends, *tests]
        run = subprocess.Popen(
            ["sh", "-c", f'ulimit -t {limit:.0f}; exec "$@"', "sh", *command],
            cwd=self.place,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            told, _ = run.communicate(timeout=SHARED * limit)
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)
            run.communicate()
            return Fate.UNDECIDED, ""
        if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return Fate.UNDECIDED, ""
        failed = FAILED.search(told)
        if failed is None and "Timeout (" in told:
            return Fate.HANGS, ""
        if failed is not None:
            return Fate.KILLED, failed[1]
        if run.returncode < 0:
            return Fate.KILLED, f"{CRASH} {signal.Signals(-run.returncode).name}"
        if run.returncode != 0:
            raise RuntimeError(f"pytest ends with {run.returncode} and names no test:\n{told[-2000:]}")
        return Fate.SURVIVED, ""
