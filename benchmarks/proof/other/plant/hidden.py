"""Sizes of all possible concealed effects in the second plant, 0 where absent."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Hidden:
    """Sizes, SI; laws in gaps.py, rubbing.py, chamber.py and aside.py.

    viscosity_pressure: 1/Pa at small pressure; opening_*: 1/Pa of a gap's film; film_heating: factor on the Nahme
    number; shear_thinning: 1/Pa, one over Eyring's stress; mixed_friction: coefficient at rest; thermal_*: 1/K; lift:
    m; squeeze: m of stroke; churning: factor; seal: N m at rated speed; charge_pump: m3 a turn; short_circuit: m2;
    cross_leak: m3; control_flow: m3/s at 20 MPa; droop: share of the full stroke at 35 MPa; throttling: Pa at rated
    flow; suction: Pa at rated flow; erosion: rad; air: share at atmosphere; resonance: share of the delivery;
    compression: share. In no catalogue: weeping: m3/s at 35 MPa into the case above 25 MPa; belt: N m at rated
    speed; hot_leak: m3/s at 20 MPa and 50 degC; shuttle: m3/s at rated speed and no stroke; pocketing: N m at 20 MPa.
    """

    viscosity_pressure: float = 0.0
    opening_piston: float = 0.0
    opening_slipper: float = 0.0
    opening_plate: float = 0.0
    film_heating: float = 0.0
    shear_thinning: float = 0.0
    mixed_friction: float = 0.0
    thermal_piston: float = 0.0
    thermal_slipper: float = 0.0
    thermal_plate: float = 0.0
    lift: float = 0.0
    squeeze: float = 0.0
    churning: float = 0.0
    seal: float = 0.0
    charge_pump: float = 0.0
    short_circuit: float = 0.0
    cross_leak: float = 0.0
    control_flow: float = 0.0
    droop: float = 0.0
    throttling: float = 0.0
    suction: float = 0.0
    erosion: float = 0.0
    air: float = 0.0
    resonance: float = 0.0
    compression: float = 0.0
    weeping: float = 0.0
    belt: float = 0.0
    hot_leak: float = 0.0
    shuttle: float = 0.0
    pocketing: float = 0.0


NOTHING = Hidden()
