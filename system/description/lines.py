"""[delivery_line] and [suction_line] of the pump description, and the lines of `system.pump.ports.lines` that
they mean.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

from system.inputs.faults import Fault
from system.inputs.sections.fields import Area, ImpedanceRows, Pressure, Volume, fields_of
from system.inputs.units import Dimension, format_quantity


class LineKind(Enum):
    """Line on a port: a held pressure, a volume before an orifice, or a line of given impedance."""

    HELD = "held"
    ORIFICE = "orifice"
    IMPEDANCE = "impedance"


@dataclass(frozen=True, kw_only=True)
class LineSection:
    """[delivery_line], [suction_line]: from the port on."""

    kind: LineKind | None = None
    volume: Volume | None = None
    orifice_area: Area | None = None
    tank_pressure: Pressure | None = None
    impedance: ImpedanceRows | None = None


_KEYS = {
    None: (),
    LineKind.HELD: (),
    LineKind.ORIFICE: ("volume", "orifice_area", "tank_pressure"),
    LineKind.IMPEDANCE: ("volume", "impedance"),
}
"""The keys that belong to a kind."""


def line_faults(path: str, stated: LineSection) -> Iterator[Fault]:
    """Yield keys that a line's kind lacks or does not read, and rows that are no impedance."""
    kind = stated.kind
    for key in fields_of(LineSection):
        if key != "kind" and key not in _KEYS[kind] and getattr(stated, key) is not None:
            fits = " or ".join(f"'{one.value}'" for one, keys in _KEYS.items() if one is not None and key in keys)
            found = "without a kind" if kind is None else f"beside kind = '{kind.value}'"
            yield Fault(f"{path}.{key}", found, f"no {key}, or kind = {fits}")
    if kind is LineKind.ORIFICE and stated.volume is None:
        yield Fault(f"{path}.volume", "missing", "the volume between pump and orifice, such as '1 L'")
    if kind is LineKind.IMPEDANCE and stated.impedance is None:
        yield Fault(f"{path}.impedance", "missing", "rows of frequency, real, imaginary, or a CSV file of them")
    rows = (stated.impedance or ()) if kind is LineKind.IMPEDANCE else ()
    frequency = [0.0, *(row[0] for row in rows)]
    for before, after in pairwise(frequency):
        if before >= after:
            found = f"{_frequency(after)} after {_frequency(before)}"
            yield Fault(f"{path}.impedance", found, "frequencies that rise from above zero")
    for at, real, imaginary in rows:
        if real == imaginary == 0.0:
            yield Fault(f"{path}.impedance", f"0 at {_frequency(at)}", "an impedance other than zero")


def ripple_faults(path: str, stated: LineSection, lowest: float, highest: float) -> Iterator[Fault]:
    """Yield the frequencies (Hz) of the pump's ripple that an impedance does not reach."""
    if stated.kind is not LineKind.IMPEDANCE or not stated.impedance:
        return
    first, last = stated.impedance[0][0], stated.impedance[-1][0]
    if first > lowest or last < highest:
        found = f"frequencies from {_frequency(first)} to {_frequency(last)}"
        wanted = f"{_frequency(lowest)} or less to {_frequency(highest)} or more, the harmonics of the ripple"
        yield Fault(f"{path}.impedance", found, wanted, "a table of more frequencies, or another speed")


def _frequency(value: float) -> str:
    return format_quantity(value, Dimension.FREQUENCY, digits=4)
