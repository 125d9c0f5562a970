"""Volumetric efficiency of the HST 196 transmission: band predicted from its drawing, beside 399 measured units.

    python examples/hst196/band.py [MEASURED.csv] [--picture FILE.png]

Two equal machines of ../pumps/hst196.toml, pump and motor in a closed circuit, at the end-of-line test point: 1780
rpm, 207 against 14 bar, oil of 60 degC. The drawing's tolerances give the piston clearances. All other values that
decide leakage and compression are not given; each is drawn from the range and source that its `Unknown` names.
MEASURED.csv: hst196_production_tests.csv, the production tests of github.com/ivanokhotnikov/effmap.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import qmc

from reynolds import Array
from system import load_pump, operating_point, transmission

PUMP = Path(__file__).resolve().parents[1] / "pumps" / "hst196.toml"
INCH = 25.4e-3
SWEPT = 21.78e-6  # m3: 196 cm3/rev over nine pistons
MACHINES = ("pump", "motor")
HIGH, CHARGE = 207e5, 14e5  # Pa gauge
ATMOSPHERE = 101325.0  # Pa
LOAD = HIGH / 35e6
HOT = 60.0  # K: oil of 120 degC in the films
SLIP_OF_READING = 0.05  # of the input speed: a larger difference of forward and reverse is a wrong reading
SAMPLES = 256


@dataclass(frozen=True)
class Unknown:
    """An unknown value, evenly distributed from `low` to `high`, SI; `each`: pump and motor have their own."""

    name: str
    low: float
    high: float
    each: bool
    source: str


DRAWING = (
    Unknown("piston diameter", 1.1650 * INCH, 1.1653 * INCH, True, "the drawing"),
    Unknown("bore diameter", 1.1671 * INCH, 1.1677 * INCH, True, "the drawing"),
)
NOT_GIVEN = (
    Unknown("slipper film", 8e-6, 15e-6, True, "Xu et al. 2017 at 35 and 5 MPa; the data's author 15 um"),
    Unknown("valve plate film", 8e-6, 15e-6, True, "Xu et al. 2017 8 um, the data's author 15 um"),
    Unknown("piston eccentricity", 0.0, 1.0, True, "anywhere in the bore"),
    Unknown("bore opening at 35 MPa", 1.5e-6, 4e-6, False, "thick ring stiffened by its neighbours"),
    Unknown("slipper opening at 35 MPa", 1e-6, 3e-6, False, "dishing of the slipper, estimated"),
    Unknown("valve plate opening at 35 MPa", 2e-6, 5e-6, False, "block and plate, estimated"),
    Unknown("film heating", 0.0, 20.0, False, "0.45 K/MPa by throttling and as much by shear, at most"),
    Unknown("viscosity factor", 0.9, 1.1, False, "spread of an ISO VG grade, 10 %"),
    Unknown("bulk modulus", 1.3e9, 1.7e9, False, "the data's author 1.5 GPa, REF90 1.6 GPa, warm or cold"),
    Unknown("free air", 0.005, 0.02, False, "usual in circuits"),
    Unknown("dead volume over swept volume", 0.3, 1.3, False, "solid pistons to hollow ones; REF90 0.6"),
    Unknown("swash droop at 35 MPa", 0.002, 0.01, False, "stop and actuator give 0.2 to 1 %, estimated"),
)
UNKNOWNS = (*DRAWING, *NOT_GIVEN)


def columns(unknowns: Sequence[Unknown]) -> list[str]:
    """Return names of the drawn values: 'slipper film, pump' where each machine has its own."""
    return [name for unknown in unknowns for name in _names(unknown)]


def draw(unknowns: Sequence[Unknown], count: int, seed: int) -> Array:
    """Return values (count, columns) of a Latin hypercube over the ranges."""
    ends = np.array([(u.low, u.high) for u in unknowns for _ in _names(u)])
    cube = qmc.LatinHypercube(len(ends), seed=seed).random(count)
    return np.asarray(ends[:, 0] + cube * (ends[:, 1] - ends[:, 0]))


def middle(unknowns: Sequence[Unknown]) -> dict[str, float]:
    """Return the middle of every range by name."""
    return {name: 0.5 * (u.low + u.high) for u in unknowns for name in _names(u)}


def efficiency(value: Mapping[str, float]) -> float:
    """Return the test bench's volumetric efficiency: motor over pump speed of two machines of one displacement.

    `value` holds every column of DRAWING and NOT_GIVEN.
    """
    pump, motor = (load_pump(PUMP, keys_of(value, name)) for name in MACHINES)
    droop = 1.0 - value["swash droop at 35 MPa"] * LOAD
    point = operating_point(pump, displacement_ratio=droop)
    point = replace(point, viscosity=point.viscosity * value["viscosity factor"])
    return transmission(pump, motor, point).speed_ratio


def by_clearance() -> Array:
    """Return efficiency (2,) at the least and the largest clearance of every piston, all else in the middle."""
    ends = ((DRAWING[0].high, DRAWING[1].low), (DRAWING[0].low, DRAWING[1].high))
    known = middle(NOT_GIVEN)
    return np.array(
        [
            efficiency(known | {name: piston if "piston" in name else bore for name in columns(DRAWING)})
            for piston, bore in ends
        ]
    )


def sample(count: int, seed: int = 196) -> tuple[Array, Array]:
    """Return values (count, columns) of all unknowns and the efficiency (count,) of each."""
    names = columns(UNKNOWNS)
    values = draw(UNKNOWNS, count, seed)
    return values, np.array([efficiency(dict(zip(names, row, strict=True))) for row in values])


def shares(values: Array, found: Array) -> Array:
    """Return the share of the variance of `found` (n,) due to each column of `values` (n, k).

    Standardised slope times correlation (Pratt 1987): the sum is the share that a linear law explains, at most 1.
    """
    scaled = (values - values.mean(axis=0)) / values.std(axis=0)
    off = (found - found.mean()) / found.std()
    slopes, *_ = np.linalg.lstsq(scaled, off)
    return np.asarray(slopes * (off @ scaled) / len(off))


def measured(file: Path) -> Array:
    """Return motor over pump speed (n,), forward, of every unit tested."""
    return _speed_ratios(file, "forward")


def shared_spread(file: Path) -> float:
    """Return the standard deviation between units that forward and reverse share, root of their covariance.

    Clearances are the same both ways; other scatter is that of the test and of the direction. One unit with a
    third of the usual reverse speed is left out.
    """
    forward, reverse = (_speed_ratios(file, way) for way in ("forward", "reverse"))
    alike = np.abs(forward - reverse) < SLIP_OF_READING
    return float(np.sqrt(np.cov(forward[alike], reverse[alike])[0, 1]))


def _speed_ratios(file: Path, way: str) -> Array:
    """Return motor over pump speed (n,) one way of every unit tested forward."""
    with file.open(encoding="utf-8") as rows:
        tested = [row for row in csv.DictReader(rows) if float(row["forward_speed_rpm"] or 0.0) > 0.0]
    return np.array([float(row[f"{way}_speed_rpm"] or 0.0) for row in tested]) / 1780.0


def _names(unknown: Unknown) -> list[str]:
    return [f"{unknown.name}, {machine}" for machine in MACHINES] if unknown.each else [unknown.name]


def keys_of(value: Mapping[str, float], machine: str) -> dict[str, object]:
    """Return keys of the pump file for one of the two machines."""
    piston, bore = value[f"piston diameter, {machine}"], value[f"bore diameter, {machine}"]
    films = {
        "piston.radial_clearance": 0.5 * (bore - piston) + LOAD * value["bore opening at 35 MPa"],
        "slipper.film_thickness": value[f"slipper film, {machine}"] + LOAD * value["slipper opening at 35 MPa"],
        "valve_plate.film_thickness": value[f"valve plate film, {machine}"]
        + LOAD * value["valve plate opening at 35 MPa"],
    }
    # Free air at one atmosphere, compressed isothermally, adds its compliance to that of the oil.
    low, high = CHARGE + ATMOSPHERE, HIGH + ATMOSPHERE
    air = value["free air"] * ATMOSPHERE / (low * high)
    return {
        **{key: f"{film * 1e6} um" for key, film in films.items()},
        "piston.eccentricity_ratio": min(value[f"piston eccentricity, {machine}"], 0.999),
        "pump.dead_volume": f"{value['dead volume over swept volume'] * SWEPT * 1e6} cm3",
        "oil.bulk_modulus": f"{1e-9 / (1.0 / value['bulk modulus'] + air)} GPa",
        "operating.temperature": f"{60.0 + value['film heating']} degC",
    }


def main(arguments: list[str]) -> None:
    """Print the band, its causes, and the measured spread beside it; draw them where a picture is named."""
    parser = argparse.ArgumentParser(description="Efficiency of the HST 196 transmission from its drawing.")
    parser.add_argument("measured", type=Path, nargs="?")
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args(arguments)
    tight, wide = 100.0 * by_clearance()
    print(f"clearance alone, 22.9 .. 34.3 um, the rest in the middle: {tight:.2f} .. {wide:.2f} %")
    hot = 100.0 * efficiency(middle(UNKNOWNS) | {"film heating": HOT})
    print(f"all in the middle but for films {HOT:.0f} K hotter than the oil: {hot:.2f} %")
    values, found = sample(SAMPLES)
    low, high = 100.0 * np.quantile(found, (0.05, 0.95))
    print(f"all unknown values drawn, 90 %: {low:.2f} .. {high:.2f} %")
    parts = dict(zip(columns(UNKNOWNS), shares(values, found), strict=True))
    print("share of the variance, both machines together:")
    for unknown in UNKNOWNS:
        print(f"  {sum(parts[name] for name in _names(unknown)):6.1%}  {unknown.name} ({unknown.source})")
    units = np.array([])
    if asked.measured:
        units = measured(asked.measured)
        print(f"measured on {units.size} units: {units.mean():.2%}, standard deviation {units.std(ddof=1):.2%}")
        print(f"of it shared by forward and reverse: {shared_spread(asked.measured):.2%}")
    if asked.picture:
        draw_band(found, units, {one.name: sum(parts[name] for name in _names(one)) for one in UNKNOWNS}, asked.picture)


def draw_band(predicted: Array, units: Array, parts: Mapping[str, float], picture: Path) -> None:
    """Draw the predicted band beside the measured units, and what the values share of its variance."""
    figure = Figure(figsize=(10.0, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    bins = np.arange(85.0, 98.0, 0.25)
    for values, name in ((predicted, "predicted, unknown values drawn"), (units, "measured units")):
        if values.size:
            left.hist(100.0 * values, bins=bins, density=True, alpha=0.6, label=name)
    left.set(xlabel="motor over pump speed [%]", ylabel="density [1/%]")
    left.legend(fontsize="small")
    ordered = sorted(parts, key=lambda name: parts[name])
    right.barh(ordered, [100.0 * parts[name] for name in ordered])
    right.set(xlabel="share of the variance [%]")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1:])
