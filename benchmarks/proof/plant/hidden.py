"""Effects that may be concealed in the plant, each by one size (SI), 0 where it is absent."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Hidden:
    """Sizes of the physics that the simulation leaves out. The laws stand in gaps.py, losses.py and byways.py.

    viscosity_pressure: 1/Pa at small pressure, growing as Roelands has it; opening_*: 1/Pa of a gap's film, walls
    that stiffen; film_heating: share of a film's loss that leaves with its oil; shear_thinning: share of viscosity
    lost at high rates; mixed_friction: coefficient of dry contact; thermal_*: 1/K; squeeze: m of stroke of the
    slippers; churning: factor; seal: N m; charge_pump: m3 a turn; short_circuit, control_flow: m2; cross_leak: m3;
    droop: 1/Pa of the stroke; throttling: factor; suction: Pa lost in the inlet line at 188.7 L/min; erosion: rad;
    air: share at 1 atm; resonance: share of Q_out; compression: share of the work of compression that is lost;
    lift: m that slippers rise off the plate at suction.
    In no catalogue: stiffening: rise of the modulus with pressure; root_drag, foam, whirl, cold_seal: N m at the
    reference point; seepage: m3/s/Pa above 28 MPa; windage: m3/s into the case; spin_leak: factor at full speed.
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
    lift: float = 0.0
    stiffening: float = 0.0
    root_drag: float = 0.0
    foam: float = 0.0
    whirl: float = 0.0
    cold_seal: float = 0.0
    seepage: float = 0.0
    windage: float = 0.0
    spin_leak: float = 0.0

    def scaled(self, factor: float) -> Hidden:
        """All sizes times a factor."""
        return replace(self, **{name: factor * size for name, size in vars(self).items()})


NOTHING = Hidden()
