"""Fig. 13: friction coefficients tuned by Eq. (21), and what points at one speed and displacement determine."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from system.bench_points import BenchPoints
from system.channels import ChannelName
from system.estimation.observations import Channel, Observations
from system.pairs import Pair
from system.paper.figures import Axis, Curve, Figure, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Impossibility, Judged, Range, judge, range_of
from system.paper.points import PRESSURES, RATIOS, SPEEDS, PaperPoint, PaperPoints, Reading
from system.paper.statements import CLAIMS
from system.paper_fit import RANGES, EqFit, EqTwentyOne, eq_fits, measured_losses, paper_priors

SEED = 13
NOISE = {
    ChannelName.Q_OUT: (0.08 / 6e4, 0.0006),
    ChannelName.Q_IN: (0.12 / 6e4, 0.001),
    ChannelName.Q_CASE: (0.015 / 6e4, 0.004),
    ChannelName.TORQUE: (0.25, 0.0006),
}
"""One sigma of a channel, SI: so much, and so much of the reading; the sensors of a good test bench."""
MADE = "made, not measured"
PLAN = tuple((speed, pressure, ratio) for ratio in RATIOS[1:] for speed in SPEEDS for pressure in PRESSURES)
"""The paper's test plan, 112 points."""


def fig13(model: PaperPoints, seen: PaperPoints) -> FigureResult:
    """Coefficients by Eq. (21) of `model`, tuned to readings made of the points in `seen` with noise.

    model: by the lumped fidelity. The paper's test points stand in no text, so readings are made: by another
    fidelity where `seen` is one, else by the model itself, which flatters it.
    """
    points, readings = made_readings(seen)
    equation = equation_of(model)
    losses = measured_losses(points, readings)
    fits = eq_fits(equation, losses, points, model.pump.pump.rated_speed)
    own = ", the model's own, so that the fit finds what it was made of" if seen.fidelity is model.fidelity else ""
    told = f"Readings are {MADE}: of {seen.fidelity.value} points{own}; with a bench's noise, seed {SEED}."
    return fig13_of(fits, told)


def fig13_of(fits: Sequence[EqFit], told: str) -> FigureResult:
    """The figure of fits at one speed, displacement by displacement, and of the whole map; `told`: of what."""
    cells = [fit for fit in fits if fit.ratio is not None]
    x = np.array([fit.ratio for fit in cells], dtype=float)
    names = [parameter.name.rpartition(".")[2] for parameter in fits[-1].posterior.parameters]
    bounded = tuple(
        Curve(name.replace("_", " "), x, np.array([fit.posterior.values[k] for fit in cells]))
        for k, name in enumerate(names)
    )
    printed = tuple(
        Curve(name.replace("_", " "), x, np.array([abs(fit.printed[k]) for fit in cells]))
        for k, name in enumerate(names)
    )
    axis, along = Axis("displacement", Unit.SHARE), Axis("friction coefficient", Unit.NUMBER)
    panels = (
        Panel("Coefficients at rated speed with bounds and priors", PanelKind.LINES, axis, along, bounded),
        Panel("Their size by plain least squares, as printed", PanelKind.LOGARITHMIC, axis, along, printed),
    )  # fmt: skip
    judged = (_solved(cells), _in_range(cells, names))
    return FigureResult(Figure.FIG13, panels, judged, (told, *_widths(fits[-1], names)))


def made_readings(seen: PaperPoints) -> tuple[BenchPoints, Observations]:
    """What a bench with sensors of NOISE would read at PLAN; the same at each call."""
    rows = [seen.at(*place) for place in PLAN]
    true = np.array([
        [of.delivery_flow, of.inlet_flow, of.drain_flow, of.shaft_torque] for of in (one.bench for one in rows)
    ])  # fmt: skip
    sigma = np.array([one for one, _ in NOISE.values()]) + np.array(
        [share for _, share in NOISE.values()]
    ) * np.abs(true)
    values = true + sigma * np.random.default_rng(SEED).standard_normal(true.shape)
    channels = tuple(Channel(name.value, name.dimension) for name in NOISE)
    count = len(rows)
    readings = Observations(channels, values, sigma, (), np.zeros((count, 0)), np.zeros(4), np.arange(count))
    return _bench_points(rows, seen), readings


