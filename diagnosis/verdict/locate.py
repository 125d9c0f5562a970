"""Place of a mismatch: channel and region, component, shaft angle, time. Needs no catalogue."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.detect.angle_scan import AngleWindow, scan_angles
from diagnosis.detect.component_evidence import component_evidences, departing_inputs, missing_pattern, tied
from diagnosis.detect.contrasts import Contrasts, contrasts
from diagnosis.detect.regions import MapRegion, densest_region, strongest_region
from diagnosis.detect.time_scan import TimeMark, scan_time
from diagnosis.explain.explained import unexplained_traces
from diagnosis.explain.ranked import Explanation
from diagnosis.study.map_axes import axis_values
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.inputs.channels import ChannelName

_Box = Callable[[ChannelName, Contrasts, Array, Mapping[ChannelName, Array]], MapRegion | None]


@dataclass(frozen=True)
class Location:
    """Channels of the mismatch, largest share first, and the region of the first (None: everywhere).

    components: ln evidence of each, best first; tie: components that cannot be separated from the best; inputs:
    those with which the best departs. If no component is ahead of the null, there are no channels, no region, no tie
    and no inputs.
    """

    channels: tuple[ChannelName, ...]
    region: MapRegion | None
    components: tuple[tuple[Component, float], ...]
    tie: tuple[Component, ...]
    angle: AngleWindow | None
    time: TimeMark | None
    inputs: tuple[ChannelName, ...] = ()


def locate(study: Study, thresholds: Thresholds) -> Location:
    """Place of the difference between readings and simulation. Useful only where `detect` finds a mismatch."""
    limits = thresholds.locate
    ranking = component_evidences(study, thresholds)
    tie = tied(ranking, thresholds.name.odds)
    pattern = missing_pattern(study, tie[0], thresholds) if tie else np.zeros(study.observations.values.shape)
    channels = _channels(study, pattern, limits.channel_share)
    densest = partial(densest_region, limits=limits)
    return Location(
        channels=channels,
        region=_region(study, channels[0], pattern, densest) if channels else None,
        components=ranking,
        tie=tie,
        angle=scan_angles(study.traces, study.events, limits, thresholds.seeds.locate),
        time=scan_time(study, thresholds),
        inputs=departing_inputs(study, tie[0], thresholds) if tie else (),
    )


def of_explanation(study: Study, location: Location, added: Array, thresholds: Thresholds) -> Location:
    """The same with channels and strongest region of an explanation's addition to the readings, (N, C) in SI.

    The level of a law's free multiplier is known only up to the fitted films and zeros: only an explanation
    decides between too much leakage at low pressure and too little at high. Components follow from steady
    readings: an explanation that adds to traces alone has none.
    """
    whitening = study.base.whitening
    sigma = np.where(whitening.measured, whitening.sigma, np.inf)
    pattern = added / sigma
    channels = _channels(study, pattern, thresholds.locate.channel_share)
    strongest = partial(strongest_region, limits=thresholds.locate)
    region = _region(study, channels[0], pattern, strongest) if channels else None
    tie = location.tie if set(channels) & set(study.channels) else ()
    return replace(location, channels=channels, region=region, tie=tie)


def without_explanation(study: Study, location: Location, explanation: Explanation, thresholds: Thresholds) -> Location:
    """The same with the shaft angle at which traces differ from a refit without its explanation.

    For an explanation that acts on the chamber: tolerances alone may follow it (a worn groove is one cut too long).
    """
    traces = unexplained_traces(study, explanation, thresholds)
    angle = scan_angles(traces, study.events, thresholds.locate, thresholds.seeds.locate)
    return replace(location, angle=angle)


def _channels(study: Study, pattern: Array, least_share: float) -> tuple[ChannelName, ...]:
    """Channels of the missing part of the best component; a raw excess would count the noise of every channel."""
    energy = study.by_shown((pattern**2).sum(axis=0))
    order = np.argsort(-energy)
    least = least_share * energy.sum()
    return tuple(study.shown_channels[at] for at in order if energy[at] > 0 and energy[at] >= least)


def _region(study: Study, channel: ChannelName, pattern: Array, box: _Box) -> MapRegion | None:
    """The box of a pattern (N, C) in a channel; None for a channel without steady readings."""
    if channel not in study.channels:
        return None
    at = study.channels.index(channel)
    return box(channel, contrasts(study.base, at), pattern[:, at], axis_values(study.recording))
