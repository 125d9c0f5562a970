"""Means of what stages tell: numbers, arrays and dataclasses within dataclasses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from gaps.revolution.course import numbers_of, with_numbers


@dataclass(frozen=True)
class Inner:
    power: float


@dataclass(frozen=True)
class Told:
    flow: np.ndarray
    inner: Inner
    label: str


def test_fields_are_averaged_by_weight_and_labels_are_the_last():
    told = [Told(np.array([1.0, 2.0]), Inner(3.0), "first"), Told(np.array([5.0, -2.0]), Inner(7.0), "last")]
    found = with_numbers(told[-1], np.average([numbers_of(one) for one in told], axis=0, weights=[3.0, 1.0]))
    assert found.flow == pytest.approx([2.0, 1.0])
    assert found.inner == Inner(4.0)
    assert found.label == "last"
