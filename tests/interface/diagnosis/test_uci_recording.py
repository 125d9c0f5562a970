"""The ZeMA rig's files become recordings; their repeatability comes from the cycles themselves."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from diagnosis import NoteKind, check_recording, load_thresholds, read_recording
from system import ChannelName

RIG = runpy.run_path(str(Path(__file__).parents[3] / "examples" / "uci_hydraulic" / "rig.py"))


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    data = Path(__file__).parents[4] / "shared" / "recordings" / "uci_hydraulic"
    if not data.is_dir():
        pytest.skip(f"no shared reference material at {data}")
    folder, found = tmp_path_factory.mktemp("uci"), []
    for leak in (0, 1, 2):
        RIG["write_recording"](RIG["cycle_means"](data, leak, 100), folder / str(leak), leak, 100)
        found.append(check_recording(read_recording(folder / str(leak)), None, load_thresholds().data))
    return found


def test_readings_and_their_repeatability(recordings):
    for recording in recordings:
        flow = recording.channel(ChannelName.Q_OUT)
        assert len(recording.steady.values) > 50
        assert 0.002 < flow.sigma * 60e3 < 0.1
        assert "sigma" in flow.assumed
        assert 120e5 < np.median(recording.steady.column(ChannelName.P_OUT)) < 180e5
        assert not [note for note in recording.notes if note.kind is NoteKind.FAULT]


def test_leakage_stands_out_of_the_flow(recordings):
    """Less flow by .23 and .35 L/min at equal pressure (both within .05), many times the repeatability."""
    means = [float(np.nanmedian(one.steady.column(ChannelName.Q_OUT))) * 60e3 for one in recordings]
    assert means[0] - means[1] == pytest.approx(0.23, abs=0.06)
    assert means[0] - means[2] == pytest.approx(0.35, abs=0.06)
