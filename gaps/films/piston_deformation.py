"""What a piston and its bore that give way do besides opening the film between them.

The piston carries its own dents along as it moves: pressure on their slopes pushes it along the bore. Both parts
give way to the chamber's pressure, too, where the film leaves them bare; by virtual work the chamber grows by

    V = int (p + p_contact) g dA + s p_chamber,

g the film's opening by unit pressure in the chamber, s what bare faces do to each other. With both, the power of
walls and chamber is what the film turns into heat and the parts store; over a turn they keep nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gaps.walls.pair import BoreWalls
from gaps.walls.parts import Stand
from reynolds.bodies.compliance import full
from reynolds.floating.step import Stage
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import evaluate


@dataclass(frozen=True)
class Yielding:
    """How piston and bore have given way at an instant.

    opened (vertices,) m: opening of the film by both, dented the same by the piston alone; swollen m3: growth of
    the chamber.
    """

    opened: Array
    dented: Array
    swollen: float

    def slope(self, solution: FilmSolution) -> Array:
        """d dented/dy at the quadrature points of the film, (cells, points)."""
        space = solution.problem.space
        nodal = np.zeros(space.size)
        nodal[space.vertex_dofs] = self.dented
        return evaluate(solution, nodal)[2]


def yielding(walls: BoreWalls, stage: Stage, stand: Stand, chamber_pressure: float) -> Yielding:
    """How both parts have given way to the film, its contact and the chamber's pressure (Pa)."""
    shape, borne = stage.instant.shape, stage.borne
    assert shape.walls is not None
    space, bare = shape.space, walls.by_chamber(shape.space, stand)
    on_film = evaluate(stage.solution, borne)[0]
    return Yielding(
        opened=full(shape.walls.matrix) @ borne + chamber_pressure * bare.opened,
        dented=full(walls.piston_at(space, stand).matrix) @ borne + chamber_pressure * bare.piston,
        swollen=float(np.sum(on_film * space.sample_vertices(bare.opened) * space.area))
        + chamber_pressure * bare.swollen,
    )
