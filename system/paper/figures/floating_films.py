"""Figs. 8 and 9 by gaps that float: piston and slipper, each alone under the pressure of the lumped chamber."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from gaps.revolution.march import GapRevolution
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from system.description.pump import PumpDescription
from system.effects.switched import hold_plain
from system.films.drives import drives, no_rubbing
from system.films.parts import floating_parts
from system.films.rotor import engaged_share, rotor
from system.paper.figure import Curve, Figure, FigureAxis, FigureField, Panel, PanelKind, Unit
from system.paper.figures.films import FILM, SHOWN_ANGLE, film_field, film_panel
from system.paper.judge import FigureResult, Range, judge, range_of
from system.paper.points import KEY_LENGTH, PRESSURES, RATED, RATIOS, PaperWork, Place, PointFidelity
from system.paper.statements import CLAIMS
from system.points.floating_gaps import FloatingOptions, piston_revolution, slipper_revolution
from system.points.lumped import lumped_point
from system.pump_file.check import run_checks
from system.pump_file.file import resolved_toml
from system.pump_file.floating import slipper_has_a_wedge
from system.work.kept_results import KeptPoints, run_kept
from system.work.progress import Report, silent
from system.work.tasks import Executor, PartStatus, Record

FLOATING_RATIOS = RATIOS[1:]
"""Displacements at which the gaps float, all at rated speed and pressure."""
ENDS = ("inner end", "case edge")
ALONE = (
    "Each gap floats separately under the pressure of the lumped chamber, without the films' friction on the parts "
    "between them."
)


@dataclass(frozen=True)
class FloatingWork:
    """Films of piston and slipper over the turn at the paper's points: a `system.work.tasks.Work`."""

    pump: PumpDescription
    options: FloatingOptions

    @property
    def stated(self) -> str:
        """Physics, meshes and accuracy, as text."""
        own, exact = self.options, self.options.accuracy
        left_out = ", ".join(effect.value.replace("_", " ") for effect in own.physics.left_out)
        cells = " and ".join(f"{x} x {y}" for x, y in (own.piston_cells, own.slipper_cells))
        return (
            f"Left out of the films: {left_out or 'nothing'}. Cells of piston and slipper: {cells}; {own.steps} "
            f"angles a turn; a step errs by {exact.step:g} of the least film at most."
        )

    def key(self, part: Place) -> str:
        """Name of all that the films depend on."""
        return content_key("floating films 2", resolved_toml(self.pump), self.stated, part)[:KEY_LENGTH]

    def solve(self, part: Place) -> Record:
        """Films of both gaps, by `_films_record` and `_piston_record`.

        Raises FilmNotConverged, and InputError for a pump with effects of [physics].
        """
        hold_plain(self.pump)
        lumped = lumped_point(self.pump, PaperWork(self.pump, PointFidelity.LUMPED).at(part))
        at, parts = rotor(self.pump, lumped.point), floating_parts(self.pump)
        angle, pressure = lumped.cycle.shaft_angle, lumped.cycle.pressure
        driven = drives(at, parts, angle, pressure, no_rubbing(angle.size))
        piston = piston_revolution(at, parts, driven.piston, self.options)
        slipper = slipper_revolution(at, parts, driven.slipper, self.options)
        engaged = engaged_share(at, parts.piston.guide_length, piston.angles)
        return {
            "slipper": _films_record(slipper),
            "piston": {**_films_record(piston), **_piston_record(piston, engaged)},
        }


def _films_record(found: GapRevolution[Any]) -> Record:
    """Means over the turn: film over the area (m), contact load (N); the least film anywhere (m)."""
    instants = found.turn.instants
    return {
        "mean": float(np.mean([one.mean_film for one in instants])),
        "least": min(one.least_gap for one in instants),
        "contact": float(np.mean([one.report.contact_load for one in instants])),
    }


def _piston_record(found: GapRevolution[Any], engaged: Array) -> Record:
    """Eccentricity (m) of the axis at both ends of the film over the shaft angle (rad), and the film shown."""
    inner, case = found.positions.T[:2], found.positions.T[2:]
    own_end = case + (inner - case) * engaged
    angles = np.array(list(found.turn.films))
    at = float(angles[np.argmin(np.abs(angles - SHOWN_ANGLE))])
    field = film_field(found.turn.films[at])
    return {
        "angle": found.angles.tolist(),
        "eccentricity": [np.hypot(*end).tolist() for end in (own_end, case)],
        "shown": at,
        "field": [one.tolist() for one in (field.x, field.y, field.values)],
    }


