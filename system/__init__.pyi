from .bench.calibration.extended_pump import extended_pump as extended_pump
from .bench.outputs import SIMULATED as SIMULATED
from .bench.parameters import base_parameters as base_parameters
from .bench.points import BenchPoints as BenchPoints, operating_at as operating_at
from .bench.simulator import LumpedBench as LumpedBench
from .description.drawing import drawing_of as drawing_of
from .description.gap import Gap as Gap
from .description.pump import PumpDescription as PumpDescription, PumpSection as PumpSection
from .description.tolerances import tolerances as tolerances
from .effects.catalogue.entries import CATALOGUE as CATALOGUE, EXTENSIONS as EXTENSIONS, entry_of as entry_of
from .effects.components import Component as Component
from .effects.effect import BenchState as BenchState, EffectId as EffectId, GapCourse as GapCourse, Kind as Kind
from .effects.extension import Extension as Extension
from .estimation.additions import (
    Addition as Addition,
    Ladder as Ladder,
    Rung as Rung,
    additions as additions,
    held_out as held_out,
    ladder as ladder,
)
from .estimation.fit import best_posterior as best_posterior, maximum_posterior as maximum_posterior
from .estimation.function_simulator import FunctionSimulator as FunctionSimulator
from .estimation.observations import (
    Channel as Channel,
    Observations as Observations,
    independent_observations as independent_observations,
)
from .estimation.parameters import Parameter as Parameter, Role as Role, Scale as Scale
from .estimation.posterior import Posterior as Posterior, linear_posterior as linear_posterior
from .estimation.simulator import Simulator as Simulator
from .estimation.trial import FitLimits as FitLimits
from .films.cycle import SMOOTH as SMOOTH
from .films.drives import Drives as Drives, drives as drives, no_rubbing as no_rubbing
from .films.parts import FloatingParts as FloatingParts, floating_parts as floating_parts
from .films.problems import RIGID as RIGID
from .films.rotor import Rotor as Rotor, rotor as rotor, valve_plate_geometry as valve_plate_geometry
from .inputs.channels import INPUTS as INPUTS, OUTPUTS as OUTPUTS, ChannelName as ChannelName
from .inputs.coefficients.flow_files import read_flow_coefficients as read_flow_coefficients
from .inputs.coefficients.loss_files import read_step_losses as read_step_losses
from .inputs.faults import Fault as Fault, InputFaults as InputFaults
from .inputs.units import Dimension as Dimension
from .maps.data import MapData as MapData
from .maps.duty import Duty as Duty
from .maps.plan import map_plan as map_plan
from .multibody.assumed import assumptions as assumptions
from .multibody.rotating_group import joint_forces as joint_forces
from .points.films import FilmsPoint as FilmsPoint, films_point as films_point
from .points.floating import FloatingPoint as FloatingPoint, floating_point as floating_point
from .points.floating_gaps import (
    USUAL as USUAL,
    FloatingOptions as FloatingOptions,
    block_revolution as block_revolution,
    piston_revolution as piston_revolution,
    slipper_revolution as slipper_revolution,
)
from .points.floating_solved import Solved as Solved
from .points.lumped import lumped_point as lumped_point
from .points.table.build import build_table as build_table
from .points.table.point import table_point as table_point
from .points.table.store import find_table as find_table
from .points.transmission import transmission as transmission
from .pump.assembly import PointWarning as PointWarning, PumpPoint as PumpPoint
from .pump.laws.directions import bore_axis as bore_axis, plate_axes as plate_axes
from .pump.laws.friction_pairs import Pair as Pair
from .pump.laws.kinematics import (
    SwashDrive as SwashDrive,
    piston_acceleration as piston_acceleration,
    piston_displacement as piston_displacement,
    piston_velocity as piston_velocity,
    slipper_acceleration as slipper_acceleration,
    slipper_sliding_velocity as slipper_sliding_velocity,
    stroke as stroke,
)
from .pump.laws.leakage import (
    piston_conductance as piston_conductance,
    slipper_conductance as slipper_conductance,
    valve_plate_conductance as valve_plate_conductance,
)
from .pump.lumped import piston_area as piston_area, piston_motion as piston_motion, port_openings as port_openings
from .pump.operating import OperatingPoint as OperatingPoint, operating_point as operating_point
from .pump.ports.areas import (
    PortOpening as PortOpening,
    break_angles as break_angles,
    opening_area as opening_area,
    orifice_flow as orifice_flow,
)
from .pump.ports.lines import ImpedanceLine as ImpedanceLine
from .pump.ports.relief_grooves import ReliefGroove as ReliefGroove
from .pump_file.file import check_pump as check_pump, load_pump as load_pump, resolved_toml as resolved_toml
from .variation.sampling import Series as Series, drawn_series as drawn_series
