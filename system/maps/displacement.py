"""Derived displacement: the displacement at zero pressure difference from readings of flow (ISO 8426)."""

from dataclasses import dataclass, replace
from math import nan

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.estimation.folds import levels
from system.inputs.units import TURN

LEAST_LEVELS = 5  # speeds, and pressure differences, that ISO 8426-1:2025 requires


@dataclass(frozen=True)
class Derived:
    """A derived displacement in m3 per revolution with one sigma by its own scatter (nan: too few pressures).

    residual: rms of the displacements at each pressure difference about their line, m3; speeds, differences:
    numbers of levels used; notes: where these are fewer than the standard requires.
    """

    value: float
    sigma: float
    residual: float
    speeds: int
    differences: int
    notes: tuple[str, ...]


def toet_displacement(shaft_speed: Array, pressure_difference: Array, delivery_flow: Array) -> Derived:
    """The two-step method of Toet (ISO 8426-1:2025; Toet et al. 2019, Energies 12, 415).

    rad/s, Pa, m3/s (N,) of one displacement setting, each pump turn wholly filled: the caller leaves out points with a
    starved inlet. First the slope V(dp) of flow over speed at each level of the pressure difference: leakage, the same
    at every speed, is no part of it; then the line V(dp), read at dp = 0. Raises InputError for fewer than two pressure
    differences with two speeds each.
    """
    level, speed_level = levels(pressure_difference), levels(shaft_speed)
    own = [level == one for one in np.unique(level)]
    own = [points for points in own if np.unique(speed_level[points]).size > 1]
    if len(own) < 2:
        found = f"{len(own)} pressure differences with two speeds"
        raise InputError("readings", found, "flows at two speeds and two pressure differences at least")
    slopes = [TURN * _line(shaft_speed[points], delivery_flow[points])[1] for points in own]
    at = [float(np.mean(pressure_difference[points])) for points in own]
    speeds = min(np.unique(speed_level[points]).size for points in own)
    derived = _at_no_pressure(np.array(at), np.array(slopes), speeds)
    return replace(derived, notes=(*_few(speeds, "speeds"), *derived.notes))


def _at_no_pressure(difference: Array, displacement: Array, speeds: int) -> Derived:
    """The line of displacement over pressure difference at 0."""
    value, slope = _line(difference, displacement)
    left = displacement - value - slope * difference
    count = len(difference)
    centred = difference - difference.mean()
    spread = np.sqrt(1.0 / count + difference.mean() ** 2 / (centred @ centred))
    sigma = float(np.sqrt(left @ left / (count - 2)) * spread) if count > 2 else nan
    notes = _few(count, "pressure differences")
    return Derived(value, sigma, float(np.sqrt(np.mean(left**2))), speeds, count, notes)


def _few(count: int, what: str) -> tuple[str, ...]:
    return (f"{count} {what}, where ISO 8426 asks for {LEAST_LEVELS}",) if count < LEAST_LEVELS else ()


def _line(x: Array, y: Array) -> tuple[float, float]:
    """Value at 0 and slope of the least squares line."""
    centred = x - x.mean()
    slope = float(centred @ (y - y.mean()) / (centred @ centred))
    return float(y.mean() - slope * x.mean()), slope
