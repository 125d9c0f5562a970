"""The pump description, format 1: the values of a pump file, in SI floats.

Lengths in m, angles in rad, speeds in rad/s, pressures in Pa gauge (atmosphere = 0), temperatures in K.
`system.pump_file.file` reads and writes it; `system.pump_file.check` holds it to geometry.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated

from gaps.shapes.bearing_pads import BearingPads
from gaps.shapes.slipper_lands import SlipperLands, lands_between
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.laws.oil import Oil
from system.description.effects import PhysicsSection
from system.description.lines import LineSection
from system.description.parts import (
    BodySection,
    BoreSection,
    MaterialsSection,
    PadSection,
    ReliefSection,
    RetainerSection,
    Stroking,
    SurfacesSection,
    SwashPlateSection,
    WavinessSection,
)
from system.description.ports import PortsSection
from system.description.profile import Profile
from system.description.tolerance import ToleranceSection
from system.inputs.sections.fields import (
    AcuteAngle,
    Angle,
    AngularSpeed,
    AnyLength,
    Area,
    Coefficient,
    Conductivity,
    Density,
    Displacement,
    Expansion,
    Film,
    FlowFile,
    Force,
    Fraction,
    GrooveFile,
    Grooves,
    Height,
    KinematicViscosity,
    Leakage,
    Length,
    Limits,
    Mass,
    Micrometres,
    Modulus,
    NotNegative,
    Positive,
    Pressure,
    PressureCoefficient,
    SlipperGrooves,
    SpecificHeat,
    StepFile,
    Stiffness,
    Temperature,
    Volume,
)
from system.inputs.units import Dimension

FORMAT = 1


@dataclass(frozen=True, kw_only=True)
class PumpSection:
    """[pump]: the rotating group as a whole."""

    pistons: Annotated[int, Limits(least=3, most=99)]  # number of pistons
    displacement: Displacement | None = None  # checked against the geometry, Eq. (6)
    swash_angle_max: AcuteAngle  # at full displacement
    cross_angle: Annotated[float, Dimension.ANGLE, Limits(above=-math.pi / 4, below=math.pi / 4)] | None = None
    bore_cone_angle: Annotated[float, Dimension.ANGLE, Limits(least=0.0, below=math.pi / 2)]  # bores to shaft axis
    piston_diameter: Length  # outer
    pitch_radius: Length  # of the ball centres at zero swash angle
    dead_volume: Volume  # of one chamber at inner dead centre and full swash angle
    rated_speed: AngularSpeed  # above it a run warns
    rated_pressure: Annotated[float, Dimension.PRESSURE, Positive]  # above it a run warns, gauge


@dataclass(frozen=True, kw_only=True)
class PistonSection:
    """[piston]: one piston in its bore; lengths at inner dead centre and full swash angle."""

    radial_clearance: Film  # bore radius less piston radius
    engaged_length: Length  # of piston in the bore
    overhang: Annotated[float, Dimension.LENGTH, NotNegative]  # ball centre to bore edge
    eccentricity_ratio: Annotated[float, Limits(least=0.0, below=1.0)]  # given; used where no balance is
    mass: Mass  # piston without slipper
    spin_ratio: float | None = None  # spin relative to the block / shaft speed
    stand_out_share: Annotated[float, Limits(least=0.0, most=1.2)] | None = None  # of (H_max - H)/2 at part stroke
    guide_length: Length | None = None  # of the land in the bore, from the case edge inwards
    centre_of_mass: Length | None = None  # from the ball centre into the bore
    profile: Profile | None = None  # from the chamber's end
    barrel: Height | None = None  # fall of a crowned piston from its middle to its ends
    edge_relief: ReliefSection | None = None  # at the chamber's end
    grooves: Grooves | None = None  # rings; places from the chamber's end
    bore_diameter: Annotated[float, Dimension.LENGTH, NotNegative] | None = None  # of a hollow piston
    body: BodySection | None = None


@dataclass(frozen=True, kw_only=True)
class SlipperSection:
    """[slipper]: one slipper; film thickness and tilts are the given ones, used where no balance is."""

    land_inner_radius: Length  # the pocket's edge
    land_outer_radius: Length  # the rim
    orifice_diameter: Length  # of the bore that feeds the pocket
    orifice_length: Length  # of the same bore
    film_thickness: Film  # given; used where no balance is
    mass: Mass  # slipper alone
    centre_of_mass_to_ball: Annotated[float, Dimension.LENGTH, NotNegative]  # towards the swash plate
    ball_joint_radius: Length  # of the ball
    spin_ratio: float | None = None  # spin about its own axis / shaft speed
    tilt_radial: Angle  # given; opens the film outwards
    tilt_tangential: Angle  # given; opens the film forwards
    ball_height: Length | None = None  # of the ball centre above the sliding face
    orifice_flow_coefficient: Annotated[float, Limits(above=0.0, most=1.0)] | None = None  # of entry and exit
    orifice_file: FlowFile | None = None  # flow coefficients of the whole bore
    pocket_file: StepFile | None = None  # losses of steps, at the edges of pocket, lands and rim
    groove_file: GrooveFile | None = None  # losses of grooves, of those in the land
    profile: Profile | None = None  # over the radius
    crown: Annotated[AnyLength, Micrometres] | None = None  # of the face over its outer radius; negative: dished
    rim_relief: ReliefSection | None = None  # at the outer radius
    grooves: SlipperGrooves | None = None  # closed rings in the land
    vented_grooves: SlipperGrooves | None = None  # rings open to the case
    flange_thickness: Length | None = None  # bends outside the socket
    socket_radius: Length | None = None  # up to which the ball holds the flange
    body: BodySection | None = None

    @property
    def lands(self) -> SlipperLands:
        """The sealing lands that the grooves leave; raises InputError for grooves that do not lie apart."""
        grooves, vented = self.grooves or (), self.vented_grooves or ()
        return lands_between(self.land_inner_radius, self.land_outer_radius, grooves, vented)


@dataclass(frozen=True, kw_only=True)
class ValvePlateSection:
    """[valve_plate]: sealing lands 1 .. 2 and 3 .. 4 (inner and outer), the block's kidneys between them."""

    land_radius_1: Length  # inner land, inner radius
    land_radius_2: Length  # inner land, outer radius
    land_radius_3: Length  # outer land, inner radius
    land_radius_4: Length  # outer land, outer radius
    kidney_pitch_radius: Length  # middle of the kidneys
    kidney_width: Length  # radial, of a block kidney
    kidney_arc: Annotated[float, Dimension.ANGLE, Positive]  # over all, rounded ends included
    film_thickness: Film  # given, on the shaft axis; used where no balance is
    tilt_x: Angle  # given; opens towards the inner dead centre
    tilt_y: Angle  # given; opens a quarter turn on
    residual_clamping: Coefficient  # fraction of the pressure force
    kidney_file: StepFile | None = None  # losses of steps, at the edges of the lands
    thickness: Length | None = None  # of the plate, its back held
    waviness: WavinessSection | None = None  # of the face, around the shaft
    profile: Profile | None = None  # over the radius
    pads: tuple[PadSection, ...] = ()  # beyond the outer land
    sphere_radius: Length | None = None  # of a face that bulges into a hollow block; radii are then off the axis
    body: BodySection | None = None

    @property
    def sphere(self) -> Sphere:
        """The face, a plane where no radius is stated."""
        return PLANE if self.sphere_radius is None else Sphere(self.sphere_radius)

    @property
    def bearing_pads(self) -> tuple[BearingPads, ...]:
        """The pads as inputs of films; raises InputError for pads that overlap."""
        return tuple(BearingPads(pad.inner, pad.outer, pad.arc, pad.number) for pad in self.pads)

    @property
    def outer_radius(self) -> float:
        """Outermost radius that bears, m."""
        return max([self.land_radius_4, *(pad.outer for pad in self.pads)])


