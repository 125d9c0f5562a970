"""Table 1: the simulated pump against what the paper's text states of its own."""

from __future__ import annotations

from system.kinematics import displacement, stroke
from system.lumped import block_spring, full_drive, piston_area
from system.pairs import Pair
from system.paper.figures import Figure
from system.paper.judge import FigureResult, Range, judge
from system.paper.points import PaperPoints
from system.paper.statements import CLAIMS

_PAIRS = {pair.value for pair in Pair}
_COEFFICIENT = "a start value in the paper, to be tuned; here the films' shear is counted beside it"


def table1(points: PaperPoints) -> FigureResult:
    """Rated values, films and start coefficients of the pump beside those in the text."""
    pump = points.pump
    friction = pump.friction
    found = {
        "displacement": displacement(pump.pump.pistons, piston_area(pump), float(stroke(full_drive(pump)))),
        "pressure": pump.pump.rated_pressure,
        "speed": pump.pump.rated_speed,
        "swash_angle": pump.pump.swash_angle_max,
        "spring": block_spring(pump),
        "piston_film": pump.piston.radial_clearance,
        "plate_film": pump.valve_plate.film_thickness,
        "bearings": friction.front_bearing,
    }
    found |= {pair.value: getattr(friction, pair.value) for pair in Pair if f"table1.{pair.value}" in CLAIMS}
    judged = tuple(
        judge(
            CLAIMS[f"table1.{name}"],
            Range(float(value), float(value)),
            reason=_COEFFICIENT if name in _PAIRS else "",
        )
        for name, value in found.items()
    )
    remark = (
        "The table itself is lost: every number that its text does not state is an assumption of the pump file."
    )
    return FigureResult(Figure.TABLE1, (), judged, (remark,))
