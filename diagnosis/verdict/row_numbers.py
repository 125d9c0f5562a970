"""Row numbers of a recording's own table, of which some rows may not be used in the diagnosis."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import NoteKind, Recording
from diagnosis.verdict.diagnosis import Diagnosis


def table_rows(recording: Recording) -> NDArray[np.int64]:
    """The row, from 1, of each of the N points in the table (or windows of the series) that was read.

    Rows without an input are skipped, by the recording's notes: `inputs.complete`. Points may be in the order of their
    times: `inputs.in_time`.
    """
    gone = {
        point
        for note in recording.notes
        if note.kind is NoteKind.REMOVED and note.channel is None
        for point in note.points
    }
    whole, order = np.arange(len(recording.steady.values) + len(gone)), recording.steady.rows
    found = np.setdiff1d(whole, np.array(sorted(gone), dtype=np.int64)) + 1
    return found if order is None else found[order]


def by_table_rows(found: Diagnosis, recording: Recording) -> Diagnosis:
    """The diagnosis with the place of a drift or an onset by the table's rows (from 0)."""
    time = found.location.time
    if time is None:
        return found
    row = int(table_rows(recording)[time.at]) - 1
    return replace(found, location=replace(found.location, time=replace(time, at=row)))
