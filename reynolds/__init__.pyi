from .bodies.elasticity import Elastic as Elastic
from .bodies.supports import Supports as Supports
from .bodies.wall import Body as Body
from .bodies.wall import body_wall as body_wall
from .errors import FilmInputError as FilmInputError
from .errors import FilmNotConverged as FilmNotConverged
from .fem.mesh import (
    Cell as Cell,
)
from .fem.mesh import (
    annulus as annulus,
)
from .fem.mesh import (
    read_mesh_file as read_mesh_file,
)
from .fem.mesh import (
    rectangle as rectangle,
)
from .fem.mesh import (
    ring as ring,
)
from .fem.space import film_space as film_space
from .floating.load_search import carry as carry
from .laws.contact import Asperities as Asperities
from .laws.density import BulkModulus as BulkModulus
from .laws.fluid import Fluid as Fluid
from .laws.oil import ISO_GRADES as ISO_GRADES
from .laws.oil import Oil as Oil
from .laws.roughness import Surface as Surface
from .laws.viscosity import Barus as Barus
from .laws.viscosity import Roelands as Roelands
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
from .problem import (
    film as film,
)
from .solve.export import write_vtu as write_vtu
from .solve.loads import Loads as Loads
from .solve.loads import loads as loads
from .solve.solver import FilmSolver as FilmSolver
from .solve.transient import march as march
from .thermal.film import march_thermal as march_thermal
from .thermal.film import solve_thermal as solve_thermal
