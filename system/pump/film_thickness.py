"""Films of given thickness where [physics] changes the thickness itself: as it warms, or before pressure acts."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from reynolds.errors import InputError
from system.description.effects import OpeningSection
from system.description.gap import Gap
from system.description.pump import OperatingSection, PumpDescription

LEAST_FILM = 0.05
"""Least share of a film's thickness to which thermal expansion may close it: below, a fit's trial has no film."""


def given_film(pump: PumpDescription, gap: Gap) -> float:
    """The film (m) that the description gives a gap: the piston's radial clearance, the others' film thickness."""
    return {
        Gap.PISTON: pump.piston.radial_clearance,
        Gap.SLIPPER: pump.slipper.film_thickness,
        Gap.VALVE_PLATE: pump.valve_plate.film_thickness,
    }[gap]


def at_temperature(pump: PumpDescription, temperature: float) -> PumpDescription:
    """The pump with films after [physics.thermal_clearance] at a temperature (K), without such a table.

    Raises InputError as `expansion`.
    """
    if pump.physics.thermal_clearance is None:
        return pump
    times = expansion(pump, temperature)
    bare = replace(pump.physics, thermal_clearance=None)
    return replace(_thicker(pump, times), physics=bare)


def expansion(pump: PumpDescription, temperature: float) -> dict[Gap, float]:
    """Films at a temperature (K) over those stated: 1 + rate (T - T0), T0 the pump's own of [operating].

    Raises InputError where a film would close, to less than LEAST_FILM of itself.
    """
    warmer, times = temperature - pump.operating.temperature, {}
    for gap in Gap:
        own = getattr(pump.physics.thermal_clearance, gap.value, None)
        rate = 0.0 if own is None else own.rate
        times[gap] = 1.0 + rate * warmer
        if times[gap] < LEAST_FILM:
            where, limit = f"physics.thermal_clearance.{gap.value}.rate", (LEAST_FILM - 1.0) / warmer
            found = f"{rate:g} 1/K, a film that is closed at {warmer:+.3g} K"
            raise InputError(where, found, f"{'above' if warmer > 0.0 else 'below'} {limit:.3g} 1/K")
    return times


def moved_to(pump: PumpDescription, operating: OperatingSection) -> PumpDescription:
    """The pump with another operating point as its own, films as thick as they are there (`at_temperature`)."""
    return replace(at_temperature(pump, operating.temperature), operating=operating)


def unpressed(pump: PumpDescription, case_pressure: float) -> PumpDescription:
    """The pump whose walls on springs, under the case's pressure (Pa) alone, give films of the stated thickness."""
    return _thicker(pump, {gap: 1.0 - opening_share(pump, gap) * case_pressure for gap in Gap})


def opening_share(pump: PumpDescription, gap: Gap) -> float:
    """`opening` of [physics.elastic_opening.GAP], 1/Pa: share of its film; 0 between walls of another kind."""
    stated: OpeningSection | None = getattr(pump.physics.elastic_opening, gap.value, None)
    return 0.0 if stated is None or stated.opening is None else stated.opening


def _thicker(pump: PumpDescription, times: Mapping[Gap, float]) -> PumpDescription:
    """The pump with films so many times as thick, those of single parts too."""

    def scaled(part: Any, key: str, gap: Gap) -> Any:
        return replace(part, **{key: getattr(part, key) * times[gap]})

    piston, slipper = "radial_clearance", "film_thickness"
    return replace(
        pump,
        piston=scaled(pump.piston, piston, Gap.PISTON),
        slipper=scaled(pump.slipper, slipper, Gap.SLIPPER),
        valve_plate=scaled(pump.valve_plate, slipper, Gap.VALVE_PLATE),
        single_pistons=tuple((k, scaled(one, piston, Gap.PISTON)) for k, one in pump.single_pistons),
        single_slippers=tuple((k, scaled(one, slipper, Gap.SLIPPER)) for k, one in pump.single_slippers),
    )
