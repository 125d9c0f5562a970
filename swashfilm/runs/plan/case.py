"""A test to plan, by a command line: pump, bench, planned points, suspects."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from diagnosis.next_point.meters import WORDS, meters
from diagnosis.next_point.operating_box import BenchBox, pump_box
from diagnosis.planning.design import Asked, spread_order
from diagnosis.planning.responses import expected_parameters
from diagnosis.planning.suspects import COST, suspect_names
from diagnosis.recording.model import RecordedChannel
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from swashfilm.console.floating_options import alike_faults
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text, option_value, whole
from swashfilm.console.levels import map_axis
from swashfilm.console.settings import set_values
from swashfilm.runs.map.command import LEVELS, by_option
from swashfilm.runs.plan.campaign_file import axis_values, read_campaign
from swashfilm.runs.plan.limits import AXES, beyond, limited, widened
from swashfilm.runs.plan.sensors import Bench, bench_of, further_names
from system.bench.points import BenchPoints
from system.description.pump import PumpDescription
from system.description.tolerances import Tolerances, tolerances
from system.effects.effect import EffectId
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.maps.plan import MapAxis, MapInput, map_plan
from system.maps.usual_levels import usual_axes
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import load_pump
from system.pump_file.operating import check_operating_point

USUAL = {MapInput.SPEED: 3, MapInput.PRESSURE: 3, MapInput.RATIO: 2}
"""Levels of the grid of a test without stated points."""
POSSIBLE = (5, 5, 3, 3, 2)
"""Levels over the box at which points may be added; the last of the inlet pressure, where it is an axis."""
ADDED, MOST_ADDED, MOST_POINTS = 24, 200, 1000
BOX = tuple(AXES.values())


@dataclass(frozen=True)
class PlanCase:
    """A test to plan: the requirements, the bench, the chosen suspects (None: all that these meters can show)."""

    pump: PumpDescription
    given: str
    tolerances: Tolerances
    asked: Asked
    meters: tuple[RecordedChannel, ...]
    names: tuple[str, ...] | None
    box: BenchBox


def planned_case(options: argparse.Namespace, plans: Sequence[str]) -> PlanCase:
    """Return the test of a command line, with a word of `plans` for --plan; raise InputFaults with every fault."""
    faults = [*_word_faults(options, plans)]
    set_keys = set_values(options.set, faults)
    axes = _stated_axes(options, faults)
    bench = bench_of(options.sensors, faults)
    most = whole(faults, "--add", options.add, ADDED, (0, MOST_ADDED), "a number of readings")
    more = whole(faults, "--add-meters", options.add_meters, 1, (0, len(WORDS)), "a number of meters")
    further = further_names(options.further, bench, faults)
    cost = _percent(options.cost, faults)
    apart = _sigma(options.apart, faults)
    expect(options.pump, "pump", "film")
    try:
        pump = load_pump(options.pump, set_keys)
    except InputFaults as reason:
        raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None
    faults += alike_faults(pump)
    box = limited(pump_box(pump), options.limit, faults)
    own = tolerances(pump)[0]
    channels = meters(pump, bench.stated)
    names = _names(options.suspects, suspect_names(expected_parameters(pump, channels, own)), bench, faults)
    planned, repeats, order = _planned(options, pump, box, axes, faults)
    box = widened(box, options.limit, axis_values(planned, BOX)) if planned else box
    faults += beyond(box, axis_values(planned, BOX), "--campaign" if options.campaign else "planned points")
    possible = _possible(pump, box) if not faults else BenchPoints(*(np.zeros(0) for _ in range(10)))
    if not faults and most and not len(possible.speed):
        faults.append(Fault("--limit", "no point that the pump can be driven at", "limits with one at least"))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    asked = Asked(
        _bench_points(planned, box, order), repeats, possible, bench.channels, most, cost, apart,
        meters=more, further=further,
    )  # fmt: skip
    return PlanCase(pump, given_text(options.pump, set_keys), own, asked, channels, names, box)


def _word_faults(options: argparse.Namespace, plans: Sequence[str]) -> Iterator[Fault]:
    if options.plan not in plans:
        yield Fault("--plan", repr(options.plan), f"one of {', '.join(plans)}", nearest_choice(options.plan, plans))
    if options.campaign is not None:
        for option in LEVELS:
            if option_value(options, option) is not None:
                yield Fault(option, "beside --campaign", "one of the two: the file states every point")


def _stated_axes(options: argparse.Namespace, faults: list[Fault]) -> dict[MapInput, MapAxis]:
    found = {}
    for option, (name, example, _) in LEVELS.items():
        if (text := option_value(options, option)) is not None:
            axis = map_axis(option, text, MapInput[name], example)
            if isinstance(axis, Fault):
                faults.append(axis)
            else:
                found[axis.input] = axis
    return found


def _percent(text: str | None, faults: list[Fault]) -> float:
    """Return a loss of efficiency as a share; COST where it is left out."""
    if text is None:
        return COST
    try:
        value = 0.01 * float(text.strip().removesuffix("%"))
    except ValueError:
        value = 0.0
    if not 1e-4 <= value <= 0.2:
        faults.append(Fault("--cost", repr(text), "points of efficiency, 0.01% to 20%", "1%"))
    return value


def _sigma(text: str | None, faults: list[Fault]) -> float | None:
    if text is None:
        return None
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 1.0 <= value <= 20.0:
        faults.append(Fault("--apart", repr(text), "a number of sigma, 1 to 20", "3.4"))
    return value


def _names(text: str | None, known: Sequence[str], bench: Bench, faults: list[Fault]) -> tuple[str, ...] | None:
    """Return the suspects that a text names, None for all; an effect's id stands for all its places."""
    if text is None or text.strip() == "all":
        return None
    count, found = len(faults), []
    for word in (one.strip() for one in text.split(",")):
        own = [name for name in known if word in (name, name.partition(".")[0])]
        if not own:
            faults.append(_unknown(word, known))
        lacking = [name for name in own if (meter := _meter(name)) and meter not in bench.channels]
        faults += [
            Fault(
                "--suspects", f"'{name}', the fault of a meter that the bench lacks", f"--sensors with {_meter(name)}"
            )
            for name in lacking
        ]
        found += own
    chosen = tuple(dict.fromkeys(found))
    if len(chosen) < 2 and len(faults) == count:
        faults.append(Fault("--suspects", f"one, '{text}'", "two at least, which are to be told apart, or all"))
    return chosen


