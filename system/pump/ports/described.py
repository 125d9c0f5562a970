"""Relief grooves of the pump description: their law, and the faults of stated ones."""

import math
from collections.abc import Iterator
from typing import assert_never

import numpy as np

from system.description.lines import LineKind, LineSection
from system.description.parts import GrooveSection, GrooveShape
from system.description.ports import PortsSection
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity
from system.pump.ports.areas import MOST_GROOVES
from system.pump.ports.lines import HeldPressure, Impedance, ImpedanceLine, Line, OrificeLine
from system.pump.ports.relief_grooves import ReliefGroove, round_groove, v_groove

_KEYS = {GrooveShape.V: ("depth", "angle"), GrooveShape.ROUND: ("depth", "width"), GrooveShape.AREA: ("area",)}
"""The keys that belong to a shape."""


def relief_groove(stated: GrooveSection, kidney_full_end: float, radius: float) -> ReliefGroove:
    """The groove of a table without faults, at a radius (m).

    Ahead of the kidney it sinks from `start` to `end`, behind it (from `kidney_full_end` rad on) it rises.
    """
    ahead = stated.start < kidney_full_end
    begins, deep = (stated.start, stated.end) if ahead else (stated.end, stated.start)
    match stated.shape:
        case GrooveShape.V:
            return v_groove(begins, deep, stated.depth or 0.0, stated.angle or 0.0, radius)
        case GrooveShape.ROUND:
            return round_groove(begins, deep, stated.depth or 0.0, stated.width or 0.0, radius)
        case GrooveShape.AREA:
            return ReliefGroove(begins, deep, stated.area or 0.0)
        case _:
            assert_never(stated.shape)


def groove_faults(ports: PortsSection) -> Iterator[Fault]:
    """Yield the faults of all grooves: two ways of stating one, wrong keys, angles that belong to neither side."""
    own = {"groove_start": ports.groove_start, "groove_area": ports.groove_area}
    missing = [key for key, value in own.items() if value is None]
    if ports.grooves:
        for key in own.keys() - set(missing):
            yield Fault(f"ports.{key}", "beside grooves", "one of the two: grooves, or groove_start and groove_area")
    elif len(missing) == 1:
        yield Fault(f"ports.{missing[0]}", "missing", "groove_start and groove_area together, or neither")
    if len(ports.grooves) > MOST_GROOVES:
        yield Fault("ports.grooves", f"{len(ports.grooves)} grooves", f"at most {MOST_GROOVES} a port")
    for number, groove in enumerate(ports.grooves, start=1):
        yield from _shape_faults(f"ports.grooves.{number}", groove)
        yield from _place_faults(f"ports.grooves.{number}", groove, ports)


def _shape_faults(path: str, groove: GrooveSection) -> Iterator[Fault]:
    named = f"shape = '{groove.shape.value}'"
    for key in ("depth", "angle", "width", "area"):
        wanted, value = key in _KEYS[groove.shape], getattr(groove, key)
        if wanted and value is None:
            yield Fault(f"{path}.{key}", "missing", f"{' and '.join(_KEYS[groove.shape])} beside {named}")
        elif not wanted and value is not None:
            yield Fault(f"{path}.{key}", f"beside {named}", f"{' and '.join(_KEYS[groove.shape])} alone")


def _place_faults(path: str, groove: GrooveSection, ports: PortsSection) -> Iterator[Fault]:
    if groove.end <= groove.start:
        yield Fault(f"{path}.end", _angle(groove.end), f"more than start, {_angle(groove.start)}")
    elif groove.start < ports.kidney_full_end:
        if groove.start >= ports.groove_end or groove.end > ports.kidney_full_start:
            found = f"{_angle(groove.start)} to {_angle(groove.end)}"
            ahead = (
                f"a start before groove_end, {_angle(ports.groove_end)}, and an end by kidney_full_start, "
                f"{_angle(ports.kidney_full_start)}; or, behind the port, a start from kidney_full_end, "
                f"{_angle(ports.kidney_full_end)}, on and an end after {_angle(ports.kidney_end)}"
            )
            yield Fault(path, found, ahead)
    elif groove.end <= ports.kidney_end:
        yield Fault(f"{path}.end", _angle(groove.end), f"more than kidney_end, {_angle(ports.kidney_end)}")


def _angle(value: float) -> str:
    return format_quantity(value, Dimension.ANGLE, digits=4)


def throats(ports: PortsSection, radius: float) -> tuple[float, float]:
    """Throats (m2) of the grooves ahead of the kidney and behind it at their deepest, together."""
    found = [relief_groove(groove, ports.kidney_full_end, radius) for groove in ports.relief_grooves]
    ahead = math.fsum(groove.largest for groove in found if groove.begins < groove.deep)
    return ahead, math.fsum(groove.largest for groove in found) - ahead


def line_of(stated: LineSection, tank_pressure: float) -> Line:
    """Line on a port; `tank_pressure` Pa if not stated. The section has no faults."""
    match stated.kind:
        case None | LineKind.HELD:
            return HeldPressure()
        case LineKind.ORIFICE:
            tank = tank_pressure if stated.tank_pressure is None else stated.tank_pressure
            return OrificeLine(stated.volume or 0.0, tank, stated.orifice_area)
        case LineKind.IMPEDANCE:
            frequency, real, imaginary = np.array(stated.impedance or (), dtype=float).reshape(-1, 3).T
            return ImpedanceLine(stated.volume or 0.0, Impedance(frequency, real + 1j * imaginary))
        case _:
            assert_never(stated.kind)
