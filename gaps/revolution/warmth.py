"""Temperatures of a gap over the turn: its oil's viscosity by place and shaft angle, and its heat flows."""

from dataclasses import dataclass, field, replace

import numpy as np

from reynolds.floating.problem import Floating
from reynolds.numerics.arrays import Array
from reynolds.thermal.coupling import Coupled, with_profile
from reynolds.thermal.energy import FilmTemperature
from reynolds.thermal.film_profile import dowson, levels

Found = Coupled[FilmTemperature]


@dataclass(frozen=True)
class ViscosityRatios:
    """Viscosity over that of oil at the case's temperature, between shaft angles interpolated.

    angles (n,) rad from 0 to where the turn or pitch closes; logs (n, size, m): logarithm of the share at each
    unknown and level across the film (`reynolds.thermal.film_profile`).
    """

    angles: Array
    logs: Array = field(repr=False)

    def at(self, angle: float) -> Array:
        """The share (size, m) at an angle (rad) within the turn."""
        return np.asarray(np.exp(_between(self.angles, self.logs, angle)))


def _between(angles: Array, values: Array, angle: float) -> Array:
    """Values (n, ..) at rising angles (n,), between them linear, at an angle within."""
    after = int(np.clip(np.searchsorted(angles, angle), 1, len(angles) - 1))
    begin, end = angles[after - 1 : after + 1]
    part = (angle - begin) / (end - begin)
    return np.asarray((1.0 - part) * values[after - 1] + part * values[after])


def thinned(floating: Floating, shaft_speed: float, shares: ViscosityRatios | None) -> Floating:
    """The same gap with oil of these shares of its viscosity; None: the cold gap."""
    if shares is None:
        return floating
    cold, across = floating.shape_at, levels(shares.logs.shape[2])
    return replace(
        floating, shape_at=lambda time: with_profile(cold(time), dowson(across, shares.at(shaft_speed * time)))
    )


@dataclass(frozen=True)
class HeatFlows:
    """Heat balance of a gap's film, W.

    dissipation of the oil and rubbing of asperities arise; to_fixed, to_moving into the walls, half of rubbing with
    each; convected_out by oil, against oil that enters; stored in oil that enters the film as it grows.
    """

    dissipation: float
    rubbing: float
    to_fixed: float
    to_moving: float
    convected_out: float
    stored: float

    @property
    def balance_error(self) -> float:
        """Residual of the heat balance over all sources."""
        arises = self.dissipation + self.rubbing
        return abs(arises - self.to_fixed - self.to_moving - self.convected_out - self.stored) / max(arises, 1e-300)


@dataclass(frozen=True)
class GapTemperatures:
    """Temperatures of a gap in agreement with its motion.

    shares: the viscosity at these temperatures; film (n + 1, size) K, mean over the thickness at the angles
    of `shares`; walls (2,) K of the fixed and the moving part; mean and hottest (n,) K of the film at its angles;
    flows: means over the turn; change: root mean square relative change of viscosity by one more round; rounds of
    motion and temperature; films: those warmed, from which the next ones start.
    """

    shares: ViscosityRatios
    film: Array = field(repr=False)
    walls: Array
    mean: Array
    hottest: Array
    flows: HeatFlows
    change: float
    rounds: int
    films: tuple[Found, ...] = field(repr=False, default=())

    @property
    def angles(self) -> Array:
        """Shaft angles (n,) rad at which temperatures are solved."""
        return self.shares.angles[1:]

    def film_at(self, angle: float) -> Array:
        """Temperature (size,) K of the film, mean over its thickness, at an angle (rad) within the turn."""
        return _between(self.shares.angles, self.film, angle)

    def mean_at(self, angles: Array) -> Array:
        """Mean temperature (n,) K of the film at angles (n,) rad within the turn."""
        return np.interp(angles, self.shares.angles, [self.mean[-1], *self.mean])

    def hottest_at(self, angles: Array) -> Array:
        """Highest temperature (n,) K in the film at angles (n,) rad within the turn."""
        return np.interp(angles, self.shares.angles, [self.hottest[-1], *self.hottest])
