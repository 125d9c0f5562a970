"""The leakage of one gap measured by itself: a test of two explanations that no point of a bench separates.

Explanations that act at different gaps change the case drain alike: within the tolerances of the films one gap's
leakage can replace another's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from diagnosis.next_point.forecast import Contender, Forecast
from diagnosis.next_point.operating_box import BenchBox
from diagnosis.recording.units import channel_unit, difference, reading
from diagnosis.report.format import PLACES, if_words, pressure_text
from diagnosis.study.model import Study
from diagnosis.thresholds import NextPointLimits
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.description.gap import Gap
from system.effects.components import Component
from system.estimation.posterior import values_at
from system.inputs.channels import ChannelName

LEAKS: Mapping[Gap, Component] = {
    Gap.PISTON: Component.PISTON_LEAKAGE,
    Gap.SLIPPER: Component.SLIPPER_LEAKAGE,
    Gap.VALVE_PLATE: Component.PLATE_LEAKAGE,
}
STEP = 0.1  # of slopes, in spreads of a parameter


@dataclass(frozen=True)
class GapLeakTest:
    """Leakage of one gap at a point by two explanations, SI, one sigma of a reading, and its gain in nats.

    between: the two explanations as text.
    """

    gap: Gap
    between: tuple[str, str]
    point: BenchPoints
    leaks: tuple[float, float]
    sigma: float
    gain: float

    @property
    def text(self) -> str:
        """The measurement, its operating point, and the expected values."""
        drain, unit = ChannelName.Q_CASE, channel_unit(ChannelName.Q_CASE)
        leaks = (
            f"{reading(drain, leak):.3g} {unit} {cause}"
            for leak, cause in zip(self.leaks, if_words(*self.between), strict=True)
        )
        speed, pressure, warm = (float(one[0]) for one in (self.point.speed, self.point.p_out, self.point.T_case))
        where = (
            f"{reading(ChannelName.SPEED, speed):.0f} r/min, {pressure_text(pressure)}, "
            f"{reading(ChannelName.T_CASE, warm):.0f} degC in the case"
        )
        return (
            f"Measure the leakage of {PLACES[self.gap]} by itself, by its own drain or a gauge of the film, at "
            f"{where}: {', '.join(leaks)}. The reading must be accurate to {difference(drain, self.sigma):.2g} {unit}."
        )


def gap_leak_test(
    study: Study, box: BenchBox, first: Contender, second: Contender, limits: NextPointLimits
) -> GapLeakTest | None:
    """The gap whose leak separates the two best at the box's highest pressure; None where none settles them.

    Settled: `limits.readings` readings give odds of 20 to 1 on average, whichever of the two is true. None too
    where the case drain is not measured: the noise of its meter is assumed for the leak.
    """
    meter = study.recording.channel(ChannelName.Q_CASE)
    if meter is None or ChannelName.Q_CASE not in study.channels:
        return None
    place = _loaded(box)
    known = [_leaks(study, contender, place) for contender in (first, second)]
    between = first.text, second.text
    found = []
    for at, gap in enumerate(LEAKS):
        (one, one_spread), (other, other_spread) = ((leak[at], spread[at]) for leak, spread in known)
        sigma = meter.sigma + limits.gauge * abs(one)
        first_spread, second_spread = (np.array([[each @ each / sigma**2]]) for each in (one_spread, other_spread))
        gain = float(Forecast(np.array([(other - one) / sigma]), first_spread, second_spread).gain(limits.readings))
        found.append(GapLeakTest(gap, between, place, (float(one), float(other)), float(sigma), gain))
    best = max(found, key=lambda each: each.gain)
    return best if best.gain >= limits.settled else None


def _loaded(box: BenchBox) -> BenchPoints:
    """The point of highest pressure and displacement at the middle of speeds and temperatures."""
    speed, pressure, ratio, temperature = box.ends
    levels = (sum(speed) / 2.0, pressure[1], ratio[1], sum(temperature) / 2.0)
    return box.points(tuple(np.array([level]) for level in levels))


def _leaks(study: Study, contender: Contender, point: BenchPoints) -> tuple[Array, Array]:
    """Leaks (3,) in SI at a point, and the factor (3, k) of the covariance that the parameters give them."""
    there, xi = contender.simulator.elsewhere(point), contender.posterior.xi
    drain = study.channels.index(ChannelName.Q_CASE)

    def leaks(numbers: Array) -> Array:
        parts = there.components(values_at(there.parameters, numbers))
        return np.array([parts[component][0, drain] for component in LEAKS.values()])

    def columns(here: Array) -> Iterator[Array]:
        for at in range(xi.size):
            moved = xi.copy()
            moved[at] += STEP if there.parameters[at].highest >= xi[at] + STEP else -STEP
            yield (leaks(moved) - here) / (moved[at] - xi[at])

    here = leaks(xi)
    slopes = np.stack(list(columns(here)), axis=1)
    return here, slopes @ np.linalg.cholesky(contender.posterior.covariance)
