"""Gaps in processes of their own: the same revolutions, and errors that come over."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import Accuracy
from reynolds import FilmNotConverged, InputError
from system import RIGID, FloatingOptions, floating_point, load_pump, lumped_point, no_rubbing, operating_point, rotor
from system.description.gap import Gap
from system.points import gap_process
from system.points.floating_kinds import Group, RoundDrives, drives_of, group_of, revolutions
from system.points.floating_progress import GAP_SHARES, shares_of_gaps
from system.points.gap_process import gaps_apart, gaps_beside
from system.work.progress import silent

ROUGHLY = FloatingOptions(RIGID, steps=36, finer=0.25, accuracy=Accuracy(step=0.1, floor=1e-7, closed=0.5), keep=6)
EVERY = (Gap.PISTON, Gap.SLIPPER, Gap.VALVE_PLATE)


def asked(options: FloatingOptions = ROUGHLY) -> tuple[Group, RoundDrives]:
    pump = load_pump("ref90", {"operating.pressure": "3 MPa"})
    lumped = lumped_point(pump, operating_point(pump))
    at, angle = rotor(pump, lumped.point), lumped.cycle.shaft_angle
    pressures = tuple(one.pressure for one in lumped.chambers)
    return group_of(at, options.physics), RoundDrives(at, angle, pressures, (no_rubbing(angle.size),), (None,), options)


@pytest.mark.long
@pytest.mark.parametrize("apart", [(Gap.PISTON,), (Gap.SLIPPER, Gap.VALVE_PLATE)])
def test_a_process_of_its_own_finds_the_same_revolutions(apart):
    group, here = asked()
    told: list[str] = []
    driven = drives_of(here, group)
    with gaps_beside(group, (apart,), None) as (beside,):
        beside.start(here)
        alone = {gap: next(revolutions(gap, here, group, driven, (), silent)) for gap in apart}
        once = dict(beside.fetch(lambda done, total, what: told.append(what)))
        assert tuple(once) == apart
        for gap in apart:
            (found,) = once[gap]
            assert np.array_equal(found.positions, alone[gap].positions)
            assert found.closing.turns == alone[gap].closing.turns
            assert list(found.turn.films) == list(alone[gap].turn.films)
            assert any(what.startswith(gap.value.replace("valve_plate", "block")) for what in told)
        # It goes on from where it ended.
        beside.start(here)
        again = dict(beside.fetch(silent))
        assert all(again[gap][0].closing.turns <= once[gap][0].closing.turns for gap in apart)
        beside.start(asked(FloatingOptions(RIGID, steps=0))[1])
        with pytest.raises((InputError, ValueError), match=r"revolution|steps"):
            dict(beside.fetch(silent))


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 3])
def test_a_point_is_the_same_from_any_number_of_processes(count, monkeypatch):
    monkeypatch.setattr(gap_process, "cores", lambda: count)
    pump = load_pump("ref90", {"operating.pressure": "3 MPa"})
    alone, beside = (floating_point(pump, operating_point(pump), ROUGHLY, side_by_side=way) for way in (False, True))
    assert np.array_equal(beside.pump_point.cycle.pressure, alone.pump_point.cycle.pressure)
    assert [one.films_solved for one in beside.rounds] == [one.films_solved for one in alone.rounds]


def test_each_gap_has_one_process(monkeypatch):
    """Which ones stand beside depends on cores and physics; some gap is left for the process that waits."""
    for count in (1, 2, 3, 16):
        monkeypatch.setattr(gap_process, "cores", lambda count=count: count)
        for physics in (FloatingOptions().physics, RIGID):
            apart = [gap for gaps in gaps_apart(physics) for gap in gaps]
            assert len(apart) == len(set(apart)) < len(EVERY)
            shares = shares_of_gaps(apart)
            assert sum(shares.values()) == pytest.approx(1.0)
            assert set(shares) == set(GAP_SHARES)


@pytest.mark.parametrize("error", [FilmNotConverged("walls that touch", "less load"), InputError("slipper", "2", "3")])
def test_errors_come_over_as_they_were(error):
    import pickle

    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is type(error)
    assert str(copy) == str(error)
    assert vars(copy) == vars(error)
