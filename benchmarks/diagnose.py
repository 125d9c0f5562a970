"""What a diagnosis costs: process time and refits of the recordings of a folder, one after the other.

python benchmarks/diagnose.py ../shared/recordings/bench/open-01 ../shared/recordings/bench/open-02
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from time import process_time

from diagnosis.scant_pump import load_known_pump
from swashfilm.diagnose_run import checked_recording, run_diagnosis


def main() -> None:
    """Print a row for each recording named on the command line."""
    known = load_known_pump("ref90")
    sys.stdout.write("recording, points, verdict, status, process time / s, of it fits / s, predictions, slopes\n")
    for name in sys.argv[1:]:
        recording = checked_recording(Path(name), known)
        with tempfile.TemporaryDirectory() as folder:
            begun = process_time()
            found = run_diagnosis(known, recording, Path(folder), lambda *_: None)
            spent = process_time() - begun
        row = (
            Path(name).name, len(recording.steady.values), found.kind.value, found.status.value, f"{spent:.1f}",
            f"{found.effort.seconds:.1f}", found.effort.predictions, found.effort.slopes,
        )  # fmt: skip
        sys.stdout.write(", ".join(str(cell) for cell in row) + "\n")


if __name__ == "__main__":
    main()
