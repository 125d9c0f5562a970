"""One point of an operating map: its solver, the key of its content, and the numbers that are kept of it."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import astuple, dataclass, replace
from enum import Enum
from functools import cached_property
from importlib.metadata import version
from typing import Protocol

import numpy as np

from reynolds.numerics.cache import content_key
from system.description.parts import MaterialsSection, SurfacesSection
from system.description.pump import PumpDescription
from system.description.tolerance import ToleranceSection
from system.points.lumped import lumped_point
from system.points.table.means import SolvedPoint, given_films
from system.points.table.point import table_point
from system.points.table.response_table import ResponseTable
from system.points.table.sources import PointSolver
from system.points.table.store import table_record
from system.pump.laws.friction_pairs import Pair
from system.pump.operating import OperatingPoint
from system.pump_file.file import resolved_toml

MAP_FORMAT = 1
"""Raised when the same point gives other numbers: by the laws behind it, or by what is kept."""
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
        ...

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of the numbers besides pump and point."""
        ...

    @property
    def cost(self) -> float:
        """Seconds a point."""
        ...

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """The pump without tables that nothing here reads."""
        ...

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point; raises as the fidelity."""
        ...


@dataclass(frozen=True)
class LumpedSolver:
    """`lumped_point`: films of given thickness."""

    words = "lumped"
    cost = 0.006

    @property
    def stated(self) -> Mapping[str, str]:
        """Nothing beside pump and point."""
        return {"fidelity": "lumped: films of given thickness"}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """Without materials and surfaces, where no effect of [physics] asks for them."""
        if pump.physics.on:
            return pump
        return replace(pump, materials=MaterialsSection(), surfaces=SurfacesSection())

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point, films as given."""
        given = given_films(pump)
        return SolvedPoint(lumped_point(pump, point), given, given)


