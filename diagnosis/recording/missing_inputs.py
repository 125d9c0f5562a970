"""Origin of an input that a recording lacks: another channel, the pump file or the ambient pressure."""

from __future__ import annotations

from collections.abc import Collection
from enum import Enum

from diagnosis.recording.model import Circuit
from system.inputs.channels import ChannelName

_OTHER = {ChannelName.T_IN: ChannelName.T_CASE, ChannelName.T_CASE: ChannelName.T_IN}


class Origin(Enum):
    """Source of a value outside the recording; the value is its name in a text."""

    PUMP_FILE = "the pump file"
    AMBIENT = "the ambient pressure"


def origin(name: ChannelName, known: Collection[ChannelName], circuit: Circuit) -> Origin | ChannelName:
    """The origin of an input that is not among the `known` channels.

    Of inlet and case temperature the one for the other; the ambient pressure at the inlet of an open circuit; else the
    pump's [operating].
    """
    other = _OTHER.get(name)
    if other is not None and other in known:
        return other
    return Origin.AMBIENT if name is ChannelName.P_IN and circuit is Circuit.OPEN else Origin.PUMP_FILE
