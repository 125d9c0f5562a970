"""Figs. 16 to 18 and 20 to 22: losses of the seven pairs, and their shares."""

from collections.abc import Sequence

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.units import RPM
from system.paper.figure import Curve, Figure, FigureAxis, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Impossibility, Judged, Range, judge, range_of
from system.paper.points import (
    FULL,
    PRESSURES,
    RATED,
    RATIOS,
    SPEEDS,
    LossReading,
    PaperFidelity,
    PaperPoint,
    PaperPoints,
)
from system.paper.statements import CLAIMS
from system.pump.laws.friction_pairs import Pair

MAIN = (Pair.PISTON_CYLINDER, Pair.SLIPPER_SWASH_PLATE, Pair.VALVE_PLATE_CYLINDER)
PISTON, SLIPPER, PLATE = MAIN
GUIDE = Pair.BALL_GUIDE_RETAINER
PRINTED = ((SPEEDS[3], 1.0), (SPEEDS[3], 0.28), (SPEEDS[2], 1.0), (SPEEDS[2], 0.28), (SPEEDS[1], 1.0),
           (SPEEDS[1], 0.28), (SPEEDS[0], 0.51), (SPEEDS[0], 0.28))  # fmt: skip
"""Speed and displacement ratio of Fig. 16 (a) to (h); (g) prints 0.52 where the test plan has 51 %."""
_PRESSURE = FigureAxis("delivery pressure", Unit.PRESSURE)
_SHARE = FigureAxis("share of the pairs' loss", Unit.SHARE)


def pair_words(pair: Pair) -> str:
    """A pair's name in words."""
    return pair.value.replace("_", " ")


def fig16(points: PaperPoints) -> FigureResult:
    """Hydromechanical loss over pressure: sum of the pairs, and Eq. (2) of a bench."""
    cases = [points.over_pressure(speed, ratio) for speed, ratio in PRINTED]
    readings = points.fidelity.readings
    panels = tuple(_case(*each, readings) for each in zip("abcdefgh", PRINTED, cases, strict=True))
    judged = []
    for reading in points.fidelity.readings:
        rows = [(_pairs_sum(row, reading), _by_bench(row, reading)) for row in cases]
        departs = max(from_line(np.array(PRESSURES), pairs) for pairs, _ in rows)
        over = range_of(value for pairs, bench in rows for value in bench / pairs - 1.0)
        judged.append(judge(CLAIMS["fig16.linear"], Range(0.0, departs), reading=reading))
        judged.append(judge(CLAIMS["fig16.agrees"], over, reading=reading, reason=_bench_reason(points, reading)))
    return FigureResult(Figure.FIG16, panels, tuple(judged), (
        "No text gives the test points: Eq. (2) is applied to the readings of a simulated bench.",
        "(g) prints 0.52 of the displacement where the test plan has 51 %.",
        "Fig. 16 has pressure differences, the other figures pressures; here both are gauge at the delivery port.",
    ))  # fmt: skip


def _case(letter: str, at: tuple[float, float], row: Sequence[PaperPoint], readings: Sequence[LossReading]) -> Panel:
    (speed, ratio), x = at, np.array(PRESSURES)
    curves = tuple(
        Curve(f"{what}, {reading.value}", x, of(row, reading))
        for reading in readings
        for what, of in (("pairs", _pairs_sum), ("Eq. (2)", _by_bench))
    )
    words = f"({letter}) {speed / RPM:.0f} r/min, {100.0 * ratio:.0f} % of displacement"
    return Panel(words, PanelKind.LINES, _PRESSURE, FigureAxis("hydro-mechanical loss", Unit.POWER), curves)


def _pairs_sum(row: Sequence[PaperPoint], reading: LossReading) -> Array:
    return np.array([one.pair_losses(reading).sum() for one in row])


def _by_bench(row: Sequence[PaperPoint], reading: LossReading) -> Array:
    return np.array([one.split(reading).hydromechanical for one in row])


def from_line(x: Array, y: Array) -> float:
    """Largest departure of points from the straight line next to them, relative to the points."""
    line = np.polynomial.Polynomial.fit(x, y, 1)
    return float(np.max(np.abs(line(x) - y) / np.abs(y)))


def _bench_reason(points: PaperPoints, reading: LossReading) -> str:
    """The part of Eq. (2) outside the pairs at the rated point, and the distance of its loss from a line."""
    row = points.over_pressure(RATED, FULL)
    rated, bench = row[-1], _by_bench(row, reading)
    beside = rated.split(reading).hydromechanical - float(rated.pair_losses(reading).sum())
    return (
        f"at the rated point Eq. (2) contains {beside:.0f} W besides the pairs: throttling in the ports "
        f"({rated.throttling:.0f} W) less the excess of Eq. (1) for compression. At full displacement and rated speed "
        f"its distance from a straight line is {100.0 * from_line(np.array(PRESSURES), bench):.1f} %"
    )


