"""Means of equal dataclasses."""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import Any, TypeVar, cast

import numpy as np

Of = TypeVar("Of")


def mean_of(items: Sequence[Of]) -> Of:
    """The mean of equal dataclasses of numbers and arrays, by fields; counts (int) are the largest."""
    first = items[0]
    if len(items) == 1:
        return first
    if is_dataclass(first) and not isinstance(first, type):
        return replace(
            first, **{name: mean_of([getattr(item, name) for item in items]) for name in _names(type(first))}
        )
    numbers: list[Any] = list(items)
    found: Any = max(numbers) if isinstance(first, int) else np.mean(numbers, axis=0)
    return cast(Of, float(found) if isinstance(first, float) else found)


@cache
def _names(of: type[Any]) -> tuple[str, ...]:
    return tuple(field.name for field in fields(of))
