"""Two baselines without a pump model: a Gaussian process on the residual, and sparse regression on textbook terms."""

from __future__ import annotations

import numpy as np

from diagnosis.study.model import Study
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

from .outcome import Rival

LENGTHS = (0.3, 0.7, 1.5, 3.0)  # of axes scaled to [-1, 1]
HEIGHTS = (0.1, 0.3, 1.0, 3.0, 10.0)  # sigma
ODDS = 3.0  # nats
PATH = 30  # penalties from the largest that keeps a term down to a thousandth of it
REFERENCE = {"speed": 220.0, "p": 20.0e6}


def gaussian_process(study: Study, residual: Array) -> Rival:
    """Whether a smooth discrepancy (Kennedy and O'Hagan 2001) is likelier than none in a channel; no name."""
    apart = np.linalg.norm(study.axes[:, None, :] - study.axes[None, :, :], axis=2)
    gains = []
    for at in range(len(study.channels)):
        rows = study.observations.measured[:, at]
        own = residual[rows, at]
        found = [
            _gain(own, height**2 * _matern(apart[np.ix_(rows, rows)] / length))
            for length in LENGTHS
            for height in HEIGHTS
        ]
        gains.append(np.logaddexp.reduce(found) - np.log(len(found)))
    return Rival(bool(max(gains) > ODDS), ())


def sparse_regression(study: Study, residual: Array) -> Rival:
    """LASSO (Tibshirani 1996) of each channel's residual on textbook terms, penalty by Schwarz' criterion."""
    strongest, named = 0.0, tuple[str, ...]()
    for at, name in enumerate(study.channels):
        rows = study.observations.measured[:, at]
        terms = _terms(study, name.value)
        matrix = np.stack([column[rows] for column in terms.values()], axis=1) / _sigma(study, at)[rows, None]
        matrix /= np.linalg.norm(matrix, axis=0)
        found = _lasso(matrix, residual[rows, at])
        if np.abs(found).max() > strongest:
            strongest = float(np.abs(found).max())
            named = (list(terms)[int(np.argmax(np.abs(found)))],)
    return Rival(bool(named), named)


def _matern(distance: Array) -> Array:
    """Of smoothness 3/2."""
    scaled = np.sqrt(3.0) * distance
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _gain(own: Array, covariance: Array) -> float:
    """ln evidence of N(0, 1 + K) over N(0, 1)."""
    whole = np.eye(own.size) + covariance
    factor = np.linalg.cholesky(whole)
    white = np.linalg.solve(factor, own)
    return float(0.5 * (own @ own - white @ white) - np.log(np.diag(factor)).sum())


def _sigma(study: Study, at: int) -> Array:
    return np.asarray(study.base.whitening.sigma[:, at])


def _terms(study: Study, channel: str) -> dict[str, Array]:
    """Terms of a regression on speed, pressure, displacement and viscosity, each by the effect that it marks."""
    steady = study.recording.steady
    speed = steady.column(ChannelName.SPEED) / REFERENCE["speed"]
    stroke = steady.column(ChannelName.DISPLACEMENT_RATIO)
    p = steady.column(ChannelName.P_OUT) / REFERENCE["p"]
    mu = np.exp(-0.04 * (steady.column(ChannelName.T_CASE) - 323.15))
    one = np.ones_like(p)
    if channel in ("Q_out", "Q_in"):
        return {
            "laminar_cross_leak": p / mu, "bulk_modulus": speed * p * (1.0 + stroke) / 2.0,
            "displacement": speed * stroke, "port_short_circuit": np.sqrt(p), "swash_droop": speed * stroke * p,
            "control_flow": one, "squeeze_pumping": speed,
        }  # fmt: skip
    if channel == "Q_case":
        return {
            "film_thickness": p / mu, "viscosity_pressure": p**2 / mu, "elastic_opening": p**3 / mu,
            "squeeze_pumping": speed, "control_flow": np.sqrt(p), "Q_case_offset": one,
        }  # fmt: skip
    return {
        "torque_offset": one, "torque_gain": p * stroke, "friction_coefficient": p, "viscosity_grade": mu * speed,
        "churning": speed**2, "port_throttling": speed**2 * stroke**3,
        "mixed_friction": p * stroke * np.exp(-mu * speed / p), "compression_loss": p**2 * (1.5 - stroke / 2.0),
    }  # fmt: skip


def _lasso(matrix: Array, target: Array) -> Array:
    """Coefficients of unit columns along the path of penalties, those of the least BIC: coordinate descent."""
    best, least = np.zeros(matrix.shape[1]), float(target @ target)
    coefficients = np.zeros(matrix.shape[1])
    gram, aim = matrix.T @ matrix, matrix.T @ target
    for penalty in np.abs(aim).max() * np.logspace(0.0, -3.0, PATH):
        for _ in range(200):
            before = coefficients.copy()
            for k in range(coefficients.size):
                pull = aim[k] - gram[k] @ coefficients + coefficients[k]
                coefficients[k] = np.sign(pull) * max(abs(pull) - penalty, 0.0)
            if np.abs(coefficients - before).max() < 1e-6 * (1.0 + np.abs(coefficients).max()):
                break
        left = target - matrix @ coefficients
        criterion = float(left @ left) + np.log(target.size) * np.count_nonzero(coefficients)
        if criterion < least:
            best, least = coefficients.copy(), criterion
    return best
