"""Two pumps in one recording: a column that names them, or a flow a turn that jumps for good beside its inputs."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from diagnosis.recording.breaks.level_step import LevelStep, law_of, level_step
from diagnosis.recording.tables.table import TableColumns
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName

JUMP = np.log(1.1)  # of the flow a turn that torque confirms: more than any two states of one pump
JUMP_ALONE = np.log(1.15)  # of the flow alone
LIKE = 0.5  # of the flow's jump, to which the torque's jump is equal
LEAST_ROWS = 2  # of each name
NAMED = 4  # names that a text lists
_PUMP = r"(pump|pumpe|specimen|uut|dut|pr(ü|ue)fling)([ _.-]*(id|no|nr|number|nummer|name))?"
_SERIAL = r"((pump|pumpe|unit|device|part|specimen)[ _.-]*)?(serial([ _.-]*(id|no|nr|number))?|s/?n|seriennummer)"
IDENTITY = re.compile(rf"({_PUMP}|{_SERIAL})\.?", re.IGNORECASE)
"""Head of a column that names the pump of each row."""


def pumps_named(columns: TableColumns, used: Collection[str]) -> Iterator[tuple[str, str]]:
    """Yield (column, rows of each name as text) of columns not in use that name more than one pump."""
    numbers = {name: tuple("" if np.isnan(v) else f"{v:g}" for v in column) for name, column in columns.values.items()}
    for name, cells in {**numbers, **columns.words}.items():
        if name not in used and IDENTITY.fullmatch(name.strip()):
            rows: dict[str, list[int]] = {}
            for row, cell in enumerate(cells, start=1):
                if cell:
                    rows.setdefault(cell, []).append(row)
            if sum(len(own) >= LEAST_ROWS for own in rows.values()) > 1:
                yield name, _listed(rows)


def _listed(rows: Mapping[str, Sequence[int]]) -> str:
    shown = [f"{name} (rows {own[0]} to {own[-1]})" for name, own in rows.items()]
    more = f" and {len(shown) - NAMED} more" if len(shown) > NAMED else ""
    return ", ".join(shown[:NAMED]) + more


def pump_changes(readings: Array, names: Sequence[ChannelName]) -> Iterator[str]:
    """Yield the row from which on the flow a turn is another while the inputs do not jump; readings (N, C) in SI.

    Certain beside a smooth law of the inputs (`LevelStep.is_certain`), more than `JUMP` with an equal jump of torque,
    more than `JUMP_ALONE` where no torque is measured; a flow that jumps without the torque is its meter's.
    """
    if ChannelName.Q_OUT not in names:
        return
    law = law_of(readings, np.array([k for k, name in enumerate(names) if name in INPUTS], dtype=np.int64))
    turned = np.ones(len(readings))
    for name in (ChannelName.SPEED, ChannelName.DISPLACEMENT_RATIO):
        if name in names:
            turned = turned * readings[:, list(names).index(name)]
    flow = _step(readings[:, list(names).index(ChannelName.Q_OUT)] / np.where(turned > 0.0, turned, np.nan), law)
    if flow is None or abs(flow.size) < JUMP:
        return
    if ChannelName.TORQUE in names:
        torque = _step(readings[:, list(names).index(ChannelName.TORQUE)], law)
        alike = torque is not None and torque.row == flow.row
        if torque is None or not alike or abs(torque.size - flow.size) > LIKE * abs(flow.size):
            return
        also = " and the torque"
    elif abs(flow.size) < JUMP_ALONE:
        return
    else:
        also = ""
    over = " over speed" if ChannelName.SPEED in names else ""
    yield f"Q_out{over}{also} by {np.expm1(flow.size):+.0%} from row {flow.row + 1} on, while no input jumps"


def _step(values: Array, law: Array) -> LevelStep | None:
    """The step of the logarithm of values (N,), None where it is not certain."""
    positive = np.isfinite(values) & (np.where(np.isfinite(values), values, -1.0) > 0.0)
    found = level_step(np.log(np.where(positive, values, 1.0)) + np.where(positive, 0.0, np.nan), law)
    return found if found is not None and found.is_certain else None
