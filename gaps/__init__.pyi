from .films.block import BlockDrive as BlockDrive
from .films.block import BlockFilm as BlockFilm
from .films.block import floating_block as floating_block
from .films.block import standing_block as standing_block
from .films.over_turn import PeriodicCurve as PeriodicCurve
from .films.over_turn import constant as constant
from .films.physics import Effect as Effect
from .films.physics import Physics as Physics
from .films.piston import (
    PistonDrive as PistonDrive,
)
from .films.piston import (
    PistonFilm as PistonFilm,
)
from .films.piston import (
    PistonShape as PistonShape,
)
from .films.piston import floating_piston as floating_piston
from .films.piston import standing_piston as standing_piston
from .films.reports import Active as Active
from .films.reports import block_report as block_report
from .films.reports import piston_report as piston_report
from .films.reports import slipper_report as slipper_report
from .films.slipper import PocketOrifice as PocketOrifice
from .films.slipper import (
    SlipperDrive as SlipperDrive,
)
from .films.slipper import (
    SlipperFilm as SlipperFilm,
)
from .films.slipper import (
    SlipperShape as SlipperShape,
)
from .films.slipper import face_force as face_force
from .films.slipper import floating_slipper as floating_slipper
from .response import Axis as Axis
from .response import Response as Response
from .revolution.film_heat import warm_revolution as warm_revolution
from .revolution.march import run_revolution as run_revolution
from .revolution.schedule import Accuracy as Accuracy
from .revolution.schedule import Schedule as Schedule
from .revolution.schedule import evenly as evenly
from .shapes.profiles import DepthPoints as DepthPoints
from .shapes.profiles import EdgeRelief as EdgeRelief
from .shapes.profiles import Profile as Profile
from .shapes.profiles import Waviness as Waviness
from .shapes.slipper_lands import SlipperLands as SlipperLands
from .shapes.valve_plate_ring import ValvePlateGeometry as ValvePlateGeometry
