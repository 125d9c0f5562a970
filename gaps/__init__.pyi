from .films.block import (
    BlockDrive as BlockDrive,
    BlockFilm as BlockFilm,
    floating_block as floating_block,
    standing_block as standing_block,
)
from .films.friction import wall_shear as wall_shear
from .films.over_turn import PeriodicCurve as PeriodicCurve, constant as constant
from .films.physics import Effect as Effect, FilmLaws as FilmLaws, Physics as Physics
from .films.piston import (
    PistonDrive as PistonDrive,
    PistonFilm as PistonFilm,
    PistonShape as PistonShape,
    floating_piston as floating_piston,
    standing_piston as standing_piston,
)
from .films.reports import (
    Active as Active,
    SlipperReport as SlipperReport,
    block_report as block_report,
    piston_report as piston_report,
    slipper_report as slipper_report,
)
from .films.slipper import (
    PocketOrifice as PocketOrifice,
    SlipperDrive as SlipperDrive,
    SlipperFilm as SlipperFilm,
    SlipperShape as SlipperShape,
    face_force as face_force,
    floating_slipper as floating_slipper,
)
from .loads.ball_joint import (
    DrivenBody as DrivenBody,
    ball_forces as ball_forces,
    swept_acceleration as swept_acceleration,
)
from .response import Axis as Axis, Response as Response
from .revolution.film_heat import warm_revolution as warm_revolution
from .revolution.march import GapRevolution as GapRevolution, run_revolution as run_revolution
from .revolution.schedule import Accuracy as Accuracy, Schedule as Schedule, evenly as evenly
from .shapes.profiles import (
    DepthPoints as DepthPoints,
    EdgeRelief as EdgeRelief,
    Profile as Profile,
    Waviness as Waviness,
)
from .shapes.slipper_lands import SlipperLands as SlipperLands, slipper_mesh as slipper_mesh
from .shapes.valve_plate_ring import ValvePlateGeometry as ValvePlateGeometry
from .standing.gap_film import GapFilm as GapFilm
from .walls.parts import (
    BushingPart as BushingPart,
    PistonPart as PistonPart,
    PlatePart as PlatePart,
    Pose as Pose,
    bushing_body as bushing_body,
    part_wall as part_wall,
    piston_body as piston_body,
    plate_body as plate_body,
)
from .walls.piston import PistonWalls as PistonWalls
