"""Figs. 2 and 3: efficiency and losses as a bench reads them."""

from collections.abc import Iterator
from dataclasses import replace
from math import radians

import numpy as np

from system.description.pump import PumpDescription
from system.inputs.shown import pressure_text
from system.paper.figure import Curve, Figure, FigureAxis, FigureField, Panel, PanelKind, Unit
from system.paper.judge import FigureResult, Judged, Range, judge, range_of
from system.paper.points import (
    FULL,
    NEAR_ZERO,
    PRESSURES,
    RATED,
    RATIOS,
    LossReading,
    PaperPoint,
    PaperPoints,
    PaperWork,
    Place,
    near_zero,
    places_of,
)
from system.paper.statements import CLAIMS
from system.pump.bench import LossSplit, paper_efficiency

LATE_END = radians(178.0)
"""End of the delivery kidney in the variant of `without_trapped_oil`, rad from its dead centre."""
LOW = RATIOS[0]


def fig2(points: PaperPoints) -> FigureResult:
    """Overall efficiency by Eq. (3) at rated speed over pressure and displacement."""
    if idle := _undelivered(points, Figure.FIG2):
        return FigureResult(Figure.FIG2, remarks=idle)
    panels, judged = [], []
    for reading in points.fidelity.readings:
        field = _field(points, reading)
        panels.append(
            Panel(
                f"Overall efficiency, Eq. (3), rated speed, {reading.value}", PanelKind.FIELD,
                FigureAxis("displacement", Unit.SHARE), FigureAxis("delivery pressure", Unit.PRESSURE),
                (_best_point(field),), field,
            )
        )  # fmt: skip
        values, best = field.values, float(field.values.max())
        judged.append(
            judge(CLAIMS["fig2.best"], Range(best, best), reading=reading, reason=_best_reason(points, best, reading))
        )
        ends = range_of([values[-1, 0] / best, values[0, -1] / best])
        judged.append(judge(CLAIMS["fig2.falls"], ends, reading=reading))
    return FigureResult(Figure.FIG2, tuple(panels), tuple(judged))


def fig3(points: PaperPoints) -> FigureResult:
    """Volumetric and hydromechanical efficiency and loss, Eqs. (1), (2), (4), (5), in Cases 1 to 3."""
    if idle := _undelivered(points, Figure.FIG3):
        return FigureResult(Figure.FIG3, remarks=idle)
    judged: list[Judged] = []
    for reading in points.fidelity.readings:
        judged += _judged_cases(points, reading)
    cases = (
        ("Case 1: 5 MPa, rated speed", FigureAxis("displacement", Unit.SHARE), np.array(RATIOS), case_one(points)),
        ("Case 2: 13 % displacement, rated speed", FigureAxis("delivery pressure", Unit.PRESSURE),
         np.array([near_zero(points.pump), *PRESSURES]), case_two(points)),
    )  # fmt: skip
    panels = [panel for words, x, at, own in cases for panel in _case_panels(words, x, at, own)]
    panels += _rated_panels(case_three(points))
    split = case_three(points).split(LossReading.WITH_SHEAR)
    near = pressure_text(near_zero(points.pump))
    remarks = (
        f"Case 3 (rated point): volumetric loss {split.volumetric:.0f} W, hydro-mechanical "
        f"{split.hydromechanical:.0f} W, share {100.0 * split.hydromechanical_share:.1f} %; the text states no "
        "number.",
        f"'Near 0' of Case 2 is taken as {near} at the delivery port, {pressure_text(NEAR_ZERO)} above the inlet's.",
    )
    return FigureResult(Figure.FIG3, tuple(panels), tuple(judged), remarks)


def _undelivered(points: PaperPoints, figure: Figure) -> tuple[str, ...]:
    """Points at which leakage equals the displacement, so that efficiencies are not defined; else empty."""
    places = places_of(points.pump, (figure,))
    idle = [place.text for place in places if points.points[place].bench.delivery_flow <= 0.0]
    if not idle:
        return ()
    return (f"Not made: this pump delivers nothing at {'; '.join(idle)}, and Eqs. (3) to (5) have no value there.",)


def case_one(points: PaperPoints) -> tuple[PaperPoint, ...]:
    """Least pressure, rated speed, over displacement."""
    return tuple(points.at(RATED, PRESSURES[0], ratio) for ratio in RATIOS)


