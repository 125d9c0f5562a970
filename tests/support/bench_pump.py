"""The pump of the recordings in examples/recordings, which has films of given thickness."""

from pathlib import Path

BENCH = Path(__file__).parents[2] / "examples" / "recordings" / "bench_pump.toml"