def _unknown(word: str, known: Sequence[str]) -> Fault:
    ids = list(dict.fromkeys(name.partition(".")[0] for name in known))
    if any(word == one.value for one in EffectId):
        return Fault("--suspects", f"'{word}', which steady readings do not show", f"one of {', '.join(ids)}")
    near = nearest_choice(word, [*known, *ids])
    return Fault("--suspects", f"'{word}', nothing that is known", f"one of {', '.join(ids)}", near)


def _meter(name: str) -> str:
    """The channel of a meter whose fault a suspect is; empty for any other suspect."""
    for what in ("_offset", "_gain", "_drift"):
        if name.endswith(what):
            return name.removesuffix(what)
    return ""


def _planned(
    options: argparse.Namespace,
    pump: PumpDescription,
    box: BenchBox,
    axes: dict[MapInput, MapAxis],
    faults: list[Fault],
) -> tuple[tuple[OperatingPoint, ...], NDArray[np.int64], Array]:
    """Return the planned points, the readings at each, and their places in the order of driving, 0 to 1."""
    if options.campaign is not None:
        try:
            file = read_campaign(options.campaign, pump)
        except InputFaults as reason:
            raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None
        for point, line in zip(file.points, file.lines, strict=True):
            report = check_operating_point(pump, point)
            faults += [Fault(f"{one.path}, line {line}", one.found, one.expected, one.nearest) for one in report.faults]
        return file.points, file.repeats, np.arange(len(file.points)) / len(file.points)
    usual = {axis.input: axis for axis in usual_axes(pump)} if options.plan == "paper" else {}
    if options.plan == "grid":
        usual = {given: _usual(given, box) for given in USUAL}
    try:
        plan = map_plan(pump, list((usual | axes).values()))
        points = plan.points
    except InputError as reason:
        faults.append(Fault(reason.where, reason.found, reason.expected))
        return (), np.zeros(0, dtype=np.int64), np.zeros(0)
    if len(points) > MOST_POINTS:
        faults.append(Fault("planned points", str(len(points)), f"{MOST_POINTS} at most"))
        return (), np.zeros(0, dtype=np.int64), np.zeros(0)
    faults += by_option(plan.checked().faults)
    return points, np.ones(len(points), dtype=np.int64), spread_order(len(points))


def _usual(given: MapInput, box: BenchBox) -> MapAxis:
    lower, upper = box.ends[BOX.index(given)]
    return MapAxis(given, tuple(map(float, np.unique(np.linspace(lower, upper, USUAL[given])))))


def _possible(pump: PumpDescription, box: BenchBox) -> BenchPoints:
    """The points of the box at which the pump can be driven, after the planned ones in a mixed order."""
    levels = [np.unique(np.linspace(*ends, count)) for ends, count in zip(box.ends, POSSIBLE, strict=False)]
    found = []
    for place in product(*levels):
        point = operating_point(pump, **{axis.value: float(value) for axis, value in zip(BOX, place, strict=False)})
        if not check_operating_point(pump, point).faults:
            found.append(point)
    return _bench_points(found, box, spread_order(len(found), 7))


def _bench_points(points: Sequence[OperatingPoint], box: BenchBox, order: Array) -> BenchPoints:
    """Operating points as those of a bench: the inlet's oil colder than the case's by the usual warming in a case."""

    def column(name: str) -> Array:
        return np.array([getattr(point, name) for point in points], dtype=float)

    warm = column("temperature")
    return BenchPoints(
        speed=column("shaft_speed"), displacement_ratio=column("displacement_ratio"), p_out=column("delivery_pressure"),
        p_in=column("inlet_pressure"), p_case=column("case_pressure"), T_case=warm, T_in=warm - box.warmer,
        hours=np.full(len(points), np.nan), order=order, warming=np.zeros(len(points)),
    )  # fmt: skip
