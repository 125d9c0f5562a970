"""Figs. 8 and 9 by gaps that float: films of piston and slipper in the coupled points."""

from collections.abc import Sequence
from math import inf

import numpy as np

from system.inputs.shown import pressure_text
from system.paper.figure import Curve, Figure, FigureAxis, FigureField, Panel, PanelKind, Unit
from system.paper.figures.films import film_panel
from system.paper.film_records import FILM
from system.paper.judge import FigureResult, Range, judge, range_of
from system.paper.points import FULL, PRESSURES, RATED, RATIOS, PaperPoints
from system.paper.statements import CLAIMS
from system.work.tasks import Record

FLOATING_RATIOS = RATIOS[1:]
"""Displacements of Fig. 9, at rated speed and pressure."""
ENDS = ("inner end", "case edge")


def floating_fig8(points: PaperPoints) -> FigureResult:
    """The piston's film at the rated point: as drawn in the paper, and the path of its axis over the turn."""
    pump, piston = points.pump, films_at(points, FULL)["piston"]
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
    return FigureResult(Figure.FIG8, panels, judged, (remark,))


def floating_fig9(points: PaperPoints) -> FigureResult:
    """Mean films of slipper and piston over the displacement."""
    records = [films_at(points, ratio) for ratio in FLOATING_RATIOS]
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
    least = films_at(points, FULL, PRESSURES[0])["slipper"]["mean"]
    remark = f"At full displacement and {pressure_text(PRESSURES[0])} the slipper's mean film is {1e6 * least:.2f} um."
    return FigureResult(Figure.FIG9, panels, judged, (remark,))


def films_at(points: PaperPoints, ratio: float, pressure: float = PRESSURES[-1]) -> Record:
    """Films at rated speed; ValueError for points of a fidelity without floating gaps."""
    films = points.at(RATED, pressure, ratio).films
    if films is None:
        raise ValueError(f"no floating films in points of the fidelity {points.fidelity.value}")
    return films


def _slipper_films(records: Sequence[Record]) -> str:
    """Mean film of the slipper by displacement, and the load on asperities."""
    films = " ".join(f"{record['slipper']['mean'] * 1e6:.2f}" for record in records)
    bear = " ".join(f"{record['slipper']['contact']:.0f}" for record in records)
    at = " ".join(f"{100.0 * ratio:.0f}" for ratio in FLOATING_RATIOS)
    return f"at {at} % of displacement the mean film is {films} um, and asperities bear {bear} N"
