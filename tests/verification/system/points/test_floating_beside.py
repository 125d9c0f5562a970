"""Gaps in processes of their own: the same revolutions, and errors that come over."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import Accuracy
from reynolds import FilmNotConverged, InputError
from system import (
    RIGID,
    FloatingOptions,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    rotor,
)
from system.description.gap import Gap
from system.points.floating_gaps import piston_revolution, slipper_revolution
from system.points.gap_process import Driven, gap_beside

ROUGHLY = FloatingOptions(RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.5), keep=6)


def asked(options: FloatingOptions = ROUGHLY) -> Driven:
    pump = load_pump("ref90", {"operating.pressure": "3 MPa"})
    lumped = lumped_point(pump, operating_point(pump))
    cycle = lumped.cycle
    return Driven(
        rotor(pump, lumped.point), cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size), options
    )


@pytest.mark.long
@pytest.mark.parametrize("gap", [Gap.PISTON, Gap.SLIPPER])
def test_a_process_of_its_own_finds_the_same_revolution(gap):
    here, told = asked(), []
    parts = floating_parts(here.rotor.pump)
    driven = drives(here.rotor, parts, here.shaft_angle, here.pressure, here.rubbing)
    with gap_beside(gap, (parts,), [None]) as beside:
        beside.start((here,))
        if gap is Gap.PISTON:
            alone = piston_revolution(here.rotor, parts, driven.piston, ROUGHLY)
        else:
            alone = slipper_revolution(here.rotor, parts, driven.slipper, ROUGHLY)
        (found,) = beside.fetch(lambda done, total, what: told.append(what))
        assert np.array_equal(found.positions, alone.positions)
        assert found.closing.turns == alone.closing.turns
        assert list(found.turn.films) == list(alone.turn.films)
        assert any(what.startswith(gap.value) for what in told)
        # It goes on from where it ended.
        beside.start((here,))
        (again,) = beside.fetch(lambda *_: None)
        assert again.closing.turns <= found.closing.turns
        beside.start((asked(FloatingOptions(RIGID, steps=0)),))
        with pytest.raises(InputError, match="revolution"):
            beside.fetch(lambda *_: None)


@pytest.mark.parametrize("error", [FilmNotConverged("walls that touch", "less load"), InputError("slipper", "2", "3")])
def test_errors_come_over_as_they_were(error):
    import pickle

    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is type(error)
    assert str(copy) == str(error)
    assert vars(copy) == vars(error)
