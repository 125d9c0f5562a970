"""Text and figures as a page holds them: gzip in letters without meaning in HTML.

The letters are Python's base 85, a fifth fewer bytes of overhead than base 64, with `,.:` in place of `&<>`. So no
`</script>` in a name ends a figure.
"""

from __future__ import annotations

import base64
import gzip
import json
from math import isfinite
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array

DIGITS = 6
"""Significant digits of the numbers, as in the tables of a run folder."""
EXACT = 1e15
"""Size below which whole numbers are written as such."""


_LETTERS = str.maketrans("&<>", ",.:")


def packed(text: str) -> str:
    """Return a text as letters of its gzip, after a digit, the number of bytes that fill up the last four."""
    zipped = gzip.compress(text.encode("utf-8"), 9, mtime=0)
    return f"{-len(zipped) % 4}{base64.b85encode(zipped, pad=True).decode('ascii').translate(_LETTERS)}"


def packed_json(values: Any) -> str:
    """Return values as packed JSON: arrays as lists, nan and inf as null."""
    return packed(json.dumps(_plain(values), separators=(",", ":"), allow_nan=False))


def short(values: Any, digits: int = DIGITS) -> Any:
    """Return numbers rounded to significant digits as (nested) lists, nan and inf as None."""
    array: Array = np.ma.filled(np.ma.asarray(values, dtype=float), np.nan)
    return _plain(np.char.mod(f"%.{digits}g", array).astype(float))


def _plain(values: Any) -> Any:
    if isinstance(values, dict):
        return {key: _plain(one) for key, one in values.items()}
    if isinstance(values, np.ndarray):
        return _plain(values.tolist())
    if isinstance(values, (list, tuple)):
        return [_plain(one) for one in values]
    if isinstance(values, np.generic):
        return _plain(values.item())
    if isinstance(values, float):
        return None if not isfinite(values) else int(values) if values.is_integer() and abs(values) < EXACT else values
    return values
