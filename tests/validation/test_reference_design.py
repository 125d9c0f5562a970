"""The design of the reference pump: with all physics its films are those of the paper, cool and mostly without contact.

Xu, Hu, Zhang and Mao 2017: piston film 15 um; slipper film 8 um at 35 MPa and 15 um at 5 MPa (Fig. 9); valve plate
film 8 um.
"""

import numpy as np
import pytest

from gaps.revolution.march import GapRevolution
from system import load_pump
from system.points.floating import FloatingPoint, floating_point
from system.pump.operating import operating_point

HOTTEST = 393.15  # K
SOURCE = "Xu, Hu, Zhang and Mao 2017, films of the pairs"


def mean_film(gap: GapRevolution) -> float:
    """Film thickness, mean over area and turn, m."""
    return float(np.mean([at.mean_film for at in gap.turn.instants]))


def point_at(pressure: str) -> FloatingPoint:
    pump = load_pump("ref90", {"operating.pressure": pressure})
    return floating_point(pump, operating_point(pump), side_by_side=True)


@pytest.mark.long
@pytest.mark.parametrize(("pressure", "slipper"), [("35 MPa", 8e-6), ("5 MPa", 15e-6)])
def test_films_are_those_of_the_paper(pressure, slipper, validation):
    found = point_at(pressure)
    gaps, checks = found.kinds[0].gaps, found.pump_point.checks
    films = (
        ("piston", gaps.piston, 15e-6, 1e-6),
        ("slipper", gaps.slipper, slipper, 2e-6),
        ("block", gaps.block, 8e-6, 2e-6),
    )
    for name, gap, expected, tolerance in films:
        validation(
            case="Design of the reference pump, all physics",
            source=SOURCE,
            quantity=f"mean film, {name}, {pressure}",
            unit="m",
            expected=expected,
            obtained=mean_film(gap),
            tolerance=tolerance,
        )
        assert gap.warmth is not None
        assert gap.warmth.hottest.max() < HOTTEST
    # Only run-in edges of a piston touch: they rub less than a tenth of what its film shears.
    rubbing = [np.mean([at.passed.heat.rubbing for at in gap.turn.instants]) for _, gap, _, _ in films]
    sheared = [np.mean([at.passed.heat.shear for at in gap.turn.instants]) for _, gap, _, _ in films]
    assert (np.array(rubbing) < 0.1 * np.array(sheared)).all()
    cycle = found.pump_point.cycle
    assert cycle.pressure.min() > 0.0
    if pressure == "35 MPa":
        assert cycle.pressure.max() < 1.1 * found.pump_point.point.delivery_pressure
    assert checks.energy_balance_error < 1e-3
    assert checks.mass_balance_error < 1e-8
