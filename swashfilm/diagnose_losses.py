"""What a finding means for the pump: where its shaft power goes without it and with it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict

import numpy as np

from diagnosis.diagnosis_tables import Row
from diagnosis.readings import bench_points
from diagnosis.study import Study
from diagnosis.verdict import Diagnosis
from system.assembly import PumpPoint
from system.bench_points import operating_at
from system.description import PumpDescription
from system.estimation.posterior import Posterior
from system.extended_pump import extended_pump
from system.lumped_point import lumped_point
from system.operating import OperatingPoint
from system.pairs import Pair


def claimed_pump(pump: PumpDescription, found: Diagnosis) -> PumpDescription:
    """The pump as the claimed explanation has it: its fit's parameters, its effects switched on."""
    return extended_pump(pump, _by_name(found.after), found.hypotheses[0].hypothesis.laws)


def loss_rows(pump: PumpDescription, study: Study, found: Diagnosis) -> Iterator[Row]:
    """Sinks of the shaft power in W, without and with what is claimed, at the recorded point of greatest effect.

    Each by its own fit of the recording. The first row names the point. Nothing where nothing is claimed. Raises
    NotConverged where the point cannot be solved.
    """
    if not found.effects:
        return
    at = _greatest(found)
    before = lumped_point(extended_pump(pump, _by_name(found.before), ()), _point(pump, study, at))
    after = lumped_point(claimed_pump(pump, found), _point(pump, study, at))
    sinks = _sinks(before), _sinks(after)
    for name in sinks[0]:
        one, other = (found[name] for found in sinks)
        yield {
            "point": str(at + 1),
            "sink": name,
            "before [W]": f"{one:.1f}",
            "after [W]": f"{other:.1f}",
            "change [W]": f"{other - one:+.1f}",
        }


def _by_name(fit: Posterior) -> dict[str, float]:
    names = (parameter.name for parameter in fit.parameters)
    return dict(zip(names, (float(value) for value in fit.values), strict=True))


def _greatest(found: Diagnosis) -> int:
    """The recorded point at which the two fits part the most, in sigma."""
    whitening = found.after.whitening
    apart = whitening.whiten(found.after.predictions - found.before.predictions)
    return int(np.argmax(np.bincount(whitening.rows[:, 0], weights=apart**2)))


def _point(pump: PumpDescription, study: Study, at: int) -> OperatingPoint:
    points, _ = bench_points(study.recording, pump)
    return operating_at(pump, points, at)


def _sinks(point: PumpPoint) -> Mapping[str, float]:
    """Where the shaft power goes, pair by pair, in W."""
    power = point.power
    return {
        "shaft power": power.shaft,
        "hydraulic power": power.hydraulic,
        "compression of the oil": power.elastic,
        **{f"leakage, {gap.replace('_', ' ')}": loss for gap, loss in asdict(power.leakage).items()},
        "throttling in the ports": power.throttling,
        **{f"friction, {pair.value.replace('_', ' ')}": point.pairs.loss(pair).mean for pair in Pair},
        "effects beside gaps and pairs": power.extended,
    }
