from .bodies.chart import Cylinder as Cylinder
from .bodies.chart import Plane as Plane
from .bodies.chart import Side as Side
from .bodies.elasticity import Elastic as Elastic
from .bodies.foundation import half_space as half_space
from .bodies.foundation import winkler as winkler
from .bodies.mesh import BodyMesh as BodyMesh
from .bodies.mesh import block as block
from .bodies.mesh import disc as disc
from .bodies.mesh import hollow_cylinder as hollow_cylinder
from .bodies.supports import Supports as Supports
from .bodies.wall import Body as Body
from .bodies.wall import body_wall as body_wall
from .errors import FilmInputError as FilmInputError
from .errors import FilmNotConverged as FilmNotConverged
from .errors import InputError as InputError
from .errors import NotConverged as NotConverged
from .fem.mesh import (
    Cell as Cell,
)
from .fem.mesh import FilmMesh as FilmMesh
from .fem.mesh import (
    annulus as annulus,
)
from .fem.mesh import mesh_from_file as mesh_from_file
from .fem.mesh import (
    read_mesh_file as read_mesh_file,
)
from .fem.mesh import (
    rectangle as rectangle,
)
from .fem.mesh import (
    ring as ring,
)
from .fem.space import FilmSpace as FilmSpace
from .fem.space import film_space as film_space
from .floating.load_search import RigidLoad as RigidLoad
from .floating.load_search import carry_load as carry_load
from .floating.problem import Floating as Floating
from .floating.problem import Outer as Outer
from .floating.problem import steady as steady
from .floating.rest import held_at as held_at
from .floating.step import FloatingStage as FloatingStage
from .floating.step import solve_stage as solve_stage
from .laws.contact import Asperities as Asperities
from .laws.density import BulkModulus as BulkModulus
from .laws.fluid import Fluid as Fluid
from .laws.oil import ISO_GRADES as ISO_GRADES
from .laws.oil import Oil as Oil
from .laws.roughness import Surface as Surface
from .laws.viscosity import Barus as Barus
from .laws.viscosity import Roelands as Roelands
from .numerics.arrays import Array as Array
from .problem import (
    ZERO as ZERO,
)
from .problem import (
    Cavitation as Cavitation,
)
from .problem import (
    Film as Film,
)
from .problem import (
    FilmProblem as FilmProblem,
)
from .problem import (
    FilmSolution as FilmSolution,
)
from .problem import (
    Held as Held,
)
from .problem import (
    Pocket as Pocket,
)
from .problem import Storage as Storage
from .problem import (
    film as film,
)
from .problem import no_feed as no_feed
from .solve.export import write_vtu as write_vtu
from .solve.loads import Loads as Loads
from .solve.loads import boundary_flows as boundary_flows
from .solve.loads import loads as loads
from .solve.solver import FilmSolver as FilmSolver
from .solve.transient import march as march
from .thermal.energy import Heat as Heat
from .thermal.film import march_thermal as march_thermal
from .thermal.film import solve_thermal as solve_thermal
from .thermal.walls import Adiabatic as Adiabatic
from .thermal.walls import GivenTemperature as GivenTemperature