@dataclass(frozen=True, kw_only=True)
class BallGuideSection:
    """[ball_guide]: the ball guide under its spring, F = stiffness (compression + displacement), Eq. (13)."""

    radius: Length  # of the ball guide
    contact_latitude: AcuteAngle  # of the contact with the retainer
    spring_preload: Force  # at zero relative displacement
    spring_stiffness: Stiffness  # of the guide's spring
    spring_compression: Annotated[float, Dimension.LENGTH, NotNegative]  # relative displacement


@dataclass(frozen=True, kw_only=True)
class BlockSection:
    """[block]: the cylinder block."""

    mass: Mass  # cylinder block
    spline_position: AnyLength | None = None  # above the valve plate: where the shaft holds the block sideways
    end_thickness: Length | None = None  # between the bores and the face on the valve plate
    profile: Profile | None = None  # of that face over the radius
    body: BodySection | None = None


@dataclass(frozen=True, kw_only=True)
class BearingsSection:
    """[bearings]: mean diameters, and the share of the side force that each bearing takes."""

    front_diameter: Length  # mean diameter
    rear_diameter: Length  # mean diameter
    front_share: Fraction  # of the side force
    rear_share: Fraction  # of the side force
    front_position: AnyLength | None = None  # above the valve plate, of the bearings' middles
    rear_position: AnyLength | None = None


@dataclass(frozen=True, kw_only=True)
class ActuatorSection:
    """[actuator]: the piston that tilts the swash plate, and the spring against it."""

    strokes: Stroking | None = None
    area: Area | None = None
    arm: Length | None = None  # from the tilt axis
    dead_volume: Volume | None = None  # at its innermost place
    orifice_area: Area | None = None  # between control pressure and actuator
    leakage: Leakage | None = None  # to the case
    spring_rate: Stiffness | None = None
    spring_preload: Force | None = None  # at the actuator's innermost place


