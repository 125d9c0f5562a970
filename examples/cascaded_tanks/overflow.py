"""Missing physics of a model of two tanks, found from one record and tested on another.

    python examples/cascaded_tanks/overflow.py DATA.csv

DATA.csv: dataBenchmark.csv of the Cascaded Tanks benchmark (4TU.ResearchData, doi 10.4121/12960104, CC BY-SA 4.0),
columns uEst, yEst, uVal, yVal. The estimation engine fits the model of `tanks.py`.

Sizes and errors come from a simulation of the whole record. For the evidence the residual of the base model is
noise with memory, autoregressive of second order. Neighbouring residuals have a correlation of 0.995, so that 1024
samples count as few; evidence from independent samples would favour any addition. Of the test record only first
levels are fitted.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from tanks import BASE, EXTENSIONS, Tanks

from reynolds import Array
from system import Channel, FitLimits, Observations, Parameter, Posterior, best_posterior

LIMITS = FitLimits(steps=100, stall=20.0)  # rims are kinks: the last nats of thousands are out of reach
FIRST_LEVELS = tuple(parameter for parameter in BASE if parameter.name.startswith("first"))
SENSOR = 0.3  # V: first value of one sigma; that of the record replaces it
STARTS = (0.1, -0.5, 1.0)  # spreads from the prior mean
BLOCK = 64  # samples
OVERFLOW = "overflow of both tanks"


@dataclass(frozen=True)
class Record:
    """Voltage of the pump and of the level sensor, one sample every 4 s, of the two records."""

    pump: Array
    sensor: Array
    test_pump: Array
    test_sensor: Array


@dataclass(frozen=True)
class Addition:
    """An addition to the model: ln evidence over the model without it, RMS errors on both records in V, fit."""

    name: str
    evidence: float
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


def fitted(tanks: Tanks, readings: Observations, starts: Sequence[Array]) -> Posterior:
    """Return the best peak from several starts, each moved within the bounds."""
    lowest = [parameter.lowest for parameter in tanks.parameters]
    highest = [parameter.highest for parameter in tanks.parameters]
    return best_posterior(tanks, readings, [np.clip(start, lowest, highest) for start in starts], LIMITS)


def simulated(record: Record, parameters: tuple[Parameter, ...], start: Array) -> Posterior:
    """Return the model fitted to the whole record, from the peak of the model without its last parameters."""
    added = len(parameters) - start.size
    starts = [np.append(start, np.full(added, spreads)) for spreads in STARTS]
    return fitted(Tanks(record.pump, parameters), observed(record.sensor, SENSOR), starts)


def errors(record: Record, fit: Posterior) -> tuple[float, float]:
    """Return RMS errors in V of a fit on its own record and on the test record."""
    known = {parameter.name: value for parameter, value in zip(fit.parameters, fit.values, strict=True)}
    there = fitted(Tanks(record.test_pump, FIRST_LEVELS, known), observed(record.test_sensor, SENSOR), [np.zeros(2)])
    own = record.sensor - fit.predictions[:, 0]
    return float(np.sqrt(np.mean(own**2))), float(np.sqrt(np.mean((record.test_sensor - there.predictions[:, 0]) ** 2)))


def additions(record: Record, base: Posterior, names: Sequence[str]) -> tuple[Addition, ...]:
    """Return each extension added to a model, the one of greatest evidence first."""
    sigma, memory = noise(record.sensor - base.predictions[:, 0])
    readings = observed(record.sensor, sigma, memory)
    without = fitted(Tanks(record.pump, base.parameters), readings, [base.xi])
    found = []
    for name in names:
        parameters = (*base.parameters, *EXTENSIONS[name])
        fit = simulated(record, parameters, base.xi)
        beside = np.append(without.xi, np.full(len(EXTENSIONS[name]), STARTS[0]))
        peak = fitted(Tanks(record.pump, parameters), readings, [fit.xi, beside])
        found.append(Addition(name, peak.log_evidence - without.log_evidence, *errors(record, fit), fit))
    return tuple(sorted(found, key=lambda addition: -addition.evidence))


def base_fit(record: Record) -> Posterior:
    """Return the fit of the model without any addition."""
    return simulated(record, BASE, np.zeros(len(BASE)))


def _table(title: str, error: tuple[float, float], found: Sequence[Addition]) -> None:
    print(f"{title}: RMS error {error[0]:.3f} V, test record {error[1]:.3f} V")
    print(f"  {'added':28s} {'ln evidence':>11s} {'RMS, V':>8s} {'test, V':>8s}")
    for each in found:
        print(f"  {each.name:28s} {each.evidence:11.1f} {each.error:8.3f} {each.test_error:8.3f}")


def main(path: str) -> None:
    """Print the gain by one addition, and by a second one beside the overflow."""
    record = read_record(Path(path))
    base = base_fit(record)
    first = additions(record, base, tuple(EXTENSIONS))
    _table("Torricelli's law", errors(record, base), first)
    overflow = next(each for each in first if each.name == OVERFLOW)
    rest = [name for name in EXTENSIONS if "overflow" not in name]
    _table(f"\nwith {OVERFLOW}", (overflow.error, overflow.test_error), additions(record, overflow.fit, rest))


if __name__ == "__main__":
    main(sys.argv[1])
