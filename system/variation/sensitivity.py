"""Sensitivity of a pump: derivatives of its numbers by every dimension, at its operating points."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.description.drawing import drawing_of
from system.description.drawn import pump_sigma
from system.description.keys import PumpKey
from system.description.pump import PumpDescription
from system.inputs.faults import InputFaults
from system.inputs.units import Dimension
from system.pump_file.file import Variant, varied
from system.variation.differences import Side, Stencil, Verdict, one_of, stencils, usual_step, verdicts
from system.variation.measures import Measure, measured
from system.variation.solving import VariedWork, numbers_in, solved_variants
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor, PartOutcome, PartStatus

PERCENT = 0.01


@dataclass(frozen=True)
class Accuracy:
    """Accuracy of a fidelity's differences.

    step: share of a value by which it is varied; noise: of the solver, of a number; rounds: of falling steps.
    """

    step: float
    noise: float
    rounds: int


@dataclass(frozen=True)
class KeySlopes:
    """Derivatives by one dimension, SI per SI: of the measures, arrays (M,), verdict by `Verdict`.

    sites, sites_error: of the NUMBERS at each operating point, (P, NUMBERS). sigma: one standard deviation that
    [tolerance] states, SI, None where it states none.
    """

    stencil: Stencil
    value: Array
    error: Array
    verdict: np.ndarray
    sites: Array
    sites_error: Array
    sigma: float | None

    @property
    def key(self) -> PumpKey:
        """The dimension."""
        return self.stencil.key

    @property
    def unit(self) -> float:
        """The usual unit change (SI): 1 um of a length, 1 deg of an angle, else 1 %."""
        return unit_change(self.key)


@dataclass(frozen=True)
class Refused:
    """A dimension without a derivative, and the reason."""

    key: PumpKey
    reason: str


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives of all measures by all dimensions.

    middle: the measures (M,) of the pump as stated; internal: True where a pump ended by an error of the program.
    """

    measures: tuple[Measure, ...]
    middle: Array
    slopes: tuple[KeySlopes, ...]
    refused: tuple[Refused, ...]
    warnings: tuple[str, ...]
    internal: bool
    solved: int
    seconds: float

    def place(self, name: str) -> int:
        """Return the place of a measure."""
        return next(at for at, one in enumerate(self.measures) if one.name == name)

    def ranked(self, name: str) -> list[KeySlopes]:
        """Return the dimensions with a number for a measure, the costliest first by their unit change."""
        at = self.place(name)
        known = [one for one in self.slopes if one.verdict[at] is Verdict.SMOOTH]
        return sorted(known, key=lambda one: -abs(one.value[at] * one.unit))


def unit_change(key: PumpKey) -> float:
    """Return the change (SI) of a dimension by which its cost is stated: 1 um, 1 deg, or 1 % of it."""
    return {Dimension.LENGTH: 1e-6, Dimension.ANGLE: float(np.radians(1.0))}.get(
        key.dimension or Dimension.TIME, PERCENT * one_of(key)
    )


def sensitivity(
    work: VariedWork,
    keys: Mapping[str, PumpKey],
    measures: tuple[Measure, ...],
    accuracy: Accuracy,
    folder: Path,
    executor: Executor,
    report: Report,
    earlier: KeptPoints | None = None,
) -> Sensitivity:
    """Return the derivatives of the measures by dimensions of a pump, each by differences of `Stencil`.

    Where numbers of a dimension do not converge, its step falls to a quarter, `accuracy.rounds` times in all; each
    number is that of the first step at which it converges. Where a pump has no result the next stencil is tried.
    Raises NotConverged where the stated pump has no result.
    """
    chosen, refused = _chosen(work.pump, keys, accuracy)
    pumps = _Pumps(work, folder, executor, report, earlier, measures, accuracy.noise, _sigmas(work.pump))
    first = {path: iter(options) for path, options in chosen.items()}
    slopes, failed = _differentiated(first, pumps, accuracy.rounds)
    stated = pumps.known[()]
    middle = measured(pumps.middle, work.sites.weights, measures)
    seconds = sum(one.seconds for one in pumps.known.values())
    warnings = tuple(stated.record["warnings"])
    internal = any(one.status is PartStatus.INTERNAL for one in pumps.known.values())
    return Sensitivity(measures, middle, slopes, (*refused, *failed), warnings, internal, len(pumps.known), seconds)


def _differentiated(
    left: Mapping[str, Iterator[Stencil]], pumps: _Pumps, most: int
) -> tuple[tuple[KeySlopes, ...], list[Refused]]:
    """Return the slopes of each dimension by the stencils that are left to it, and those without any, with the reason.

    most: rounds of a dimension whose numbers do not converge.
    """
    todo, refused = [next(options) for options in left.values()], list[Refused]()
    found, rounds = dict[str, KeySlopes](), Counter[str]()
    pumps.solve(todo)
    while todo:
        following: list[Stencil] = []
        for stencil in todo:
            path = stencil.key.path
            made = pumps.slopes(stencil)
            if isinstance(made, KeySlopes):
                rounds[path] += 1
                found[path] = _better(found.get(path), made)
                if Verdict.NOT_SMOOTH in found[path].verdict and rounds[path] < most:
                    following.append(replace(stencil, step=0.25 * stencil.step))
            elif (other := next(left[path], None)) is not None and path not in found:
                following.append(other)
            elif path not in found:
                refused.append(made)
        todo = following
        pumps.solve(todo)
    return tuple(found.values()), refused


