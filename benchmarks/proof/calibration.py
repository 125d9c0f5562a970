"""Whether probabilities mean what they say, on the mix of cases that the priors declare."""

from __future__ import annotations

from collections.abc import Sequence
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
    return float(sum(share * abs(told - true) for told, true, share in bins(outcomes)))


def bins(outcomes: Sequence[Outcome]) -> list[tuple[float, float, float]]:
    """Mean probability, share of truth and weight of each bin that holds a case."""
    told, true, weight = weighted(outcomes)
    place = np.clip(np.digitize(told, BINS) - 1, 0, BINS.size - 2)
    found = []
    for each in np.unique(place):
        own = place == each
        share = weight[own].sum()
        found.append(
            (float(weight[own] @ told[own] / share), float(weight[own] @ true[own] / share), float(share))
        )
    return found


def draw(outcomes: Sequence[Outcome], path: Path) -> None:
    """The reliability diagram as a PNG: truth over probability, each bin's area its weight."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    told, true, share = np.array(bins(outcomes)).T
    figure, axes = plt.subplots(figsize=(4.2, 4.0), layout="constrained")
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=1)
    axes.scatter(told, true, s=20 + 400 * share, color="#1f5a8a", alpha=0.8, zorder=3)
    axes.set(xlim=(-0.05, 1.05), ylim=(-0.05, 1.05), xlabel="probability of the likeliest explanation",
             ylabel="share of cases in which it is the truth", aspect="equal")  # fmt: skip
    axes.set_title(f"{len(outcomes)} cases, weighted to the declared mix", fontsize=9)
    figure.savefig(path, dpi=130)
    plt.close(figure)
