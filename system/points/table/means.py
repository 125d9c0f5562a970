"""Entries of a response table for one solved point: the gaps' means over the turn, as ratios to the lumped law.

The lumped law contains pressure, speed and viscosity already; the ratio is of order one and smooth. Ratios are computed
at the solved point's own chamber pressure, so that they describe the gap alone.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gaps.response import Measure, Output
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.pump.assembly import PumpPoint
from system.pump.chamber.problem import LeakTable
from system.pump.chamber.setup import periodic_values
from system.pump.chamber.turn import Gaps
from system.pump.film_thickness import given_film
from system.pump.laws.friction_pairs import Pair
from system.pump.laws.kinematics import Number
from system.pump.lumped import lumped_leaks, lumped_pairs, piston_motion
from system.pump.operating import OperatingPoint, flat

TABLE_FORMAT = 4
"""Raised when solved points give other numbers in a table: by the kept numbers, or by their laws."""
OLDEST_TABLE = 4
"""No release wrote earlier formats."""
GAP_PAIRS = {
    "piston": Pair.PISTON_CYLINDER,
    "slipper": Pair.SLIPPER_SWASH_PLATE,
    "valve_plate": Pair.VALVE_PLATE_CYLINDER,
}
OF_EVERY_GAP = {
    "leakage": "mean flow out of the chambers into the gap, without the drag flow / by the lumped law",
    "carried": "drag power of the walls / by the lumped law; of slipper and plate / its leakage power",
    "friction": "mean loss of the pair, less the drag power / by the lumped law",
    "contact_share": "loss of contact (Coulomb friction) / loss of the pair",
    "film_mean": "mean film over area and turn / the film given by the description",
    "film_least": "least film anywhere in the turn / the film given by the description",
    "film_rise": "hottest oil of the film in the turn, above the temperature of the case / 100 K",
}
OF_ONE_PART = {
    "socket.friction": "mean loss of the ball joints / by the lumped law",
    "valve_plate.delivery_draw": "what the film takes from the delivery port / plate flow",
    "valve_plate.suction_draw": "what the film takes from the suction port / plate flow",
}
"""Plate flow: the lumped law's with half of the chambers at delivery pressure, `plate_flow`."""
MEANINGS = {f"{gap}.{name}": text for gap in GAP_PAIRS for name, text in OF_EVERY_GAP.items()} | OF_ONE_PART
"""Outputs by name with their meanings, in the order of `mean_ratios`."""
OF_ORDER_ONE = ("leakage", "friction", "film_mean", "film_least")
"""Learnt by logarithm, their error relative, where they are positive at all points: a flow may change its sign, so may
the distance of rough walls. The others may be zero; their error is that of the ratio itself."""


BY_DRAG = ("slipper.leakage", "slipper.carried", "valve_plate.carried")
"""Outputs, where a flow may change its sign, of films with drag and pressure flow: over the pressure flow the drag flow
goes as speed times viscosity over pressure. Learnt times the inverse of this, their errors are 1.6 to 9 times smaller
with eight points of two inputs."""
DRAG = (("shaft_speed", -1.0), ("delivery_pressure", 1.0), ("viscosity", -1.0))
FILM_RISE = 100.0
"""K: the scale of temperatures in a table."""


def measured_outputs(values: Array) -> tuple[Output, ...]:
    """The outputs with their measure, given values (n, m) at all points."""
    return tuple(_output(name, column) for name, column in zip(MEANINGS, values.T, strict=True))


def _output(name: str, values: Array) -> Output:
    if name.partition(".")[2] in OF_ORDER_ONE and np.all(values > 0.0):
        return Output(name, Measure.RELATIVE)
    return Output(name, Measure.ABSOLUTE, powers=DRAG if name in BY_DRAG else ())


@dataclass(frozen=True)
class SolvedPoint:
    """A point solved by a costly fidelity, with its films.

    In m: mean over area and turn, least anywhere in the turn; K: the hottest oil in the turn, above the case.
    load_carried: one less the largest load over the turn that the film does not support, of the turn's largest load: at
    a given position any such load, of a floating part that on contact; None where no film was solved.
    """

    pump_point: PumpPoint
    film_mean: Gaps
    film_least: Gaps
    film_rise: Gaps
    load_carried: Gaps | None = None


