"""Text and figures as a page holds them: gzip in base64, which no `</script>` in a name can end."""

from __future__ import annotations

import base64
import gzip
import json
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array

DIGITS = 6
"""Significant digits of the numbers, as in the tables of a run folder."""


def packed(text: str) -> str:
    """Return a text as base64 of gzip, the same for the same text."""
    return base64.b64encode(gzip.compress(text.encode("utf-8"), 9, mtime=0)).decode("ascii")


def packed_json(values: Any) -> str:
    """Return values as packed JSON: arrays as lists, numbers with DIGITS figures, nan and inf as null."""
    return packed(json.dumps(_plain(values), separators=(",", ":"), allow_nan=False))


def short(values: Any, digits: int = DIGITS) -> Any:
    """Return numbers rounded to significant digits as (nested) lists, nan and inf as None."""
    array: Array = np.ma.filled(np.ma.asarray(values, dtype=float), np.nan)
    text = np.char.mod(f"%.{digits}g", array)
    return _plain(text.astype(float), None)


def _plain(values: Any, digits: int | None = DIGITS) -> Any:
    if isinstance(values, dict):
        return {key: _plain(one, digits) for key, one in values.items()}
    if isinstance(values, np.ndarray):
        return _plain(values.tolist(), digits)
    if isinstance(values, (list, tuple)):
        return [_plain(one, digits) for one in values]
    if isinstance(values, (float, np.floating)):
        if not np.isfinite(values):
            return None
        number = float(values) if digits is None else float(f"{values:.{digits}g}")
        return int(number) if number.is_integer() and abs(number) < 1e15 else number
    return values.item() if isinstance(values, np.generic) else values
