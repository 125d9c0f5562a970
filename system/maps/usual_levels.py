"""Usual levels of an operating map: the paper's 112 points in shares of the rating."""

import math
from collections.abc import Sequence

from system.description.pump import PumpDescription
from system.inputs.units import RPM
from system.maps.plan import MapAxis, MapInput

PAPER_SPEEDS = (1000.0, 1300.0, 1700.0, 2100.0)
PAPER_PRESSURES = (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0)
PAPER_RATIOS = (0.28, 0.51, 0.77, 1.0)
"""The paper's 112 test points: r/min, MPa gauge at the delivery port, share of the full displacement.

The last speed and the last pressure are the rating of its pump.
"""
MEGAPASCAL = 1e6  # Pa
STEPS = 20
"""Steps of rounded levels in a power of ten: 50 r/min for a rating of 2600 r/min, 0.5 MPa for 28 MPa."""


def usual_axes(pump: PumpDescription) -> tuple[MapAxis, ...]:
    """The paper's speeds and pressures in shares of the pump's rating, and its displacements.

    Levels are rounded, but the highest is the rating itself. A pump of the paper's rating has the paper's 112 points.
    Pressures that do not exceed the pump's inlet pressure are left out.
    """
    rated = pump.pump
    speeds = _in_shares(PAPER_SPEEDS, rated.rated_speed, RPM)
    pressures = _in_shares(PAPER_PRESSURES, rated.rated_pressure, MEGAPASCAL)
    raised = tuple(level for level in pressures if level > pump.operating.inlet_pressure)
    return (
        MapAxis(MapInput.SPEED, speeds),
        MapAxis(MapInput.PRESSURE, raised or pressures[-1:]),
        MapAxis(MapInput.RATIO, PAPER_RATIOS),
    )


def _in_shares(levels: Sequence[float], rated: float, unit: float) -> tuple[float, ...]:
    """Levels (SI) in the ratio of the paper's to the highest of them, for a rating (SI) and its unit."""
    most = float(f"{rated / unit:.9g}")  # 2100, not 2100.0000000000005
    step = 10.0 ** math.floor(math.log10(most)) / STEPS
    rounded = (unit * step * round(most * level / levels[-1] / step) for level in levels[:-1])
    return (*rounded, min(unit * most, rated))
