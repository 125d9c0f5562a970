"""The ceiling of names: who knows the plant's laws tells what can be told apart, and nothing else."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

READINGS = 50


class Laws:
    """Laws and cases by the directions of their shifts."""

    def __init__(self, ceiling: Any) -> None:
        self._ceiling = ceiling

    def law(self, id: str, size: float, *along: float, is_signed: bool = False) -> Any:
        shift = np.zeros(READINGS)
        shift[: len(along)] = along
        return self._ceiling.Law(id, size * shift / np.linalg.norm(shift), is_signed)

    def told(self, causes: tuple[Any, ...], *rivals: Any) -> float:
        return float(self._ceiling.right(self._ceiling.Posed(causes, 8.0, rivals), np.random.default_rng(1)))

    def recognised(self, cause: Any, *rivals: Any) -> float:
        posed = self._ceiling.Posed((cause,), 8.0, rivals)
        return float(self._ceiling.recognised(posed, np.random.default_rng(1)))


@pytest.fixture(scope="module")
def laws(proof: SimpleNamespace) -> Laws:
    return Laws(proof.ceiling)


@pytest.mark.parametrize(("size", "least", "most"), [(8.0, 0.99, 1.0), (0.5, 0.0, 0.2)])
def test_a_law_unlike_all_others_is_told_where_it_is_large(laws: Laws, size: float, least: float, most: float) -> None:
    rivals = laws.law("a", 8.0, 1.0), laws.law("b", 8.0, 0.0, 1.0), laws.law("c", 8.0, 0.0, 0.0, 1.0)
    assert least <= laws.told((laws.law("a", size, 1.0),), *rivals) <= most


def test_a_rival_that_is_nearly_the_law_is_of_its_class_and_hides_unknown_physics(laws: Laws) -> None:
    alike, apart = laws.law("b", 8.0, 1.0, 0.05), laws.law("c", 8.0, 0.0, 0.0, 1.0)
    assert laws.told((laws.law("a", 8.0, 1.0),), alike, apart) > 0.99
    assert laws.recognised(laws.law("", 8.0, 1.0), alike, apart) < 0.01
    assert laws.recognised(laws.law("", 8.0, 1.0), apart) > 0.99


def test_the_sign_tells_an_effect_from_its_mirror_image_but_no_fault(laws: Laws) -> None:
    mirrored = laws.law("b", 8.0, -1.0)
    assert laws.recognised(laws.law("", 8.0, 1.0), mirrored) > 0.99
    assert laws.recognised(laws.law("", 8.0, 1.0), laws.law("b", 8.0, -1.0, is_signed=True)) < 0.01


def test_both_of_two_are_told_beside_a_law_between_them(laws: Laws) -> None:
    causes = laws.law("a", 10.0, 1.0), laws.law("b", 10.0, 0.0, 1.0)
    assert laws.told(causes, laws.law("c", 8.0, 1.0, 1.0), laws.law("d", 8.0, 0.0, 0.0, 1.0)) > 0.95
    assert laws.told((laws.law("a", 1.0, 1.0), causes[1]), laws.law("d", 8.0, 0.0, 0.0, 1.0)) < 0.95
