"""A recording on disk in the documented form: recording.toml, steady.csv, traces.csv."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .sensors import METERS, TRACE_NOISE, Meter, Readings

BENCH = Path(__file__).parents[2] / "examples" / "recordings" / "bench_pump.toml"
"""The pump of the recordings."""
HEAD = """format = 1
title = "{title}"
pump = "ref90"
circuit = "{circuit}"
pressure_reference = "absolute"
oil = "ISO VG 46"
order = "points stand in the order in which they were recorded"

[steady]
file = "steady.csv"

[channel]
"""
TRACES = """
[traces]
file = "traces.csv"
point = "point"
angle = {{ column = "angle_deg", unit = "deg" }}
p_chamber = {{ column = "p_chamber_bar", unit = "bar", sigma = {sigma} }}
"""
DOCUMENTED = {"ratio": "displacement_ratio"}  # names of the recording's form that differ from the plant's


def write_recording(folder: Path, title: str, readings: Readings, circuit: str) -> None:
    """Write the recording into a folder, which must exist."""
    text = HEAD.format(title=title, circuit=circuit) + "".join(
        _channel(name, METERS[name]) for name in readings.columns
    )
    if readings.traces:
        text += TRACES.format(sigma=TRACE_NOISE / 1e5)
    (folder / "recording.toml").write_text(text, encoding="utf-8")
    names = list(readings.columns)
    rows = np.column_stack([np.arange(1, len(readings.columns[names[0]]) + 1), *readings.columns.values()])
    formats = ["%d", *(f"%.{METERS[name].digits}f" for name in names)]
    head = ",".join(["point", *(METERS[name].column for name in names)])
    np.savetxt(folder / "steady.csv", rows, formats, delimiter=",", header=head, comments="")
    if readings.traces:
        rows = np.concatenate(
            [np.column_stack([np.full(a.size, point + 1), a, p]) for point, (a, p) in readings.traces.items()]
        )
        head = "point,angle_deg,p_chamber_bar"
        np.savetxt(folder / "traces.csv", rows, ["%d", "%.2f", "%.3f"], delimiter=",", header=head, comments="")


def _channel(name: str, meter: Meter) -> str:
    keys = [f'column = "{meter.column}"', f'unit = "{meter.unit}"', f"sigma = {meter.sigma}"]
    keys += [f"sigma_relative = {meter.relative}"] if meter.relative else []
    unit = "K" if meter.unit == "degC" else meter.unit
    zero = f"{meter.zero}" if unit == "1" else f'"{meter.zero} {unit}"'
    keys += [f"calibration = {{ gain = {meter.gain}, zero = {zero} }}"]
    return f"{DOCUMENTED.get(name, name)} = {{ {', '.join(keys)} }}\n"
