"""Calibration of the stated probabilities, on the mix of cases that the priors declare."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .judged import confidence
from .outcome import Outcome

MIX = {
    "no_mismatch": 0.5, "missing_physics": 0.3, "sensor_fault": 0.1, "wrong_parameter": 0.1,
    "unknown_physics": 0.1,
}  # fmt: skip
"""Shares of the kinds of truth, as in thresholds.toml [prior]; divided by their sum."""
BINS = np.linspace(0.0, 1.0, 11)


def weighted(outcomes: Sequence[Outcome]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Probability of the likeliest explanation, whether it is true, and the case's weight in the mix."""
    kinds = [one.truth for one in outcomes]
    weight = np.array([MIX[kind] / kinds.count(kind) for kind in kinds])
    told, true = zip(*(confidence(one) for one in outcomes), strict=True)
    return np.array(told), np.array(true, dtype=float), weight / weight.sum()


def brier(outcomes: Sequence[Outcome]) -> float:
    """Mean square of probability less truth (Brier 1950)."""
    told, true, weight = weighted(outcomes)
    return float(weight @ (told - true) ** 2)


def calibration_error(outcomes: Sequence[Outcome]) -> float:
    """Expected calibration error over ten bins (Naeini 2015)."""
    return sum(one.weight * abs(one.told - one.true) for one in bins(outcomes))


@dataclass(frozen=True)
class Bin:
    """Cases of similar probability: its mean, the share in which it is true, weight in the mix, number.

    alike: number of cases of equal weight that tell as much (Kish 1965).
    """

    told: float
    true: float
    weight: float
    cases: int
    alike: float


def bins(outcomes: Sequence[Outcome]) -> list[Bin]:
    """Each bin that holds a case."""
    told, true, weight = weighted(outcomes)
    place = np.clip(np.digitize(told, BINS) - 1, 0, BINS.size - 2)
    found = []
    for each in np.unique(place):
        own = place == each
        share = weight[own].sum()
        mean_told, mean_true = (float(weight[own] @ values[own] / share) for values in (told, true))
        alike = float(share**2 / (weight[own] ** 2).sum())
        found.append(Bin(mean_told, mean_true, float(share), int(own.sum()), alike))
    return found


def wilson(hits: float, cases: float, z: float = 1.96) -> tuple[float, float]:
    """Wilson's (1927) interval of a share."""
    if cases == 0:
        return 0.0, 1.0
    share, weight = hits / cases, z * z / cases
    middle, half = share + weight / 2.0, z * np.sqrt(share * (1.0 - share) / cases + weight / (4.0 * cases))
    return max(0.0, float((middle - half) / (1.0 + weight))), float((middle + half) / (1.0 + weight))


def draw(outcomes: Sequence[Outcome], path: Path) -> None:
    """The reliability diagram as a PNG: truth over probability, area by weight, Wilson's 95 % intervals.

    The intervals are those of as many cases of equal weight as tell as much: rare kinds weigh more in the mix.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 5.0), layout="constrained")
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=1)
    for one in bins(outcomes):
        axes.vlines(one.told, *wilson(one.true * one.alike, one.alike), color="#9aa4ab")
        axes.scatter(one.told, one.true, s=20 + 400 * one.weight, color="#1f5a8a", alpha=0.8, zorder=3)
        axes.annotate(f" {one.cases}", (one.told, one.true), (6, -10), textcoords="offset points", fontsize=8)
    axes.set(xlim=(-0.05, 1.05), ylim=(-0.05, 1.05), xlabel="probability of the likeliest explanation",
             ylabel="share of cases in which it is the truth", aspect="equal")  # fmt: skip
    axes.set_title(f"{len(outcomes)} cases, weighted to the declared mix; numbers: cases", fontsize=9)
    figure.savefig(path, dpi=130)