@dataclass(frozen=True)
class TableSolver:
    """`table_point` by one response table."""

    table: ResponseTable
    cost = 0.02

    @property
    def words(self) -> str:
        """The fidelity that the table condenses."""
        return f"{self.table.origin.source.value}, by response table"

    @property
    def stated(self) -> Mapping[str, str]:
        """The table's whole record, by content."""
        learnt = self.table.response.learnt
        name = content_key(table_record(self.table), learnt.points, learnt.values)[:KEY_LENGTH]
        return {"fidelity": self.words, "table": name, **self.table.origin.stated}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """All of it."""
        return pump

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point, with the films of the table."""
        found = table_point(pump, point, self.table)
        return SolvedPoint(found.pump_point, found.film_mean, found.film_least)


@dataclass(frozen=True)
class DirectSolver:
    """Each point solved by a fidelity that solves films."""

    solver: PointSolver
    cost: float

    @property
    def words(self) -> str:
        """The fidelity."""
        return f"{self.solver.source.value}, each point solved"

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of the numbers besides pump and point."""
        return {"fidelity": self.words, **self.solver.stated}

    def reads(self, pump: PumpDescription) -> PumpDescription:
        """All of it."""
        return pump

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point as the fidelity solves it."""
        return self.solver.solve(pump, point)


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


def _of_bench(name: str, unit: str, words: str) -> Quantity:
    return Quantity(name, unit, words, Members.PUMP, lambda solved, _: getattr(solved.pump_point.bench, name))


def _of_power(name: str, field: str, words: str) -> Quantity:
    return Quantity(name, "W", words, Members.PUMP, lambda solved, _: getattr(solved.pump_point.power, field))


QUANTITIES = (
    _of_bench("delivery_flow", "m3/s", "flow out of the delivery port, at its pressure"),
    _of_bench("inlet_flow", "m3/s", "flow into the inlet, at its pressure"),
    _of_bench("drain_flow", "m3/s", "flow out of the case, at its pressure"),
    _of_bench("shaft_torque", "N m", "mean shaft torque"),
    Quantity(
        "port_delivery_pressure", "Pa", "mean pressure at the delivery port, gauge", Members.PUMP,
        lambda solved, _: solved.pump_point.bench.delivery_pressure,
    ),
    Quantity(
        "port_inlet_pressure", "Pa", "mean pressure at the inlet, gauge", Members.PUMP,
        lambda solved, _: solved.pump_point.bench.inlet_pressure,
    ),
    _of_bench("drain_pressure", "Pa", "pressure in the case, gauge"),
    _of_power("shaft_power", "shaft", "power at the shaft"),
    _of_power("hydraulic_power", "hydraulic", "p Q summed over delivery, inlet and case"),
    _of_power("compression_power", "elastic", "stored in the oil that leaves, less that which enters"),
    _of_power("ripple_power", "ripple", "what pulsing of both ports' lines takes"),
    _of_power("throttling_delivery", "throttling_delivery", "loss in the delivery port"),
    _of_power("throttling_suction", "throttling_suction", "loss in the suction port"),
    _of_power("extended_loss", "extended", "carried off by effects of [physics]"),
    Quantity(
        "pair_loss", "W", "loss of a friction pair", Members.PAIR,
        lambda solved, pair: solved.pump_point.pairs.loss(Pair(pair)).mean,
    ),
    Quantity(
        "pair_loss_coulomb", "W", "Coulomb part of a friction pair's loss", Members.PAIR,
        lambda solved, pair: solved.pump_point.pairs.loss(Pair(pair)).mean_coulomb,
    ),
    Quantity(
        "leakage_loss", "W", "turned into heat by the flow through a gap", Members.GAP,
        lambda solved, gap: getattr(solved.pump_point.power.leakage, gap),
    ),
    Quantity(
        "leakage_flow", "m3/s", "flow through a gap into the case, at its pressure", Members.GAP,
        lambda solved, gap: getattr(solved.pump_point.leakage_flow, gap),
    ),
    Quantity(
        "film_mean", "m", "mean film of a gap over area and turn", Members.GAP,
        lambda solved, gap: getattr(solved.film_mean, gap),
    ),
    Quantity(
        "film_least", "m", "least film of a gap anywhere in the turn", Members.GAP,
        lambda solved, gap: getattr(solved.film_least, gap),
    ),
    Quantity(
        "chamber_pressure_peak", "Pa", "highest chamber pressure, gauge", Members.PUMP,
        lambda solved, _: float(max(np.max(own.pressure) for own in solved.pump_point.chambers)),
    ),
    Quantity(
        "geometric_displacement", "m3/rev", "stroke times piston area, all pistons", Members.PUMP,
        lambda solved, _: solved.pump_point.geometric_displacement,
    ),
    Quantity(
        "swept_displacement", "m3/rev", "what chambers without leakage would deliver at no pressure", Members.PUMP,
        lambda solved, _: solved.pump_point.derived_displacement,
    ),
    Quantity(
        "energy_balance_error", "1", "torque of forces against all sinks, of the shaft power", Members.PUMP,
        lambda solved, _: solved.pump_point.checks.energy_balance_error,
    ),
    Quantity(
        "mass_balance_error", "1", "of the delivered mass", Members.PUMP,
        lambda solved, _: solved.pump_point.checks.mass_balance_error,
    ),
)  # fmt: skip
"""All that is kept of a point."""


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


@dataclass(frozen=True)
class MapWork:
    """The points of a map as work in parts."""

    pump: PumpDescription
    solver: MapSolver

    def key(self, point: OperatingPoint) -> str:
        """Name of all that a point's numbers depend on: pump as far as it is read, solver, point, program."""
        made_by = "operating map", MAP_FORMAT, version("swashfilm"), sorted(self.solver.stated.items())
        read = self._read, self.pump.file_contents
        return content_key(*made_by, *read, np.array(astuple(point)))[:KEY_LENGTH]

    def solve(self, point: OperatingPoint) -> dict[str, object]:
        """The point's numbers and warnings."""
        solved = self.solver.solve(self.pump, point)
        remarks = [[remark.warning.value, remark.text] for remark in solved.pump_point.warnings]
        return {"numbers": point_numbers(solved), "warnings": remarks}

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
