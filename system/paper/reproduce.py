"""All figures of Xu, Hu, Zhang and Mao (2017) by one call."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from system.description.pump import PumpDescription
from system.paper.figure import Figure
from system.paper.figures.chambers import fig10, fig11
from system.paper.figures.coefficients import fig13
from system.paper.figures.efficiencies import fig2, fig3
from system.paper.figures.equations import equations
from system.paper.figures.films import GIVEN, NO_FIELD, fig8_of_films
from system.paper.figures.floating_films import floating_fig8, floating_fig9
from system.paper.figures.guide import fig15, fig19
from system.paper.figures.pair_losses import fig16, fig17, fig18, fig20, fig21, fig22
from system.paper.figures.table_one import table1
from system.paper.judge import FigureResult
from system.paper.points import PaperFidelity, PaperPoints, PaperWork, places_of, solve_points
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
"""Figures that require the operating points alone."""


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

    Raises InputError where a point has no solution.
    """
    work = PaperWork(pump, fidelity, means.floating)
    floats = fidelity is PaperFidelity.FLOATING
    places = places_of(pump, [one for one in figures if floats or one not in (Figure.FIG8, Figure.FIG9)])
    points = solve_points(work, places, means.store, means.executor, means.report)
    return tuple(_made(points, figures, means))


def _made(points: PaperPoints, figures: Sequence[Figure], means: Means) -> Iterator[FigureResult]:
    fidelity = points.fidelity
    lumped, floating = fidelity is PaperFidelity.LUMPED, fidelity is PaperFidelity.FLOATING
    for figure in figures:
        if figure in OF_POINTS:
            yield OF_POINTS[figure](points)
        elif figure is Figure.FIG8 and lumped:
            yield FigureResult(figure, remarks=(NO_FIELD,))
        elif figure is Figure.FIG8:
            yield floating_fig8(points) if floating else fig8_of_films(points.pump)
        elif figure is Figure.FIG9:
            yield floating_fig9(points) if floating else FigureResult(figure, remarks=(GIVEN,))
        else:
            yield fig13(points if lumped else _lumped(points.pump, means), points)


def _lumped(pump: PumpDescription, means: Means) -> PaperPoints:
    work = PaperWork(pump, PaperFidelity.LUMPED)
    return solve_points(work, places_of(pump, (Figure.FIG13,)), means.store, means.executor)
