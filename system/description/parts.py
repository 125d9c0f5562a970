"""Tables of the pump description that floating gaps need: the parts' shapes, surfaces, materials and holds.

Every key may be left out; `system.films.parts` has the assumed values and their reasons.
"""

import math
from dataclasses import dataclass
from enum import Enum
from typing import Annotated

from system.description.profile import Profile
from system.inputs.sections.fields import (
    Angle,
    AnyLength,
    Area,
    ArealDensity,
    Coefficient,
    Conductivity,
    Damping,
    Density,
    Elasticity,
    Expansion,
    FaceName,
    FaceNames,
    Height,
    Inertia,
    Length,
    Limits,
    MeshFile,
    Micrometres,
    NotNegative,
    Stiffness,
    Torque,
)
from system.inputs.units import Dimension


@dataclass(frozen=True, kw_only=True)
class ReliefSection:
    """An edge taken back: by `depth` at the edge, falling to nothing at `width` from it as a parabola."""

    width: Length  # from the edge inwards
    depth: Annotated[float, Dimension.LENGTH, NotNegative, Micrometres]  # taken off at the edge; 0: sharp


@dataclass(frozen=True, kw_only=True)
class WavinessSection:
    """[valve_plate.waviness]: the plate's face rises and falls by `amplitude` around the shaft."""

    waves: Annotated[int, Limits(least=1, most=99)]  # around the shaft
    amplitude: Height  # half of crest to trough


@dataclass(frozen=True, kw_only=True)
class PadSection:
    """[[valve_plate.pads]]: a run of outer bearing pads, evenly spaced, the first about the inner dead centre."""

    inner: Length
    outer: Length
    arc: Annotated[float, Dimension.ANGLE, Limits(above=0.0, most=2.0 * math.pi * (1.0 + 1e-12))]
    number: Annotated[int, Limits(least=1, most=99)]


class MeshUnit(Enum):
    """Unit of the coordinates in a mesh file."""

    METRE = "m"
    CENTIMETRE = "cm"
    MILLIMETRE = "mm"
    MICROMETRE = "um"
    INCH = "in"

    @property
    def metres(self) -> float:
        """Length of the unit, m."""
        return {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 25.4e-3}[self.value]


@dataclass(frozen=True, kw_only=True)
class BodySection:
    """[PART.body]: a mesh of one's own in place of the body that is made from the part's sizes.

    A name left out is the face of the mesh that has the key's own name, if it has one.
    """

    mesh: MeshFile
    unit: MeshUnit
    film: FaceName | None = None  # under the film
    held: FaceNames | None = None  # held fast
    sliding: FaceNames | None = None  # held across, free along
    chamber: FaceName | None = None  # where the chamber presses on piston or bore beside the film
    pocket: FaceName | None = None  # where a slipper's pocket presses on slipper or swash plate


@dataclass(frozen=True, kw_only=True)
class BoreSection:
    """[bore]: the bore's own shape."""

    profile: Profile | None = None  # from the case edge inwards
    edge_relief: ReliefSection | None = None  # of the guide's case edge
    wall: Length | None = None  # of the bore, to the middle of the web
    body: BodySection | None = None


@dataclass(frozen=True, kw_only=True)
class SwashPlateSection:
    """[swash_plate]: what the slippers slide on, and what tilts."""

    thickness: Length | None = None
    inertia: Inertia | None = None  # about the tilt axis, with all that tilts
    pivot_offset: AnyLength | None = None  # of the tilt axis from the shaft's, to the inner dead centre
    angle_min: Angle | None = None  # of the lower stop; the upper one is at [pump] swash_angle_max
    damping: Damping | None = None
    trunnion_friction: Torque | None = None
    body: BodySection | None = None  # of what lies under one slipper


class GrooveShape(Enum):
    """Section of a relief groove: triangular, cut by a round tool, or known by its throat's area alone."""

    V = "v"
    ROUND = "round"
    AREA = "area"


@dataclass(frozen=True, kw_only=True)
class GrooveSection:
    """[[ports.grooves]]: a relief groove between two angles, ahead of the port's kidney or behind it."""

    start: Angle
    end: Angle
    shape: GrooveShape
    depth: Length | None = None  # at the kidney
    angle: Annotated[float, Dimension.ANGLE, Limits(above=0.0, below=math.pi)] | None = (
        None  # between the flanks of a V
    )
    width: Length | None = None  # of the round tool
    area: Area | None = None  # of the throat at the kidney


class Stroking(Enum):
    """Sense in which the actuator's pressure tilts the swash plate: to larger displacement, or to smaller."""

    UP = "up"
    DOWN = "down"


class RetainerKind(Enum):
    """Retainer that keeps slippers on the swash plate: pressed by the spring, or at a fixed clearance."""

    SPRING = "spring"
    CLEARANCE = "clearance"


@dataclass(frozen=True, kw_only=True)
class RetainerSection:
    """[retainer]: the plate that keeps the slippers on the swash plate."""

    kind: RetainerKind | None = None
    clearance: Height | None = None  # film at which the retainer is reached
    stiffness: Stiffness | None = None  # beyond it, a slipper


@dataclass(frozen=True, kw_only=True)
class MaterialSection:
    """[materials.PART]: what a part is made of."""

    youngs_modulus: Elasticity
    poissons_ratio: Annotated[float, Limits(above=-1.0, below=0.5)]
    density: Density | None = None
    thermal_conductivity: Conductivity | None = None
    thermal_expansion: Expansion | None = None


@dataclass(frozen=True, kw_only=True)
class MaterialsSection:
    """[materials]: the six parts that meet in the three gaps."""

    piston: MaterialSection | None = None
    bushing: MaterialSection | None = None
    slipper: MaterialSection | None = None
    swash_plate: MaterialSection | None = None
    block: MaterialSection | None = None
    valve_plate: MaterialSection | None = None


@dataclass(frozen=True, kw_only=True)
class SurfaceSection:
    """[surfaces.PAIR]: both faces of a gap together, as `reynolds.laws.roughness` and `reynolds.laws.contact` take
    them.
    """

    composite_roughness: Height | None = None
    asperity_density: ArealDensity | None = None
    asperity_radius: Height | None = None
    friction_coefficient: Coefficient | None = None  # of the boundary layer


@dataclass(frozen=True, kw_only=True)
class SurfacesSection:
    """[surfaces]: the three gaps by the names of their friction pairs."""

    piston_cylinder: SurfaceSection | None = None
    slipper_swash_plate: SurfaceSection | None = None
    valve_plate_cylinder: SurfaceSection | None = None