def _bench_points(rows: Sequence[PaperPoint], seen: PaperPoints) -> BenchPoints:
    at, count = seen.pump.operating, len(rows)
    held = np.full(count, at.temperature)
    return BenchPoints(
        speed=np.array([one.bench.shaft_speed for one in rows]),
        displacement_ratio=np.array([ratio for _, _, ratio in PLAN]),
        p_out=np.array([one.bench.delivery_pressure for one in rows]),
        p_in=np.array([one.bench.inlet_pressure for one in rows]),
        p_case=np.array([one.bench.drain_pressure for one in rows]),
        T_case=held,
        T_in=held,
        hours=np.zeros(count),
        order=np.arange(count, dtype=float),
    )


def equation_of(model: PaperPoints) -> EqTwentyOne:
    """Eq. (21) at PLAN: each pair's Coulomb loss at a coefficient of 1, and what Eq. (2) counts besides."""
    priors, _ = paper_priors(model.pump)
    rows = [model.at(*place) for place in PLAN]
    pairs = [Pair(prior.name.rpartition(".")[2]) for prior in priors]
    stated = np.array([getattr(model.pump.friction, pair.value) for pair in pairs])
    losses = np.array([[one.coulomb[list(Pair).index(pair)] for pair in pairs] for one in rows])
    loss = np.array([one.split(Reading.WITH_SHEAR).hydromechanical for one in rows])
    return EqTwentyOne(loss - losses.sum(axis=1), losses / stated, priors)


def _solved(cells: Sequence[EqFit]) -> Judged:
    ranks = range_of(float(fit.rank) for fit in cells)
    printed = range_of(float(np.max(np.abs(fit.printed))) for fit in cells)
    reason = (
        "at one speed and displacement every pair's loss is straight in pressure: plain least squares, as "
        "printed, "
        f"gives coefficients of up to {printed.low:.2g} to {printed.high:.2g}"
    )
    rank = float(max(fit.rank for fit in cells))
    impossible = Impossibility("rank of the seven points' matrix", Unit.NUMBER, rank, Range(low=7.0))
    return judge(CLAIMS["fig13.solved"], ranks, reason=reason, impossible=impossible)


def _in_range(cells: Sequence[EqFit], names: Sequence[str]) -> Judged:
    beyond = {
        name: max(beyond_range(RANGES[Pair(name)], float(fit.posterior.values[k])) for fit in cells)
        for k, name in enumerate(names)
    }
    furthest = max(beyond, key=lambda name: beyond[name])
    at = names.index(furthest)
    found = range_of(float(fit.posterior.values[at]) for fit in cells)
    low, high = RANGES[Pair(furthest)]
    reason = (
        f"with bounds and priors; furthest is {furthest.replace('_', ' ')}, {found.text(Unit.NUMBER)}, where "
        "the "
        f"paper's range is {low:g} to {high:g}: that range is of coefficients that hold the films' shear"
    )
    return judge(CLAIMS["fig13.range"], Range(max(beyond.values()), max(beyond.values())), reason=reason)


def beyond_range(ends: tuple[float, float], value: float) -> float:
    """How many times beyond the nearer end of a range of positive numbers a value lies; 1 within."""
    low, high = ends
    return max(1.0, low / value, value / high)


def _widths(whole: EqFit, names: Sequence[str]) -> tuple[str, ...]:
    """What the whole map knows of each coefficient."""
    posterior = whole.posterior
    spread = np.sqrt(np.diag(posterior.covariance))
    told = ", ".join(
        f"{name.replace('_', ' ')} {value:.4f} ({100.0 * width:.0f} %)"
        for name, value, width in zip(names, posterior.values, spread, strict=True)
    )
    return (f"All {whole.points} points together, and how wide still of the prior: {told}.",)
