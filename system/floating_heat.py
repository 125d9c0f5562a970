"""What warms the floating gaps of a pump: its oil, and walls at the case's temperature."""

from __future__ import annotations

import numpy as np

from gaps.film_heat import GapHeat, Sink
from reynolds.mesh import Array
from reynolds.oil import walther
from system.assumptions import Assumption, Taken
from system.description import PumpDescription
from system.instants import Rotor
from system.units import Dimension


def gap_heat(rotor: Rotor) -> GapHeat:
    """Oil and walls of any gap at the pump's operating point; oil thins by Walther's law."""
    oil, point = rotor.pump.oil, rotor.point
    fluid = oil.fluid

    def thins(temperature: Array) -> Array:
        return np.asarray(walther(temperature, fluid) * oil.density / point.viscosity)

    return GapHeat(
        density=oil.density,
        specific_heat=oil.specific_heat,
        conductivity=_conductivity(rotor.pump, Taken()),
        temperature=point.temperature,
        thins=thins,
        fixed=Sink(point.temperature),
        moving=Sink(point.temperature),
    )


def heat_taken(rotor: Rotor) -> tuple[Assumption, ...]:
    """What `gap_heat` takes where the pump file says nothing."""
    taken = Taken()
    _conductivity(rotor.pump, taken)
    taken.note(
        "temperature of the walls", f"{rotor.point.temperature - 273.15:.4g} degC", "the parts have the case's"
    )
    return tuple(taken.assumptions)


def _conductivity(pump: PumpDescription, taken: Taken) -> float:
    return taken.value(
        "oil.thermal_conductivity", pump.oil.thermal_conductivity, 0.13, "a mineral oil, 0.12 .. 0.15",
        Dimension.CONDUCTIVITY,
    )  # fmt: skip
