"""One point of an operating map: its solver, the key of its content, and its kept numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import astuple, dataclass, replace
from enum import Enum
from functools import cached_property
from importlib.metadata import version
from operator import attrgetter
from typing import Protocol

import numpy as np

from reynolds.numerics.cache import content_key
from system.description.parts import MaterialsSection, SurfacesSection
from system.description.pump import PumpDescription
from system.description.tolerance import ToleranceSection
from system.maps.plan import LUMPED_SECONDS
from system.points.lumped import lumped_point
from system.points.table.means import SolvedPoint, given_films
from system.points.table.point import table_point
from system.points.table.response_table import ResponseTable
from system.points.table.sources import PointSolver, fidelity_words
from system.points.table.store import table_name
from system.pump.chamber.turn import Gaps
from system.pump.laws.friction_pairs import Pair
from system.pump.operating import OperatingPoint
from system.pump_file.file import resolved_toml

MAP_FORMAT = 2
"""Raised when the same point gives other numbers: by its laws, or by the kept numbers."""
GAPS = ("piston", "slipper", "valve_plate")
KEY_LENGTH = 24


class MapSolver(Protocol):
    """Solver of the points of a map: frozen data that can be sent to another process.

    words: its name for people; stated: all inputs of the numbers besides pump and point; cost: seconds of
    processor time per point, about; reads: the part of a pump that the numbers depend on.
    """

    @property
    def words(self) -> str:
        """Name of the solver for people."""

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of the numbers besides pump and point."""

    @property
    def cost(self) -> float:
        """Seconds a point."""

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """The pump without tables that are not read here."""

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point; raises as the fidelity."""

    def row(self) -> MapSolver:
        """The solver of points that follow each other in one process."""


@dataclass(frozen=True)
class LumpedSolver:
    """`lumped_point`: films of given thickness."""

    words = "lumped"
    cost = LUMPED_SECONDS

    @property
    def stated(self) -> Mapping[str, str]:
        """No inputs besides pump and point."""
        return {"fidelity": "lumped: films of given thickness"}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """Without materials and surfaces, where no effect of [physics] needs them."""
        if pump.physics.on:
            return pump
        return replace(pump, materials=MaterialsSection(), surfaces=SurfacesSection())

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point, films as given."""
        given = given_films(pump)
        return SolvedPoint(lumped_point(pump, point), given, given, Gaps(0.0, 0.0, 0.0))

    def row(self) -> LumpedSolver:
        """The same."""
        return self


