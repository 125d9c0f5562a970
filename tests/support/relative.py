"""pytest.approx without an absolute tolerance of its own: 1e-12 would pass any conductance or compliance in SI."""

from functools import wraps
from typing import Any

import pytest

_own = pytest.approx
USUAL = 1e-6  # pytest's own relative tolerance


@wraps(_own)
def approx(expected: Any, rel: float | None = None, abs: float | None = None, nan_ok: bool = False) -> Any:
    """As pytest.approx; without an absolute tolerance given it is relative alone."""
    if abs is None:
        rel, abs = USUAL if rel is None else rel, 0.0
    return _own(expected, rel=rel, abs=abs, nan_ok=nan_ok)


def compare_relatively() -> None:
    """From here on `pytest.approx` is the one above."""
    pytest.approx = approx
