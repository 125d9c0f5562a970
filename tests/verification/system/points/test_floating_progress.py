"""Progress of a floating point: units that only grow, and rounds expected by the rate at which changes fall."""

import pytest

from system.points.floating_progress import EXPECTED_ROUNDS, FIRST, GAP_SHARES, LATER, WholeRun


def rounds(changes: list[float]) -> list[tuple[int, int, str]]:
    """Reports of a run whose rounds change by so many times their tolerances, two turns of each gap in a round."""
    told: list[tuple[int, int, str]] = []
    whole = WholeRun(lambda *one: told.append(one), 12, GAP_SHARES)
    for change in changes:
        report = whole.begun()
        for gap in ("slipper", "block", "piston"):
            for turn in ("turn 1", "turn 2"):
                for done in (18, 36):
                    report(done, 36, f"{gap}, {turn}")
        whole.ended(change)
    return told


def test_progress_never_goes_back_and_is_never_more_than_all():
    told = rounds([40.0, 8.0, 2.0, 0.5])
    done = [one[0] for one in told]
    assert done == sorted(done)
    assert all(0 <= part <= whole for part, whole, what in told if not what.startswith("round 1"))
    assert told[0][2] == "round 1, slipper, turn 1"


def test_the_units_in_all_are_known_from_the_end_of_the_first_round():
    told = rounds([40.0, 8.0])
    assert {whole for _, whole, what in told if what.startswith("round 1")} == {0}
    assert {whole for _, whole, what in told if what.startswith("round 2")} == {FIRST + (EXPECTED_ROUNDS - 1) * LATER}


@pytest.mark.parametrize(
    ("changes", "left"),
    [
        ([30.0, 10.0, 3.0], 3),
        ([100.0, 50.0, 25.0], 5),
        ([300.0, 20.0, 16.0], 3),
        ([300.0, 20.0, 16.0, 12.0], 3),
        ([0.5], 1),
    ],
)
def test_rounds_are_expected_by_the_rate_of_those_before(changes, left):
    whole = WholeRun(lambda *_: None, 12, GAP_SHARES)
    for change in changes:
        whole.begun()
        whole.ended(change)
    assert whole.expected == len(changes) + left