@dataclass(frozen=True, kw_only=True)
class FrictionSection:
    """[friction]: Coulomb coefficient of each of the seven friction pairs."""

    piston_cylinder: Coefficient  # piston in its bore
    piston_slipper_socket: Coefficient  # ball joint
    slipper_swash_plate: Coefficient  # slipper on the plate
    valve_plate_cylinder: Coefficient  # block on the valve plate
    ball_guide_retainer: Coefficient  # ball guide in the retainer
    front_bearing: Coefficient  # shaft bearing
    rear_bearing: Coefficient  # shaft bearing


@dataclass(frozen=True, kw_only=True)
class OilSection:
    """[oil]: a pump file may say `grade` in place of the two viscosities."""

    kinematic_viscosity_40C: KinematicViscosity  # of the data sheet
    kinematic_viscosity_100C: KinematicViscosity  # of the data sheet
    density: Density  # of the oil
    bulk_modulus: Modulus  # with the air that it usually carries
    specific_heat: SpecificHeat  # of the oil
    pressure_viscosity: PressureCoefficient | None = None  # Barus' coefficient
    thermal_conductivity: Conductivity | None = None
    thermal_expansion: Expansion | None = None

    @property
    def fluid(self) -> Oil:
        """The oil for `reynolds.laws.oil`; raises ValueError where Walther's law is not valid."""
        return Oil(**{name: getattr(self, name) for name in Oil.__dataclass_fields__})


@dataclass(frozen=True, kw_only=True)
class OperatingSection:
    """[operating]: where the pump runs when nothing else is asked for."""

    speed: AngularSpeed  # of the shaft
    pressure: Pressure  # of delivery, gauge
    displacement_ratio: Annotated[float, Limits(above=0.0, most=1.0)]  # share of the full displacement
    temperature: Temperature  # of the oil in the case and films
    inlet_pressure: Pressure  # gauge
    case_pressure: Pressure  # gauge


SINGLE_PARTS = ("piston", "slipper", "bore")
"""Tables of which single parts may differ: [piston.3] puts its values in place of [piston]'s for chamber 3."""


@dataclass(frozen=True, kw_only=True)
class PumpDescription:
    """A pump, complete: every table of the pump file."""

    name: str
    format: Annotated[int, Limits(least=FORMAT, most=FORMAT)]
    pump: PumpSection
    piston: PistonSection
    slipper: SlipperSection
    valve_plate: ValvePlateSection
    ports: PortsSection
    ball_guide: BallGuideSection
    block: BlockSection
    bearings: BearingsSection
    friction: FrictionSection
    oil: OilSection
    operating: OperatingSection
    bore: BoreSection = field(default_factory=BoreSection)
    swash_plate: SwashPlateSection = field(default_factory=SwashPlateSection)
    actuator: ActuatorSection = field(default_factory=ActuatorSection)
    retainer: RetainerSection = field(default_factory=RetainerSection)
    materials: MaterialsSection = field(default_factory=MaterialsSection)
    surfaces: SurfacesSection = field(default_factory=SurfacesSection)
    delivery_line: LineSection = field(default_factory=LineSection)
    suction_line: LineSection = field(default_factory=LineSection)
    physics: PhysicsSection = field(default_factory=PhysicsSection)
    tolerance: ToleranceSection = field(default_factory=ToleranceSection)
    single_pistons: tuple[tuple[int, PistonSection], ...] = ()  # by chamber, complete
    single_slippers: tuple[tuple[int, SlipperSection], ...] = ()
    single_bores: tuple[tuple[int, BoreSection], ...] = ()

    @property
    def bodies(self) -> tuple[BodySection, ...]:
        """The meshes that are stated for parts."""
        stated = (
            self.piston.body, self.bore.body, self.slipper.body, self.swash_plate.body, self.block.body,
            self.valve_plate.body, *(part.body for _, part in self.single_pistons),
            *(part.body for _, part in self.single_slippers), *(part.body for _, part in self.single_bores),
        )  # fmt: skip
        return tuple(body for body in stated if body is not None)

    @property
    def file_contents(self) -> tuple[str, ...]:
        """Names for what the files hold that the pump's own names by their paths: meshes and coefficients."""
        slippers = (self.slipper, *(part for _, part in self.single_slippers))
        tables = [
            *((part.orifice_file, part.pocket_file, part.groove_file) for part in slippers),
            (self.valve_plate.kidney_file,),
            self.ports.coefficient_tables,
        ]
        losses = (" ".join(table.content for table in part if table is not None) for part in tables)
        return (*(body.mesh.content for body in self.bodies), *losses)

    def of_chamber(self, chamber: int) -> PumpDescription:
        """The pump with piston, slipper and bore of a chamber (1 .. z) in place of all, and no single parts."""
        return replace(
            self,
            piston=dict(self.single_pistons).get(chamber, self.piston),
            slipper=dict(self.single_slippers).get(chamber, self.slipper),
            bore=dict(self.single_bores).get(chamber, self.bore),
            single_pistons=(),
            single_slippers=(),
            single_bores=(),
        )
