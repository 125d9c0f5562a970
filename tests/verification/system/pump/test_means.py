"""Mean of dataclasses: numbers and arrays field by field, counts at their largest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from system.work.means import mean_of


@dataclass(frozen=True)
class _Inner:
    steps: int
    flow: float


@dataclass(frozen=True)
class _Outer:
    course: np.ndarray
    inner: _Inner


def test_fields_are_means_and_counts_the_largest() -> None:
    items = [_Outer(np.array([1.0, 2.0]), _Inner(7, 1.0)), _Outer(np.array([3.0, 6.0]), _Inner(5, 4.0))]
    found = mean_of(items)
    np.testing.assert_array_equal(found.course, [2.0, 4.0])
    assert found.inner == _Inner(7, 2.5)
    assert isinstance(found.inner.flow, float)
    assert mean_of(items[:1]) is items[0]
