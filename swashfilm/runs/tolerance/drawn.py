"""Dimensions of a pump that scatter, chosen by a command line, and the faults of the choice."""

from __future__ import annotations

from fnmatch import fnmatchcase

from system.description.drawing import drawing_of
from system.description.drawn import Drawing
from system.description.keys import pump_keys
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, nearest_choice
from system.variation.sampling import part_of
from system.variation.shares import pumps_needed
from system.variation.solving import variable_keys


def chosen_drawing_of(pump: PumpDescription, keys: str | None) -> Drawing:
    """Return the scatter of a pump's dimensions, of those that the words of --keys name; raises as `drawing_of`."""
    drawing = drawing_of(pump)
    return drawing if keys is None else part_of(drawing, _named(drawing, keys))


def drawing_faults(pump: PumpDescription, keys: str | None, pumps: int, *, by_table: bool) -> list[Fault]:
    """Return the faults of a choice: no tolerance, a dimension that a response table holds, too few pumps."""
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
    variable = variable_keys(pump, by_table)
    held = [one.name for one in chosen.members if not set(one.keys) <= set(variable)]
    if held:
        free = [name for name in drawing.names if name in variable]
        found = f"{', '.join(held)}: the films of a response table are those of the pump as stated"
        faults.append(Fault("--table", found, "--fidelity lumped, or dimensions beside the films", _keys_option(free)))
    if pumps < (needed := pumps_needed(len(chosen.names))):
        expected = f"{needed} at least for {len(chosen.names)} dimensions: the shares follow from a quadratic surface"
        faults.append(Fault("--pumps", str(pumps), expected))
    return faults


def _named(drawing: Drawing, keys: str) -> set[str]:
    words = [word.strip() for word in keys.split(",")]
    return {name for name in drawing.names if any(fnmatchcase(name, word) for word in words)}


def _keys_option(names: list[str]) -> str:
    return f"--keys {','.join(names)}" if names else ""
