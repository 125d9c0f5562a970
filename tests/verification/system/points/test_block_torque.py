"""Torque against the block's turning: that of its film and that of its kidneys on a tilted block add up."""

from types import SimpleNamespace

import numpy as np
import pytest

from system.points.floating_exchange import block_torque


@pytest.mark.parametrize("pitches", [1, 9])
def test_both_torques_brake_the_block(pitches):
    rng = np.random.default_rng(3)
    torque, tilted = rng.uniform(1.0, 3.0, (2, 12))
    reports = [SimpleNamespace(torque=one, tilted_torque=other) for one, other in zip(torque, tilted, strict=True)]
    turn = SimpleNamespace(instants=[SimpleNamespace(passed=one) for one in reports])
    angles = np.linspace(0.0, 2.0 * np.pi / pitches, 13)[1:]
    block = SimpleNamespace(angles=angles, turn=turn)
    found = block_torque(block, 12 * pitches)
    assert found.shape == (12 * pitches,)
    assert found.mean() == pytest.approx(np.mean(torque + tilted), rel=1e-12)