def fig17(points: PaperPoints) -> FigureResult:
    """Shares over pressure at full displacement and four speeds."""
    rows = {speed: points.over_pressure(speed, FULL) for speed in reversed(SPEEDS)}
    panels = tuple(
        stacked(f"{speed / RPM:.0f} r/min, full displacement, {reading.value}", _PRESSURE, PRESSURES, row, reading)
        for reading in points.fidelity.readings
        for speed, row in rows.items()
    )
    every = [one for row in rows.values() for one in row]
    about_guide, judged = _guide_reason(rows[RATED][0], points.fidelity), list[Judged]()
    for reading in points.fidelity.readings:
        for pair in MAIN:
            found = range_of(one.share(pair, reading) for one in every)
            reason = _share_reason(points, every, pair, reading)
            judged.append(judge(CLAIMS[f"fig17.{pair.value}"], found, reading=reading, reason=reason))
        top = [uppermost(one, reading, 1) <= {PISTON, SLIPPER} for one in every]
        main = [uppermost(one, reading, 3) == set(MAIN) for one in every]
        guide = rows[RATED][0].share(GUIDE, reading)
        judged += [
            judge(CLAIMS["fig17.top"], _part(top), reading=reading),
            judge(CLAIMS["fig17.main"], _part(main), reading=reading, reason=_others_reason(every, reading)),
            judge(CLAIMS["fig17.ball_guide"], Range(guide, guide), reading=reading, reason=about_guide),
        ]
    return FigureResult(Figure.FIG17, panels, tuple(judged))


def fig18(points: PaperPoints) -> FigureResult:
    """Loss of each pair over pressure at rated speed and full displacement."""
    row, panels, judged = points.over_pressure(RATED, FULL), [], []
    for reading in points.fidelity.readings:
        losses = np.array([one.pair_losses(reading) for one in row])
        curves = tuple(Curve(pair_words(pair), np.array(PRESSURES), losses[:, k]) for k, pair in enumerate(Pair))
        title = f"Loss of each pair, rated speed, full displacement, {reading.value}"
        panels.append(Panel(title, PanelKind.LINES, _PRESSURE, FigureAxis("loss", Unit.POWER), curves))
        others = [k for k, pair in enumerate(Pair) if pair is not GUIDE]
        guide = losses[:, list(Pair).index(GUIDE)]
        change = float(np.ptp(guide) / guide.mean())
        over = range_of(losses[-1, others] / losses[0, others])
        judged += [
            judge(CLAIMS["fig18.independent"], Range(change, change), reading=reading),
            judge(CLAIMS["fig18.proportional"], over, reading=reading, reason=_affine_reason(losses[:, others]),
                  impossible=_left_at_zero(losses[:, others])),
        ]  # fmt: skip
    return FigureResult(Figure.FIG18, tuple(panels), tuple(judged))


def fig20(points: PaperPoints) -> FigureResult:
    """Shares over displacement at the least pressure and rated speed."""
    row = [points.at(RATED, PRESSURES[0], ratio) for ratio in RATIOS]
    panels, judged = [], []
    for reading in points.fidelity.readings:
        axis = FigureAxis("displacement", Unit.SHARE)
        panels.append(stacked(f"rated speed, 5 MPa, {reading.value}", axis, RATIOS, row, reading))
        steps = {pair: np.array([one.share(pair, reading) for one in row]) for pair in MAIN}
        falling = {pair: shares[:-1] / shares[1:] for pair, shares in steps.items()}
        others = np.concatenate([falling[SLIPPER], falling[PLATE]])
        reason = ", ".join(f"{pair_words(pair)} {_percent(steps[pair])} %" for pair in MAIN)
        text = f"from {_percent(np.array(RATIOS))} % of displacement: {reason}"
        judged += [
            judge(CLAIMS["fig20.piston"], range_of(falling[PISTON]), reading=reading, reason=text),
            judge(CLAIMS["fig20.others"], range_of(others), reading=reading, reason=text),
        ]
    return FigureResult(Figure.FIG20, tuple(panels), tuple(judged))


def fig21(points: PaperPoints) -> FigureResult:
    """Shares over pressure at 28 % and rated speed."""
    row = points.over_pressure(RATED, RATIOS[1])
    return _leading(points.fidelity, Figure.FIG21, "rated speed, 28 %", _PRESSURE, PRESSURES, row)


def fig22(points: PaperPoints) -> FigureResult:
    """Shares over speed at 28 % and the least pressure."""
    row = [points.at(speed, PRESSURES[0], RATIOS[1]) for speed in SPEEDS]
    along = FigureAxis("shaft speed", Unit.SPEED)
    return _leading(points.fidelity, Figure.FIG22, "5 MPa, 28 %", along, SPEEDS, row)


