"""Effects of elastic piston and bore besides the film's deformation: force along the bore, growth of the chamber.

The piston's deformation moves with it: pressure on its slope is a force along the bore. Outside the film both
parts deform under the chamber's pressure; by virtual work the chamber grows by

    V = int (p + p_contact) g dA + s p_chamber,

g the film's deformation by unit pressure in the chamber, s the chamber's growth by bare faces alone. With
both, the power of walls and chamber is the film's dissipation and the change of elastic energy, zero over a turn.
"""

from dataclasses import dataclass

import numpy as np

from gaps.walls.pair import BoreWalls
from gaps.walls.parts import Pose
from reynolds.bodies.compliance import full
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import evaluate


@dataclass(frozen=True)
class PistonDeformation:
    """Deformation of piston and bore at an instant.

    film (vertices,) m: growth of the film by both; piston (vertices,) m: by the piston alone; chamber_growth m3.
    """

    film: Array
    piston: Array
    chamber_growth: float


def slope_along(solution: FilmSolution, height: Array) -> Array:
    """Slope along the bore of a height (vertices,) m at the quadrature points of the film, (cells, points)."""
    space = solution.problem.space
    nodal = np.zeros(space.size)
    nodal[space.vertex_dofs] = height
    return evaluate(solution, nodal)[2]


def piston_deformation(
    walls: BoreWalls, stage: FloatingStage, pose: Pose, chamber_pressure: float
) -> PistonDeformation:
    """Deformation of both parts by the film, its contact and the chamber's pressure (Pa)."""
    shape, wall_pressure = stage.instant.shape, stage.wall_pressure
    assert shape.walls is not None
    space, bare = shape.space, walls.by_chamber(shape.space, pose)
    on_film = evaluate(stage.solution, wall_pressure)[0]
    return PistonDeformation(
        film=full(shape.walls.matrix) @ wall_pressure + chamber_pressure * bare.deformation,
        piston=full(walls.piston_at(space, pose).matrix) @ wall_pressure + chamber_pressure * bare.piston,
        chamber_growth=float(np.sum(on_film * space.sample_vertices(bare.deformation) * space.area))
        + chamber_pressure * bare.chamber_growth,
    )
