"""Recordings of the ZeMA hydraulic rig (UCI repository 447) in the form that `swashfilm diagnose` reads.

    python examples/uci_hydraulic/rig.py DATA FOLDER [--leak 0|1|2] [--cooler 3|20|100] [--picture FILE.png]

DATA: folder of the repository's files (CC BY 4.0; cite Helwig, Pignanelli, Schuetze, I2MTC 2015,
doi 10.1109/I2MTC.2015.7151267). One row is one stable cycle of 60 s: means over its seconds 30 to 57, in which
valve and pressure are constant. Pump leakage is a bypass orifice that the rig switches on; the recording has no
column of it. The source recorded the motor's electric power, but not shaft speed, displacement and torque.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from reynolds import Array

STEADY = slice(30, 58)  # s of a cycle
WORKING = 7.0  # L/min: below it the circuit, not the pump, decides the flow
CHANNELS = {"PS1": "p_out_bar", "FS1": "Q_out_lpm", "EPS1": "electric_power_W", "TS1": "T_out_degC"}
COOLER, VALVE, LEAK, ACCUMULATOR, UNSTABLE = range(5)  # columns of profile.txt

FORM = """format = 1
title = "ZeMA rig, pump leakage {leak}, cooler {cooler} %"
circuit = "open"
pressure_reference = "gauge"       # not stated by the source; at 150 bar of no consequence
order = "cycles in the order in which they ran"

[steady]
file = "steady.csv"
repeats = "set_point"              # same valve and accumulator; repeatability comes from these

[channel]
p_out = {{ column = "p_out_bar", unit = "bar" }}
Q_out = {{ column = "Q_out_lpm", unit = "L/min" }}
T_out = {{ column = "T_out_degC", unit = "degC" }}
electric_power = {{ column = "electric_power_W", unit = "W" }}
"""


def cycle_means(data: Path, leak: int, cooler: int) -> Array:
    """Return rows of set point, p_out bar, Q_out L/min, P W, T_out degC, one per stable cycle of this leakage.

    Cycles whose flow falls below `WORKING` are left out.
    """
    profile = np.loadtxt(data / "profile.txt")
    chosen = (profile[:, UNSTABLE] == 0) & (profile[:, LEAK] == leak) & (profile[:, COOLER] == cooler)
    means = [np.loadtxt(data / f"{name}.txt.gz")[chosen, STEADY].mean(axis=1) for name in CHANNELS]
    set_point = 1000 * profile[chosen, VALVE] + profile[chosen, ACCUMULATOR]
    rows = np.stack([set_point, *means], axis=1)
    return rows[rows[:, 2] >= WORKING]


def write_recording(rows: Array, folder: Path, leak: int, cooler: int) -> None:
    """Write recording.toml and steady.csv into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    head = ",".join(["set_point", *CHANNELS.values()])
    np.savetxt(folder / "steady.csv", rows, delimiter=",", header=head, comments="", fmt="%.6g")
    (folder / "recording.toml").write_text(FORM.format(leak=leak, cooler=cooler), "utf-8")


def main(words: Sequence[str]) -> None:
    """Write the recording that the command line asks for."""
    parser = argparse.ArgumentParser(description="One recording of the ZeMA rig.")
    parser.add_argument("data", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--leak", type=int, choices=(0, 1, 2), default=0)
    parser.add_argument("--cooler", type=int, choices=(3, 20, 100), default=100)
    parser.add_argument("--picture", type=Path)
    asked = parser.parse_args(words)
    rows = cycle_means(asked.data, asked.leak, asked.cooler)
    write_recording(rows, asked.folder, asked.leak, asked.cooler)
    print(f"{len(rows)} cycles in {asked.folder}")
    if asked.picture:
        draw(rows, asked.picture)


def draw(rows: Array, picture: Path) -> None:
    """Draw flow and power of the cycles over the temperature of the oil, coloured by pressure."""
    figure = Figure(figsize=(9.0, 3.6), layout="constrained")
    for axes, column, name in zip(figure.subplots(1, 2), (2, 3), ("flow [L/min]", "motor power [W]"), strict=True):
        dots = axes.scatter(rows[:, 4], rows[:, column], c=rows[:, 1], s=8)
        axes.set(xlabel="oil temperature [degC]", ylabel=name)
    figure.colorbar(dots, label="pressure [bar]")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1:])