@dataclass(frozen=True)
class _Pumps:
    """Varied pumps, solved when needed; known: their outcomes."""

    work: VariedWork
    folder: Path
    executor: Executor
    report: Report
    earlier: KeptPoints | None
    measures: tuple[Measure, ...]
    noise: float
    sigmas: Mapping[str, float]
    known: dict[Variant, PartOutcome] = field(default_factory=dict)

    def solve(self, todo: Sequence[Stencil]) -> None:
        """Solve the pump as stated and those of the stencils that are not yet known."""
        wanted = [(), *(((one.key.path, value),) for one in todo for value in one.values)]
        new = [variant for variant in dict.fromkeys(wanted) if variant not in self.known]
        if new:
            found = solved_variants(self.work, new, self.folder, self.executor, self.report, self.earlier)
            self.known.update(zip(new, found, strict=True))

    @property
    def middle(self) -> Array:
        """Numbers (P, NUMBERS) of the pump as stated; raises NotConverged where it has no result."""
        stated = self.known[()]
        if stated.status is not PartStatus.SOLVED:
            raise NotConverged(f"the pump as stated: {stated.reason}")
        return numbers_in(stated)

    def slopes(self, stencil: Stencil) -> KeySlopes | Refused:
        """Return the slopes by the pumps of a stencil, or the reason why one of them has no result."""
        outcomes = [self.known[((stencil.key.path, value),)] for value in stencil.values]
        middle, weights = self.middle, self.work.sites.weights
        lacking = [one for one in outcomes if one.status is not PartStatus.SOLVED]
        if lacking:
            return Refused(stencil.key, f"{lacking[0].status.value}: {lacking[0].reason}")
        sites = np.stack([numbers_in(one) for one in outcomes])
        value, error = stencil.derivative(middle, sites)
        whole = measured(middle, weights, self.measures)
        of_all, of_all_error = stencil.derivative(whole, measured(sites, weights, self.measures))
        verdict = verdicts(stencil, whole, of_all, of_all_error, self.noise)
        return KeySlopes(stencil, of_all, of_all_error, verdict, value, error, self.sigmas.get(stencil.key.path))


def variants_needed(count: int) -> int:
    """Return the number of pumps that the first round solves for so many dimensions."""
    return 1 + 4 * count


def _chosen(
    pump: PumpDescription, keys: Mapping[str, PumpKey], accuracy: Accuracy
) -> tuple[dict[str, list[Stencil]], list[Refused]]:
    """Return the stencils of each dimension that has any, and the others with the fault of the geometry."""
    chosen, refused = dict[str, list[Stencil]](), list[Refused]()
    for path, key in keys.items():
        step = usual_step(key, accuracy.step)
        options = list(stencils(key, step, partial(_varied_to, pump, path)))
        if options:
            chosen[path] = options
        else:
            refused.append(Refused(key, f"the geometry refuses both sides: {'; '.join(_whys(pump, key, step))}"))
    return chosen, refused


def _varied_to(pump: PumpDescription, path: str, value: float) -> PumpDescription:
    return varied(pump, ((path, value),))


def _whys(pump: PumpDescription, key: PumpKey, step: float) -> Iterator[str]:
    """Yield the value on either side of the stated one and what is wrong with it."""
    for value in (key.value - step, key.value + step):
        try:
            varied(pump, ((key.path, value),))
        except InputFaults as reason:
            yield f"at {key.shown(value)} {reason.faults[0].line}"


def _better(before: KeySlopes | None, after: KeySlopes) -> KeySlopes:
    """Return the slopes of which each is that of the step that converges, with the smaller error."""
    if before is None:
        return after
    rough = before.verdict == Verdict.NOT_SMOOTH
    mended = rough & (after.verdict != Verdict.NOT_SMOOTH)
    finer = after.sites_error < before.sites_error
    return KeySlopes(
        after.stencil,
        np.where(mended, after.value, before.value),
        np.where(mended, after.error, before.error),
        np.where(mended, after.verdict, before.verdict),
        np.where(finer, after.sites, before.sites),
        np.where(finer, after.sites_error, before.sites_error),
        before.sigma,
    )


def _sigmas(pump: PumpDescription) -> dict[str, float]:
    """Return the standard deviations that [tolerance] states, by path."""
    drawn = drawing_of(pump)
    return {one.name: pump_sigma(one) for one in drawn.members if len(one.keys) == 1}


def one_sided(found: Sensitivity) -> list[KeySlopes]:
    """Return the dimensions whose difference the geometry allows on one side only."""
    return [one for one in found.slopes if one.stencil.side is not Side.BOTH]
