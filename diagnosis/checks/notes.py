"""Notes on the data as text: kind, channel and points, counted from 1."""

from __future__ import annotations

from collections.abc import Sequence

from diagnosis.recording.model import DataNote, NoteKind


def note_text(note: DataNote) -> str:
    """A note on the data with its channel and its points, counted from 1."""
    where = [note.channel.value] if note.channel else []
    if note.points:
        where.append(f"point {point_ranges(note.points)}")
    kind = [] if note.kind in (NoteKind.NOTED, NoteKind.WARNED) else [note.kind.value]
    return ": ".join([*kind, *([" ".join(where)] if where else []), note.text])


def point_ranges(points: Sequence[int]) -> str:
    """Points counted from 1, runs of them by their ends: "3, 8 to 12"."""
    breaks = [k for k in range(1, len(points)) if points[k] != points[k - 1] + 1]
    parts = [points[start:stop] for start, stop in zip([0, *breaks], [*breaks, len(points)], strict=True)]
    return ", ".join(f"{p[0] + 1} to {p[-1] + 1}" if len(p) > 2 else ", ".join(str(k + 1) for k in p) for p in parts)
