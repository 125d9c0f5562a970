from .description.gap import Gap as Gap
from .description.pump import PumpDescription as PumpDescription
from .inputs.faults import Fault as Fault
from .inputs.faults import InputFaults as InputFaults
from .maps.data import MapData as MapData
from .maps.duty import Duty as Duty
from .maps.plan import map_plan as map_plan
from .multibody.rotating_group import joint_forces as joint_forces
from .points.films import films_point as films_point
from .points.floating import floating_point as floating_point
from .points.lumped import lumped_point as lumped_point
from .points.table.build import build_table as build_table
from .points.table.point import table_point as table_point
from .points.table.store import find_table as find_table
from .pump.laws.friction_pairs import Pair as Pair
from .pump.operating import OperatingPoint as OperatingPoint
from .pump.operating import operating_point as operating_point
from .pump_file.file import (
    check_pump as check_pump,
)
from .pump_file.file import (
    load_pump as load_pump,
)
from .pump_file.file import (
    resolved_toml as resolved_toml,
)
