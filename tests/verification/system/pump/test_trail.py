"""Steps of a revolution that another chamber takes again: where its run-in begins."""

import numpy as np
import pytest

from system.pump.chamber.kernels import BEGIN, LENGTH
from system.pump.chamber.trail_kernels import RUN_IN, run_in_row

COLUMNS = max(BEGIN, LENGTH) + 1


@pytest.mark.parametrize(("steps", "turn"), [(40, 2.0 * np.pi), (7, 2.0 * np.pi), (3, 0.5 * RUN_IN)])
def test_a_run_in_covers_its_angle_with_the_fewest_steps(steps, turn):
    trail = np.zeros((steps, COLUMNS))
    trail[:, BEGIN], trail[:, LENGTH] = turn / steps * np.arange(steps), turn / steps
    row = run_in_row(trail)
    begins = turn - RUN_IN
    assert row == max((k for k in range(steps) if trail[k, BEGIN] <= begins), default=0)
