"""Parts of the shaft power by name, the small ones together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from swashfilm.output.data.gap_names import TITLES
from swashfilm.runs.pump.data import GAPS
from system.effects.effect import EffectId
from system.pump.laws.friction_pairs import Pair

SMALLEST = 0.003
"""Share of the shaft power below which a part is included in `other`."""
CARRYING = (
    EffectId.CHURNING, EffectId.SEAL_DRAG, EffectId.CHARGE_PUMP_DRAG, EffectId.CONTROL_FLOW,
    EffectId.PORT_SHORT_CIRCUIT, EffectId.LAMINAR_CROSS_LEAK,
)  # fmt: skip
"""Effects of [physics] with a loss outside chambers and friction pairs."""


class PowerKind(Enum):
    """Kind of a part of the shaft power."""

    SHAFT = "shaft"
    DELIVERED = "delivered"
    FRICTION = "friction"
    LEAKAGE = "leakage"
    THROTTLING = "throttling"
    OIL = "oil"
    EFFECT = "effect"
    OTHER = "other"


@dataclass(frozen=True)
class Power:
    """A part of the shaft power, W; negative where it returns power."""

    name: str
    watts: float
    kind: PowerKind


def power_parts(summary: Mapping[str, Any]) -> tuple[Power, ...]:
    """Return the sinks of the shaft power, delivered power first; the parts add up to the shaft power.

    Parts that are exactly zero are left out. The last part is the error of the balance.
    """
    parts = [part for part in _parts(summary) if part.watts != 0.0]
    rest = summary["power_balance"]["shaft_W"] - sum(part.watts for part in parts)
    return (*parts, Power("error of the balance", rest, PowerKind.OTHER))


def _parts(summary: Mapping[str, Any]) -> Iterator[Power]:
    power = summary["power_balance"]
    delivers = power["hydraulic_W"] > 0.0
    name = "delivered hydraulic power" if delivers else "hydraulic power at the ports"
    yield Power(name, power["hydraulic_W"], PowerKind.DELIVERED)
    for pair in Pair:
        yield Power(f"friction, {pair.words}", summary["pair_loss"][pair.value]["total_W"], PowerKind.FRICTION)
    for gap in GAPS:
        yield Power(f"leakage, {TITLES[gap]}", power[f"leakage_{gap}_W"], PowerKind.LEAKAGE)
    for port in ("delivery", "suction"):
        yield Power(f"throttling, {port} port", power[f"throttling_{port}_W"], PowerKind.THROTTLING)
    yield Power("compression of the oil", power["elastic_W"], PowerKind.OIL)
    yield Power("pulsation in the lines", power["ripple_W"], PowerKind.OIL)
    yield Power(_effects(summary), power["extended_W"], PowerKind.EFFECT)


def _effects(summary: Mapping[str, Any]) -> str:
    """Return the names of the effects of [physics] behind `extended_W`."""
    active = [one.value.replace("_", " ") for one in CARRYING if one.value in summary["physics"]["closed_laws"]]
    return ", ".join(active) or "effects of [physics]"


def gathered(parts: Sequence[Power], smallest: float = SMALLEST) -> tuple[Power, ...]:
    """Return the parts by size, the delivered first; those below a share of the whole are the last one, `other`.

    Their sum is that of the parts.
    """
    least = smallest * sum(abs(part.watts) for part in parts)
    large = [part for part in parts if abs(part.watts) >= least]
    small = [part for part in parts if abs(part.watts) < least]
    large.sort(key=lambda part: (part.kind is not PowerKind.DELIVERED, -part.watts))
    if len(small) < 2:
        return (*large, *small)
    rest = Power(f"other, {len(small)} parts", sum(part.watts for part in small), PowerKind.OTHER)
    return (*large, rest)


def largest_losses(parts: Sequence[Power], share: float = 0.5) -> tuple[tuple[Power, ...], float]:
    """Return the fewest parts that make up `share` of the power not delivered, and their share."""
    lost = sorted((part for part in parts if part.kind is not PowerKind.DELIVERED), key=lambda part: -part.watts)
    whole, taken, found = sum(part.watts for part in lost), 0.0, []
    for part in lost:
        found.append(part)
        taken += part.watts
        if taken >= share * whole:
            break
    return tuple(found), taken / whole


def power_text(watts: float, whole: float) -> str:
    """Return a power in the unit that suits the whole, W or kW."""
    if abs(whole) >= 2000.0:
        return f"{1e-3 * watts:.2f} kW"
    return f"{watts:.0f} W" if abs(watts) >= 100.0 else f"{watts:.3g} W"


def share_text(watts: float, whole: float) -> str:
    """Return a share of the whole in %."""
    share = 100.0 * watts / abs(whole)
    return f"{share:.1f} %" if abs(share) >= 0.05 or share == 0.0 else f"{share:.1g} %"
