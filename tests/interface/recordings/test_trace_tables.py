"""The table and the picture of recorded chamber pressures in a diagnosis's run folder."""

from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import TraceBlock
from diagnosis.report.trace_tables import trace_residual_rows
from diagnosis.study.model import TraceMisfit
from swashfilm.runs.diagnose.files import with_stated
from swashfilm.runs.diagnose.page import strongest_courses
from swashfilm.runs.diagnose.trace_plots import trace_residuals, worst_points

ANGLE = 2.0 * np.pi * np.arange(72) / 72
SIGMA = 0.4e5  # Pa


def _rows(points=(4, 9)):
    """Traces that read 3 sigma above a simulation without any pressure (gauge), where nothing is claimed."""

    def misfit(point):
        block = TraceBlock(point, ANGLE, np.full(72, 3.0 * SIGMA), None, 1)
        return TraceMisfit(block, block.mean, np.zeros((72, 0)), np.full(72, SIGMA))

    flat = SimpleNamespace(traces=lambda values, points, angles: np.zeros((len(points), len(angles))))
    recording = SimpleNamespace(notes=(), steady=SimpleNamespace(values=np.zeros((10, 0)), rows=None))
    study = SimpleNamespace(traces=tuple(map(misfit, points)), simulator=flat, recording=recording)
    nothing = SimpleNamespace(
        effects=(), hypotheses=(SimpleNamespace(posterior=None),), before=SimpleNamespace(values=np.zeros(0))
    )
    return list(with_stated(study, trace_residual_rows(study, nothing)))


def test_each_sample_stands_in_the_table_with_its_pulls():
    rows = _rows()
    assert [row["point"] for row in rows] == ["5"] * 72 + ["10"] * 72
    assert float(rows[1]["angle [deg]"]) == pytest.approx(5.0)
    for row in rows:
        assert float(row["measured [bar]"]) == pytest.approx(1.2)
        assert (row["before [bar]"], row["after [bar]"], row["sigma [bar]"]) == ("0", "0", "0.4")
        assert row["stated [bar]"] == "0"
        assert float(row["pull_before"]) == pytest.approx(3.0)


def test_the_picture_shows_the_worst_few():
    rows = _rows(tuple(range(7)))
    misfit = (3.0, 1.0, 6.0, 2.0, 5.0, 0.0, 4.0)
    rows = [{**row, "pull_before": str(misfit[int(row["point"]) - 1])} for row in rows]
    assert worst_points(rows) == ["1", "3", "5", "7"]
    assert trace_residuals(rows, (350.0, 5.0), {"5": "point 5: 1000 rpm"}).axes


def test_what_is_claimed_is_drawn_where_it_adds_most_and_nowhere_of_a_trace_alone():
    def rows(drain, torque):
        place = [(bar, rpm) for bar in (100, 200, 300) for rpm in (1000, 2000)]
        return [
            {"channel": name, "p_out [bar]": str(bar), "speed [rpm]": str(rpm), "displacement_ratio [1]": "",
             "T_case [degC]": "50", "added": str(size), "sigma": "1"}
            for bar, rpm in place
            for name, size in (("Q_case", drain * bar / 100), ("torque", torque * rpm / 1000))
        ]  # fmt: skip

    assert strongest_courses(rows(5.0, -1.0)) == [("Q_case", "p_out [bar]"), ("torque", "speed [rpm]")]
    assert strongest_courses(rows(0.01, 1.0)) == [("torque", "speed [rpm]")]
    assert strongest_courses(rows(0.0, 0.0)) == []
