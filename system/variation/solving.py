"""Varied pumps solved at all operating points, as work in parts whose results are kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.metadata import version
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from system.description.keys import PumpKey, pump_keys
from system.description.pump import PumpDescription
from system.description.tolerance import ToleranceSection
from system.maps.point import KEY_LENGTH, MapSolver, point_numbers as map_numbers, point_remarks
from system.points.table.response_table import ResponseTable
from system.pump_file.file import Variant, resolved_toml, varied
from system.variation.measures import point_numbers
from system.variation.sites import Sites
from system.variation.together import TogetherSolver
from system.work.kept_results import KeptPoints, run_kept
from system.work.progress import Report
from system.work.tasks import Executor, PartOutcome

FORMAT = 3
"""Raised when the same pump gives other numbers: by the laws behind it, or by what is kept."""
PART = 0.3
"""Least seconds of work in a batch, for which the data sent with it are negligible."""
_OF_TABLE = (
    "ports.", "delivery_line.", "suction_line.", "bearings.", "pump.dead_volume", "oil.bulk_modulus",
    "oil.kinematic_viscosity", "ball_guide.radius", "ball_guide.contact_latitude", "friction.ball_guide_retainer",
    "friction.front_bearing", "friction.rear_bearing", "friction.piston_slipper_socket",
)  # fmt: skip
"""Dimensions that act outside the films of a response table, or on them by its viscosity."""


def variable_keys(pump: PumpDescription, table: ResponseTable | None = None) -> dict[str, PumpKey]:
    """Return the dimensions that may vary: all of a pump's; by a response table its axes and those outside films."""
    keys = pump_keys(pump)
    if table is None:
        return keys
    return {path: one for path, one in keys.items() if path in table.origin.dimensions or beside_films(path)}


def beside_films(path: str) -> bool:
    """True for a dimension that acts on the films of a response table not at all, or by its viscosity alone."""
    return path.startswith(_OF_TABLE)


@dataclass(frozen=True)
class VariedWork:
    """Variants of a pump as work in parts: each is solved at all sites.

    whole: numbers and warnings of a map are kept of each site beside the NUMBERS; not of sites solved together.
    """

    pump: PumpDescription
    solver: MapSolver | TogetherSolver
    sites: Sites
    whole: bool = False

    def key(self, variant: Variant) -> str:
        """Name of all inputs of a variant's numbers."""
        made_by = "varied pump", FORMAT, version("swashfilm"), sorted(self.solver.stated.items()), self._read
        points = np.array([list(vars(point).values()) for point in self.sites.points])
        paths, values = [path for path, _ in variant], np.array([value for _, value in variant])
        return content_key(*made_by, self.whole, self.pump.file_contents, points, paths, values)[:KEY_LENGTH]

    def solve(self, variant: Variant) -> dict[str, object]:
        """The numbers of all sites, and the names of their warnings, absent for points solved together."""
        pump = varied(self.pump, variant)
        if isinstance(self.solver, TogetherSolver):
            return {"numbers": self.solver.solve_all(pump, self.sites.of(pump)), "warnings": []}
        solver = self.solver.row()
        solved = [solver.solve(pump, point) for point in self.sites.of(pump)]
        names = sorted({remark.warning.value for one in solved for remark in one.pump_point.warnings})
        found: dict[str, object] = {"numbers": [point_numbers(pump, one) for one in solved], "warnings": names}
        if self.whole:
            found["map"] = [[[*map_numbers(one).values()], point_remarks(one)] for one in solved]
        return found

    @cached_property
    def _read(self) -> str:
        return resolved_toml(replace(self.solver.reads(self.pump), name="", tolerance=ToleranceSection()))


def solved_variants(
    work: VariedWork,
    variants: Sequence[Variant],
    folder: Path,
    executor: Executor,
    report: Report,
    earlier: KeptPoints | None = None,
) -> tuple[PartOutcome, ...]:
    """Return the outcome of every variant; each is kept in a folder as soon as it is known."""
    cost = work.solver.cost * len(work.sites.points)
    batch = max(1, round(PART / cost))
    found = run_kept(
        work, variants, KeptPoints(folder), executor, earlier=earlier, batch=batch, described=_progress, report=report
    )
    return found.outcomes


def numbers_in(outcome: PartOutcome) -> Array:
    """Return the numbers (P, NUMBERS) of a solved variant."""
    return np.array(outcome.record["numbers"], dtype=float)


def _progress(variant: Variant, outcome: PartOutcome) -> str:
    where = ", ".join(path for path, _ in variant) if len(variant) < 3 else f"{len(variant)} dimensions"
    return f"{where or 'as stated'}: {outcome.status.value}"
