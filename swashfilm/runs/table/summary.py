"""Summary of a pump's point by a response table: its origin, the films of the gaps, and its error."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from swashfilm.console.fidelity import Fidelity
from system.description.pump import PumpDescription
from system.films.parts import floating_parts
from system.points.table.means import GAP_PAIRS
from system.points.table.point import TablePoint, table_point
from system.points.table.response_table import LARGE_ERROR, ResponseTable, axis_value, axis_words
from system.points.table.sources import Source, fidelity_words
from system.points.table.store import find_table, own_table
from system.pump.operating import OperatingPoint

TABLE_POINT_HEAD = ("", "mean film", "least film", "share of contact", "largest error at held-out points")


def point_by_table(pump: PumpDescription, point: OperatingPoint, path: Path | None) -> TablePoint:
    """Return the point by the table of `table_of`."""
    return table_point(pump, point, table_of(pump, point, path))


def table_of(pump: PumpDescription, point: OperatingPoint, path: Path | None) -> ResponseTable:
    """Return the table of a file, or the stored one that fits best; raise InputFaults without one."""
    return own_table(path, pump) if path else find_table(pump, point)


def table_point_summary(pump: PumpDescription, found: TablePoint) -> dict[str, Any]:
    """Return fidelity, origin of the table with the error of each output, films of the gaps, and assumptions."""
    origin, response = found.table.origin, found.table.response
    error = response.held_out_error
    return {
        "fidelity": Fidelity.TABLE.value,
        "assumptions": [str(one) for one in floating_parts(pump).taken],
        "table": {
            "source": origin.source.value,
            "stated": dict(origin.stated),
            "points": {"learnt": len(response.learnt.points), "held_out": len(response.held_out.points)},
            "held_out_rms_error": {one.name: float(error.rms[k]) for k, one in enumerate(response.outputs)},
            "held_out_largest_error": {one.name: float(error.largest[k]) for k, one in enumerate(response.outputs)},
            "numbers_largest_error": _numbers_largest(found),
            "film_thickness_mean_m": asdict(found.film_mean),
            "film_thickness_min_m": asdict(found.film_least),
            "contact_share": asdict(found.contact_share),
        },
    }


def table_point_warnings(pump: PumpDescription, found: TablePoint) -> Iterator[str]:
    """Yield warnings of outputs with errors above LARGE_ERROR, and of a failed point next to this one."""
    response, point = found.table.response, found.pump_point.point
    largest = response.held_out_error.largest
    errors = {output.name: float(largest[k]) for k, output in enumerate(response.outputs)}
    missed = _numbers_largest(found) | errors
    off = [f"{name} by up to {error:.2g}" for name, error in missed.items() if error > LARGE_ERROR]
    if off:
        yield (
            f"table_error: errors at held-out points exceed {LARGE_ERROR:g}: {', '.join(off)}; solve the "
            f"point by the {found.table.origin.source.value} fidelity to be sure"
        )
    failed = found.table.beside_failed(pump, point)
    if failed:
        at = zip(response.axes, failed.at, strict=True)
        place = ", ".join(f"{axis_words(axis.name)} {axis_value(axis.name, value)}" for axis, value in at)
        yield f"table_guesses: the nearest point of the table has no result ({place}: {failed.reason})"


def _numbers_largest(found: TablePoint) -> dict[str, float]:
    """Return the largest error of runs by the table at its held-out points, by number."""
    numbers = found.table.numbers
    return {} if numbers is None else numbers.largest()


def source_words(summary: Mapping[str, Any]) -> str:
    """Return the fidelity that the table of a point condenses, with the film physics that it leaves out."""
    return fidelity_words(Source(summary["table"]["source"]), summary["table"]["stated"])


def table_point_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (gap, mean film, least film, share of contact in its friction, largest error at held-out points)."""
    table = summary["table"]
    for gap in GAP_PAIRS:
        errors = table["numbers_largest_error"]
        yield (
            gap.replace("_", " "),
            f"{table['film_thickness_mean_m'][gap] * 1e6:.2f} um",
            f"{table['film_thickness_min_m'][gap] * 1e6:.2f} um",
            f"{table['contact_share'][gap]:.1%}",
            f"leakage {errors[f'{gap}.leakage_flow']:.2%}, loss {errors[f'{gap}.loss']:.2%}",
        )
