"""Physics that a model of two tanks lacks, found from one record and tested on another.

    python examples/cascaded_tanks/overflow.py DATA.csv [--picture FILE.png]

DATA.csv: dataBenchmark.csv of the Cascaded Tanks benchmark (4TU.ResearchData, doi 10.4121/12960104, CC BY-SA 4.0),
columns uEst, yEst, uVal, yVal. The estimation engine adds to the model of `tanks.py` what it lacks, one piece after
the other, as long as the evidence for it is three nats.

For the evidence the residual of the model so far is noise with memory, autoregressive of second order. Neighbouring
residuals have a correlation of 0.995, so that 1024 samples count as few; evidence from independent samples would favour
any addition. Sizes and errors come from a simulation of the whole record. Of the test record only first levels are
fitted.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tanks import BASE, EXTENSIONS, Tanks

from reynolds import Array
from system import Channel, FitLimits, Ladder, Observations, Parameter, Posterior, Rung, best_posterior, ladder

LIMITS = FitLimits(steps=100, stall=20.0)  # rims are kinks: the last nats of thousands are out of reach
FIRST_LEVELS = tuple(parameter for parameter in BASE if parameter.name.startswith("first"))
SENSOR = 0.3  # V: first value of one sigma; that of the record replaces it
BLOCK = 64  # samples
SIZES = (0.1, -0.5, 1.0)  # of an addition, in spreads, at which its fit starts


@dataclass(frozen=True)
class Record:
    """Voltage of the pump and of the level sensor, one sample every 4 s, of the two records."""

    pump: Array
    sensor: Array
    test_pump: Array
    test_sensor: Array


@dataclass(frozen=True)
class Step:
    """A model of the tanks: what was added last, its gain in nats, RMS errors on both records in V, fit.

    note: what the readings do not tell from it, or that its gain is short of three nats.
    """

    name: str
    gain: float
    note: str
    error: float
    test_error: float
    fit: Posterior


def read_record(path: Path) -> Record:
    """Return the two records of the benchmark's file."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return Record(*(np.array([float(row[name]) for row in rows]) for name in ("uEst", "yEst", "uVal", "yVal")))


def observed(sensor: Array, sigma: float, memory: tuple[float, ...] = ()) -> Observations:
    """Return a record as readings of one sigma in V, whose noise may have a memory."""
    return Observations(
        channels=(Channel("level", None),),
        values=sensor[:, None],
        sigma=np.full((sensor.size, 1), sigma),
        inputs=(),
        input_sigma=np.zeros((sensor.size, 0)),
        quantum=np.zeros(1),
        blocks=np.arange(sensor.size) // BLOCK,
        memory=memory,
    )


def noise(residual: Array) -> tuple[float, tuple[float, ...]]:
    """Return sigma in V and second-order memory of a model's residual (Yule 1927)."""
    lag = [float(np.mean(residual[at:] * residual[: residual.size - at])) for at in range(3)]
    first, second = np.linalg.solve([[lag[0], lag[1]], [lag[1], lag[0]]], lag[1:])
    return lag[0] ** 0.5, (float(first), float(second))


def found(record: Record, possible: Mapping[str, Sequence[Parameter]] = EXTENSIONS) -> Ladder:
    """Return what the tanks lack, by evidence with the noise that each model leaves."""

    def renewed(fit: Posterior) -> Observations:
        return observed(record.sensor, *noise(record.sensor - fit.predictions[:, 0]))

    return ladder(Tanks(record.pump), observed(record.sensor, SENSOR), possible, renewed, LIMITS)


def steps(record: Record, climbed: Ladder) -> tuple[Step, ...]:
    """Return the model as it is, with each addition that the evidence asks for, and with the likeliest one more."""
    done = [_step(record, "nothing", 0.0, "", BASE, [np.zeros(len(BASE))])]
    for rung in climbed.rungs:
        best = rung.tried[0]
        if best.gain > 0.0:
            known = dict(zip((one.name for one in done[-1].fit.parameters), done[-1].fit.xi, strict=True))
            begun = [[known.get(one.name, size) for one in best.fit.parameters] for size in SIZES]
            starts = [best.fit.xi, *map(np.array, begun)]
            done.append(_step(record, best.name, best.gain, _note(rung, climbed), best.fit.parameters, starts))
    return tuple(done)


def _note(rung: Rung, climbed: Ladder) -> str:
    """Certainty of the best addition of a step."""
    rivals = ", ".join(one.name for one in rung.rivals)
    if rung.taken is None:
        return "likely, not sure"
    if rung.taken.name not in climbed.kept:
        return "not needed beside later ones"
    return f"not told from {rivals}" if rivals else ""


def _step(
    record: Record, name: str, gain: float, note: str, parameters: tuple[Parameter, ...], starts: Sequence[Array]
) -> Step:
    """The simulation of both records by a model whose sizes fit the whole of the first one."""
    fit = _fitted(Tanks(record.pump, parameters), record.sensor, starts)
    known = {one.name: value for one, value in zip(parameters, fit.values, strict=True)}
    there = _fitted(Tanks(record.test_pump, FIRST_LEVELS, known), record.test_sensor, [np.zeros(2)])
    errors = (_rms(record.sensor - fit.predictions[:, 0]), _rms(record.test_sensor - there.predictions[:, 0]))
    return Step(name, gain, note, *errors, fit)


def _fitted(tanks: Tanks, sensor: Array, starts: Sequence[Array]) -> Posterior:
    """The best peak from several starts, each moved within the bounds."""
    lowest = [parameter.lowest for parameter in tanks.parameters]
    highest = [parameter.highest for parameter in tanks.parameters]
    return best_posterior(tanks, observed(sensor, SENSOR), [np.clip(one, lowest, highest) for one in starts], LIMITS)


def _rms(error: Array) -> float:
    return float(np.sqrt(np.mean(error**2)))


def main(path: str, picture: str = "") -> None:
    """Print every addition that was tried, and the errors of each model; draw them where a picture is named."""
    record = read_record(Path(path))
    climbed = found(record)
    for rung in climbed.rungs:
        print("; ".join(f"{one.name} {one.gain:+.1f}" for one in rung.tried), "nats")
    print(f"  {'added':28s} {'nats':>6s} {'RMS, V':>8s} {'test, V':>8s}")
    models = steps(record, climbed)
    for step in models:
        print(f"  {step.name:28s} {step.gain:6.1f} {step.error:8.3f} {step.test_error:8.3f}  {step.note}".rstrip())

    if picture:
        draw(record, (models[0], models[-1]), picture)


def draw(record: Record, models: Sequence[Step], picture: str) -> None:
    """Draw the level of the first record with two models, and what these leave of it."""
    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    level, left = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    time = 4.0 * np.arange(record.sensor.size)
    level.plot(time, record.sensor, color="#888888", label="measured")
    for step, name in zip(models, ("model as it is", "model with all additions"), strict=True):
        level.plot(time, step.fit.predictions[:, 0], linewidth=1.0, label=name)
        left.plot(time, record.sensor - step.fit.predictions[:, 0], linewidth=1.0)
    level.set(ylabel="level sensor [V]")
    level.legend()
    left.set(xlabel="time [s]", ylabel="measured less model [V]")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[3] if sys.argv[2:3] == ["--picture"] else "")
