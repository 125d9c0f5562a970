from .adjoint.gradient import (
    FilmGradient as FilmGradient,
    film_gradients as film_gradients,
    held_gradient as held_gradient,
    weakly_active as weakly_active,
)
from .adjoint.outputs import (
    Axis as Axis,
    ContactLoadOutput as ContactLoadOutput,
    DissipationOutput as DissipationOutput,
    FlowOutput as FlowOutput,
    FrictionForceOutput as FrictionForceOutput,
    FrictionOutput as FrictionOutput,
    FrictionTorqueOutput as FrictionTorqueOutput,
    LoadOutput as LoadOutput,
    MomentOutput as MomentOutput,
    Output as Output,
    Wall as Wall,
    output_names as output_names,
)
from .adjoint.solved import OutputSlopes as OutputSlopes, SolvedFilm as SolvedFilm, slopes_of as slopes_of
from .bodies.chart import Cylinder as Cylinder, Plane as Plane, Side as Side, face_normals as face_normals
from .bodies.elasticity import Elastic as Elastic, structure as structure
from .bodies.foundation import Compliance as Compliance, both as both, half_space as half_space, winkler as winkler
from .bodies.mesh import (
    BodyMesh as BodyMesh,
    block as block,
    disc as disc,
    hollow_cylinder as hollow_cylinder,
    section as section,
)
from .bodies.space import body_space as body_space
from .bodies.supports import Supports as Supports, rigid_motions as rigid_motions
from .bodies.wall import Body as Body, body_wall as body_wall, heated_wall as heated_wall
from .equation.balance import stiffness as stiffness
from .equation.coefficients import at_points as at_points, isotropic as isotropic
from .errors import (
    FilmInputError as FilmInputError,
    FilmNotConverged as FilmNotConverged,
    InputError as InputError,
    NotConverged as NotConverged,
)
from .fem.mesh import (
    Cell as Cell,
    FilmMesh as FilmMesh,
    annulus as annulus,
    mesh_from_file as mesh_from_file,
    read_mesh_file as read_mesh_file,
    rectangle as rectangle,
    ring as ring,
)
from .fem.space import FilmSpace as FilmSpace, film_space as film_space
from .floating.coordinates import generalised_force as generalised_force, modes_on as modes_on
from .floating.problem import Floating as Floating, Outer as Outer, steady as steady
from .floating.rest import held_at as held_at
from .floating.stage import FloatingStage as FloatingStage
from .floating.start import started as started
from .floating.step import full_film as full_film, solve_stage as solve_stage
from .laws.contact import Asperities as Asperities, contact_pressure as contact_pressure
from .laws.density import BulkModulus as BulkModulus, RationalDensity as RationalDensity
from .laws.fluid import CONSTANT as CONSTANT, Fluid as Fluid
from .laws.oil import ISO_GRADES as ISO_GRADES, Oil as Oil, dynamic_viscosity as dynamic_viscosity, walther as walther
from .laws.rheology import Carreau as Carreau
from .laws.roughness import Surface as Surface
from .laws.viscosity import Barus as Barus, Roelands as Roelands
from .numerics.arrays import Array as Array
from .numerics.dirk import (
    ALEXANDER_2 as ALEXANDER_2,
    BACKWARD_EULER as BACKWARD_EULER,
    Tableau as Tableau,
    advance as advance,
    integrate as integrate,
    nodes_only as nodes_only,
)
from .problem import (
    ZERO as ZERO,
    Boundary as Boundary,
    Cavitation as Cavitation,
    Film as Film,
    FilmProblem as FilmProblem,
    FilmSolution as FilmSolution,
    Held as Held,
    Pocket as Pocket,
    Storage as Storage,
    film as film,
    no_feed as no_feed,
)
from .solve.export import write_vtu as write_vtu
from .solve.load_search import RigidLoad as RigidLoad, carry_load as carry_load
from .solve.loads import Loads as Loads, boundary_flows as boundary_flows, loads as loads, point_fields as point_fields
from .solve.solver import FilmSolver as FilmSolver
from .solve.transient import march as march
from .thermal.energy import FilmTemperature as FilmTemperature, Heat as Heat, solve_energy as solve_energy
from .thermal.film import (
    ThermalSolution as ThermalSolution,
    march_thermal as march_thermal,
    solve_thermal as solve_thermal,
)
from .thermal.walls import (
    Adiabatic as Adiabatic,
    Convecting as Convecting,
    GivenTemperature as GivenTemperature,
    Turning as Turning,
)