def case_two(points: PaperPoints) -> tuple[PaperPoint, ...]:
    """Least displacement, rated speed, over pressure."""
    first = points.at(RATED, near_zero(points.pump), LOW)
    return (first, *points.over_pressure(RATED, LOW))


def case_three(points: PaperPoints) -> PaperPoint:
    """The rated point."""
    return points.at(RATED, PRESSURES[-1], FULL)


def drain_for_share(split: LossSplit, share: float, fall: float) -> float:
    """Flow (m3/s) into the case, over a pressure drop (Pa), that gives this hydromechanical share."""
    return (split.hydromechanical / share - split.hydromechanical - split.volumetric) / fall


def share_with_drain(split: LossSplit, drain: float, fall: float) -> float:
    """Hydromechanical share of the losses with an additional flow (m3/s) into the case, over its pressure drop (Pa)."""
    return split.hydromechanical / (split.hydromechanical + split.volumetric + drain * fall)


def _field(points: PaperPoints, reading: LossReading) -> FigureField:
    rows = [[points.at(RATED, p, ratio).overall(reading) for ratio in RATIOS] for p in PRESSURES]
    return FigureField(
        FigureAxis("overall efficiency", Unit.SHARE), np.array(RATIOS), np.array(PRESSURES), np.array(rows)
    )


def _best_point(field: FigureField) -> Curve:
    """Place of the best efficiency."""
    row, column = np.unravel_index(int(np.argmax(field.values)), field.values.shape)
    best = Unit.SHARE.factor * float(field.values[row, column])
    return Curve(f"best {best:.1f} %", field.x[column : column + 1], field.y[row : row + 1])


def _best_reason(points: PaperPoints, best: float, reading: LossReading) -> str:
    """Losses at the best point; where oil is trapped at the inner dead centre, the best efficiency without it."""
    at = max(
        (Place(RATED, p, ratio) for p in PRESSURES for ratio in RATIOS),
        key=lambda one: points.points[one].overall(reading),
    )
    stated = points.points[at]
    if points.pump.ports.kidney_end >= LATE_END:
        loss, shaft = stated.pair_losses(reading).sum(), stated.bench.shaft_torque * stated.bench.shaft_speed
        return (
            f"of {shaft:.0f} W at the shaft the seven pairs take {loss:.0f} W and the ports {stated.throttling:.0f} W; "
            "the rest of the loss is leakage and compression"
        )
    open_longer = PaperWork(without_trapped_oil(points.pump), points.fidelity).solved(at)
    own = open_longer.overall(reading)
    text = (
        f"the ports throttle {stated.throttling:.0f} W at this point. With kidneys that close at "
        f"{np.degrees(LATE_END):.0f} deg, not at the assumed {np.degrees(points.pump.ports.kidney_end):.0f} deg, they "
        f"throttle {open_longer.throttling:.0f} W, and the efficiency is {100.0 * own:.1f} %, not {100.0 * best:.1f} %"
    )
    if reading is LossReading.MIXED:
        return text
    mixed = 100.0 * open_longer.overall(LossReading.MIXED)
    return (
        f"{text}. Without the {sum(stated.viscous):.0f} W of the films' shear, which the paper's coefficients include, "
        f"it is {mixed:.1f} %"
    )


def without_trapped_oil(pump: PumpDescription) -> PumpDescription:
    """The pump with kidneys that shut at LATE_END, if they shut earlier."""
    late = max(pump.ports.kidney_end, LATE_END)
    return replace(pump, ports=replace(pump.ports, kidney_end=late))


def _judged_cases(points: PaperPoints, reading: LossReading) -> Iterator[Judged]:
    every = (*case_one(points), *case_two(points), case_three(points))
    found = [paper_efficiency(one.read(reading)) for one in every]
    less = range_of(one.volumetric - one.hydromechanical for one in found)
    yield judge(CLAIMS["fig3.volumetric"], less, reading=reading)
    splits = [one.split(reading) for one in every]
    over = range_of(split.hydromechanical / split.volumetric for split in splits)
    yield judge(CLAIMS["fig3.greater"], over, reading=reading)
    first, second = (
        range_of(one.split(reading).hydromechanical_share for one in case)
        for case in (case_one(points), case_two(points))
    )
    yield judge(CLAIMS["fig3.case1"], first, reading=reading, reason=_needed_drain(points, reading))
    yield judge(CLAIMS["fig3.case2"], second, reading=reading, reason=_steady_drain(points, reading))


