"""Means over steps of a march, with the weights by which the march itself keeps its oil."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Generic, TypeVar, cast

import numpy as np

from reynolds.numerics.arrays import Array

Told = TypeVar("Told")


def mean_of(told: Sequence[Told], weights: Array) -> Told:
    """Weighted mean of what several stages tell, of the same unit.

    Numbers and arrays are averaged, dataclasses field by field; what is neither is as the last one tells it.
    A flow averaged over stages by the weights of their method is what the step has passed, to round-off.
    """
    last = told[-1]
    if is_dataclass(last) and not isinstance(last, type):
        names = (field.name for field in fields(last))
        means = {name: mean_of([getattr(one, name) for one in told], weights) for name in names}
        return cast(Told, replace(last, **means))
    if isinstance(last, float):
        return cast(Told, float(np.average(np.array(told), weights=weights)))
    if isinstance(last, np.ndarray):
        return cast(Told, np.average(np.array(told), axis=0, weights=weights))
    return last


class Passed(Generic[Told]):
    """What the stages of some steps have told, each with the time (s) for which it stands."""

    def __init__(self) -> None:
        self._told: list[Told] = []
        self._pushed: list[float] = []
        self._times: list[float] = []

    def add(self, time: float, told: Told, pushed: float) -> None:
        """One more stage; pushed: power (W) by which its film moves what presses on it."""
        self._told.append(told)
        self._pushed.append(pushed)
        self._times.append(time)

    @property
    def mean(self) -> Told:
        """What they tell in the mean."""
        return mean_of(self._told, np.array(self._times))

    @property
    def mean_pushed(self) -> float:
        """Their power (W) in the mean."""
        return mean_of(self._pushed, np.array(self._times))
