from .films.block import BlockDrive as BlockDrive
from .films.block import BlockFilm as BlockFilm
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
from .films.slipper import (
    SlipperDrive as SlipperDrive,
)
from .films.slipper import (
    SlipperFilm as SlipperFilm,
)
from .films.slipper import (
    SlipperShape as SlipperShape,
)
from .response import Axis as Axis
from .response import Response as Response
from .revolution.film_heat import warm_revolution as warm_revolution
from .revolution.march import run_revolution as run_revolution
from .revolution.schedule import Accuracy as Accuracy
from .revolution.schedule import Schedule as Schedule
from .shapes.valve_plate_ring import ValvePlateGeometry as ValvePlateGeometry
