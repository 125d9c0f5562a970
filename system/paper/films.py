"""Figs. 8 and 9: the films of piston and slipper, by fidelities that solve them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from math import inf, pi

import numpy as np

from gaps.result import GapFilm
from reynolds.bodies.cache import content_key
from reynolds.errors import FilmInputError
from system.description import PumpDescription
from system.films import films_point
from system.gap_cycle import Report, silent
from system.kept_points import KeptPoints, run_kept
from system.paper.figures import Axis, Curve, Field, Figure, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Range, judge, range_of
from system.paper.points import (
    FULL,
    KEY_LENGTH,
    PRESSURES,
    RATED,
    RATIOS,
    PaperWork,
    Place,
    PointFidelity,
)
from system.paper.statements import CLAIMS
from system.power import Gaps
from system.pump_file import resolved_toml
from system.table_sources import FloatingSolver
from system.work import Hands, Record, Status

FLOATING_RATIOS = RATIOS[1:]
"""Displacements at which the gaps float for Figs. 8 and 9, all at rated speed and pressure."""
SHOWN_ANGLE = 1.5 * pi
"""Shaft angle (rad) of the film that is drawn: the middle of the delivery half."""
NO_FIELD = "Films of given thickness have no field: --fidelity films or floating."
GIVEN = (
    "The film is the one that the pump file gives: only --fidelity floating finds how it follows the displacement."
)


def fig8_of_films(pump: PumpDescription) -> FigureResult:
    """The piston's film at rated point in the position that the description gives."""
    place = Place(RATED, PRESSURES[-1], FULL)
    found = films_point(pump, PaperWork(pump, PointFidelity.FILMS).at(place)).gaps
    at = int(np.argmin(np.abs(found.shaft_angle - SHOWN_ANGLE)))
    mean = float(np.mean([film.film_thickness_mean for film in found.piston]))
    field = film_field(found.piston[at])
    panel = Panel(
        f"Film of the piston at {np.degrees(found.shaft_angle[at]):.0f} deg", PanelKind.FIELD,
        Axis("angle round the piston", Unit.ANGLE), Axis("length ratio", Unit.NUMBER), field=field,
    )  # fmt: skip
    over = field.values.mean() / field.values.min()
    reason = f"by construction: eccentricity {pump.piston.eccentricity_ratio:g} is given, parallel to the bore"
    judged = (
        judge(CLAIMS["fig8.mean"], Range(mean, mean), reason="by construction: the clearance of the pump file"),
        judge(CLAIMS["fig8.nonuniform"], Range(float(over), float(over)), reason=reason),
    )
    return FigureResult(Figure.FIG8, (panel,), judged)


def film_field(film: GapFilm) -> Field:
    """Thickness at a film's quadrature points over angle (rad) and share of the length."""
    space = film.solution.problem.space
    x, y = (one.ravel() for one in space.points)
    thickness = np.broadcast_to(film.solution.film.thickness, space.points[0].shape).ravel()
    columns, column = np.unique(np.round(x / np.ptp(x), 9), return_inverse=True)
    rows, row = np.unique(np.round(y / np.ptp(y), 9), return_inverse=True)
    values = np.full((rows.size, columns.size), np.nan)
    values[row, column] = thickness
    angle = 2.0 * pi * (columns - columns[0]) / (columns[-1] - columns[0] + columns[1] - columns[0])
    length = (rows - rows[0]) / (rows[-1] - rows[0])
    return Field(Axis("film", Unit.FILM), angle, length, values)


@dataclass(frozen=True)
class FloatingWork:
    """Films of the floating gaps at the paper's points: a `system.work.Work`."""

    pump: PumpDescription
    solver: FloatingSolver

    def key(self, part: Place) -> str:
        """Name of all that the films depend on."""
        return content_key("floating films 1", resolved_toml(self.pump), dict(self.solver.stated), part)[
            :KEY_LENGTH
        ]

    def solve(self, part: Place) -> Record:
        """Mean film over area and turn, and the least anywhere, m; raises as `floating_point`."""
        solved = self.solver.solve(self.pump, PaperWork(self.pump, PointFidelity.LUMPED).at(part))
        return {"mean": asdict(solved.film_mean), "least": asdict(solved.film_least)}


def floating_figures(
    pump: PumpDescription, solver: FloatingSolver, store: KeptPoints, hands: Hands, report: Report = silent
) -> tuple[FigureResult, FigureResult]:
    """Figs. 8 and 9 of floating gaps. Raises FilmInputError for the first point that has no solution."""
    work = FloatingWork(pump, solver)
    places = [Place(RATED, PRESSURES[-1], ratio) for ratio in FLOATING_RATIOS]
    kept = run_kept(work, places, store, hands, report=report)
    for place, outcome in zip(places, kept.outcomes, strict=True):
        if outcome.status is not Status.SOLVED:
            raise FilmInputError(f"floating gaps at {place}", outcome.reason, "a point that can be solved")
    records = [outcome.record for outcome in kept.outcomes]
    stated = ". ".join(f"{name.capitalize()}: {text}" for name, text in solver.stated.items()) + "."
    return _fig8(records[-1], stated), _fig9(records, stated)


def _fig8(record: Record, stated: str) -> FigureResult:
    mean, least = Gaps(**record["mean"]).piston, Gaps(**record["least"]).piston
    over = mean / least if least > 0.0 else inf
    told = f"least film anywhere {Unit.FILM.factor * least:.2f} um; below 0 rough walls overlap"
    judged = (
        judge(CLAIMS["fig8.mean"], Range(mean, mean)),
        judge(CLAIMS["fig8.nonuniform"], Range(over, over), reason=told),
    )
    return FigureResult(Figure.FIG8, (), judged, (stated,))


def _fig9(records: Sequence[Mapping[str, Mapping[str, float]]], stated: str) -> FigureResult:
    x = np.array(FLOATING_RATIOS)
    slipper, piston = (np.array([record["mean"][gap] for record in records]) for gap in ("slipper", "piston"))
    curves = (Curve("slipper", x, slipper), Curve("piston", x, piston))
    panel = Panel("Mean film over displacement, rated speed and pressure", PanelKind.LINES,
                  Axis("displacement", Unit.SHARE), Axis("mean film", Unit.FILM), curves)  # fmt: skip
    changes = [float(np.ptp(film) / film.mean()) for film in (slipper, piston)]
    faster = changes[0] / changes[1] if changes[1] > 0.0 else inf
    told = f"over the displacements the slipper's mean film changes by {100.0 * changes[0]:.1f} %, the "
    "piston's by " \
        f"{100.0 * changes[1]:.2f} %"  # fmt: skip
    judged = (
        judge(CLAIMS["fig9.falls"], range_of(slipper[1:] / slipper[:-1])),
        judge(CLAIMS["fig9.faster"], Range(faster, faster), reason=told),
    )
    return FigureResult(Figure.FIG9, (panel,), judged, (stated,))
