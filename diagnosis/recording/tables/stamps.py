"""Cells that are dates or times of day, to seconds from the first."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Sequence
from datetime import datetime

import numpy as np
import pandas as pd
from pandas.tseries.api import guess_datetime_format

from reynolds.numerics.arrays import Array

_OF_DAY = re.compile(r"\d{1,2}:\d{2}:\d{2}(\.\d+)?")
_DECIMAL_COMMA = re.compile(r"(?<=:\d\d),(?=\d+)")
_YEAR_FIRST = re.compile(r"\d{4}\D")
_DAY = 86400.0


def seconds_of(cells: Sequence[object]) -> tuple[Array, str] | None:
    """Seconds from the first stamp, nan for other cells, and the kind of the stamps in words; None without a stamp.

    A date has a four-digit year. If it begins with the year, the month follows; if it has points, the day is first.
    Else the order is the one in which all cells are dates; of both the one in which the recording is shorter. A time of
    day that falls by more than half a day is of the next day.
    """
    if any(isinstance(cell, datetime) for cell in cells):
        times = pd.to_datetime(pd.Series([cell if isinstance(cell, datetime) else None for cell in cells]))
        return _from_first(times), "dates"
    texts = [_DECIMAL_COMMA.sub(".", str(cell).strip()) for cell in cells]
    first = next((text for text in texts if any(sign.isdigit() for sign in text)), "")
    if _OF_DAY.fullmatch(first):
        return _of_day(texts), "times of day"
    found = [(_from_first(_parsed(texts, form)), form) for form in dict.fromkeys(_forms(first))]
    found = [(times, form) for times, form in found if np.isfinite(times).any()]
    if not found:
        return None
    seconds, form = min(found, key=lambda each: (np.isnan(each[0]).sum(), np.nanmax(each[0]) - np.nanmin(each[0])))
    if all(np.array_equal(each, seconds, equal_nan=True) for each, _ in found):
        return seconds, "dates"
    return seconds, f"dates, {'day before month' if form.find('%d') < form.find('%m') else 'month before day'}"


def _forms(text: str) -> Iterator[str]:
    """Forms of dates that a text may have, the likelier first."""
    orders = (False,) if _YEAR_FIRST.match(text) else (True,) if text.count(".") > 1 else (True, False)
    for day_first in orders:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the other order is tried for an ambiguous text
            form = guess_datetime_format(text.replace("PM", "AM"), dayfirst=day_first)  # pandas has none for PM
        if form:
            yield form.replace("%B", "%b")


def _parsed(texts: Sequence[str], form: str) -> pd.Series:
    """Dates of a form, with a fraction of the second or without; of a zone (Z, +02:00) in universal time."""
    whole = form.replace(".%f", "")
    cells, fine = pd.Series(texts), whole.replace("%S", "%S.%f")
    seconds, fractions = (
        pd.to_datetime(cells, format=one, errors="coerce", utc=True).dt.tz_localize(None).astype("datetime64[us]")
        for one in (whole, fine)
    )
    return seconds.fillna(fractions)


def _of_day(texts: Sequence[str]) -> Array:
    seconds = _from_first(pd.to_timedelta(pd.Series(texts), errors="coerce"))
    known = np.isfinite(seconds)
    nights = np.cumsum(np.diff(seconds[known], prepend=seconds[known][:1]) < -0.5 * _DAY)
    seconds[known] += _DAY * nights
    return seconds


def _from_first(times: pd.Series) -> Array:
    known = times.dropna()
    if known.empty:
        return np.full(len(times), np.nan)
    return np.array((times - known.iloc[0]).dt.total_seconds(), dtype=float)