@dataclass(frozen=True)
class TableSolver:
    """`table_point` by one response table."""

    table: ResponseTable
    cost = 0.02

    @property
    def words(self) -> str:
        """The fidelity that the table condenses, with the physics that it leaves out."""
        return f"{fidelity_words(self.table.origin.source, self.table.origin.stated)}, by response table"

    @property
    def stated(self) -> Mapping[str, str]:
        """The table's whole record, by content."""
        origin = self.table.origin
        return {
            "fidelity": f"{origin.source.value}, by response table",
            "table": table_name(self.table),
            **origin.stated,
        }

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """All of it."""
        return pump

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point, with the films of the table."""
        found = table_point(pump, point, self.table)
        return SolvedPoint(found.pump_point, found.film_mean, found.film_least, found.film_rise)

    def row(self) -> TableSolver:
        """The same."""
        return self


@dataclass(frozen=True)
class DirectSolver:
    """Each point solved by a fidelity that solves films."""

    solver: PointSolver
    cost: float

    @property
    def words(self) -> str:
        """The fidelity, with the physics that it leaves out."""
        return f"{fidelity_words(self.solver.source, self.solver.stated)}, each point solved"

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of the numbers besides pump and point."""
        return {"fidelity": f"{self.solver.source.value}, each point solved", **self.solver.stated}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """All of it."""
        return pump

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point as the fidelity solves it."""
        return self.solver.solve(pump, point)

    def row(self) -> DirectSolver:
        """A solver whose films may start from those of the point before."""
        return replace(self, solver=self.solver.row())


class Members(Enum):
    """Members of a quantity: the pump, each friction pair, or each gap."""

    PUMP = ("",)
    PAIR = tuple(pair.value for pair in Pair)
    GAP = GAPS


@dataclass(frozen=True)
class Quantity:
    """A number that a map keeps of each point, SI; `of` reads it from the point and the pair or gap."""

    name: str
    unit: str
    words: str
    members: Members
    of: Callable[[SolvedPoint, str], float]

    @property
    def columns(self) -> tuple[str, ...]:
        """Its names, one for each member: `pair_loss.piston_cylinder`."""
        return tuple(f"{self.name}.{member}" if member else self.name for member in self.members.value)


def _of_pump(name: str, unit: str, words: str, place: str) -> Quantity:
    """Return a number of the whole pump, by its place in a solved point."""
    read = attrgetter(place)
    return Quantity(name, unit, words, Members.PUMP, lambda solved, _: read(solved.pump_point))


def _of_gaps(name: str, unit: str, words: str, place: str) -> Quantity:
    """Return a number of each gap, by the place of the gaps in a solved point."""
    read = attrgetter(place)
    return Quantity(name, unit, words, Members.GAP, lambda solved, gap: getattr(read(solved), gap))


def _of_pairs(name: str, words: str, part: str) -> Quantity:
    """Return a part of the loss of each friction pair."""
    return Quantity(
        name, "W", words, Members.PAIR, lambda solved, pair: getattr(solved.pump_point.pairs.loss(Pair(pair)), part)
    )


QUANTITIES = (
    _of_pump("delivery_flow", "m3/s", "flow out of the delivery port, at its pressure", "bench.delivery_flow"),
    _of_pump("inlet_flow", "m3/s", "flow into the inlet, at its pressure", "bench.inlet_flow"),
    _of_pump("drain_flow", "m3/s", "flow out of the case, at its pressure", "bench.drain_flow"),
    _of_pump("shaft_torque", "N m", "mean shaft torque", "bench.shaft_torque"),
    _of_pump("port_delivery_pressure", "Pa", "mean pressure at the delivery port, gauge", "bench.delivery_pressure"),
    _of_pump("port_inlet_pressure", "Pa", "mean pressure at the inlet, gauge", "bench.inlet_pressure"),
    _of_pump("drain_pressure", "Pa", "pressure in the case, gauge", "bench.drain_pressure"),
    _of_pump("shaft_power", "W", "power at the shaft", "power.shaft"),
    _of_pump("hydraulic_power", "W", "p Q summed over delivery, inlet and case", "power.hydraulic"),
    _of_pump("compression_power", "W", "stored in the oil that leaves, less that which enters", "power.elastic"),
    _of_pump("ripple_power", "W", "what pulsing of both ports' lines takes", "power.ripple"),
    _of_pump("throttling_delivery", "W", "loss in the delivery port", "power.throttling_delivery"),
    _of_pump("throttling_suction", "W", "loss in the suction port", "power.throttling_suction"),
    _of_pump("extended_loss", "W", "carried off by effects of [physics]", "power.extended"),
    _of_pairs("pair_loss", "loss of a friction pair", "mean"),
    _of_pairs("pair_loss_coulomb", "Coulomb part of a friction pair's loss", "mean_coulomb"),
    _of_gaps("leakage_loss", "W", "turned into heat by the flow through a gap", "pump_point.power.leakage"),
    _of_gaps("leakage_flow", "m3/s", "flow through a gap into the case, at its pressure", "pump_point.leakage_flow"),
    _of_gaps("film_mean", "m", "mean film of a gap over area and turn", "film_mean"),
    _of_gaps("film_least", "m", "least film of a gap anywhere in the turn", "film_least"),
    Quantity(
        "film_temperature", "K", "hottest oil in a gap in the turn", Members.GAP,
        lambda solved, gap: solved.pump_point.point.temperature + float(getattr(solved.film_rise, gap)),
    ),
    Quantity(
        "chamber_pressure_peak", "Pa", "highest chamber pressure, gauge", Members.PUMP,
        lambda solved, _: float(max(np.max(own.pressure) for own in solved.pump_point.chambers)),
    ),
    _of_pump("geometric_displacement", "m3/rev", "stroke times piston area, all pistons", "geometric_displacement"),
    _of_pump(
        "swept_displacement", "m3/rev", "what chambers without leakage would deliver at no pressure",
        "derived_displacement",
    ),
    _of_pump(
        "energy_balance_error", "1", "torque of forces against all sinks, of the shaft power",
        "checks.energy_balance_error",
    ),
    _of_pump("mass_balance_error", "1", "of the delivered mass", "checks.mass_balance_error"),
)  # fmt: skip
"""All kept numbers of a point."""


def columns() -> Iterator[tuple[str, str, str]]:
    """Name, unit and meaning of every number of a point."""
    for quantity in QUANTITIES:
        for column in quantity.columns:
            yield column, quantity.unit, quantity.words


def point_numbers(solved: SolvedPoint) -> dict[str, float]:
    """The numbers of a point by the head of their column, `shaft_torque [N m]`, SI."""
    return {
        f"{column} [{quantity.unit}]": float(quantity.of(solved, member))
        for quantity in QUANTITIES
        for column, member in zip(quantity.columns, quantity.members.value, strict=True)
    }


def point_remarks(solved: SolvedPoint) -> list[list[str]]:
    """The warnings of a point, [name, text] each."""
    return [[remark.warning.value, remark.text] for remark in solved.pump_point.warnings]


@dataclass(frozen=True)
class MapWork:
    """The points of a map as work in parts."""

    pump: PumpDescription
    solver: MapSolver

    def key(self, point: OperatingPoint) -> str:
        """Name of all inputs of a point's numbers: pump as far as it is read, solver, point, program."""
        made_by = "operating map", MAP_FORMAT, version("swashfilm"), sorted(self.solver.stated.items())
        read = self._read, self.pump.file_contents
        return content_key(*made_by, *read, np.array(astuple(point)))[:KEY_LENGTH]

    def solve(self, point: OperatingPoint) -> dict[str, object]:
        """The point's numbers and warnings."""
        solved = self.solver.solve(self.pump, point)
        return {"numbers": point_numbers(solved), "warnings": point_remarks(solved)}

    def row(self) -> MapWork:
        """The same points, each started from the one before."""
        return replace(self, solver=self.solver.row())

    @cached_property
    def _read(self) -> str:
        """The part of the pump's file that the numbers depend on: no name, no operating point, no tolerances.

        The temperature of the operating point is included where clearances change with temperature.
        """
        unread = ["speed", "pressure", "inlet_pressure", "case_pressure"]
        if self.pump.physics.thermal_clearance is None:
            unread.append("temperature")
        stated = replace(self.pump.operating, **(dict.fromkeys(unread, 0.0) | {"displacement_ratio": 1.0}))
        read = self.solver.reads(self.pump)
        return resolved_toml(replace(read, name="", operating=stated, tolerance=ToleranceSection()))
