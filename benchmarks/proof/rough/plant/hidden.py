"""Sizes of all possible concealed effects in a pump of the third plant, 0 where absent."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Hidden:
    """Sizes relative to the pump, so that one of any displacement has them; laws in model.py.

    opening, thickening: share of the leakage's pressure factor at 30 MPa; clearance: 1/K; heating: K of the films at 20
    MPa; control, short_circuit, cross_leak, squeeze: flow over that of the plate at 20 MPa and 40 degC; droop: share
    of the stroke at 30 MPa; mixed: coefficient at rest; compression: share of the stored energy; churning: torque over
    V 1 MPa/(2 pi) at 1480 r/min. In no catalogue: weeping: flow over the plate's at 30 MPa, above 18 MPa; softening:
    1/K of the modulus; swelling: flow over the plate's about 12 MPa; creeping: torque over V 1 MPa/(2 pi) with pressure
    in cold oil.
    """

    opening: float = 0.0
    thickening: float = 0.0
    clearance: float = 0.0
    heating: float = 0.0
    control: float = 0.0
    short_circuit: float = 0.0
    cross_leak: float = 0.0
    squeeze: float = 0.0
    droop: float = 0.0
    mixed: float = 0.0
    compression: float = 0.0
    churning: float = 0.0
    weeping: float = 0.0
    softening: float = 0.0
    swelling: float = 0.0
    creeping: float = 0.0


NOTHING = Hidden()
