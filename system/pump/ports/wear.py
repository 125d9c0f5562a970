"""Ports whose grooves and kidneys differ from the drawing: by their cut, and by wear."""

from dataclasses import dataclass, replace
from typing import Generic

from system.pump.laws.kinematics import Number
from system.pump.ports.areas import PortOpening


@dataclass(frozen=True)
class PortWear(Generic[Number]):
    """Difference of both ports from the drawing; PortWear[Array]: at N operating points, arrays (N,).

    groove_advance in rad: earlier begin of the relief grooves ahead of the kidneys; groove_area: factor on their
    throats; suction_area: factor on the suction kidney.
    """

    groove_advance: Number
    groove_area: Number
    suction_area: Number


AS_DRAWN: PortWear[float] = PortWear(0.0, 1.0, 1.0)


def worn_ports(suction: PortOpening, delivery: PortOpening, wear: PortWear[float]) -> tuple[PortOpening, PortOpening]:
    """Suction and delivery port with their wear."""
    kidney = suction.kidney_area * wear.suction_area
    return replace(eroded(suction, wear), kidney_area=kidney), eroded(delivery, wear)


def eroded(port: PortOpening, wear: PortWear[float]) -> PortOpening:
    """A port whose grooves ahead of the kidney begin sooner, with wider throats."""
    grooves = tuple(
        replace(groove, begins=groove.begins - wear.groove_advance, area=groove.area * wear.groove_area)
        if groove.begins < groove.deep
        else groove
        for groove in port.grooves
    )
    return replace(port, grooves=grooves)