def _leading(
    fidelity: PaperFidelity, figure: Figure, words: str, axis: FigureAxis, at: Sequence[float],
    row: Sequence[PaperPoint],
) -> FigureResult:  # fmt: skip
    readings, claim = fidelity.readings, f"{figure.value}.lead"
    panels = tuple(stacked(f"{words}, {reading.value}", axis, at, row, reading) for reading in readings)
    judged = []
    for reading in readings:
        leads = [uppermost(one, reading, 2) == {SLIPPER, PLATE} for one in row]
        shares = (
            f"{pair_words(pair)} {_percent(np.array([one.share(pair, reading) for one in row]))} %" for pair in MAIN
        )
        judged.append(judge(CLAIMS[claim], _part(leads), reading=reading, reason=", ".join(shares)))
    return FigureResult(figure, panels, tuple(judged))


def stacked(
    words: str, axis: FigureAxis, at: Sequence[float], row: Sequence[PaperPoint], reading: LossReading
) -> Panel:
    """Shares of all pairs on top of each other."""
    curves = tuple(
        Curve(pair_words(pair), np.array(at), np.array([one.share(pair, reading) for one in row])) for pair in Pair
    )
    return Panel(f"Shares, {words}", PanelKind.STACKED, axis, _SHARE, curves)


def uppermost(point: PaperPoint, reading: LossReading, count: int) -> set[Pair]:
    """The pairs of largest loss."""
    return set(sorted(Pair, key=lambda pair: -point.loss(pair, reading))[:count])


def coefficient_for_share(point: PaperPoint, pair: Pair, share: float, reading: LossReading) -> float:
    """Factor on a pair's Coulomb coefficient at which the pair has this share.

    All other losses stay: share (rest + c k + s) = c k + s, with s the pair's own shear (0 of mixed coefficients).
    """
    own = point.coulomb[list(Pair).index(pair)]
    shear = point.loss(pair, reading) - own
    rest = float(point.pair_losses(reading).sum()) - own - shear
    return (share * rest / (1.0 - share) - shear) / own


def _share_reason(points: PaperPoints, every: Sequence[PaperPoint], pair: Pair, reading: LossReading) -> str:
    """The part of the paper's range that ours covers, and the coefficient for its upper end."""
    expected, found = CLAIMS[f"fig17.{pair.value}"].expected, range_of(one.share(pair, reading) for one in every)
    spans = (found.high - found.low) / (expected.high - expected.low)
    if points.fidelity is PaperFidelity.FLOATING:
        rated, k = points.at(RATED, PRESSURES[-1], FULL), list(Pair).index(pair)
        return (
            f"the computed range spans {100.0 * spans:.0f} % of the paper's. No coefficient is fitted: at the rated "
            f"point the film shears {rated.viscous[k]:.0f} W, and contact takes {rated.coulomb[k]:.0f} W"
        )
    stated = getattr(points.pump.friction, pair.value)
    needed = min(coefficient_for_share(one, pair, expected.high, reading) for one in every) * stated
    return (
        f"the computed range spans {100.0 * spans:.0f} % of the paper's. The upper end needs a coefficient of "
        f"{needed:.2g} or more in place of {stated:.2g}; the paper's are 0.008 to 0.03"
    )


def _others_reason(every: Sequence[PaperPoint], reading: LossReading) -> str:
    """Pairs among the three uppermost that are not the paper's three."""
    others = {pair for one in every for pair in uppermost(one, reading, 3)} - set(MAIN)
    text = ", ".join(sorted(pair_words(pair) for pair in others))
    return f"the third place goes to {text} at some points" if text else ""


def _guide_reason(point: PaperPoint, fidelity: PaperFidelity) -> str:
    shares = ", ".join(f"{100.0 * point.share(GUIDE, reading):.1f} % {reading.value}" for reading in fidelity.readings)
    return f"the share is {shares}; it depends on the films' shear in the sum of all pairs"


def _affine_reason(losses: Array) -> str:
    left = zero_share(losses)
    return (
        f"{100.0 * left.min():.0f} to {100.0 * left.max():.0f} % of the losses at 5 MPa remain at zero pressure, since "
        "spring, inertia, charge pressure in the suction half and the films' shear do not depend on it"
    )


def zero_share(losses: Array) -> Array:
    """Losses (n, k) over PRESSURES, each extrapolated linearly to zero delivery pressure, of those at the first."""
    lines = np.polynomial.polynomial.polyfit(np.array(PRESSURES) / PRESSURES[-1], losses, 1)
    return np.asarray(lines[0] / losses[0])


def _left_at_zero(losses: Array) -> Impossibility:
    largest = float(zero_share(losses).max())
    quantity = "largest part of a pair's loss at 5 MPa that remains at zero pressure"
    return Impossibility(quantity, Unit.SHARE, largest, Range(-0.05, 0.05))


def _part(met: Sequence[bool]) -> Range:
    share = sum(met) / len(met)
    return Range(share, share)


def _percent(shares: Array) -> str:
    return " ".join(f"{value:.1f}" for value in 100.0 * shares)
