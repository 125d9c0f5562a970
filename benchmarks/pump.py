"""Time one operating point of a pump in both fidelities: `python benchmarks/pump.py [PUMP]`.

Prints the shortest and the median of repeats once everything is compiled. Nothing in it runs in parallel.
"""

import sys
import time
from collections.abc import Callable
from statistics import median

from journal_case import one_thread
from rich.console import Console
from rich.table import Table

from system.points.films import films_point
from system.points.lumped import lumped_point
from system.pump.operating import operating_point
from system.pump_file.file import load_pump


def seconds(work: Callable[[], object], repeats: int) -> list[float]:
    """Wall time of each of `repeats` calls after one that compiles."""
    work()
    found = []
    for _ in range(repeats):
        began = time.perf_counter()
        work()
        found.append(time.perf_counter() - began)
    return found


def main() -> None:
    """Time both fidelities and print them."""
    one_thread()
    pump = load_pump(sys.argv[1] if len(sys.argv) > 1 else "ref90")
    point = operating_point(pump)
    table = Table(title=f"{pump.name} at its own operating point")
    for head in ("what", "repeats", "shortest / ms", "median / ms"):
        table.add_column(head, justify="right")
    for what, work, repeats in (
        ("lumped point", lambda: lumped_point(pump, point), 200),
        ("films point", lambda: films_point(pump, point), 2),
    ):
        times = seconds(work, repeats)
        table.add_row(what, str(repeats), f"{1e3 * min(times):.2f}", f"{1e3 * median(times):.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
