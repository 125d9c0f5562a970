"""Distances of suspects under a campaign, in sigma, and the gain of one reading more.

The readings of suspect i are those of the pump and its own columns at its size, y = y0 + J xi + V t_i + noise. Its
rival j follows them as closely as possible, by the uncertain parameters xi of priors N(0, 1) and by its own sizes b of
priors N(0, w^2), of the sign that they can have:

    d_ij^2 = min over xi, b |W^(1/2) (V t_i - J xi - V_j b)|^2 + |xi|^2 + |b / w|^2

in sigma, W the number of readings at each point: T-optimality (Atkinson and Fedorov 1975) of linear models with priors.
With A = J^T W J + 1 and M = V^T W V - V^T W J A^-1 J^T W V it is t_i^T M t_i less the part that b follows. The distance
of a pair is that of its nearer direction. A further reading never reduces d: its gain is half of its addition to d^2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from diagnosis.next_point.discrimination import promise
from diagnosis.next_point.forecast import Forecast
from diagnosis.planning.responses import White
from diagnosis.planning.suspects import Suspect
from diagnosis.thresholds import FormLimits
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class Contest:
    """Suspects before a bench's readings at N points.

    widths, signs: (Q,), prior sigma of the size of each column in its spreads, and the sign that it must have or 0;
    beside: readings in any campaign, one at each of their points (traces of the chamber).
    """

    white: White
    suspects: Sequence[Suspect]
    widths: Array
    signs: Array
    beside: tuple[White, ...] = ()

    @cached_property
    def truths(self) -> Array:
        """(Q, S), the sizes of every suspect."""
        return np.stack([one.truth for one in self.suspects], axis=1)

    @cached_property
    def either(self) -> NDArray[np.bool_]:
        """(S,), true for suspects whose size has either sign."""
        return np.array([not np.any(self.signs[list(one.members[0])]) for one in self.suspects])

    def fitted(self, counts: NDArray[np.int64]) -> Fitted:
        """The fit of all parameters to so many readings at each point (N,)."""
        slopes = self.white.slopes
        weighted = slopes * counts[:, None, None]
        precision = np.eye(slopes.shape[2]) + np.einsum("nmk,nml->kl", weighted, slopes, optimize=True)
        mixed = np.einsum("nmk,nmq->kq", weighted, self.white.columns, optimize=True)
        columns = self.white.columns * np.sqrt(counts)[:, None, None]
        content = np.einsum("nmq,nmp->qp", columns, columns, optimize=True)
        for one in self.beside:
            precision += np.einsum("nmk,nml->kl", one.slopes, one.slopes, optimize=True)
            mixed += np.einsum("nmk,nmq->kq", one.slopes, one.columns, optimize=True)
            content += np.einsum("nmq,nmp->qp", one.columns, one.columns, optimize=True)
        factor = cho_factor(precision)
        taken = cho_solve(factor, mixed)
        return Fitted(cho_solve(factor, np.eye(len(precision))), taken, content - mixed.T @ taken)

    def apart(self, counts: NDArray[np.int64]) -> Apart:
        """Distances of all suspects by so many readings at each point (N,)."""
        fitted = self.fitted(counts)
        return Apart(fitted, self.truths, tuple(self._rivalry(fitted, one) for one in self.suspects))

    def _rivalry(self, fitted: Fitted, rival: Suspect) -> Rivalry:
        """A rival that follows every suspect by the best member of its grid."""
        found = [self._followed(fitted, one) for one in rival.members]
        taken = np.stack([one for one, _ in found])
        best = np.argmax(taken, axis=0)
        sizes = tuple(found[member][1][:, at] for at, member in enumerate(best))
        return Rivalry(taken.max(axis=0), tuple(rival.members[member] for member in best), sizes)

    def _followed(self, fitted: Fitted, columns: tuple[int, ...]) -> tuple[Array, Array]:
        """Part of t^T M t of every suspect (S,) that sizes of some columns follow, and these sizes (q, S).

        Sizes with a required sign are 0 if they would have the other (all subsets are tried); a suspect of either sign
        has the one that the rival follows best.
        """
        own = list(columns)
        pull = fitted.content[own] @ self.truths
        stiff = fitted.content[np.ix_(own, own)] + np.diag(self.widths[own] ** -2.0)
        best, sizes = np.zeros(pull.shape[1]), np.zeros_like(pull)
        for free in _subsets(len(own)):
            some = np.linalg.solve(stiff[np.ix_(free, free)], pull[free])
            takes = np.sum(some * pull[free], axis=0)
            signed = some * self.signs[[own[at] for at in free]][:, None]
            allowed = np.all(signed >= 0.0, axis=0) | (self.either & np.all(signed <= 0.0, axis=0))
            better = allowed & (takes > best)
            best = np.where(better, takes, best)
            whole = np.zeros_like(pull)
            whole[free] = some
            sizes = np.where(better, whole, sizes)
        return best, sizes

    def forecast(self, apart: Apart, truth: int, rival: int) -> tuple[Array, Array]:
        """Difference (N, m) of a suspect's readings from the rival's fit, and covariance (N, m, m) of that forecast."""
        left = self._left(apart.fitted)
        own, sizes = list(apart.rivalries[rival].columns[truth]), apart.rivalries[rival].sizes[truth]
        difference = left @ self.truths[:, truth] - left[..., own] @ sizes
        free = [at for at, size in zip(own, sizes, strict=True) if size != 0.0]
        spread = left[..., free]
        stiff = apart.fitted.content[np.ix_(free, free)] + np.diag(self.widths[free] ** -2.0)
        return difference, spread @ np.linalg.inv(stiff) @ np.swapaxes(spread, 1, 2)

    def told(self, apart: Apart, wanted: float, limits: FormLimits) -> NDArray[np.bool_]:
        """(S, S), true for pairs that are `wanted` sigma apart, and farther than the error of form of their laws.

        That error is a share of the square of the less significant suspect: of a law wrong by a tenth `true_to`, of one
        effect at two places `placed_by`. In a diagnosis suspects within it are of one class.
        """
        effects = [one.effect for one in self.suspects]
        same = np.array([[one is other for other in effects] for one in effects])
        share = np.where(same, limits.placed_by, limits.true_to)
        least = np.minimum(apart.seen[:, None], apart.seen[None, :])
        return np.asarray(apart.distances >= np.maximum(wanted, np.sqrt(share * np.maximum(least, 0.0))))

    def _left(self, fitted: Fitted) -> Array:
        """(N, m, Q), columns less the part that the fitted parameters follow."""
        return self.white.columns - self.white.slopes @ fitted.taken

    def common(self, apart: Apart) -> Array:
        """(N, m, m), covariance of the readings by the parameters that all explanations share."""
        slopes = self.white.slopes
        return slopes @ apart.fitted.covariance @ np.swapaxes(slopes, 1, 2)


@dataclass(frozen=True)
class Fitted:
    """covariance (k, k) of the parameters; taken (k, Q), by which they follow each column; content (Q, Q): M."""

    covariance: Array
    taken: Array
    content: Array


@dataclass(frozen=True)
class Rivalry:
    """One rival against S suspects: the part that it follows of the square of each, its columns and their sizes."""

    takes: Array
    columns: tuple[tuple[int, ...], ...]
    sizes: tuple[Array, ...]


@dataclass(frozen=True)
class Apart:
    """Distances of S suspects by a campaign."""

    fitted: Fitted
    truths: Array
    rivalries: tuple[Rivalry, ...]

    @cached_property
    def seen(self) -> Array:
        """(S,), squared distance of each suspect from the null."""
        return np.einsum("qs,qp,ps->s", self.truths, self.fitted.content, self.truths, optimize=True)

    @cached_property
    def squares(self) -> Array:
        """(S, S), squared distance of a suspect (row) from a rival (column); 0 on the diagonal."""
        taken = np.stack([one.takes for one in self.rivalries], axis=1)
        found = np.maximum(self.seen[:, None] - taken, 0.0)
        np.fill_diagonal(found, 0.0)
        return found

    @property
    def distances(self) -> Array:
        """(S, S), sigma, of the pairs: the nearer of both directions."""
        return np.sqrt(np.minimum(self.squares, self.squares.T))


@dataclass(frozen=True)
class PairCampaign:
    """The pairs of a contest that count, beside a campaign (`diagnosis.next_point.discrimination.Campaign`).

    wanted: sigma from which a pair counts as separated.
    """

    contest: Contest
    pairs: tuple[tuple[int, int], ...]
    wanted: float

    @property
    def enough(self) -> float:
        """Nats of a separated pair."""
        return 0.5 * self.wanted**2

    def total(self, counts: NDArray[np.int64]) -> float:
        """Sum of the pairs' levels in nats, each up to `enough`."""
        return float(np.minimum(self.levels(counts), self.enough).sum())

    def levels(self, counts: NDArray[np.int64]) -> Array:
        """(P,), mean ln odds of the true one of each pair, half the square of the lesser distance."""
        return self._levels(self.contest.apart(counts))

    def promised(self, counts: NDArray[np.int64]) -> Array:
        """(N,), predicted gain of one reading more at each point, nats."""
        apart = self.contest.apart(counts)
        levels = self._levels(apart)
        near = np.flatnonzero(levels < self.enough)
        if near.size == 0:
            return np.zeros(len(counts))
        gains = self._gains(apart, [self.pairs[at] for at in near], levels[near])
        return promise(levels[near], gains, self.enough)

    def _levels(self, apart: Apart) -> Array:
        distances = apart.distances
        return np.array([0.5 * distances[one, other] ** 2 for one, other in self.pairs])

    def _gains(self, apart: Apart, pairs: Sequence[tuple[int, int]], levels: Array) -> Array:
        """(P, N), rise of the lesser of both directions of each pair by one reading."""
        both = self._direction(apart, pairs), self._direction(apart, [(other, one) for one, other in pairs])
        return np.minimum(*both) - levels[:, None]

    def _direction(self, apart: Apart, pairs: Sequence[tuple[int, int]]) -> Array:
        """(P, N), nats of each (suspect, rival) after one reading at each point."""
        common, found = self.contest.common(apart), []
        for some in _portions(pairs):
            told = [self.contest.forecast(apart, truth, rival) for truth, rival in some]
            covariance = common + np.stack([spread for _, spread in told])
            gain = Forecast(np.stack([difference for difference, _ in told]), covariance, covariance).gain(1)
            found.append(gain + 0.5 * np.array([apart.squares[pair] for pair in some])[:, None])
        return np.concatenate(found)


def all_pairs(count: int) -> tuple[tuple[int, int], ...]:
    """Every pair of so many suspects."""
    return tuple(combinations(range(count), 2))


def _subsets(count: int) -> Iterator[list[int]]:
    for size in range(1, count + 1):
        yield from (list(one) for one in combinations(range(count), size))


def _portions(pairs: Sequence[tuple[int, int]], size: int = 64) -> Iterator[Sequence[tuple[int, int]]]:
    for begin in range(0, len(pairs), size):
        yield pairs[begin : begin + size]
