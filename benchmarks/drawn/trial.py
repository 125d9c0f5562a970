"""One drawn case: solved as a user solves it, and its outcome."""

from __future__ import annotations

import math
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import tomli_w

import swashfilm as sf
from reynolds.errors import InputError, NotConverged

from .films import film_case
from .pumps import pump_case

MASS, ENERGY, PUMP_ENERGY = 1e-9, 1e-6, 5e-3
"""Largest relative errors: of oil, in films and pumps; of power or heat in a film; of a pump's power, by the torque of
its forces at sampled angles against the sum of all sinks (beyond, a run warns)."""
Balances = tuple[float, float, Mapping[str, Any]]
"""Relative errors of mass and energy (NaN where the balance omits a work by its theory), and the summary."""


class Fate(StrEnum):
    """Outcome of a drawn case."""

    BALANCED = "converged in balance"
    REFUSED = "refused in words"
    NOT_CONVERGED = "not converged, in words"
    UNBALANCED = "out of balance"
    NOT_FINITE = "not finite"
    RAISED = "an error of the program"

    @property
    def good(self) -> bool:
        """True for an outcome as promised."""
        return self in (Fate.BALANCED, Fate.REFUSED, Fate.NOT_CONVERGED)


@dataclass(frozen=True)
class Outcome:
    """A case, its outcome, its relative errors of mass and energy, its message, and processor time in seconds."""

    kind: str
    number: int
    fate: Fate
    mass: float
    energy: float
    told: str
    seconds: float


def film(number: int) -> Balances:
    """Solve a film."""
    case = film_case(number)
    found = sf.film(case).summary
    mass = max(found["mass_balance_error"], found.get("mass_balance_error_of_time", 0.0))
    if "heat_balance_error" in found:
        return mass, found["heat_balance_error"], found
    return mass, math.nan if _leaves_out(case) else found["energy_balance_error"], found


def _leaves_out(case: Mapping[str, Any]) -> bool:
    """Whether a film does work that its balance does not count.

    No published flow factor has that of the pressure on the flanks of asperities; that of compression is not counted.
    """
    rough = "roughness" in case or case.get("physics", {}).get("surfaces") == "rough"
    return rough or "density_law" in case.get("oil", {})


def pump(number: int, fidelity: str) -> Balances:
    """Solve a pump."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "drawn.toml"
        path.write_text(tomli_w.dumps(pump_case(number)), encoding="utf-8")
        found = sf.run(path, fidelity=fidelity).summary
    return found["checks"]["mass_balance_error"], found["checks"]["energy_balance_error"], found


@dataclass(frozen=True)
class Kind:
    """A kind of case: number of cases, its solver, and the largest errors of mass and energy."""

    count: int
    solve: Callable[[int], Balances]
    mass: float
    energy: float


KINDS = {
    "film": Kind(1000, film, MASS, ENERGY),
    "pump, lumped": Kind(300, lambda number: pump(number, "lumped"), MASS, PUMP_ENERGY),
    "pump, fixed": Kind(40, lambda number: pump(number, "fixed"), MASS, PUMP_ENERGY),
}
"""The films of a fixed pump take a minute of the clock, so that a part of the pumps has them."""


def tried(kind: str, number: int) -> Outcome:
    """Solve a case and judge the result; a warning of numpy counts as an error of the program."""
    began = time.process_time()
    mass = energy = math.nan
    told = ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            mass, energy, found = KINDS[kind].solve(number)
        balanced = mass <= KINDS[kind].mass and not energy > KINDS[kind].energy
        fate = Fate.BALANCED if balanced else Fate.UNBALANCED
        if bad := next(_not_finite(found), ""):
            fate, told = Fate.NOT_FINITE, bad
    except NotConverged as reason:
        fate, told = Fate.NOT_CONVERGED, str(reason)
    except (sf.InputFaults, InputError) as reason:
        fate, told = Fate.REFUSED, str(reason)
    except Exception as reason:
        where = traceback.extract_tb(reason.__traceback__)[-1]
        fate, told = Fate.RAISED, f"{type(reason).__name__}: {reason} ({where.filename}:{where.lineno})"
    return Outcome(kind, number, fate, mass, energy, told, round(time.process_time() - began, 2))


def _not_finite(value: Any, path: str = "") -> Iterator[str]:
    """Yield the paths of numbers in a summary that are not finite."""
    if isinstance(value, Mapping):
        for key, one in value.items():
            yield from _not_finite(one, f"{path}.{key}")
    elif isinstance(value, (list, tuple)):
        for place, one in enumerate(value):
            yield from _not_finite(one, f"{path}.{place}")
    elif isinstance(value, float) and not math.isfinite(value):
        yield f"{path.lstrip('.')} is {value}"
