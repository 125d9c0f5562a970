"""All figures of Xu, Hu, Zhang and Mao (2017) by one call."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from system.description.pump import PumpDescription
from system.paper.figure import Figure
from system.paper.figures.chambers import fig10, fig11
from system.paper.figures.coefficients import fig13
from system.paper.figures.efficiencies import fig2, fig3
from system.paper.figures.equations import equations
from system.paper.figures.films import GIVEN, NO_FIELD, fig8_of_films
from system.paper.figures.floating_films import floating_figures
from system.paper.figures.guide import fig15, fig19
from system.paper.figures.pair_losses import fig16, fig17, fig18, fig20, fig21, fig22
from system.paper.figures.table_one import table1
from system.paper.judge import FigureResult
from system.paper.points import PaperPoints, PointFidelity, places_of, solve_points
from system.points.floating_gaps import FloatingOptions
from system.work.kept_results import KeptPoints
from system.work.progress import Report, silent
from system.work.tasks import Executor

OF_POINTS: Mapping[Figure, Callable[[PaperPoints], FigureResult]] = {
    Figure.TABLE1: table1,
    Figure.FIG2: fig2,
    Figure.FIG3: fig3,
    Figure.FIG10: fig10,
    Figure.FIG11: fig11,
    Figure.FIG15: fig15,
    Figure.FIG16: fig16,
    Figure.FIG17: fig17,
    Figure.FIG18: fig18,
    Figure.FIG19: fig19,
    Figure.FIG20: fig20,
    Figure.FIG21: fig21,
    Figure.FIG22: fig22,
    Figure.EQUATIONS: equations,
}
"""Figures that are made of the operating points alone."""


class PaperFidelity(Enum):
    """Fidelity of the paper's numbers: films of given thickness, solved at given positions, or floating."""

    LUMPED = "lumped"
    FIXED = "fixed"
    FLOATING = "floating"

    @property
    def figures(self) -> tuple[Figure, ...]:
        """The figures that mean something by it; the floating gaps' films alone are Figs. 8 and 9."""
        return FLOATING if self is PaperFidelity.FLOATING else tuple(Figure)


FLOATING = (Figure.FIG8, Figure.FIG9)


@dataclass(frozen=True)
class Means:
    """Means of the work: folder of costly points, executor, options of floating gaps."""

    store: KeptPoints
    executor: Executor
    floating: FloatingOptions
    report: Report = silent


def reproduce(
    pump: PumpDescription, figures: Sequence[Figure], fidelity: PaperFidelity, means: Means
) -> tuple[FigureResult, ...]:
    """The figures, in the given order; for those without meaning in this fidelity the reason alone.

    Raises InputError where a point has no solution, as the fidelity where the pump is unsuitable for it.
    """
    if fidelity is PaperFidelity.FLOATING:
        made = {
            result.figure: result
            for result in floating_figures(pump, means.floating, means.store, means.executor, means.report)
        }
        return tuple(made.get(figure, _nothing(figure)) for figure in figures)
    own = PointFidelity(fidelity.value)
    points = solve_points(pump, own, places_of(pump, figures), means.store, means.executor, means.report)
    return tuple(_made(points, figures, means))


def _made(points: PaperPoints, figures: Sequence[Figure], means: Means) -> Iterator[FigureResult]:
    lumped = points.fidelity is PointFidelity.LUMPED
    for figure in figures:
        if figure in OF_POINTS:
            yield OF_POINTS[figure](points)
        elif figure is Figure.FIG8:
            yield FigureResult(figure, remarks=(NO_FIELD,)) if lumped else fig8_of_films(points.pump)
        elif figure is Figure.FIG9:
            yield FigureResult(figure, remarks=(GIVEN,))
        else:
            yield fig13(points if lumped else _lumped(points.pump, means), points)


def _lumped(pump: PumpDescription, means: Means) -> PaperPoints:
    return solve_points(pump, PointFidelity.LUMPED, places_of(pump, (Figure.FIG13,)), means.store, means.executor)


def _nothing(figure: Figure) -> FigureResult:
    return FigureResult(figure, remarks=("Floating gaps are solved for Figs. 8 and 9 alone: minutes a point.",))
