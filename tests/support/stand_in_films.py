"""A stand-in for solved films: the lumped law with films that thin under load, which takes milliseconds."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

from reynolds import FilmNotConverged
from system import lumped_point
from system.points.table.means import SolvedPoint
from system.points.table.sources import Source
from system.pump.chamber.turn import Gaps


@dataclass(frozen=True)
class ThinningFilms:
    """Films of (Hersey number)^exponent times the given ones; `broken`: none converges at high pressure.

    opening: share by which all films open at 35 MPa.
    """

    exponent: float = 0.1
    broken: bool = False
    opening: float = 0.0
    source = Source.FIXED

    @property
    def stated(self):
        physics = f"thinning films, {self.exponent}, open by {self.opening}"
        return {"physics": physics, "mesh": "none", "accuracy": "that of lumped"}

    def row(self):
        return self

    def solve(self, pump, point):
        if self.broken and point.delivery_pressure > 35e6:
            raise FilmNotConverged("made to fail", "nothing")
        hersey = point.viscosity / 0.03 * point.shaft_speed / 220.0 * 35e6 / point.delivery_pressure
        opened = 1.0 + self.opening * point.delivery_pressure / 35e6
        thin = opened * hersey**self.exponent
        clearance = opened * pump.piston.radial_clearance
        films = {
            "piston": replace(pump.piston, radial_clearance=clearance),
            "slipper": replace(pump.slipper, film_thickness=thin * pump.slipper.film_thickness),
            "valve_plate": replace(pump.valve_plate, film_thickness=thin * pump.valve_plate.film_thickness),
        }
        found = lumped_point(replace(pump, **films), point)
        mean = Gaps(clearance, films["slipper"].film_thickness, films["valve_plate"].film_thickness)
        least = Gaps(*(0.5 * value for value in asdict(mean).values()))
        return SolvedPoint(found, mean, least, Gaps(40.0 / thin, 20.0 / thin, 30.0 / thin), Gaps(1.0, 1.0, 1.0))
