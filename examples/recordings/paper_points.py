"""An artificial recording over the paper's 112 points: REF90 with other friction, read by a good bench.

    python examples/recordings/paper_points.py examples/recordings/paper_points

writes recording.toml and steady.csv into that folder, the same at each call. Nothing in it was measured. The pump
is REF90 but for the coefficients of PLANTED; each reading is the lumped simulation's and one draw of the sigma
that recording.toml states for its channel. The bench's circuit is closed, pressures are gauge.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from system.paper.made_readings import PLAN
from system.points.lumped import lumped_point
from system.pump.bench import BenchReading
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import load_pump

PLANTED = {"piston_cylinder": 0.030, "slipper_swash_plate": 0.0070, "valve_plate_cylinder": 0.013}
SEED = 112


@dataclass(frozen=True)
class Meter:
    """A channel: unit, SI in one of it, zero in SI, one sigma (so much, and so much of the reading)."""

    channel: str
    unit: str
    factor: float
    zero: float
    sigma: float
    relative: float
    digits: int


METERS = (
    Meter("speed", "rpm", np.pi / 30.0, 0.0, 0.5, 0.0, 2),
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
oil = "ISO VG 46"
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
    true = np.array(list(map(_reading, *zip(*PLAN, strict=True))))
    sigma = np.array([one.sigma for one in METERS]) + np.array([one.relative for one in METERS]) * np.abs(true)
    read = true + sigma * np.random.default_rng(SEED).standard_normal(true.shape)
    rows = [",".join(one.channel for one in METERS)]
    rows += [",".join(f"{value:.{one.digits}f}" for value, one in zip(row, METERS, strict=True)) for row in read]
    (folder / "steady.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")


def _reading(speed: float, pressure: float, ratio: float) -> list[float]:
    """What every channel shows at a point without noise, in its unit."""
    pump = load_pump("ref90")
    pump = replace(pump, friction=replace(pump.friction, **PLANTED))
    at = operating_point(pump, shaft_speed=speed, delivery_pressure=pressure, displacement_ratio=ratio)
    shown = _shown(at, lumped_point(pump, at).bench)
    return [(shown[one.channel] - one.zero) / one.factor for one in METERS]


def _shown(at: OperatingPoint, bench: BenchReading) -> dict[str, float]:
    """The channels in SI."""
    return {
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


if __name__ == "__main__":
    main()
