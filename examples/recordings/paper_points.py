"""An artificial recording over the paper's 112 points: `ref90` with other friction on a good bench.

    python examples/recordings/paper_points.py examples/recordings/paper_points

writes recording.toml and steady.csv into that folder, the same at each call. Nothing in it was measured. The pump
is `ref90` with the coefficients of PLANTED. Each reading is that of the lumped simulation plus one draw of the
noise that recording.toml states for its channel. The bench's circuit is closed, pressures are gauge.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

import numpy as np

from system import load_pump, lumped_point, operating_point

RPM = np.pi / 30.0
SPEEDS = [RPM * speed for speed in (1000.0, 1300.0, 1700.0, 2100.0)]  # rad/s
PRESSURES = [1e6 * pressure for pressure in (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0)]  # Pa
RATIOS = (0.28, 0.51, 0.77, 1.0)
PLANTED = {"piston_cylinder": 0.030, "slipper_swash_plate": 0.0070, "valve_plate_cylinder": 0.013}
SEED = 112


@dataclass(frozen=True)
class Meter:
    """A channel: its unit, `factor` and `zero` of the unit in SI, one sigma as a value and as a share."""

    channel: str
    unit: str
    factor: float
    zero: float
    sigma: float
    relative: float
    digits: int


METERS = (
    Meter("speed", "rpm", RPM, 0.0, 0.5, 0.0, 2),
    Meter("displacement_ratio", "1", 1.0, 0.0, 0.0005, 0.0, 4),
    Meter("p_out", "bar", 1e5, 0.0, 0.15, 0.0, 2),
    Meter("p_in", "bar", 1e5, 0.0, 0.02, 0.0, 3),
    Meter("p_case", "bar", 1e5, 0.0, 0.01, 0.0, 3),
    Meter("T_in", "degC", 1.0, 273.15, 0.1, 0.0, 2),
    Meter("T_case", "degC", 1.0, 273.15, 0.1, 0.0, 2),
    Meter("Q_out", "L/min", 1.0 / 6e4, 0.0, 0.08, 0.0006, 3),
    Meter("Q_in", "L/min", 1.0 / 6e4, 0.0, 0.12, 0.001, 3),
    Meter("Q_case", "L/min", 1.0 / 6e4, 0.0, 0.015, 0.004, 4),
    Meter("torque", "N*m", 1.0, 0.0, 0.25, 0.0006, 3),
)
HEAD = """# Artificial: written by examples/recordings/paper_points.py, nothing in it was measured.
format = 1
title = "the paper's 112 points, artificial"
pump = "ref90 with other friction"
circuit = "closed"
oil = "ISO VG 68"
pressure_reference = "gauge"

[steady]
file = "steady.csv"

[channel]
"""


def main() -> None:
    """Write the recording into the folder that the command line names."""
    words = argparse.ArgumentParser(description="Write an artificial recording over the paper's 112 points.")
    words.add_argument("folder", type=Path)
    folder = words.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    channels = "".join(
        f'{one.channel} = {{ column = "{one.channel}", unit = "{one.unit}", sigma = {one.sigma}'
        + (f", sigma_relative = {one.relative}" if one.relative else "")
        + " }\n"
        for one in METERS
    )
    (folder / "recording.toml").write_text(HEAD + channels, encoding="utf-8")
    true = np.array([_reading(*place) for place in product(RATIOS, SPEEDS, PRESSURES)])
    sigma = np.array([one.sigma for one in METERS]) + np.array([one.relative for one in METERS]) * np.abs(true)
    read = true + sigma * np.random.default_rng(SEED).standard_normal(true.shape)
    rows = [",".join(one.channel for one in METERS)]
    rows += [",".join(f"{value:.{one.digits}f}" for value, one in zip(row, METERS, strict=True)) for row in read]
    (folder / "steady.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")


def _reading(ratio: float, speed: float, pressure: float) -> list[float]:
    """Return the reading of every channel at a point without noise, in its unit."""
    pump = load_pump("ref90")
    pump = replace(pump, friction=replace(pump.friction, **PLANTED))
    at = operating_point(pump, shaft_speed=speed, delivery_pressure=pressure, displacement_ratio=ratio)
    bench = lumped_point(pump, at).bench
    value = {
        "speed": bench.shaft_speed,
        "displacement_ratio": at.displacement_ratio,
        "p_out": bench.delivery_pressure,
        "p_in": bench.inlet_pressure,
        "p_case": bench.drain_pressure,
        "T_in": at.temperature,
        "T_case": at.temperature,
        "Q_out": bench.delivery_flow,
        "Q_in": bench.inlet_flow,
        "Q_case": bench.drain_flow,
        "torque": bench.shaft_torque,
    }
    return [(value[one.channel] - one.zero) / one.factor for one in METERS]


if __name__ == "__main__":
    main()