def floating_figures(
    pump: PumpDescription, options: FloatingOptions, store: KeptPoints, executor: Executor, report: Report = silent
) -> tuple[FigureResult, FigureResult]:
    """Figs. 8 and 9 of floating gaps. Raises InputError for the first point that has no solution."""
    work = FloatingWork(pump, options)
    places = [Place(RATED, PRESSURES[-1], ratio) for ratio in FLOATING_RATIOS]
    kept = run_kept(work, places, store, executor, report=report)
    for place, outcome in zip(places, kept.outcomes, strict=True):
        if outcome.status is not PartStatus.SOLVED:
            raise InputError(f"floating gaps at {place.text}", outcome.reason, "a point that can be solved")
    records = [outcome.record for outcome in kept.outcomes]
    doubts = tuple(f"{one}." for one in run_checks((slipper_has_a_wedge,), pump).warnings)
    remarks = (ALONE, work.stated, *doubts)
    return _fig8(pump, records[-1]["piston"], remarks), _fig9(records, remarks)


def _fig8(pump: PumpDescription, piston: Mapping[str, Any], remarks: tuple[str, ...]) -> FigureResult:
    clearance = pump.piston.radial_clearance
    x, y, values = (np.array(one) for one in piston["field"])
    ratios = np.array(piston["eccentricity"]) / clearance
    courses = tuple(
        Curve(f"at the film's {end}", np.array(piston["angle"]), own) for end, own in zip(ENDS, ratios, strict=True)
    )
    angle = FigureAxis("shaft angle from inner dead centre", Unit.ANGLE)
    panels = (
        film_panel(FigureField(FILM, x, y, values), piston["shown"]),
        Panel("Eccentricity of the piston over its clearance", PanelKind.LINES, angle,
              FigureAxis("eccentricity over clearance", Unit.NUMBER), courses),
    )  # fmt: skip
    mean, over = piston["mean"], float(values.mean() / values.min())
    wider = f"the clearance is {clearance * 1e6:g} um; relieved edges and elastic walls make the mean film thicker"
    least = f"the least film is {piston['least'] * 1e6:.2f} um (below 0 rough walls overlap), the mean "
    judged = (
        judge(CLAIMS["fig8.mean"], Range(mean, mean), reason=wider),
        judge(CLAIMS["fig8.nonuniform"], Range(over, over),
              reason=f"{least}contact load {piston['contact']:.0f} N"),
    )  # fmt: skip
    given = pump.piston.eccentricity_ratio
    remark = (
        f"Mean eccentricity over clearance: {ratios[0].mean():.2f} at the film's inner end, {ratios[1].mean():.2f} at "
        f"its case edge, on opposite sides of a tilted piston. Eq. (15) has the one eccentricity of a parallel piston, "
        f"{given:g} by the pump file."
    )
    return FigureResult(Figure.FIG8, panels, judged, (remark, *remarks))


def _fig9(records: Sequence[Mapping[str, Mapping[str, float]]], remarks: tuple[str, ...]) -> FigureResult:
    x = np.array(FLOATING_RATIOS)
    means = {gap: np.array([record[gap]["mean"] for record in records]) for gap in ("slipper", "piston")}
    along = FigureAxis("displacement", Unit.SHARE)
    panels = (
        Panel("Mean film, rated speed and pressure", PanelKind.LINES, along, FigureAxis("mean film", Unit.FILM),
              tuple(Curve(gap, x, film) for gap, film in means.items())),
        Panel("Mean film over that at full displacement", PanelKind.LINES, along,
              FigureAxis("mean film over that at full displacement", Unit.SHARE),
              tuple(Curve(gap, x, film / film[-1]) for gap, film in means.items())),
    )  # fmt: skip
    slipper = means["slipper"]
    changes = {gap: float(np.ptp(film) / film.mean()) for gap, film in means.items()}
    faster = changes["slipper"] / changes["piston"] if changes["piston"] > 0.0 else inf
    spans = ", ".join(f"{gap} {100.0 * change:.1f} %" for gap, change in changes.items())
    judged = (
        judge(CLAIMS["fig9.falls"], range_of(slipper[1:] / slipper[:-1]), reason=_slipper_films(records)),
        judge(CLAIMS["fig9.faster"], Range(faster, faster), reason=f"mean film over the displacements: {spans}"),
    )
    return FigureResult(Figure.FIG9, panels, judged, remarks)


def _slipper_films(records: Sequence[Mapping[str, Mapping[str, float]]]) -> str:
    """Mean film of the slipper by displacement, and the load on asperities."""
    films = " ".join(f"{record['slipper']['mean'] * 1e6:.2f}" for record in records)
    bear = " ".join(f"{record['slipper']['contact']:.0f}" for record in records)
    at = " ".join(f"{100.0 * ratio:.0f}" for ratio in FLOATING_RATIOS)
    return f"at {at} % of displacement the mean film is {films} um, and asperities bear {bear} N"
