"""Raw traces of a profilometer: tilt and waves below a cutoff removed."""

from collections.abc import Sequence

import numpy as np

from reynolds.numerics.arrays import Array

HALF = np.log(2.0) / np.pi
"""Square of the Gaussian filter's constant 0.4697: a wave as long as the cutoff keeps half its amplitude."""
STEPS = 10
"""Points of a smoothed trace per cutoff: straight lines between them miss 5 % of such a wave at its crests."""


def levelled(places: Array, depths: Array, unworn: Sequence[tuple[float, float]]) -> Array:
    """Depths (n,) m over their least-squares line through the points of the ranges (from, to), m.

    Zero depth is then the unworn face; offset and tilt of the trace do not matter. Two points or more lie there.
    """
    chosen = np.logical_or.reduce([(places >= start) & (places <= end) for start, end in unworn])
    return np.asarray(depths - np.polynomial.Polynomial.fit(places[chosen], depths[chosen], 1)(places))


def smoothed(places: Array, depths: Array, cutoff: float, at: Array) -> Array:
    """Depths (m) at places `at` (m,), smoothed by a Gaussian of a cutoff wavelength (m), from (n,) rising places.

    Line of least squares about each place with the weights exp(-pi (x/cutoff)^2/0.4697^2), each point standing for the
    length up to the middles between it and its neighbours. Away from the ends and on equal steps that is the Gaussian
    filter of ISO 16610-21; at the ends and on unequal steps a straight trace is unchanged (ISO 16610-28). Points are to
    lie closer than half the cutoff.
    """
    middles = 0.5 * (places[1:] + places[:-1])
    share = np.diff(np.concatenate([places[:1], middles, places[-1:]]))
    found = np.empty(len(at))
    for k, place in enumerate(at):
        offset = places - place
        weight = share * np.exp(-np.pi / HALF * (offset / cutoff) ** 2)
        moments = [np.sum(weight * offset**power) for power in range(3)]
        sums = np.sum(weight * depths), np.sum(weight * offset * depths)
        found[k] = (moments[2] * sums[0] - moments[1] * sums[1]) / (moments[0] * moments[2] - moments[1] ** 2)
    return found


def grid(first: float, last: float, cutoff: float) -> Array:
    """Places (m) from first to last, a tenth of the cutoff apart, the last step up to one and a half of it."""
    step = cutoff / STEPS
    return np.append(np.arange(first, last - 0.5 * step, step), last)
