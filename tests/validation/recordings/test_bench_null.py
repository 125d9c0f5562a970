"""Bench map without a left-out effect: residuals at the noise."""

from pathlib import Path

import numpy as np
from bench_pump import BENCH

from diagnosis import observations, read_recording
from diagnosis.study.inputs import bench_points
from system import SIMULATED, ChannelName, LumpedBench, base_parameters, linear_posterior, load_pump, tolerances
from system.bench.sensors import sensor_parameters

INPUTS = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.P_IN, ChannelName.P_CASE, ChannelName.T_CASE)


def test_null_recording_is_noise(validation):
    """Priors and noise being right, residuals^2 + parameters^2 is chi-square of as many as there are readings.

    The tolerance is three sigma of that. Where the piston can stand out in no way but as a pivot on the shaft axis
    would have it, it is missed: leakage falls by 12 % from full to 28 % displacement.
    """
    recording = read_recording(Path(__file__).parents[3] / "examples" / "recordings" / "open-01")
    pump = load_pump(BENCH)
    points, _ = bench_points(recording, pump)
    parameters = (*base_parameters(pump, tolerances(pump)[0]), *sensor_parameters(recording.channels))
    bench = LumpedBench(pump, points, SIMULATED, parameters, inputs=INPUTS)
    read = observations(recording, SIMULATED, INPUTS)
    found = linear_posterior(bench, read)
    size = found.residual.size
    validation(
        case="bench map without an effect", source="examples/recordings/open-01",
        quantity="chi-square per reading", unit="1",
        expected=1.0, obtained=found.objective / size, tolerance=3.0 * np.sqrt(2.0 / size),
    )  # fmt: skip
    fixed = tuple(one for one in parameters if one.name != "stand_out_share")
    pivoted = load_pump(BENCH, {"piston.stand_out_share": 1.0})
    missed = linear_posterior(LumpedBench(pivoted, points, SIMULATED, fixed, inputs=INPUTS), read)
    assert missed.objective / size > 1.0 + 3.0 * np.sqrt(2.0 / size)
