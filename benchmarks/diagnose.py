"""Cost of a diagnosis from files to its page: time and fits of recordings, one after the other.

The pump is the recording's own pump.toml, else that of the bench.

python benchmarks/diagnose.py [--workers N] examples/recordings/open-01 examples/recordings/open-06
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from diagnosis.finding import diagnose
from diagnosis.study.acceptance import checked_recording
from swashfilm.runs.diagnose.run import write_finding
from system.pump_file.file import load_known_pump

BENCH = Path(__file__).parents[1] / "examples" / "recordings" / "bench_pump.toml"


def main() -> None:
    """Print a row for each recording named on the command line; process time counts the other processes too."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("recordings", nargs="+", type=Path)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    sys.stdout.write(f"load {os.getloadavg()[0]:.1f}, {options.workers} workers\n")
    sys.stdout.write("recording, points, verdict, status, wall / s, process / s, of it fits / s, predictions, slopes\n")
    for path in options.recordings:
        begun, used, own = perf_counter(), _used(), path / "pump.toml"
        known = load_known_pump(own if own.is_file() else BENCH)
        recording = checked_recording(path, known)
        result = diagnose(known, recording, workers=options.workers)
        with TemporaryDirectory() as folder:
            write_finding(Path(folder), result)
        found = result.diagnosis
        wall, spent = perf_counter() - begun, _used() - used
        row = (
            path.name, len(recording.steady.values), found.kind.value, found.status.value, f"{wall:.1f}",
            f"{spent:.1f}", f"{found.effort.seconds:.1f}", found.effort.predictions, found.effort.slopes,
        )  # fmt: skip
        sys.stdout.write(", ".join(str(cell) for cell in row) + "\n")
        sys.stdout.flush()


def _used() -> float:
    """Process time of this process and of those that have ended, in s."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


if __name__ == "__main__":
    main()
