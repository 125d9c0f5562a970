"""Coupled point with floating gaps, elastic walls and viscosity over pressure."""

import pytest

from gaps import Effect, Physics
from system import FloatingOptions, floating_point, load_pump, operating_point


@pytest.mark.long
def test_energy_between_walls_that_give_way(energy_balances):
    """The energy stored in the bodies returns over a turn: the shaft pays for oil and heat alone."""
    pump = load_pump("ref90", {"operating.pressure": "10 MPa"})
    found = floating_point(
        pump, operating_point(pump), FloatingOptions(Physics().without(Effect.HEAT), steps=36, finer=0.5)
    )
    energy_balances(
        case="REF90 floating between elastic walls, coarse films, 10 MPa, 2100 r/min: balances",
        checks=found.pump_point.checks,
    )
