"""Fig. 13: friction coefficients tuned by Eq. (21), and the combinations that points at one speed and displacement
determine.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.calibration.equation_21 import RANGES, EqFit, eq_fits, measured_losses
from system.paper.figure import Curve, Figure, FigureAxis, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Impossibility, Judged, Range, judge, range_of
from system.paper.made_readings import MADE, SEED, equation_of, made_readings
from system.paper.points import LossReading, PaperPoints
from system.paper.statements import CLAIMS
from system.pump.laws.friction_pairs import Pair


def fig13(model: PaperPoints, source: PaperPoints) -> FigureResult:
    """Coefficients by Eq. (21) of `model`, tuned to readings made from the points in `source` with noise.

    model: by the lumped fidelity. No text gives the paper's test points, so readings are made: by another
    fidelity if `source` is one, else by the model itself, which favours it.
    """
    points, readings = made_readings(source)
    equation, losses = equation_of(model), measured_losses(points, readings)
    rated = model.pump.pump.rated_speed
    fits = {
        LossReading.WITH_SHEAR: eq_fits(equation, losses, points, rated),
        LossReading.MIXED: eq_fits(equation.mixed, losses, points, rated),
    }
    own = " They are the model's own, so the fit finds its own numbers." if source.fidelity is model.fidelity else ""
    remarks = f"Readings are {MADE}: {source.fidelity.value} points with a bench's noise, seed {SEED}.{own}"
    return fig13_of(fits, (remarks,))


def fig13_of(fits: Mapping[LossReading, Sequence[EqFit]], remarks: Sequence[str]) -> FigureResult:
    """The figure of fits at one speed, displacement by displacement, and of the whole map, with `remarks`.

    By both readings: with the films' shear separate, and with the shear in the coefficients.
    """
    cells = {reading: [fit for fit in own if fit.ratio is not None] for reading, own in fits.items()}
    panels = (*(_bounded(own, reading) for reading, own in cells.items()), _printed(cells[LossReading.MIXED]))
    judged = (_solved(cells[LossReading.MIXED]), *(_in_range(own, reading) for reading, own in cells.items()))
    widths = tuple(_widths(own[-1], reading) for reading, own in fits.items())
    return FigureResult(Figure.FIG13, panels, judged, (*remarks, _rank(fits[LossReading.MIXED]), *widths))


_DISPLACEMENT, _COEFFICIENT = (FigureAxis("displacement", Unit.SHARE), FigureAxis("friction coefficient", Unit.NUMBER))


def _names(fit: EqFit) -> list[str]:
    """The pairs whose coefficients are tuned."""
    return [parameter.name.rpartition(".")[2] for parameter in fit.posterior.parameters]


def _bounded(cells: Sequence[EqFit], reading: LossReading) -> Panel:
    """Coefficients and their sigma over displacement, with bounds and priors."""
    curves = tuple(
        Curve(
            name,
            x,
            np.array([fit.posterior.values[k] for fit in cells]),
            np.array([fit.posterior.sigma(fit.posterior.parameters[k].name) for fit in cells]),
        )
        for k, name, x in _columns(cells)
    )
    title = f"Coefficients at rated speed and one sigma, {reading.value}"
    return Panel(title, PanelKind.LOGARITHMIC, _DISPLACEMENT, _COEFFICIENT, curves)


def _printed(cells: Sequence[EqFit]) -> Panel:
    """Size of the coefficients by plain least squares."""
    curves = tuple(Curve(name, x, np.array([abs(fit.printed[k]) for fit in cells])) for k, name, x in _columns(cells))
    title = "Their size by plain least squares, as printed"
    return Panel(title, PanelKind.LOGARITHMIC, _DISPLACEMENT, _COEFFICIENT, curves)


def _columns(cells: Sequence[EqFit]) -> Iterator[tuple[int, str, Array]]:
    """Column, words and displacements of each coefficient, in the order of `Pair`."""
    names, x = _names(cells[0]), np.array([fit.ratio for fit in cells], dtype=float)
    for pair in Pair:
        if pair.value in names:
            yield names.index(pair.value), pair.value.replace("_", " "), x


def _rank(fits: Sequence[EqFit]) -> str:
    """Number of combinations that the points determine, displacement by displacement and all together."""
    ranks = ", ".join(f"{fit.rank} at {100.0 * fit.ratio:.0f} %" for fit in fits if fit.ratio is not None)
    whole = fits[-1]
    return (
        f"Number of the {len(_names(whole))} coefficients that Eq. (21)'s points at rated speed and one displacement "
        f"determine (rank): {ranks}. All {whole.points} points together determine {whole.rank}."
    )


def _solved(cells: Sequence[EqFit]) -> Judged:
    ranks = range_of(float(fit.rank) for fit in cells)
    printed = range_of(float(np.max(np.abs(fit.printed))) for fit in cells)
    reason = (
        "at one speed and displacement every pair's loss is linear in pressure. Plain least squares, as printed, "
        f"give coefficients of up to {printed.low:.2g} to {printed.high:.2g}"
    )
    rank = float(max(fit.rank for fit in cells))
    impossible = Impossibility("rank of the seven points' matrix", Unit.NUMBER, rank, Range(low=7.0))
    return judge(CLAIMS["fig13.solved"], ranks, reason=reason, impossible=impossible)


_WHY = {
    LossReading.WITH_SHEAR: "The paper's coefficients include the films' shear, these do not",
    LossReading.MIXED: "Shear of films of given thickness is the same at every pressure, so only coefficients of pairs "
    "whose loss hardly rises with pressure can include it",
}


def _in_range(cells: Sequence[EqFit], reading: LossReading) -> Judged:
    names = _names(cells[0])
    beyond = {
        name: max(beyond_range(RANGES[Pair(name)], float(fit.posterior.values[k])) for fit in cells)
        for k, name in enumerate(names)
    }
    furthest = max(beyond, key=lambda name: beyond[name])
    at = names.index(furthest)
    found = range_of(float(fit.posterior.values[at]) for fit in cells)
    low, high = RANGES[Pair(furthest)]
    reason = (
        f"fit with bounds and priors. The furthest coefficient is {furthest.replace('_', ' ')}, "
        f"{found.text(Unit.NUMBER)}; the paper's range is {low:g} to {high:g}. {_WHY[reading]}. The rms residual is "
        f"{_left(cells):.1f} sigma"
    )
    far = max(beyond.values())
    return judge(CLAIMS["fig13.range"], Range(far, far), reading=reading, reason=reason)


def beyond_range(ends: tuple[float, float], value: float) -> float:
    """Factor by which a value lies beyond the nearer end of a range of positive numbers; 1 within."""
    low, high = ends
    return max(1.0, low / value, value / high)


def _widths(whole: EqFit, reading: LossReading) -> str:
    """Width of each coefficient from the whole map."""
    posterior, names = whole.posterior, _names(whole)
    spread = np.sqrt(np.diag(posterior.covariance))
    shown = ", ".join(
        f"{name.replace('_', ' ')} {value:.4f} ({100.0 * width:.0f} %)"
        for name, value, width in zip(names, posterior.values, spread, strict=True)
    )
    return (
        f"Fit of all {whole.points} points, {reading.value} (in brackets: sigma over the prior's): {shown}. The rms "
        f"residual is {_left([whole]):.1f} sigma."
    )


def _left(fits: Sequence[EqFit]) -> float:
    """Root mean square of the residuals of fits, in sigma."""
    return float(np.sqrt(np.mean(np.concatenate([fit.posterior.residual for fit in fits]) ** 2)))
