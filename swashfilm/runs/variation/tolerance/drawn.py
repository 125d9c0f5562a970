"""Dimensions of a pump that scatter, chosen by a command line, and the faults of the choice."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatchcase
from math import ceil

import numpy as np

from system.description.drawing import drawing_of
from system.description.drawn import Drawing
from system.description.keys import PumpKey, pump_keys
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, nearest_choice
from system.points.table.response_table import ResponseTable
from system.pump_file.file import Variant
from system.variation.admitted import MOST_REFUSED, TRIED, trial
from system.variation.sampling import drawn_series, part_of
from system.variation.scatter import FEWEST
from system.variation.shares import pumps_needed
from system.variation.solving import variable_keys

REASONS = 3
"""Reasons of refused pumps that are told."""


def chosen_drawing_of(pump: PumpDescription, keys: str | None) -> Drawing:
    """Return the scatter of a pump's dimensions, of those that the words of --keys name; raises as `drawing_of`."""
    drawing = drawing_of(pump)
    return drawing if keys is None else part_of(drawing, _named(drawing, keys))


def drawing_faults(
    pump: PumpDescription, table: ResponseTable | None, keys: str | None, pumps: int, seed: int
) -> list[Fault]:
    """Return the faults of a choice: no tolerance, a dimension that a response table holds, pumps beyond its box, too
    few pumps, too many that the geometry refuses."""
    drawing, stated = drawing_of(pump), pump_keys(pump)
    if not drawing.names:
        expected = "[[tolerance.dimension]] or a sigma, such as film_thickness = 0.08"
        return [Fault("tolerance", "no dimension that scatters", expected)]
    faults = []
    for word in [] if keys is None else keys.split(","):
        path = word.strip()
        named = any(fnmatchcase(one, path) for one in stated)
        if named and not any(fnmatchcase(one, path) for one in drawing.names):
            near = nearest_choice(path, drawing.names)
            faults.append(Fault("--keys", f"'{path}', without a tolerance", "a dimension of [tolerance]", near))
    chosen = chosen_drawing_of(pump, keys)
    variable = variable_keys(pump, table)
    held = [one.name for one in chosen.members if not set(one.keys) <= set(variable)]
    if held:
        free = [name for name in drawing.names if name in variable]
        found = f"{', '.join(held)}: the films of this response table have no axis of these dimensions"
        asked = " ".join(f"--vary {name}" for name in held)
        expected = f"a table with them (swashfilm table {asked}), other dimensions, or --fidelity lumped"
        faults.append(Fault("--table", found, expected, _keys_option(free)))
    elif table is not None:
        faults += _beyond_box(table, drawn_series(chosen, pumps, seed).variants(pump), stated)
    if pumps < (needed := pumps_needed(len(chosen.names))):
        faults.append(Fault("--pumps", str(pumps), _enough(needed, chosen), str(needed)))
    elif chosen.names:
        faults += _refused(pump, chosen, pumps, seed)
    return faults


def _refused(pump: PumpDescription, chosen: Drawing, pumps: int, seed: int) -> Iterator[Fault]:
    """Yield the fault of a series of which the geometry refuses so many pumps that the others are no sample of it, or
    too few."""
    found = trial(pump, list(drawn_series(chosen, min(pumps, TRIED), seed).variants(pump)))
    if not found.refused:
        return
    told = f"{sum(found.refused.values())} of {found.tried} pumps drawn are refused by the geometry"
    needed = ceil(max(FEWEST, pumps_needed(len(chosen.names))) / (1.0 - found.share)) if found.share < 1.0 else 0
    if found.share > MOST_REFUSED:
        expected = f"{100.0 * MOST_REFUSED:g} % at most: the others are no sample of the series"
        first = next(iter(found.refused)).partition(":")[0]
        yield Fault("tolerance", f"{told}, {by_reason(found.refused)}", expected, f"a narrower tolerance of {first}")
    elif pumps < needed:
        yield Fault("--pumps", f"{pumps}; {told}", _enough(needed, chosen), str(needed))


def _enough(needed: int, chosen: Drawing) -> str:
    return f"{needed} at least for {len(chosen.names)} dimensions: the shares follow from a quadratic surface"


def by_reason(refused: Mapping[str, int]) -> str:
    """Return how many pumps have each of the commonest reasons, and how many another one."""
    shown = [
        f"{count} by {reason.rstrip('.').replace(': ', ', such as ', 1)}"
        for reason, count in [*refused.items()][:REASONS]
    ]
    others = sum(refused.values()) - sum([*refused.values()][:REASONS])
    return ", ".join([*shown, *([f"{others} by others"] if others else [])])


def _beyond_box(table: ResponseTable, variants: Iterable[Variant], known: Mapping[str, PumpKey]) -> Iterator[Fault]:
    """Yield the fault of each dimension of which drawn pumps lie beyond the table's box."""
    drawn = [dict(variant) for variant in variants]
    for axis in table.response.axes:
        if axis.name not in drawn[0]:
            continue
        values, shown = np.array([one[axis.name] for one in drawn]), known[axis.name].shown
        beyond = int(np.sum((values < axis.lower) | (values > axis.upper)))
        if beyond:
            found = (
                f"{beyond} of {len(values)} pumps beyond the table's box, {shown(axis.lower)} .. {shown(axis.upper)}"
            )
            expected = f"a table over {shown(values.min())} .. {shown(values.max())}"
            yield Fault(axis.name, found, expected, f"swashfilm table --vary {axis.name}")


def _named(drawing: Drawing, keys: str) -> set[str]:
    words = [word.strip() for word in keys.split(",")]
    return {name for name in drawing.names if any(fnmatchcase(name, word) for word in words)}


def _keys_option(names: list[str]) -> str:
    return f"--keys {','.join(names)}" if names else ""
