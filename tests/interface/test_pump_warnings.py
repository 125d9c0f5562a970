"""What `swashfilm run` tells a reader to doubt about the films of the three gaps."""

from types import SimpleNamespace

import numpy as np
import pytest

from gaps.piston import PistonGap, PistonGeometry, PistonLoad, PistonState
from swashfilm.pump_warnings import (
    coarse_angles,
    impossible_pressures,
    turbulent_orifice,
    uncarried_loads,
)
from system.operating import operating_point
from system.pump_file import load_pump

EMPTY = PistonLoad((0.0, 0.0), 0.0)


def film(pressure, load=EMPTY):
    """A spinning piston at half its clearance with one pressure (Pa) at both ends."""
    state = PistonState(40e-3, pressure, pressure, -1e5, 0.03, 0.0, 220.0, 220.0)
    return PistonGap(PistonGeometry(22e-3, 15e-6), (24, 6)).at(state, load, np.array([7.5e-6, 0.0, 7.5e-6, 0.0]))


def films(piston, other):
    """The part of a FilmsPoint that is looked at: `piston` in the piston gap, `other` in the two others."""
    ring = SimpleNamespace(gap=other)
    return SimpleNamespace(gaps=SimpleNamespace(piston=(piston,), slipper=(other,), valve_plate=(ring,)))


@pytest.mark.parametrize(("share", "count"), [(0.5, 1), (1.0, 0), (2.0, 1)])
def test_a_load_that_is_not_the_films_is_told_whether_larger_or_smaller(share, count):
    held = film(100e6, PistonLoad((0.0, 1.0), 0.0)).carried_load
    told = uncarried_loads(films(film(100e6, PistonLoad((0.0, share * held), 0.0)), film(100e6)))
    assert len(told) == count


def test_pressures_that_no_wall_would_stand_are_told():
    told = impossible_pressures(films(film(150e6), film(50e6)))
    assert len(told) == 1
    assert told[0].startswith("film_pressure_beyond_rigid: piston: film pressure up to 1")
    assert "limit 100 MPa" in told[0]


@pytest.mark.parametrize(("flow", "count"), [(1e-6, 0), (4e-4, 1)])
def test_an_orifice_beyond_its_capillary_law_is_told(flow, count):
    # REF90's bore of 0.9 mm at 35 MPa: 4e-4 m3/s is 629 m/s, far beyond any laminar flow.
    pump = load_pump("ref90")
    point = SimpleNamespace(
        rotor=SimpleNamespace(pump=pump, point=operating_point(pump)),
        gaps=SimpleNamespace(slipper=(SimpleNamespace(chamber_flow=flow),), chamber_pressure=np.array([35e6])),
    )
    told = turbulent_orifice(point)
    assert len(told) == count
    assert all("orifice_not_a_capillary" in text and "m/s" in text for text in told)


@pytest.mark.parametrize(("error", "count"), [(0.005, 0), (0.3, 1)])
def test_too_few_film_angles_are_told(error, count):
    told = coarse_angles(SimpleNamespace(sampling_error=error))
    assert len(told) == count
    assert all("30.0%" in text for text in told)
