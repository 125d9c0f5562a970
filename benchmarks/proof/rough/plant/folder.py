"""A rough recording on disk: pump.toml with the type plate, recording.toml, data.csv with commas or points."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .meters import Meters
from .pump import RPM, Array, Pump

PLATE = """name = "{title}"
format = 1

[pump]
displacement = "{size:g} cm3/rev"
pistons = {pistons}

[oil]
grade = "ISO VG {grade}"

[operating]
speed = "{speed:.0f} rpm"
displacement_ratio = 1.0
"""
HEAD = """format = 1
title = "{title}"
circuit = "open"
pressure_reference = "gauge"
oil = "ISO VG {grade}"

[series]
file = "data.csv"
time.column = "time_s"
time.unit = "s"

[channel]
"""


def write_folder(folder: Path, title: str, pump: Pump, meters: Meters, columns: dict[str, Array], commas: bool) -> None:
    """Write the recording into a folder, which must exist."""
    plate = PLATE.format(title=title, size=1e6 * pump.plate, pistons=pump.pistons, grade=pump.grade,
                         speed=pump.speed / RPM)  # fmt: skip
    (folder / "pump.toml").write_text(plate, encoding="utf-8")
    lines = [_channel(name, meters) for name in columns]
    text = HEAD.format(title=title, grade=pump.grade) + "\n".join(lines) + "\n"
    (folder / "recording.toml").write_text(text, encoding="utf-8")
    names = list(columns)
    rows = np.column_stack([np.arange(columns[names[0]].size), *columns.values()])
    formats = ["%d", *(f"%.{meters[name].digits}f" for name in names)]
    cells = [",".join(["time_s", *(meters[name].column for name in names)])]
    cells += [",".join(form % value for form, value in zip(formats, row, strict=True)) for row in rows]
    table = "\n".join(cells) + "\n"
    if commas:
        table = table.replace(",", ";").replace(".", ",")
    (folder / "data.csv").write_text(table, encoding="utf-8")


def _channel(name: str, meters: Meters) -> str:
    meter = meters[name]
    keys = [f'column = "{meter.column}"', f'unit = "{meter.unit}"', *([meter.stated] if meter.stated else [])]
    return f"{name} = {{ {', '.join(keys)} }}"
