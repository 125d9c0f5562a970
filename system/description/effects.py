"""[physics] of the pump description: effects beyond the plain loss model, each switched on by its own table.

A table that is left out is an effect that is off. Keys are the parameters of `system.effects.catalogue.entries`,
by the same names and within the same bounds.
"""

from dataclasses import dataclass, fields
from typing import Annotated

from system.inputs.sections.fields import Fraction, Limits, Micrometres, NotNegative
from system.inputs.units import Dimension

_WallResistance = Annotated[float, Dimension.THERMAL_RESISTANCE, Limits(least=0.0, most=2e-3)]
_Boundary = Annotated[float, Limits(least=0.0, most=0.12)]


@dataclass(frozen=True, kw_only=True)
class FilmHeatingSection:
    """[physics.film_heating]: films warmer than the case; resistances of their walls by gap."""

    piston: _WallResistance = 0.0
    slipper: _WallResistance = 0.0
    valve_plate: _WallResistance = 0.0
    carried_share: Fraction = 0.0
    throttled_share: Fraction = 1.0
    carry_over: Annotated[float, Limits(least=0.0, most=0.95)] = 0.0


@dataclass(frozen=True, kw_only=True)
class ViscosityPressureSection:
    """[physics.viscosity_pressure]: Barus' coefficient of the oil in the gaps."""

    coefficient: Annotated[float, Dimension.PRESSURE_COEFFICIENT, Limits(least=0.0, most=4e-8)]


@dataclass(frozen=True, kw_only=True)
class EntrainedAirSection:
    """[physics.entrained_air]: bubbles in the oil that is drawn in; compressed in the chambers, with `polytropic`."""

    void: Annotated[float, Limits(least=0.0, most=0.05)]  # share of the volume at one atmosphere
    polytropic: Annotated[float, Limits(least=1.0, most=1.4)] | None = None


@dataclass(frozen=True, kw_only=True)
class IncompleteFillingSection:
    """[physics.incomplete_filling]: an inlet by which chambers no longer fill above a speed.

    The loss is of each piston's own flow; of the line's, with `laminar`; begins at a speed, with `growth`.
    """

    inlet_loss: Annotated[float, Limits(least=0.0, most=10.0)]  # 1: as much again as the kidneys
    laminar: Fraction | None = None
    growth: Annotated[float, Limits(least=0.1, most=30.0)] | None = None

    def __post_init__(self) -> None:
        """Raise ValueError for keys of two forms."""
        if self.laminar is not None and self.growth is not None:
            raise ValueError("one of the two, laminar or growth")


@dataclass(frozen=True, kw_only=True)
class ShearThinningSection:
    """[physics.shear_thinning]: oil that thins where it is sheared fast."""

    drop: Annotated[float, Limits(least=0.0, most=0.4)]
    rate: Annotated[float, Dimension.SHEAR_RATE, Limits(above=0.0)]


@dataclass(frozen=True, kw_only=True)
class MixedFrictionSection:
    """[physics.mixed_friction]: boundary layers that bear load at small Hersey numbers; coefficients by pair."""

    piston: _Boundary = 0.0
    slipper: _Boundary = 0.0
    valve_plate: _Boundary = 0.0
    hersey_scale: Annotated[float, Limits(above=0.0)]
    exponent: Annotated[float, Limits(least=0.3, most=2.5)] = 1.0


@dataclass(frozen=True, kw_only=True)
class OpeningSection:
    """[physics.elastic_opening.GAP]: how far a film opens under pressure, by one of two keys.

    opening: share of its thickness per pressure, in a closed form; compliance: of its walls over that of drawing
    and material, films solved between them.
    """

    opening: Annotated[float, Dimension.PRESSURE_COEFFICIENT, Limits(least=0.0, most=1e-7)] | None = None
    compliance: Annotated[float, Limits(least=0.0, most=1.5)] | None = None

    def __post_init__(self) -> None:
        """Raise ValueError for none of the two keys, or both."""
        if (self.opening is None) == (self.compliance is None):
            raise ValueError("one of the two, opening or compliance")


@dataclass(frozen=True, kw_only=True)
class ElasticOpeningSection:
    """[physics.elastic_opening]: gaps whose walls deform."""

    piston: OpeningSection | None = None
    slipper: OpeningSection | None = None
    valve_plate: OpeningSection | None = None


@dataclass(frozen=True, kw_only=True)
class ClearanceSection:
    """[physics.thermal_clearance.GAP]: by how much of its thickness a film grows with temperature."""

    rate: Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, Limits(least=-0.02, most=0.02)]


@dataclass(frozen=True, kw_only=True)
class ThermalClearanceSection:
    """[physics.thermal_clearance]: gaps whose walls expand unlike."""

    piston: ClearanceSection | None = None
    slipper: ClearanceSection | None = None
    valve_plate: ClearanceSection | None = None


@dataclass(frozen=True, kw_only=True)
class SqueezePumpingSection:
    """[physics.squeeze_pumping]: slippers that pump into the case."""

    stroke: Annotated[float, Dimension.LENGTH, Limits(least=0.0, most=30e-6), Micrometres]