@dataclass(frozen=True)
class LawMoments:
    """One chamber by the lumped law at a given pressure, means over the turn, of the gaps (3,), or (N, 3) at N points.

    flow: of the pressure flow G (p - p_case), m3/s; drag_flow, one: of the law's drag flow, m3/s (only in the piston's
    gap), and of a flow of 1 m3/s; all three by mass, at case pressure. power: scale of the drag power, W: the oil
    dragged in the piston's gap, the pressure flow in the others, in which the law has no drag; above: p - p_case, Pa.
    """

    flow: Array
    drag_flow: Array
    one: Array
    power: Array
    above: Array


def law_moments(law: LeakTable, pump: PumpDescription, point: OperatingPoint[Number], pressure: Array) -> LawMoments:
    """Moments of the lumped law at a chamber's pressure (M,) Pa at the law's M shaft angles, (N, M) at N points."""
    over = pressure - point.case_pressure
    above, dense = over[..., None, :], np.exp(over / pump.oil.bulk_modulus)[..., None, :]
    power = np.mean(law.conductance * above**2, axis=-1)
    power[..., 0] = np.mean(law.drag_flow[..., 0, :] * over, axis=-1)
    return LawMoments(
        flow=np.mean(law.conductance * above * dense, axis=-1),
        drag_flow=np.mean(law.drag_flow * dense, axis=-1),
        one=np.mean(dense[..., 0, :], axis=-1),
        power=power,
        above=np.mean(over, axis=-1),
    )


def mean_ratios(pump: PumpDescription, solved: SolvedPoint) -> Array:
    """The outputs (m,) of a solved point, in the order of MEANINGS."""
    found, point = solved.pump_point, solved.pump_point.point
    motion = piston_motion(pump, point)
    samples = found.cycle.shaft_angle.size
    above = found.cycle.pressure - point.case_pressure
    moments = law_moments(lumped_leaks(pump, point, motion), pump, point, found.cycle.pressure)
    flow = periodic_values(found.leaks.conductance, samples) * above
    flow = flow + periodic_values(found.leaks.drag_flow, samples)
    flow = np.mean(flow * np.exp(above / pump.oil.bulk_modulus), axis=1)
    drag_ratio = [getattr(found.exchange.drag_power, gap) for gap in GAP_PAIRS] / (found.pistons * moments.power)
    leakage = (flow - drag_ratio * moments.drag_flow) / moments.flow
    by_law = lumped_pairs(pump, point, motion, found.cycle)
    given, scale = given_films(pump), plate_flow(pump, point)
    rows = [
        (
            leakage[k],
            drag_ratio[k],
            # less the power that dragged oil returns: the net load on the shaft
            (found.pairs.loss(pair).mean - float(getattr(found.exchange.drag_power, gap))) / by_law.loss(pair).mean,
            found.pairs.loss(pair).mean_coulomb / found.pairs.loss(pair).mean,
            getattr(solved.film_mean, gap) / getattr(given, gap),
            getattr(solved.film_least, gap) / getattr(given, gap),
            getattr(solved.film_rise, gap) / FILM_RISE,
        )
        for k, (gap, pair) in enumerate(GAP_PAIRS.items())
    ]
    joint = by_law.piston_slipper_socket.mean
    socket = found.pairs.piston_slipper_socket.mean / joint if joint > 0.0 else 1.0  # a coefficient of 0
    draws = (found.exchange.delivery_draw / scale, found.exchange.suction_draw / scale)
    return np.array([*np.ravel(rows), socket, *draws])


def given_films(pump: PumpDescription) -> Gaps:
    """The films (m) that the description gives."""
    return Gaps(*(given_film(pump, gap) for gap in Gap))


def plate_flow(pump: PumpDescription, point: OperatingPoint[Number]) -> Any:
    """Leakage of the valve plate by the lumped law, m3/s or (N,), with half of the chambers at delivery pressure."""
    one, at = lumped_leaks(pump, point, piston_motion(pump, point)).conductance[..., 2, 0], flat(point)
    return 0.5 * pump.pump.pistons * one * (at.delivery_pressure - at.case_pressure)
