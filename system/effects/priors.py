"""Entries of the catalogue by their laws, and priors of these laws: ranges of parameters before any recording."""

from dataclasses import dataclass
from math import log

from system.description.gap import Gap
from system.effects.components import Component
from system.effects.effect import EffectId, Kind
from system.effects.extension import Entry, Extension, Law, Values
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension


def half(path: str, spread: float, upper: float, dimension: Dimension | None, source: str) -> Parameter:
    """A size that is never negative: half a normal law of that spread, up to `upper`."""
    return Parameter(path, Role.EXTENSION, Scale.HALF, 0.0, spread, 0.0, upper, dimension, source)


def signed(path: str, spread: float, bound: float, dimension: Dimension | None, source: str) -> Parameter:
    """A size of either sign: normal, within -bound .. bound."""
    return Parameter(path, Role.EXTENSION, Scale.NORMAL, 0.0, spread, -bound, bound, dimension, source)


def path_of(effect: EffectId, key: str, pair: Gap | None = None) -> str:
    """The name of a parameter: its key's path in a pump file below [physics]."""
    return ".".join([effect.value, *([pair.value] if pair else []), key])


def scale_of(effect: EffectId, key: str, grid: tuple[float, ...], dimension: Dimension | None) -> Parameter:
    """The scale that a grid of even ratios samples: log-normal about each member, one sigma half way to the next.

    Bounds lie one ratio beyond the ends.
    """
    ratio = grid[1] / grid[0]
    return Parameter(
        path_of(effect, key), Role.EXTENSION, Scale.LOG, grid[0], 0.5 * log(ratio), grid[0] / ratio,
        grid[-1] * ratio, dimension, "between the members of its grid",
    )  # fmt: skip


def size_of(
    effect: EffectId, key: str, spread: float, upper: float, dimension: Dimension | None, source: str
) -> Parameter:
    """A size of an effect of the whole pump, as `half`."""
    return half(path_of(effect, key), spread, upper, dimension, source)


@dataclass(frozen=True)
class Form:
    """Another published law of an effect, of the same sizes: its grid, which has a key of its own, and its scales."""

    law: Law
    grid: tuple[Values, ...]
    scales: tuple[Parameter, ...] = ()


def whole(
    effect: EffectId,
    law: Law,
    *sizes: Parameter,
    grid: tuple[Values, ...] = ({},),
    scales: tuple[Parameter, ...] = (),
    forms: tuple[Form, ...] = (),
) -> tuple[Extension, ...]:
    """The one extension of an effect by a law of the whole pump, with its other forms."""
    others = tuple(Extension(effect, None, one.law, sizes, one.grid, one.scales) for one in forms)
    return (Extension(effect, None, law, sizes, grid, scales, others),)


def share_of(effect: EffectId, key: str, centre: float, source: str) -> Parameter:
    """A share between two forms of a law, 0 to 1, of which only the range is known."""
    return Parameter(path_of(effect, key), Role.EXTENSION, Scale.NORMAL, centre, 0.5, 0.0, 1.0, None, source)


def missing_physics(
    extensions: tuple[Extension, ...],
    components: tuple[Component, ...],
    channels: tuple[ChannelName, ...],
    twins: tuple[EffectId, ...],
    regime: str,
    sentence: str,
    source: str,
) -> Entry:
    """The entry of an effect missing in the plain loss model."""
    return Entry(
        extensions[0].id, Kind.MISSING_PHYSICS, extensions, components, channels, regime, twins, sentence, source
    )
