"""Noise and calibration of a channel: as the recording states, else by its data or its accuracy class."""

from __future__ import annotations

import math

import numpy as np

from diagnosis.recording.channel_form import AccuracyClass, ChannelForm
from diagnosis.recording.model import RecordedChannel
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.units import Dimension

LEAST_GAIN = 1e-3
ZERO_SHARE = 0.5  # of the largest reading's limit: share of a class for the zero of an output
SETTING_SHARE = 5e-4  # of full displacement: assumed accuracy of a set swash angle
ENCODER = math.radians(0.3)
FEWEST_READINGS = 20  # different readings from which a step is derived
FEWEST_COARSE = 5  # the same of a display that repeats show to be coarse
USUAL, FAR = 0.9, 10.0  # quantile of the magnitudes, and times that: readings beyond are codes for no reading
STILL = 0.01  # of one sigma: repeats that scatter by less are those of a coarse display, or of no meter

# Limits of the classes A, B, C of ISO 4409 as they are commonly quoted. The standard's own table was not available for
# comparison: an important calibration is better stated by the recording than by a class.
_SHARES = {AccuracyClass.A: 0.005, AccuracyClass.B: 0.01, AccuracyClass.C: 0.02}
_FLOW_SHARES = {AccuracyClass.A: 0.005, AccuracyClass.B: 0.015, AccuracyClass.C: 0.025}
_KELVIN = {AccuracyClass.A: 0.5, AccuracyClass.B: 1.0, AccuracyClass.C: 2.0}
_LOW_PRESSURE = {AccuracyClass.A: 1e3, AccuracyClass.B: 3e3, AccuracyClass.C: 5e3}
LOW_PRESSURE = 2e5  # Pa gauge, below which a class gives a pressure and no share


def recorded_channel(form: ChannelForm, readings: Array, found: float | None) -> RecordedChannel | None:
    """Return a channel with noise and calibration in SI; None where its repeatability is neither stated nor found.

    found: repeatability from the data (replicates, window scatter), or None. Calibration that is not stated is
    that of the accuracy class, else gain = max(sigma_relative, 0.1 %) and zero = sigma, or class A where sigma is
    not stated either (scatter is no measure of calibration); a displacement ratio of sigma 0 is a setting, good to
    0.05 % of full. `assumed` names every assumed field. A code for no reading (1e38, 9999) changes none of it.
    """
    readings = _without_codes(readings)
    assumed = []
    sigma, relative = form.repeatability
    if form.sigma is None and form.sigma_relative is None:
        shown = 0.0 if form.name is ChannelName.DISPLACEMENT_RATIO else found
        if shown is None:
            return None
        sigma = shown
        assumed.append("sigma")
    quantum = form.quantum
    commanded = form.name is ChannelName.DISPLACEMENT_RATIO and sigma == 0.0
    if quantum is None:
        quantum = 0.0 if commanded else _shown_step(readings, form, found)
        assumed += ["quantum"] if quantum else []
    gain, zero = form.gain, form.zero
    usual_gain, usual_zero = _calibration(form, sigma, relative, readings)
    assumed += ["gain"] if gain is None and usual_gain else []
    assumed += ["zero"] if zero is None and usual_zero else []
    return RecordedChannel(
        name=form.name,
        column=form.column,
        unit=form.unit,
        sigma=float(sigma),
        sigma_relative=relative,
        quantum=quantum,
        lag=form.lag or 0.0,
        gain_sigma=usual_gain if gain is None else gain,
        zero_sigma=usual_zero if zero is None else zero,
        assumed=tuple(assumed),
    )


def _without_codes(readings: Array) -> Array:
    """Readings of a channel without those far beyond all usual ones."""
    size = np.abs(readings[np.isfinite(readings)])
    usual = float(np.quantile(size, USUAL)) if size.size else 0.0
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(readings) > FAR * usual, np.nan, readings) if usual > 0.0 else readings


def _shown_step(readings: Array, form: ChannelForm, found: float | None) -> float:
    """The step of a channel's readings in SI, or 0: of few different ones where it exceeds sigma and repeats agree.

    Else round levels are no steps of a reading. found: scatter of the repeats.
    """
    step = reading_step(readings, form)
    if step > 0.0 or found is None:
        return step
    sigma, relative = form.repeatability
    sigma += relative * float(np.nanmedian(np.abs(readings)))
    coarse = reading_step(readings, form, FEWEST_COARSE)
    return coarse if found < STILL * sigma < STILL * coarse else 0.0


def reading_step(readings: Array, form: ChannelForm, fewest: int = FEWEST_READINGS) -> float:
    """Return the step of a channel's readings in SI, or 0.

    The largest of 1, 2, 2.5 and 5 times a power of ten, in the file's unit, of which every reading is a multiple;
    from at least `fewest` different ones.
    """
    known = np.unique(readings[np.isfinite(readings)])
    if len(known) < fewest:
        return 0.0
    numbers = (known - form.offset) / form.factor
    top = math.floor(math.log10(max(float(np.max(np.abs(numbers))), 1e-300)))
    for power in range(top, top - 8, -1):
        for digit in (5.0, 2.5, 2.0, 1.0):
            steps = numbers / (digit * 10.0**power)
            if np.all(np.abs(steps - np.round(steps)) < 1e-6 * np.maximum(np.abs(steps), 1.0) + 1e-6):
                return digit * 10.0**power * form.factor
    return 0.0


def _calibration(form: ChannelForm, sigma: float, relative: float, readings: Array) -> tuple[float, float]:
    """One sigma of gain and zero if not stated.

    A class gives limits (see above); a limit L of even likelihood within has one sigma of L/sqrt 3 (GUM 4.3.7).
    """
    name, dimension = form.name, form.name.dimension
    if name is ChannelName.ANGLE:
        return 0.0, ENCODER
    accuracy = form.accuracy
    if accuracy is None and form.sigma is None and form.sigma_relative is None:
        accuracy = AccuracyClass.A
    if accuracy is not None and dimension is not None:
        low = dimension is Dimension.PRESSURE and np.nanmax(np.abs(readings)) < LOW_PRESSURE
        if dimension is Dimension.TEMPERATURE:
            return 0.0, _KELVIN[accuracy] / math.sqrt(3.0)
        if low:
            return 0.0, _LOW_PRESSURE[accuracy] / math.sqrt(3.0)
        wide = dimension in (Dimension.VOLUME_FLOW, Dimension.PRESSURE)
        gain = (_FLOW_SHARES if wide else _SHARES)[accuracy] / math.sqrt(3.0)
        if name in INPUTS:  # of a pressure the limit at its median: as an input it has no gain
            return gain, gain * float(np.nanmedian(np.abs(readings))) if dimension is Dimension.PRESSURE else 0.0
        return gain, ZERO_SHARE * gain * float(np.nanmax(np.abs(readings)))
    if name is ChannelName.DISPLACEMENT_RATIO:
        return 0.0, max(sigma, SETTING_SHARE)
    gain = 0.0 if dimension is Dimension.TEMPERATURE else max(relative, LEAST_GAIN)
    return gain, sigma
