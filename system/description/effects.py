"""[physics] of the pump description: effects beyond the plain loss model, each switched on by its own table.

A table that is left out is an effect that is off. Keys are the parameters of `system.effects.catalogue.entries`,
by the same names and within the same bounds.
"""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, model_validator

from system.inputs.fields import Fraction, NotNegative, Section
from system.inputs.units import Dimension

_WallResistance = Annotated[float, Dimension.THERMAL_RESISTANCE, Field(ge=0.0, le=2e-3)]
_Boundary = Annotated[float, Field(ge=0.0, le=0.12)]


class FilmHeatingSection(Section):
    """[physics.film_heating]: films warmer than the case; resistances of their walls by gap."""

    piston: _WallResistance = 0.0
    slipper: _WallResistance = 0.0
    valve_plate: _WallResistance = 0.0
    carried_share: Fraction = 0.0
    throttled_share: Fraction = 1.0
    carry_over: Annotated[float, Field(ge=0.0, le=0.95)] = 0.0


class ViscosityPressureSection(Section):
    """[physics.viscosity_pressure]: Barus' coefficient of the oil in the gaps."""

    coefficient: Annotated[float, Dimension.PRESSURE_COEFFICIENT, Field(ge=0.0, le=4e-8)]


class EntrainedAirSection(Section):
    """[physics.entrained_air]: bubbles in the oil that is drawn in."""

    void: Annotated[float, Field(ge=0.0, le=0.05)]  # share of the volume at one atmosphere


class IncompleteFillingSection(Section):
    """[physics.incomplete_filling]: an inlet line by which chambers no longer fill above a speed."""

    inlet_loss: Annotated[float, Field(ge=0.0, le=10.0)]  # 1: as much again as the kidneys


class ShearThinningSection(Section):
    """[physics.shear_thinning]: oil that thins where it is sheared fast."""

    drop: Annotated[float, Field(ge=0.0, le=0.4)]
    rate: Annotated[float, Dimension.SHEAR_RATE, Field(gt=0.0)]


class MixedFrictionSection(Section):
    """[physics.mixed_friction]: boundary layers that bear load at small Hersey numbers; coefficients by pair."""

    piston: _Boundary = 0.0
    slipper: _Boundary = 0.0
    valve_plate: _Boundary = 0.0
    hersey_scale: Annotated[float, Field(gt=0.0)]
    exponent: Annotated[float, Field(ge=0.3, le=2.5)] = 1.0


class OpeningSection(Section):
    """[physics.elastic_opening.GAP]: how far a film opens under pressure, by one of two keys.

    opening: share of its thickness per pressure, in a closed form; compliance: of its walls over that of drawing
    and material, films solved between them.
    """

    opening: Annotated[float, Dimension.PRESSURE_COEFFICIENT, Field(ge=0.0, le=1e-7)] | None = None
    compliance: Annotated[float, Field(ge=0.0, le=1.5)] | None = None

    @model_validator(mode="after")
    def _one_of_both(self) -> Self:
        if (self.opening is None) == (self.compliance is None):
            raise ValueError("one of the two, opening or compliance")
        return self


class ElasticOpeningSection(Section):
    """[physics.elastic_opening]: gaps whose walls give way."""

    piston: OpeningSection | None = None
    slipper: OpeningSection | None = None
    valve_plate: OpeningSection | None = None


class ClearanceSection(Section):
    """[physics.thermal_clearance.GAP]: by how much of its thickness a film grows with temperature."""

    rate: Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, Field(ge=-0.02, le=0.02)]


class ThermalClearanceSection(Section):
    """[physics.thermal_clearance]: gaps whose walls expand unlike."""

    piston: ClearanceSection | None = None
    slipper: ClearanceSection | None = None
    valve_plate: ClearanceSection | None = None


class SqueezePumpingSection(Section):
    """[physics.squeeze_pumping]: slippers that pump into the case."""

    stroke: Annotated[float, Dimension.LENGTH, Field(ge=0.0, le=30e-6)]


class SlipperLiftSection(Section):
    """[physics.slipper_lift]: slippers that tip off the swash plate."""

    ride_height: Annotated[float, Dimension.LENGTH, Field(ge=0.0, le=100e-6)]
    retainer_force: Annotated[float, Dimension.FORCE, NotNegative]  # on each


class BlockTippingSection(Section):
    """[physics.block_tipping]: a block that tips on the valve plate."""

    wedge: Annotated[float, Dimension.LENGTH, Field(ge=0.0, le=20e-6)]


class ChurningSection(Section):
    """[physics.churning]: drag of the oil in the case."""

    factor: Annotated[float, Field(ge=0.0, le=3.0)]


class SealDragSection(Section):
    """[physics.seal_drag]: drag of the shaft's seal."""

    torque: Annotated[float, Dimension.TORQUE, Field(ge=0.0, le=5.0)]
    per_case_pressure: Annotated[float, Dimension.PRESSURE_COEFFICIENT, NotNegative] = 0.0


class ChargePumpDragSection(Section):
    """[physics.charge_pump_drag]: a charge pump on the same shaft."""

    volume: Annotated[float, Dimension.DISPLACEMENT, Field(ge=0.0, le=40e-6)]


class PortShortCircuitSection(Section):
    """[physics.port_short_circuit]: an orifice from delivery to inlet."""

    area: Annotated[float, Dimension.AREA, Field(ge=0.0, le=3e-6)]


class LaminarCrossLeakSection(Section):
    """[physics.laminar_cross_leak]: a gap from delivery to inlet."""

    conductance: Annotated[float, Dimension.VOLUME, Field(ge=0.0, le=1.2e-12)]  # times viscosity


class ControlFlowSection(Section):
    """[physics.control_flow]: what the control draws into the case."""

    area: Annotated[float, Dimension.AREA, Field(ge=0.0, le=2e-6)]
    laminar: Fraction


class NotchErosionSection(Section):
    """[physics.notch_erosion]: worn relief grooves ahead of both ports' kidneys."""

    advance: Annotated[float, Dimension.ANGLE, Field(ge=0.0, le=0.15)] = 0.0
    widening: Annotated[float, Field(ge=0.0, le=3.0)] = 0.0


class PortThrottlingSection(Section):
    """[physics.port_throttling]: passages behind the ports."""

    factor: Annotated[float, Field(ge=0.0, le=5.0)]


class CompressionLossSection(Section):
    """[physics.compression_loss]: energy of compressed oil that is lost."""

    share: Fraction


class SwashDroopSection(Section):
    """[physics.swash_droop]: a swash plate that gives way."""

    rate: Annotated[float, Dimension.ANGLE_COMPLIANCE, Field(ge=0.0, le=3e-10)] = 0.0
    play: Annotated[float, Dimension.ANGLE, Field(ge=0.0, le=3e-3)] = 0.0


class LineResonanceSection(Section):
    """[physics.line_resonance]: a delivery meter that reads wrong about one speed."""

    height: Annotated[float, Field(ge=-0.03, le=0.03)]
    speed: Annotated[float, Dimension.ANGULAR_SPEED, Field(gt=0.0)]


class PhysicsSection(Section):
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
        """Whether any effect is switched on."""
        return any(getattr(self, name) is not None for name in type(self).model_fields)
