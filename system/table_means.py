"""What a response table holds of one solved point: the gaps' means over the turn, as ratios to the lumped law.

The lumped law knows pressure, speed and viscosity already; what is left of a solved point is of order one and
smooth. Ratios are taken at the solved point's own chamber pressure, so that they hold the gap and nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gaps.response import Measure, Output
from system.assembly import PumpPoint
from system.chamber_course import periodic_values
from system.description import PumpDescription
from system.kinematics import Array
from system.lumped import lumped_leaks, lumped_pairs, piston_motion
from system.operating import OperatingPoint
from system.pairs import FrictionPairs, Pair
from system.power import Gaps

TABLE_FORMAT = 1
"""Raised when the same solved points give other numbers in a table: by what is held, or by the laws behind it."""
GAP_PAIRS = {
    "piston": Pair.PISTON_CYLINDER,
    "slipper": Pair.SLIPPER_SWASH_PLATE,
    "valve_plate": Pair.VALVE_PLATE_CYLINDER,
}
OF_EVERY_GAP = {
    "leakage": (Measure.RELATIVE, "chambers' mean flow into the gap / the lumped law's at the same pressure"),
    "friction": (Measure.RELATIVE, "mean loss of the pair / the lumped pair's at the same pressure"),
    "contact_share": (Measure.ABSOLUTE, "loss of contact (Coulomb friction) / loss of the pair"),
    "film_mean": (Measure.RELATIVE, "mean film over area and turn / the film given by the description"),
    "film_least": (Measure.ABSOLUTE, "least film anywhere in the turn / the film given by the description"),
}
"""Outputs by name: (measure of the error, what they are). Friction of slipper and plate is net of carried oil."""
OF_ONE_GAP = {
    "piston.carried": (Measure.ABSOLUTE, "power of the oil that the piston carries / the lumped law's"),
    "valve_plate.delivery_draw": (Measure.ABSOLUTE, "what the film takes from the delivery port / plate flow"),
    "valve_plate.suction_draw": (Measure.ABSOLUTE, "what the film takes from the suction port / plate flow"),
}
"""Plate flow: the lumped law's with half of the chambers at delivery pressure, `plate_flow`."""
MEANINGS = {f"{gap}.{name}": row for gap in GAP_PAIRS for name, row in OF_EVERY_GAP.items()} | OF_ONE_GAP
OUTPUTS = tuple(Output(name, measure) for name, (measure, _) in MEANINGS.items())


@dataclass(frozen=True)
class SolvedPoint:
    """A point as a costly fidelity solves it; films in m: mean over area and turn, least anywhere in the turn."""

    pump_point: PumpPoint
    film_mean: Gaps
    film_least: Gaps


def mean_ratios(pump: PumpDescription, solved: SolvedPoint) -> Array:
    """The OUTPUTS (m,) of a solved point."""
    found, point = solved.pump_point, solved.pump_point.point
    motion = piston_motion(pump, point)
    samples = found.cycle.shaft_angle.size
    law = lumped_leaks(pump, point, motion)
    above = found.cycle.pressure - point.case_pressure
    solved_flow = periodic_values(found.leaks.conductance, samples) * above
    solved_flow = solved_flow + periodic_values(found.leaks.carried_flow, samples)
    leakage = np.mean(solved_flow, axis=1) / np.mean(law.conductance * above, axis=1)
    carried_by_law = found.pistons * float(np.mean(law.carried_flow[0] * above))
    friction, contact = _friction(found, lumped_pairs(pump, point, motion, found.cycle))
    given, scale = given_films(pump), plate_flow(pump, point)
    films = [(getattr(solved.film_mean, gap), getattr(solved.film_least, gap)) for gap in GAP_PAIRS]
    rows = [
        (leakage[k], friction[k], contact[k], mean / getattr(given, gap), least / getattr(given, gap))
        for k, (gap, (mean, least)) in enumerate(zip(GAP_PAIRS, films, strict=True))
    ]
    draws = (found.exchange.delivery_draw / scale, found.exchange.suction_draw / scale)
    return np.array([*np.ravel(rows), found.exchange.carried.piston / carried_by_law, *draws])


def given_films(pump: PumpDescription) -> Gaps:
    """The films that the description gives, m: the piston's radial clearance, the others' film thickness."""
    return Gaps(pump.piston.radial_clearance, pump.slipper.film_thickness, pump.valve_plate.film_thickness)


def plate_flow(pump: PumpDescription, point: OperatingPoint) -> float:
    """Leakage of the valve plate by the lumped law, m3/s, were half of the chambers at delivery pressure."""
    one = float(lumped_leaks(pump, point, piston_motion(pump, point)).conductance[2, 0])
    return 0.5 * pump.pump.pistons * one * (point.delivery_pressure - point.case_pressure)


def net_loss(point: PumpPoint, gap: str) -> float:
    """Loss of a gap's pair, W, of slipper and plate less what carried oil gives back: what the shaft feels.

    The piston's carried oil stands apart, as in the lumped law; the others' is a thousandth of their friction.
    """
    loss = point.pairs.loss(GAP_PAIRS[gap]).mean
    return loss if gap == "piston" else loss - float(getattr(point.exchange.carried, gap))


def _friction(found: PumpPoint, by_law: FrictionPairs) -> tuple[list[float], list[float]]:
    """Of each gap the ratio to the lumped pair, and the share of contact."""
    net = [net_loss(found, gap) for gap in GAP_PAIRS]
    ratio = [one / by_law.loss(pair).mean for one, pair in zip(net, GAP_PAIRS.values(), strict=True)]
    contact = [
        found.pairs.loss(pair).mean_coulomb / one for one, pair in zip(net, GAP_PAIRS.values(), strict=True)
    ]
    return ratio, contact
