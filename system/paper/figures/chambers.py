"""Figs. 10 and 11: areas of the ports over a turn, and the resulting chamber pressure."""

from math import pi

import numpy as np

from system.description.pump import PumpDescription
from system.inputs.shown import pressure_text
from system.inputs.units import TURN
from system.paper.figure import Curve, Figure, FigureAxis, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Judged, Range, judge
from system.paper.points import FULL, PRESSURES, RATED, PaperPoint, PaperPoints
from system.paper.statements import CLAIMS
from system.pump.lumped import port_openings
from system.pump.ports.areas import PortOpening, break_angles, opening_area

ANGLES = np.linspace(0.0, TURN, 1441)
BEFORE, AFTER = pi - pi / 6.0, pi + 5.0 * pi / 18.0
"""The pre-relief transition (rad): 30 deg before the outer dead centre, where delivery begins, to 50 after."""
_ANGLE = FigureAxis("shaft angle from inner dead centre", Unit.ANGLE)


def fig10(points: PaperPoints) -> FigureResult:
    """Area of both ports over a turn, its sections, and the effect of the relief groove on the pressure."""
    pump = points.pump
    suction, delivery = port_openings(pump)
    curves = tuple(
        Curve(name, ANGLES, opening_area(port, ANGLES)) for name, port in (("suction", suction), ("delivery", delivery))
    )
    area = FigureAxis("area", Unit.AREA)
    panels = (
        Panel("Flow area of the ports", PanelKind.LINES, _ANGLE, area, curves),
        Panel("Relief groove of the delivery", PanelKind.LINES, _ANGLE, area, (_groove(delivery),)),
    )
    count = float(sections(suction) + sections(delivery))
    rise = groove_share(pump, points.at(RATED, PRESSURES[-1], FULL))
    judged = (judge(CLAIMS["fig10.sections"], Range(count, count)), judge(CLAIMS["fig10.groove"], Range(rise, rise)))
    return FigureResult(Figure.FIG10, panels, judged, ("The areas are geometry, the same in every fidelity.",))


def _groove(port: PortOpening) -> Curve:
    """The port's area until its kidney has begun to open."""
    length = port.kidney_start - port.opens
    angles = port.dead_centre + np.linspace(port.opens - 0.5 * length, port.kidney_start + 0.1 * length, 161)
    return Curve("delivery", angles, opening_area(port, angles))


def sections(port: PortOpening) -> int:
    """Number of sections of the area of an open port over a turn."""
    breaks = break_angles(port)
    middles = breaks + 0.5 * np.diff(breaks, append=breaks[0] + TURN)
    return int(np.sum(opening_area(port, middles) > 0.0))


def groove_share(pump: PumpDescription, point: PaperPoint) -> float:
    """Part of a chamber's rise from inlet to delivery pressure made while the delivery's groove alone is open."""
    _, delivery = port_openings(pump)
    ends = delivery.dead_centre + np.array([delivery.opens, delivery.kidney_start])
    angle, pressure = np.array(point.shaft_angle), np.array(point.chamber_pressure)
    at = np.interp(ends, angle, pressure)
    return float((at[1] - at[0]) / (point.bench.delivery_pressure - point.bench.inlet_pressure))


def fig11(points: PaperPoints) -> FigureResult:
    """Chamber pressure over a turn at the ends of the pressure range, rated speed and full displacement."""
    low, high = (points.at(RATED, p, FULL) for p in (PRESSURES[0], PRESSURES[-1]))
    rated = points.pump.pump.rated_pressure
    curves = tuple(
        Curve(pressure_text(one.bench.delivery_pressure), np.array(one.shaft_angle), np.array(one.chamber_pressure))
        for one in (low, high)
    )  # fmt: skip
    panels = (
        Panel("Chamber pressure over a turn", PanelKind.LINES, _ANGLE,
              FigureAxis("pressure", Unit.PRESSURE), curves),
        Panel("Pre-relief transition", PanelKind.LINES, _ANGLE,
              FigureAxis("pressure over delivery pressure", Unit.SHARE), tuple(map(_transition, (low, high)))),
    )  # fmt: skip
    judged = (_impact("fig11.small", low, rated), _impact("fig11.none", high, rated))
    return FigureResult(Figure.FIG11, panels, judged, tuple(_trapped(one) for one in (low, high)))


def _transition(point: PaperPoint) -> Curve:
    """Chamber pressure over the delivery pressure where delivery begins."""
    angle, pressure = np.array(point.shaft_angle), np.array(point.chamber_pressure)
    inside, delivery = (angle >= BEFORE) & (angle <= AFTER), point.bench.delivery_pressure
    return Curve(pressure_text(delivery), angle[inside], pressure[inside] / delivery)


def _impact(claim: str, point: PaperPoint, rated: float) -> Judged:
    angle, pressure = np.array(point.shaft_angle), np.array(point.chamber_pressure)
    inside = (angle >= BEFORE) & (angle <= AFTER)
    at = int(np.argmax(np.where(inside, pressure, -np.inf)))
    over = float(pressure[at] - point.bench.delivery_pressure)
    reason = (
        f"peak {pressure_text(pressure[at], 4)} at {np.degrees(angle[at]):.0f} deg, "
        f"{100.0 * over / point.bench.delivery_pressure:.1f} % above the delivery pressure"
    )
    return judge(CLAIMS[claim], Range(over / rated, over / rated), reason=reason)


def _trapped(point: PaperPoint) -> str:
    angle, pressure = np.array(point.shaft_angle), point.chamber_pressure
    at = int(np.argmax(pressure))
    return (
        f"Outside the statement's region the chamber peaks at {pressure_text(pressure[at])} at "
        f"{np.degrees(angle[at]):.0f} deg, with {pressure_text(point.bench.delivery_pressure)} at the "
        "port. The end of the kidneys and the start of the grooves in the pump file cause it."
    )
