"""The run folder of a calibration: tables that programs and the page read."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from diagnosis.calibration import Calibration
from diagnosis.recording.units import channel_head, channel_unit, difference, difference_unit, reading
from diagnosis.report.format import parameter_unit
from diagnosis.verdict.row_numbers import table_rows
from swashfilm.console.schemas import write_new
from swashfilm.formats.versions import headed
from swashfilm.output.run_folder import write_json
from swashfilm.runs.calibrate.words import OFF
from swashfilm.runs.diagnose.files import write_rows
from system.bench.calibration.held_out import PHYSICS
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName
from system.inputs.units import RPM
from system.pump_file.file import resolved_toml

KIND = "calibration"
CALIBRATED = "pump_calibrated.toml"
"""In the run folder: the pump as fitted."""
Row = Mapping[str, str]


def write_calibration_files(folder: Path, found: Calibration, title: str) -> None:
    """Write six tables, the calibrated pump, summary.json and report.html into a run folder."""
    write_rows(folder / "parameters.csv", parameter_rows(found.best))
    write_rows(folder / "undetermined.csv", undetermined_rows(found))
    write_rows(folder / "equation_21.csv", equation_rows(found))
    write_rows(folder / "hersey.csv", hersey_rows(found))
    write_rows(folder / "heldout.csv", heldout_rows(found))
    write_rows(folder / "residuals.csv", residual_rows(found))
    write_new(folder / "resolved.toml", "pump", resolved_toml(found.pump))
    write_new(folder / CALIBRATED, "pump", resolved_toml(found.calibrated_pump))
    write_json(folder / "summary.json", summary(found, title))
    from swashfilm.runs.calibrate.page import write_calibrate_page

    write_calibrate_page(folder)


def summary(found: Calibration, title: str) -> dict[str, Any]:
    """Content of summary.json."""
    fit = found.best
    return {
        **headed(KIND),
        "name": title,
        "points": len(found.study.recording.steady.values),
        "readings": int(fit.residual.size),
        "chi2_per_reading": _chi2(fit),
        "chi2_constant_friction": _chi2(found.fit),
        "parameters": len(fit.parameters),
        "undetermined": len(found.undetermined),
        "hersey": None
        if found.hersey is None
        else {"evidence_nats": found.hersey.evidence, "supported": found.hersey.supported},
        "notes": list(found.notes),
        "assumptions": list(found.assumptions),
        "seconds": found.seconds,
    }


def parameter_rows(fit: Posterior) -> Iterator[Row]:
    """Every parameter: its prior one sigma either way, bounds, fitted value, sigma and distance in prior sigmas."""
    for at, parameter in enumerate(fit.parameters):
        sigma = float(np.sqrt(fit.covariance[at, at]))
        mean = float(fit.values[at])
        unit, factor = parameter_unit(parameter.dimension, mean or parameter.centre)
        yield {
            "name": parameter.name,
            "unit": unit,
            "prior_low": _text(factor * max(parameter.value(-1.0), parameter.lower)),
            "prior": _text(factor * parameter.centre),
            "prior_high": _text(factor * min(parameter.value(1.0), parameter.upper)),
            "lower": _text(factor * parameter.lower),
            "upper": _text(factor * parameter.upper),
            "mean": _text(factor * mean),
            "sigma": _text(factor * fit.sigma(parameter.name)),
            "sigma_over_prior [1]": _text(sigma),
            OFF: f"{float(fit.xi[at]):.3f}",
            "at_bound": "yes" if fit.at_bounds[at] else "no",
            "source": parameter.source,
        }


def undetermined_rows(found: Calibration) -> Iterator[Row]:
    """Combinations of standard numbers that the readings leave to the priors, the least determined first."""
    for one in found.undetermined:
        parts = (f"{weight:+.2f} {name}" for name, weight in zip(one.names, one.weights, strict=True))
        yield {"combination": " ".join(parts), "variance_over_prior [1]": f"{one.shrinkage:.4f}"}


def equation_rows(found: Calibration) -> Iterator[Row]:
    """Eq. (21): each coefficient at each displacement and of the whole map, bounded and as printed."""
    for fit in found.equation:
        whole = fit.speed is None
        chi2 = float(fit.posterior.residual @ fit.posterior.residual) / fit.points
        for at, parameter in enumerate(fit.posterior.parameters):
            yield {
                "speed [rpm]": "" if whole else _text(float(fit.speed or 0.0) / RPM),
                "displacement_ratio [1]": "" if whole else _text(float(fit.ratio or 0.0)),
                "points": str(fit.points),
                "coefficient": parameter.name.rpartition(".")[2],
                "prior [1]": _text(parameter.centre),
                "mean [1]": _text(float(fit.posterior.values[at])),
                "sigma [1]": _text(fit.posterior.sigma(parameter.name)),
                "sigma_over_prior [1]": _text(float(np.sqrt(fit.posterior.covariance[at, at]))),
                "as_printed [1]": _text(float(fit.printed[at])),
                "rank": str(fit.rank),
                "known": str(fit.known),
                "condition [1]": f"{fit.condition:.3g}",
                "chi2_per_point [1]": _text(chi2),
            }


def hersey_rows(found: Calibration) -> Iterator[Row]:
    """Coefficient of each film over its Hersey number, with one sigma."""
    for curve in found.curves:
        for number, friction, sigma in zip(curve.number, curve.friction, curve.sigma, strict=True):
            yield {
                "gap": curve.gap.value,
                "hersey_number [1]": _text(float(number)),
                "friction [1]": _text(float(friction)),
                "sigma [1]": _text(float(sigma)),
            }


def heldout_rows(found: Calibration) -> Iterator[Row]:
    """RMS of each model in each split and channel, beside the noise."""
    for row in found.rows:
        yield {
            "model": row.model,
            "left_out": row.split.value,
            "channel": row.channel.value,
            "unit": difference_unit(row.channel),
            "rms": _text(difference(row.channel, row.rms)),
            "noise": _text(difference(row.channel, row.noise)),
            "coefficients": "" if row.model == PHYSICS else str(row.coefficients),
        }


def residual_rows(found: Calibration) -> Iterator[Row]:
    """Each reading: row of the recording's table from 1, operating point, measured and fitted."""
    points, fit, readings = found.points, found.best, found.study.observations
    numbers = table_rows(found.study.recording)
    sigma = fit.whitening.sigma
    for point, at in np.argwhere(readings.measured):
        channel = ChannelName.named(readings.channels[at].name)
        measured, fitted = float(readings.values[point, at]), float(fit.predictions[point, at])
        yield {
            "point": str(numbers[point]),
            "channel": channel.value,
            "unit": channel_unit(channel),
            "speed [rpm]": _text(points.speed[point] / RPM),
            channel_head(ChannelName.P_OUT): _text(reading(ChannelName.P_OUT, points.p_out[point])),
            "displacement_ratio [1]": _text(points.displacement_ratio[point]),
            "measured": _text(reading(channel, measured)),
            "fitted": _text(reading(channel, fitted)),
            "pull": _text((measured - fitted) / sigma[point, at]),
        }


def _chi2(fit: Posterior) -> float:
    """Chi-square per reading."""
    return float(fit.residual @ fit.residual) / fit.residual.size


def _text(value: float) -> str:
    return f"{value:.6g}" if np.isfinite(value) else ""
