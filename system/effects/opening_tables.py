"""Elastic opening by the film solver: leakage and shear of films between elastic walls, learnt once.

A film held at its place between linear elastic walls is opened by C p over its thickness h, at any viscosity. Its
leakage and shear over those between rigid walls are functions of C p/h alone, as long as pressure deforms the
walls and sliding does not. So one table over the pressure, for the pump as described, holds for more compliant
walls and other films too: at the pressure x p h0/h, x the share of the computed compliance. Pressures and walls
have the whole shape of the lands, unlike a closed form.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from gaps.films.physics import Effect
from gaps.response import Axis, Measure, Output, Response
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from system.description.effects import PhysicsSection
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.laws.film import in_one_film
from system.films.cycle import SMOOTH
from system.films.instant import film_numbers
from system.films.parts import floating_parts
from system.films.rotor import rotor
from system.pump.film_thickness import given_film
from system.pump.operating import operating_point
from system.pump_file.file import resolved_toml
from system.work.progress import Report, silent
from system.work.sampled_points import samples_of, solved_points

TABLE_FORMAT = 1
COMPLIANCE = "compliance"
REACH = 1.75
"""Highest pressure of a table, of the pump's rated pressure: walls half as soft again."""
LEARNT, HELD_OUT = 12, 3
FINER = 0.5
"""Of the usual cells each way: both films of a ratio have equal errors."""
ELASTIC = SMOOTH.including(Effect.ELASTIC_WALLS)
VARIED = ("speed", "pressure", "displacement_ratio", "inlet_pressure", "case_pressure")
"""Of [operating]: a film's own values in the table."""
OUTPUTS = (Output("leakage", Measure.RELATIVE), Output("shear", Measure.RELATIVE))
INSTANT = {Gap.PISTON: 1.5 * np.pi, Gap.SLIPPER: 1.5 * np.pi, Gap.VALVE_PLATE: 0.1}
"""Shaft angle of the films: amid the delivery stroke, and of the ring just past a dead centre."""


@dataclass(frozen=True)
class OpeningCase:
    """Response to learn: a gap of a pump at rated speed, over the pressure above the case. A `SamplingTask`.

    The case's own pressure acts on all sides of the parts and deforms none; it is omitted.
    """

    pump: PumpDescription
    gap: Gap
    learnt: int = LEARNT
    held_out: int = HELD_OUT

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Pressure over that of the case, Pa, from zero on."""
        return (Axis("pressure", 0.0, REACH * self.pump.pump.rated_pressure),)

    def key(self, x: Array) -> str:
        """Name of the content of a pressure (1,)."""
        point = replace(self.pump.operating, **dict.fromkeys(VARIED, 0.0))
        bare = replace(self.pump, name="", physics=PhysicsSection(), operating=point)
        files = [content for content in self.pump.file_contents if content]
        return content_key("opening of a film", TABLE_FORMAT, resolved_toml(bare), files, self.gap.value, FINER, x)

    def solve(self, x: Array) -> Array:
        """Leakage and shear (2,) between elastic over those between rigid walls at a pressure (1,)."""
        pressure = float(x[0])
        if pressure == 0.0:
            return np.ones(len(OUTPUTS))
        point = replace(
            operating_point(self.pump), shaft_speed=self.pump.pump.rated_speed, displacement_ratio=1.0,
            delivery_pressure=pressure, inlet_pressure=0.0, case_pressure=0.0,
        )  # fmt: skip
        at, parts = rotor(self.pump, point), floating_parts(self.pump)
        soft, rigid = (
            film_numbers(self.gap, at, parts, INSTANT[self.gap], pressure, physics, FINER)
            for physics in (ELASTIC, SMOOTH)
        )
        return np.array([soft.conductance / rigid.conductance, soft.shear / rigid.shear])


@dataclass(frozen=True)
class OpeningTable:
    """A gap's leakage and shear over the pressure, and the film (m) at which they were learnt."""

    gap: Gap
    film: float
    response: Response

    @property
    def error(self) -> float:
        """Largest relative error of the held-out films."""
        return float(self.response.held_out_error.largest.max())

    def factors(self, pressure: Array) -> tuple[Array, Array]:
        """Leakage and shear over those between rigid walls at pressures (Pa) above the case.

        Below the case's pressure the film does not open; beyond the table's end it keeps the opening there, which only
        the pressure spike of a chamber exceeds.
        """
        (axis,) = self.response.axes
        places = np.clip(pressure, axis.lower, axis.upper)
        found = self.response.at(places.reshape(-1, 1))
        leakage, shear = found.T.reshape(2, *pressure.shape)
        return leakage, shear


def opening_table(pump: PumpDescription, gap: Gap, report: Report = silent) -> OpeningTable:
    """The table of a gap of a pump, its films read by content or solved.

    Raises NotConverged where too few of them have a solution.
    """
    case = OpeningCase(pump, gap)
    learnt, held_out = samples_of(case, solved_points(case, report=report))
    return OpeningTable(gap, given_film(pump, gap), Response(case.axes, OUTPUTS, learnt, held_out))


@dataclass(frozen=True)
class SolvedOpening:
    """The law of a gap's elastic walls: `compliance`, 1 for walls by drawing and material."""

    table: OpeningTable

    def __call__(self, values: Values, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
        """The effects with these values."""
        table, own = self.table, courses[self.table.gap]
        opened = values[COMPLIANCE] * table.film / own.film
        leakage, shear = table.factors(opened * own.pressure)
        if table.gap is Gap.VALVE_PLATE:  # the ring is one, half of it under the delivery's pressure at any angle
            delivery = (state.delivery_pressure - state.case_pressure)[:, None]
            shear = table.factors(opened * delivery)[1]
        return in_one_film(table.gap, courses, state, leakage, shear)
