"""Where a mismatch sits: channel and region, component, shaft angle, time. Needs no catalogue."""

from __future__ import annotations

from dataclasses import dataclass

from diagnosis.angle_scan import AngleWindow, scan_angles
from diagnosis.component_evidence import ComponentGroup, component_evidences, group_evidences, tied
from diagnosis.contrasts import contrasts
from diagnosis.detect import channel_misfits
from diagnosis.map_axes import axis_values
from diagnosis.regions import Region, densest_region
from diagnosis.study import Study
from diagnosis.thresholds import Thresholds
from diagnosis.time_scan import TimeMark, scan_time
from system.channels import ChannelName
from system.components import Component


@dataclass(frozen=True)
class Location:
    """Channels that take part, the one of greatest excess first, and the region of that one (None: everywhere).

    components, groups: ln evidence of each, best first; tie: components that cannot be told from the best, none
    where no component is ahead of nothing.
    """

    channels: tuple[ChannelName, ...]
    region: Region | None
    components: tuple[tuple[Component, float], ...]
    groups: tuple[tuple[ComponentGroup, float], ...]
    tie: tuple[Component, ...]
    angle: AngleWindow | None
    time: TimeMark | None


def locate(study: Study, thresholds: Thresholds) -> Location:
    """Where the readings part from the simulation. Means something only where `detect` finds that they do."""
    limits = thresholds.locate
    ranking = component_evidences(study, thresholds)
    channels = _channels(study, limits.channel_share)
    return Location(
        channels=channels,
        region=_region(study, channels[0], limits.region_share) if channels else None,
        components=ranking,
        groups=group_evidences(ranking),
        tie=tied(ranking, thresholds.name.odds),
        angle=scan_angles(study.traces, study.events, limits, thresholds.seeds.locate),
        time=scan_time(study, thresholds),
    )


def _channels(study: Study, least_share: float) -> tuple[ChannelName, ...]:
    found = channel_misfits(study)
    ranked = sorted(found, key=lambda channel: -found[channel].share)
    return tuple(channel for channel in ranked if found[channel].share >= least_share)


def _region(study: Study, channel: ChannelName, share: float) -> Region | None:
    names = [each.name for each in study.observations.channels]
    own = contrasts(study.base, names.index(channel.value))
    return densest_region(channel, own, axis_values(study.recording), share)
