"""Run the examples that need no data of others, as a user runs them, each in a run folder of its own.

    python examples/run_all.py [--workers N] [--long] [WORD ..]

With words, only examples whose command contains one of them; LONG ones run with --long alone. Left out are the scripts
that write files of the examples, and pumps/ref90_design.py, a study of some minutes. Prints the time of each. The exit
code is 1 where one fails.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
LIMIT = 1200.0
"""Seconds that one example may take; with --long hours."""
LONG = ("examples/optimisations/floating_slipper.toml",)
"""Examples that take more than some minutes."""


@dataclass(frozen=True)
class Outcome:
    """An example that has run: its command, wall time in s, and its output where it failed, else ""."""

    command: str
    seconds: float
    failure: str


def main(words: Sequence[str]) -> int:
    """Run the examples side by side and return the exit code."""
    parser = argparse.ArgumentParser(description="Run the examples that need no data of others.")
    parser.add_argument("--workers", type=int, default=2, help="examples side by side (2)")
    parser.add_argument("--long", action="store_true", help=f"also {', '.join(LONG)}")
    parser.add_argument("words", nargs="*", help="only examples whose command contains one of them")
    asked = parser.parse_args(words)
    picked = [one for one in commands() if not asked.words or any(word in " ".join(one) for word in asked.words)]
    picked = [one for one in picked if asked.long or not set(LONG) & set(one)]
    with tempfile.TemporaryDirectory() as place, ThreadPoolExecutor(asked.workers) as pool:
        folders = [Path(place) / str(number) for number in range(len(picked))]
        failed = [outcome for outcome in pool.map(run, picked, folders) if shown(outcome).failure]
    print(f"{len(picked) - len(failed)} of {len(picked)} examples ran")
    return 1 if failed else 0


def commands() -> Iterator[list[str]]:
    """Command of each example, relative to the checkout: `swashfilm` words, or a script."""
    for command, folder in (("film", "films"), ("transient", "transients"), ("reference", "references"),
                            ("optimise", "optimisations")):  # fmt: skip
        for case in sorted((EXAMPLES / folder).glob("*.toml")):
            yield ["swashfilm", command, str(case.relative_to(ROOT))]
    for pump in sorted((EXAMPLES / "pumps").glob("*.toml")):
        yield ["swashfilm", "run", str(pump.relative_to(ROOT)), "--fidelity", "lumped"]
    yield ["swashfilm", "diagnose", "examples/recordings/bench_pump.toml", "examples/recordings/open-06"]
    yield ["swashfilm", "calibrate", "examples/recordings/bench_pump.toml", "examples/recordings/open-01"]
    yield ["swashfilm", "reproduce", "fig13", "--recording", "examples/recordings/paper_points"]
    yield ["examples/films/shape_by_gradient.py"]
    yield ["examples/optimisations/piston_profile.py"]
    yield ["examples/own_simulator/valve.py"]
    yield ["examples/hst196/band.py"]
    yield ["examples/hst196/floating.py", "--rigid"]


def run(words: list[str], folder: Path) -> Outcome:
    """Run one command; those of the program write their run folder at `folder`."""
    start = perf_counter()
    arguments = ["-m", *words, "-o", str(folder)] if words[0] == "swashfilm" else words
    try:
        done = subprocess.run(
            [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=limit(words), check=False
        )
        failure = done.stdout[-2000:] + done.stderr[-2000:] if done.returncode else ""
    except subprocess.TimeoutExpired:
        failure = f"not done within {limit(words):.0f} s"
    return Outcome(" ".join(words), perf_counter() - start, failure)


def limit(words: Sequence[str]) -> float:
    """Return the seconds that an example may take."""
    return 10.0 * LIMIT if set(LONG) & set(words) else LIMIT


def shown(outcome: Outcome) -> Outcome:
    """Print an outcome and return it."""
    print(f"{'FAILED' if outcome.failure else 'ran':6s} {outcome.seconds:6.1f} s  {outcome.command}", flush=True)
    if outcome.failure:
        print(outcome.failure, flush=True)
    return outcome


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
