"""What is told of a floating gap at each reported angle: flows, friction, heat, contact and what limits it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import numpy as np

from gaps.films.block import BlockFilm
from gaps.films.friction import Heat
from gaps.films.piston import PistonFilm, PistonFriction
from gaps.films.slipper import SlipperFilm, SlipperFriction
from gaps.revolution.march import GapRevolution
from reynolds.floating.step import Stage
from reynolds.laws.contact import Asperities
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import boundary_flows, cavitated_fraction

SHARE = 0.01  # of the load or of the film's area, from which contact or cavities count


class Active(Enum):
    """What holds a part in its place; LIFT where nothing but the film does."""

    LIFT = "lift"
    CONTACT = "contact"
    CAVITATION = "cavitation"
    RETAINER = "retainer"


@dataclass(frozen=True)
class GapSeen:
    """What every gap tells of an instant.

    flow (n,) m3/s out of the chambers that feed it (one, or z of the block); leakage m3/s into the case; heat W;
    contact_load N, int of the asperities' pressure; active: contact where it gives over a hundredth of the largest
    generalised force from outside, cavitation where it takes over a hundredth of the film's area, the retainer
    where it presses; else lift.
    """

    flow: Array
    leakage: float
    heat: Heat
    contact_load: float
    active: tuple[Active, ...]


@dataclass(frozen=True)
class PistonSeen(GapSeen):
    """A piston's film with what it does to the piston; swollen m3, see `gaps.films.piston_deformation`."""

    friction: PistonFriction
    swollen: float


@dataclass(frozen=True)
class SlipperSeen(GapSeen):
    """A slipper's film with what it does to the slipper; pocket Pa; throttled W, heat of the orifice."""

    friction: SlipperFriction
    pocket_pressure: float
    throttled: float


@dataclass(frozen=True)
class BlockSeen(GapSeen):
    """The block's film: torque N m against its turning, what it takes from suction and delivery port, m3/s."""

    torque: float
    suction_draw: float
    delivery_draw: float


def piston_seen(film: PistonFilm) -> Callable[[Stage], PistonSeen]:
    """What `run_revolution` looks at on a piston."""

    def look(stage: Stage) -> PistonSeen:
        flows, by, given = boundary_flows(stage.solution), film.rubbed(stage), film.yielding(stage)
        return PistonSeen(
            flow=np.array([film.chamber_flow(stage, flows, given)]),
            leakage=flows["case"],
            heat=by.heat(),
            contact_load=by.load(),
            active=active(stage, film.asperities),
            friction=film.friction(stage, by, given),
            swollen=0.0 if given is None else given.swollen,
        )

    return look


def slipper_seen(film: SlipperFilm) -> Callable[[Stage], SlipperSeen]:
    """What `run_revolution` looks at on a slipper."""

    def look(stage: Stage) -> SlipperSeen:
        pocket, fed = film.supplied(stage)
        flows, by = boundary_flows(stage.solution), film.rubbed(stage)
        return SlipperSeen(
            flow=np.array([fed]),
            leakage=sum(flows[edge] for edge in film.shape.lands.open),
            heat=by.heat(),
            contact_load=by.load(),
            active=active(stage, film.asperities, held=film.is_held(stage.q)),
            friction=film.friction(stage, by),
            pocket_pressure=pocket,
            throttled=fed * (film.chamber_pressure(stage.time) - pocket),
        )

    return look


def block_seen(film: BlockFilm) -> Callable[[Stage], BlockSeen]:
    """What `run_revolution` looks at on the block; webs over the ports touch nothing and heat nothing."""

    def look(stage: Stage) -> BlockSeen:
        solution = stage.solution
        space, flows, by = solution.problem.space, boundary_flows(solution), film.rubbed(stage)
        is_film = film.is_film(space)
        chambers, suction, delivery = film.inflows(solution, flows)
        return BlockSeen(
            flow=chambers,
            leakage=sum(flows[edge] for edge in film.geometry.case_edges),
            heat=by.heat(is_film),
            contact_load=by.load(is_film),
            active=active(stage, film.asperities),
            torque=film.friction_torque(space, by),
            suction_draw=suction,
            delivery_draw=delivery,
        )

    return look


def active(stage: Stage, asperities: Asperities | None, held: bool = False) -> tuple[Active, ...]:
    """What limits an instant; `held`: a retainer presses."""
    found = []
    contact, outer = np.abs(stage.contact_force).max(), np.abs(stage.outer.force).max()
    if asperities is not None and contact > SHARE * outer:
        found.append(Active.CONTACT)
    if cavitated_fraction(stage.solution) > SHARE:
        found.append(Active.CAVITATION)
    if held:
        found.append(Active.RETAINER)
    return tuple(found) or (Active.LIFT,)


Seen = TypeVar("Seen", bound=GapSeen)


def mass_balance_error(revolution: GapRevolution[Seen]) -> float:
    """Oil that entered a gap over the turn and did not leave it, of all that passed between the reported angles.

    The march keeps its oil to round-off; what is left is what the turn lacks to be periodic, and films that are
    taken along their slopes (`Closeness`).
    """
    came = np.array([drawn(instant.passed) for instant in revolution.turn.instants])
    left = np.array([instant.passed.leakage for instant in revolution.turn.instants])
    passed = 0.5 * float(np.mean(np.abs(came)) + np.mean(np.abs(left)))
    return abs(float(np.mean(came) - np.mean(left))) / max(passed, 1e-300)


def drawn(seen: GapSeen) -> float:
    """All that a gap takes from chambers and ports, m3/s."""
    ports = seen.suction_draw + seen.delivery_draw if isinstance(seen, BlockSeen) else 0.0
    return float(seen.flow.sum()) + ports
