"""Table 1: the simulated pump against the values in the paper's text."""

from system.paper.figure import Figure
from system.paper.judge import FigureResult, Range, judge
from system.paper.points import FULL, PRESSURES, RATED, LossReading, PaperFidelity, PaperPoints
from system.paper.statements import CLAIMS
from system.pump.laws.friction_pairs import Pair
from system.pump.laws.kinematics import displacement, stroke
from system.pump.lumped import block_spring, full_drive, piston_area

_PAIRS = {pair.value: pair for pair in Pair}


def table1(points: PaperPoints) -> FigureResult:
    """Rated values, films and start coefficients of the pump with those in the text."""
    pump = points.pump
    friction = pump.friction
    found = {
        "displacement": displacement(pump.pump.pistons, piston_area(pump), float(stroke(full_drive(pump)))),
        "pressure": pump.pump.rated_pressure,
        "speed": pump.pump.rated_speed,
        "swash_angle": pump.pump.swash_angle_max,
        "spring": block_spring(pump),
        **_films(points),
        "bearings": friction.front_bearing,
    }
    found |= {pair.value: getattr(friction, pair.value) for pair in Pair if f"table1.{pair.value}" in CLAIMS}
    judged = tuple(
        judge(
            CLAIMS[f"table1.{name}"],
            Range(float(value), float(value)),
            reason=_holding_shear(points, _PAIRS[name]) if name in _PAIRS else "",
        )
        for name, value in found.items()
    )
    remark = "The table is lost. Every number that the text does not state is an assumption of the pump file."
    return FigureResult(Figure.TABLE1, (), judged, (remark,))


def _films(points: PaperPoints) -> dict[str, float]:
    """Mean films (m) of piston and valve plate: as the pump states them, or as rated floating films have them."""
    if points.fidelity is PaperFidelity.FLOATING:
        films = points.at(RATED, PRESSURES[-1], FULL).films
        assert films is not None
        return {"piston_film": films["piston"]["mean"], "plate_film": films["valve_plate"]["mean"]}
    return {"piston_film": points.pump.piston.radial_clearance, "plate_film": points.pump.valve_plate.film_thickness}


def _holding_shear(points: PaperPoints, pair: Pair) -> str:
    """A pair's coefficient with the film's shear in it, as in the paper."""
    text = "the paper's value is a start value for its fit"
    ends = [points.at(RATED, pressure, FULL) for pressure in (PRESSURES[-1], PRESSURES[0])]
    mixed, alone = (
        [one.loss(pair, reading) for one in ends] for reading in (LossReading.WITH_SHEAR, LossReading.MIXED)
    )
    if mixed == alone:
        return text
    if points.fidelity is PaperFidelity.FLOATING:
        return f"{text}. Floating films have no coefficient: oil is sheared, and asperities rub where they touch"
    stated = getattr(points.pump.friction, pair.value)
    held = [stated * both / own for both, own in zip(mixed, alone, strict=True)]
    return (
        f"{text}. Here the film's shear is separate; a coefficient that includes it is {held[0]:.4f} at 35 MPa and "
        f"{held[1]:.4f} at 5 MPa, rated speed and full displacement"
    )
