"""Fig. 8 by films solved at given positions, and the drawing of a film."""

import numpy as np

from system.description.pump import PumpDescription
from system.paper.figure import Figure, FigureAxis, FigureField, Panel, PanelKind, Unit
from system.paper.film_records import SHOWN_ANGLE, film_field
from system.paper.judge import FigureResult, Range, judge
from system.paper.points import FULL, PRESSURES, RATED, PaperFidelity, PaperWork, Place
from system.paper.statements import CLAIMS
from system.points.films import films_point

NO_FIELD = "Films of given thickness have no field: --fidelity fixed or floating."
GIVEN = "The film is that of the pump file. Only --fidelity floating computes it over the displacement."


def fig8_of_films(pump: PumpDescription) -> FigureResult:
    """The piston's film at rated point in the position that the description gives."""
    place = Place(RATED, PRESSURES[-1], FULL)
    found = films_point(pump, PaperWork(pump, PaperFidelity.FIXED).at(place)).gaps
    at = int(np.argmin(np.abs(found.shaft_angle - SHOWN_ANGLE)))
    mean = float(np.mean([film.film_thickness_mean for film in found.piston]))
    field = film_field(found.piston[at].solution)
    over = field.values.mean() / field.values.min()
    reason = f"by construction: eccentricity {pump.piston.eccentricity_ratio:g} is given, parallel to the bore"
    judged = (
        judge(CLAIMS["fig8.mean"], Range(mean, mean), reason="by construction: the clearance of the pump file"),
        judge(CLAIMS["fig8.nonuniform"], Range(float(over), float(over)), reason=reason),
    )
    return FigureResult(Figure.FIG8, (film_panel(field, float(found.shaft_angle[at])),), judged)


def film_panel(field: FigureField, shaft_angle: float) -> Panel:
    """A piston's film at a shaft angle (rad) as in the paper's Fig. 8."""
    return Panel(
        f"Film of the piston at {np.degrees(shaft_angle):.0f} deg", PanelKind.FIELD,
        FigureAxis("angle round the piston", Unit.ANGLE), FigureAxis("length ratio", Unit.NUMBER), field=field,
    )  # fmt: skip
