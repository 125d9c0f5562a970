"""The recorded chamber pressures of a diagnosis beside the simulated ones, as rows of text by column."""

from __future__ import annotations

from collections.abc import Iterator

from diagnosis.explain.hypotheses import simulator_of
from diagnosis.recording.units import channel_unit, difference, reading
from diagnosis.report.tables import Row
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis
from diagnosis.verdict.row_numbers import table_rows
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

ANGLE = f"angle [{channel_unit(ChannelName.ANGLE)}]"


def trace_residual_rows(study: Study, diagnosis: Diagnosis) -> Iterator[Row]:
    """Each sample of each trace: measured, simulated by the null's and by the claimed fit, pulls.

    sigma is that of the recorded mean, an angle known to its step; point: row of the steady table, from 1.
    """
    numbers, unit = table_rows(study.recording), channel_unit(ChannelName.P_CHAMBER)
    for trace in study.traces:
        point, angle = trace.block.point, trace.block.angle
        before, after = simulated_traces(study, diagnosis, (point,), angle)
        for at, measured in enumerate(trace.block.mean):
            one = trace.sigma[at]
            yield {
                "point": str(numbers[point]),
                ANGLE: f"{reading(ChannelName.ANGLE, float(angle[at])):.6g}",
                f"measured [{unit}]": _pressure(float(measured)),
                f"before [{unit}]": _pressure(float(before[0, at])),
                f"after [{unit}]": _pressure(float(after[0, at])),
                f"sigma [{unit}]": f"{difference(ChannelName.P_CHAMBER, float(one)):.4g}",
                "pull_before": f"{(measured - before[0, at]) / one:.4g}",
                "pull_after": f"{(measured - after[0, at]) / one:.4g}",
            }


def simulated_traces(study: Study, diagnosis: Diagnosis, points: tuple[int, ...], angle: Array) -> tuple[Array, Array]:
    """Chamber pressure (len(points), K), Pa gauge, at shaft angles (K,) rad: by the null's fit, by the claimed.

    The latter is the null's without a claim, or for a claim without a law.
    """
    before = study.simulator.traces(diagnosis.before.values, points, angle)
    own = diagnosis.hypotheses[0]
    if not diagnosis.effects or own.posterior is None:
        return before, before
    simulator = simulator_of(study, own.hypothesis, diagnosis.thresholds)
    return before, simulator.traces(own.posterior.values, points, angle)


def _pressure(pressure: float) -> str:
    return f"{reading(ChannelName.P_CHAMBER, pressure):.6g}"
