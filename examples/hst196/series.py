"""Transmissions of a series by the clearances of the drawing, beside the 399 measured ones, in one picture.

    python examples/hst196/series.py MEASURED.csv [PICTURE.png]

The piston clearances of pump and motor scatter as [[tolerance.fit]] of ../pumps/hst196.toml states; all else is in the
middle of its range (band.py). All pistons of a machine may be of one clearance, the most that the drawing allows, or
each of its own, as parts that are not sorted: the machine then leaks as one whose pistons have the cube root of the
mean cube. MEASURED.csv: as for band.py.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import band
import numpy as np

from reynolds import Array
from system import drawing_of, drawn_series, load_pump

COUNT, SEED = 20_000, 196
NODES = 4
"""Clearances of the tolerance at which a machine is solved, for the cubic through them."""


def clearances(count: int, parts: int) -> Array:
    """Return clearances (count,) in m of machines, drawn as the pump file states; parts: clearances of a machine."""
    pump = load_pump(band.PUMP)
    (fit,) = pump.tolerance.fit
    drawn = replace(pump, tolerance=replace(pump.tolerance, fit=(replace(fit, parts=parts),)))
    return np.asarray(drawn_series(drawing_of(drawn), count, SEED).values[:, 0])


def efficiency_at(**clearance: float) -> float:
    """Return the efficiency with the clearance (m) of "pump" or "motor", all else in the middle."""
    value = band.middle(band.UNKNOWNS)
    for machine, size in clearance.items():
        value[f"bore diameter, {machine}"] = value[f"piston diameter, {machine}"] + 2.0 * size
    return band.efficiency(value)


def effects() -> dict[str, np.polynomial.Polynomial]:
    """Return the change of the efficiency by the clearance (m) of either machine, from that in the middle."""
    low, high = 22.9e-6, 34.3e-6
    nodes = low + (high - low) * 0.5 * (1.0 - np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES))
    middle = efficiency_at()
    found = {}
    for machine in band.MACHINES:
        changes = [efficiency_at(**{machine: node}) - middle for node in nodes]
        found[machine] = np.polynomial.Polynomial.fit(nodes, changes, NODES - 1)
    return found


def series(count: int = COUNT, parts: int = 1) -> Array:
    """Return the efficiency (count,) of transmissions; parts: pistons of a machine with a clearance of their own."""
    drawn = np.split(clearances(2 * count, parts), 2)
    changes = [effect(own) for effect, own in zip(effects().values(), drawn, strict=True)]
    return np.asarray(efficiency_at() + sum(changes))


def picture(measured: Array, alike: Array, unlike: Array, path: Path) -> None:
    """Draw the three distributions about their own means, and where the means lie."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 3.8), layout="constrained")
    whole, about = figure.subplots(1, 2)
    names = ("399 measured units", "drawing, pistons of a machine alike", "drawing, each piston its own")
    for values, name, colour in zip((measured, alike, unlike), names, ("#888888", "#3c7a8c", "#b5523b"), strict=True):
        percent = 100.0 * values
        whole.hist(percent, bins=np.arange(85.0, 96.0, 0.1), density=True, alpha=0.55, color=colour, label=name)
        spread = f"{name}: {np.std(percent, ddof=1):.2f}"
        about.hist(
            percent - percent.mean(), bins=np.arange(-2.5, 2.5, 0.1), density=True, histtype="step", linewidth=1.8,
            color=colour, label=spread,
        )  # fmt: skip
    whole.set(xlabel="motor over pump speed / %", ylabel="density / (1/%)", yscale="log", ylim=(1e-2, 2e1))
    whole.legend(fontsize=8)
    about.set(xlabel="from the mean of each / points", title="standard deviation in points")
    about.legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main(arguments: list[str]) -> None:
    """Print mean and standard deviation of each distribution; draw them where a picture is named."""
    measured = band.measured(Path(arguments[0]))
    alike, unlike = series(), series(parts=9)
    for name, values in (("measured", measured), ("pistons alike", alike), ("each piston its own", unlike)):
        print(f"{name:20s} mean {values.mean():.2%}, standard deviation {np.std(values, ddof=1):.3%}")
    print(f"of the measured shared by forward and reverse: {band.shared_spread(Path(arguments[0])):.3%}")
    if len(arguments) > 1:
        picture(measured, alike, unlike, Path(arguments[1]))


if __name__ == "__main__":
    main(sys.argv[1:])
