"""Time one floating point: `python benchmarks/point.py [--rigid] [--beside] [--pressure "5 MPa"] ..`.

Prints for `ref90` the rounds of gaps and chambers with their changes and films, by gap the steps and films of its last
round, time and headline numbers: processor time of one process, or with --beside the time from start to end with
gaps in processes, as `swashfilm run` has them. The first call after a change of the program compiles; the second
one counts.
"""

import argparse
import time
from dataclasses import replace

from journal_case import one_thread
from rich.console import Console
from rich.table import Table

from gaps.revolution.march import GapRevolution
from system.points.floating import FloatingPoint, floating_point
from system.points.floating_gaps import usual_options
from system.pump.operating import operating_point
from system.pump_file.file import load_pump

PUMP = "ref90"
GAPS = ("piston", "slipper", "block")


def timed(changes: dict[str, object], steps: int, *, rigid: bool, beside: bool) -> tuple[FloatingPoint, float]:
    """The point and the processor time it took, s; with its gaps side by side the time from start to end."""
    pump = load_pump(PUMP, changes)
    options = usual_options(pump.pump.pistons)
    options = replace(options.rigid if rigid else options, steps=steps)
    clock = time.perf_counter if beside else time.process_time
    began = clock()
    return floating_point(pump, operating_point(pump), options, side_by_side=beside), clock() - began


def rounds_of(found: FloatingPoint) -> Table:
    """The rounds: changes, films, whether turns close."""
    table = Table(title="rounds")
    for head in ("round", "pressure", "friction", "spin", "turns close", "films"):
        table.add_column(head, justify="right")
    for number, one in enumerate(found.rounds, 1):
        changes = (f"{change:.1e}" for change in (one.pressure_change, one.friction_change, one.spin_change))
        table.add_row(str(number), *changes, "yes" if one.settled else "", str(one.films_solved))
    return table


def gaps_of(found: FloatingPoint) -> Table:
    """The gaps in the last round."""
    table, gaps = Table(title="gaps, last round"), found.kinds[0].gaps
    for head in ("gap", "turns", "steps", "films", "mean film / um", "least film / um"):
        table.add_column(head, justify="right")
    for name in GAPS:
        gap: GapRevolution = getattr(gaps, name)
        numbers = (gap.closing.turns, len(gap.turn.times), gap.films_solved)
        films = (f"{1e6 * film:.4f}" for film in (gap.mean_film, gap.least_film.film_thickness_min))
        table.add_row(name, *map(str, numbers), *films)
    return table


def main() -> None:
    """Time a point and print it."""
    one_thread()
    parser = argparse.ArgumentParser(description="Time one floating point.")
    parser.add_argument("--rigid", action="store_true", help="rigid walls, oil that neither pressure nor heat changes")
    parser.add_argument(
        "--beside", action="store_true", help="gaps in processes, as many as cores; time from start to end"
    )
    parser.add_argument("--speed", default="2100 rpm")
    parser.add_argument("--pressure", default="35 MPa")
    parser.add_argument("--displacement", type=float, default=1.0, help="of the full one")
    parser.add_argument("--steps", type=int, default=360, help="reported angles a turn")
    asked, console = parser.parse_args(), Console()
    given = {"speed": asked.speed, "pressure": asked.pressure, "displacement_ratio": asked.displacement}
    changes = {f"operating.{key}": value for key, value in given.items()}
    found, seconds = timed(changes, asked.steps, rigid=asked.rigid, beside=asked.beside)
    point = found.pump_point
    leakage = 6e4 * point.leakage_flow.total
    console.print(rounds_of(found), gaps_of(found))
    clock = "from start to end" if asked.beside else "of one processor"
    console.print(
        f"{seconds:.1f} s {clock}; leakage {leakage:.4f} L/min, friction {point.power.friction:.1f} W, "
        f"energy not balanced {point.checks.energy_balance_error:.1e}"
    )


if __name__ == "__main__":
    main()