@dataclass(frozen=True, kw_only=True)
class SlipperLiftSection:
    """[physics.slipper_lift]: slippers that tip off the swash plate; by degrees, with `sharpness`.

    With `wedge_exponent` they ride on a hydrodynamic wedge instead.
    """

    ride_height: Annotated[float, Dimension.LENGTH, Limits(least=0.0, most=100e-6), Micrometres]
    retainer_force: Annotated[float, Dimension.FORCE, NotNegative]  # on each
    sharpness: Annotated[float, Limits(least=2.0, most=30.0)] | None = None
    wedge_exponent: Annotated[float, Limits(least=0.3, most=1.2)] | None = None

    def __post_init__(self) -> None:
        """Raise ValueError for keys of two forms."""
        if self.sharpness is not None and self.wedge_exponent is not None:
            raise ValueError("one of the two, sharpness or wedge_exponent")


@dataclass(frozen=True, kw_only=True)
class BlockTippingSection:
    """[physics.block_tipping]: a block that tips on the valve plate."""

    wedge: Annotated[float, Dimension.LENGTH, Limits(least=0.0, most=20e-6), Micrometres]


@dataclass(frozen=True, kw_only=True)
class ChurningSection:
    """[physics.churning]: drag of the oil in the case."""

    factor: Annotated[float, Limits(least=0.0, most=3.0)]


@dataclass(frozen=True, kw_only=True)
class SealDragSection:
    """[physics.seal_drag]: drag of the shaft's seal."""

    torque: Annotated[float, Dimension.TORQUE, Limits(least=0.0, most=5.0)]
    per_case_pressure: Annotated[float, Dimension.PRESSURE_COEFFICIENT, NotNegative] = 0.0


@dataclass(frozen=True, kw_only=True)
class ChargePumpDragSection:
    """[physics.charge_pump_drag]: a charge pump on the same shaft."""

    volume: Annotated[float, Dimension.DISPLACEMENT, Limits(least=0.0, most=40e-6)]


@dataclass(frozen=True, kw_only=True)
class PortShortCircuitSection:
    """[physics.port_short_circuit]: an orifice from delivery to inlet."""

    area: Annotated[float, Dimension.AREA, Limits(least=0.0, most=3e-6)]


@dataclass(frozen=True, kw_only=True)
class LaminarCrossLeakSection:
    """[physics.laminar_cross_leak]: a gap from delivery to inlet."""

    conductance: Annotated[float, Dimension.VOLUME, Limits(least=0.0, most=1.2e-12)]  # times viscosity


@dataclass(frozen=True, kw_only=True)
class ControlFlowSection:
    """[physics.control_flow]: what the control draws into the case."""

    area: Annotated[float, Dimension.AREA, Limits(least=0.0, most=2e-6)]
    laminar: Fraction


@dataclass(frozen=True, kw_only=True)
class NotchErosionSection:
    """[physics.notch_erosion]: worn relief grooves ahead of both ports' kidneys."""

    advance: Annotated[float, Dimension.ANGLE, Limits(least=0.0, most=0.15)] = 0.0
    widening: Annotated[float, Limits(least=0.0, most=3.0)] = 0.0


@dataclass(frozen=True, kw_only=True)
class PortThrottlingSection:
    """[physics.port_throttling]: passages behind the ports."""

    factor: Annotated[float, Limits(least=0.0, most=5.0)]


@dataclass(frozen=True, kw_only=True)
class CompressionLossSection:
    """[physics.compression_loss]: energy of compressed oil that is lost."""

    share: Annotated[float, Limits(least=0.0, most=5.0)]


@dataclass(frozen=True, kw_only=True)
class SwashDroopSection:
    """[physics.swash_droop]: a swash plate that tilts back under load."""

    rate: Annotated[float, Dimension.ANGLE_COMPLIANCE, Limits(least=0.0, most=3e-10)] = 0.0
    play: Annotated[float, Dimension.ANGLE, Limits(least=0.0, most=3e-3)] = 0.0


@dataclass(frozen=True, kw_only=True)
class LineResonanceSection:
    """[physics.line_resonance]: a delivery meter that reads wrong about one speed."""

    height: Annotated[float, Limits(least=-0.03, most=0.03)]
    speed: Annotated[float, Dimension.ANGULAR_SPEED, Limits(above=0.0)]


@dataclass(frozen=True, kw_only=True)
class PhysicsSection:
    """[physics]: the effects by their ids."""

    film_heating: FilmHeatingSection | None = None
    viscosity_pressure: ViscosityPressureSection | None = None
    shear_thinning: ShearThinningSection | None = None
    mixed_friction: MixedFrictionSection | None = None
    elastic_opening: ElasticOpeningSection | None = None
    thermal_clearance: ThermalClearanceSection | None = None
    squeeze_pumping: SqueezePumpingSection | None = None
    slipper_lift: SlipperLiftSection | None = None
    block_tipping: BlockTippingSection | None = None
    entrained_air: EntrainedAirSection | None = None
    incomplete_filling: IncompleteFillingSection | None = None
    churning: ChurningSection | None = None
    seal_drag: SealDragSection | None = None
    charge_pump_drag: ChargePumpDragSection | None = None
    port_throttling: PortThrottlingSection | None = None
    compression_loss: CompressionLossSection | None = None
    port_short_circuit: PortShortCircuitSection | None = None
    laminar_cross_leak: LaminarCrossLeakSection | None = None
    control_flow: ControlFlowSection | None = None
    notch_erosion: NotchErosionSection | None = None
    swash_droop: SwashDroopSection | None = None
    line_resonance: LineResonanceSection | None = None

    @property
    def on(self) -> bool:
        """True if any effect is switched on."""
        return any(getattr(self, own.name) is not None for own in fields(self))