def _falls(point: PaperPoint) -> float:
    return point.bench.delivery_pressure - point.bench.drain_pressure


def _needed_drain(points: PaperPoints, reading: LossReading) -> str:
    """The flow into the case that Case 1 needs, and its effect on Case 2 by its law of pressure."""
    expected = CLAIMS["fig3.case1"].expected
    needed = [
        drain_for_share(one.split(reading), share, _falls(one))
        for one in case_one(points)
        for share in (expected.low, expected.high)
    ]
    one, last = case_one(points)[0], case_two(points)[-1]
    least = drain_for_share(one.split(reading), expected.high, _falls(one))
    rises = _falls(last) / _falls(one)
    laminar, orifice = (
        share_with_drain(last.split(reading), least * more, _falls(last)) for more in (rises, rises**0.5)
    )
    stated = CLAIMS["fig3.case2"].expected.low
    left = [Range(one, one).text(Unit.SHARE) for one in (laminar, orifice, stated)]
    passes = "that of an orifice" if orifice >= stated else "one that hardly rises with pressure"
    return (
        f"the statement needs {range_of(needed).text(Unit.FLOW)} into the case at 5 MPa in addition to the gaps' flow. "
        f"The least of it gives a share of {left[0]} at 35 MPa and 13 % through laminar gaps, and of {left[1]} through "
        f"an orifice; Case 2 states {left[2]} or more. So it is no flow of the pump's gaps, but {passes}: control or "
        "flushing"
    )


def _steady_drain(points: PaperPoints, reading: LossReading) -> str:
    """The flow into the case that meets the lower end of Case 2, and its agreement with Case 1."""
    last, expected = case_two(points)[-1], CLAIMS["fig3.case2"].expected
    drain = drain_for_share(last.split(reading), expected.low, _falls(last))
    first = [share_with_drain(one.split(reading), drain, _falls(one)) for one in case_one(points)]
    return (
        f"a share of {Range(expected.low, expected.low).text(Unit.SHARE)} at 35 MPa needs "
        f"{Unit.FLOW.factor * drain:.1f} L/min into the case in addition to the gaps' flow. The same flow at every "
        f"pressure makes Case 1 {range_of(first).text(Unit.SHARE)}. Control or flushing flow of the bench is such a "
        "flow, that of a gap is not"
    )


def _case_panels(words: str, x: FigureAxis, at: np.ndarray, case: tuple[PaperPoint, ...]) -> Iterator[Panel]:
    found = [paper_efficiency(one.bench) for one in case]
    yield Panel(
        f"{words}: efficiencies", PanelKind.LINES, x, FigureAxis("efficiency", Unit.SHARE),
        (
            Curve("volumetric, Eq. (4)", at, np.array([one.volumetric for one in found])),
            Curve("mechanical, Eq. (5)", at, np.array([one.hydromechanical for one in found])),
            Curve("overall, Eq. (3)", at, np.array([one.overall for one in found])),
        ),
    )  # fmt: skip
    splits = [one.split(LossReading.WITH_SHEAR) for one in case]
    yield Panel(
        f"{words}: losses", PanelKind.LINES, x, FigureAxis("loss", Unit.POWER),
        (
            Curve("volumetric, Eq. (1)", at, np.array([one.volumetric for one in splits])),
            Curve("hydro-mechanical, Eq. (2)", at, np.array([one.hydromechanical for one in splits])),
        ),
    )  # fmt: skip


def _rated_panels(rated: PaperPoint) -> Iterator[Panel]:
    """Case 3, one point."""
    found, split = paper_efficiency(rated.bench), rated.split(LossReading.WITH_SHEAR)
    none = FigureAxis("", Unit.NUMBER)
    yield Panel(
        "Case 3: rated point, efficiencies", PanelKind.BARS, none, FigureAxis("efficiency", Unit.SHARE),
        (_bar("volumetric", found.volumetric), _bar("mechanical", found.hydromechanical),
         _bar("overall", found.overall)),
    )  # fmt: skip
    yield Panel(
        "Case 3: rated point, losses", PanelKind.BARS, none, FigureAxis("loss", Unit.POWER),
        (_bar("volumetric", split.volumetric), _bar("hydro-mechanical", split.hydromechanical)),
    )  # fmt: skip


def _bar(name: str, value: float) -> Curve:
    return Curve(name, np.zeros(1), np.array([value]))
