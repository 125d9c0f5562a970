"""Report of a floating film at one stage: flows, heat, friction, contact and limiting state of each gap."""

from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import numpy as np

from gaps.films.block import BlockFilm
from gaps.films.friction import Dissipation
from gaps.films.piston import PistonFilm, PistonFriction
from gaps.films.slipper import SlipperFilm, SlipperFriction
from reynolds.floating.stage import FloatingStage
from reynolds.laws.contact import Asperities
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import boundary_flows, cavitated_fraction

SHARE = 0.01  # of the load or of the film's area, from which contact or cavities count


class Active(Enum):
    """Limiting states of a part; LIFT where the film alone bears it."""

    LIFT = "lift"
    CONTACT = "contact"
    CAVITATION = "cavitation"
    RETAINER = "retainer"


@dataclass(frozen=True)
class GapReport:
    """Quantities that every gap reports of a stage.

    flow (n,) m3/s out of the chambers that feed the gap (one, or z of the block); leakage m3/s into the case; heat W;
    contact_load N, int of the asperities' pressure; active: contact above a hundredth of the largest generalised force
    from outside, cavitation above a hundredth of the film's area, the retainer where it presses; else lift.
    """

    flow: Array
    leakage: float
    heat: Dissipation
    contact_load: float
    active: tuple[Active, ...]


@dataclass(frozen=True)
class PistonReport(GapReport):
    """Report of a piston's film: friction on the piston; chamber_growth m3, see `PistonDeformation`."""

    friction: PistonFriction
    chamber_growth: float


@dataclass(frozen=True)
class SlipperReport(GapReport):
    """Report of a slipper's film: friction on the slipper; pocket pressure Pa; orifice_heat W."""

    friction: SlipperFriction
    pocket_pressure: float
    orifice_heat: float


@dataclass(frozen=True)
class BlockReport(GapReport):
    """Report of the block's film: torques N m against its turning; flows from suction and delivery port, m3/s.

    torque: of shear and contact; tilted_torque: see `BlockFilm.tilted_torque`.
    """

    torque: float
    tilted_torque: float
    suction_draw: float
    delivery_draw: float


Reported = TypeVar("Reported", bound=GapReport)


def piston_report(film: PistonFilm, stage: FloatingStage, *, standing: bool = False) -> PistonReport:
    """Report of a piston's film; `standing`: in a fixed mesh, walls taken as rigid in the friction."""
    flows, by = boundary_flows(stage.solution), film.wall_shear(stage)
    given = None if standing else film.deformation(stage)
    flow = film.standing_flow(stage, flows) if standing else film.chamber_flow(stage, flows, given)
    return PistonReport(
        flow=np.array([flow]),
        leakage=flows["case"],
        heat=by.heat(),
        contact_load=by.load(),
        active=_active(stage, film.asperities),
        friction=film.friction(stage, by, given),
        chamber_growth=0.0 if given is None else given.chamber_growth,
    )


def slipper_report(film: SlipperFilm, stage: FloatingStage) -> SlipperReport:
    """Report of a slipper's film."""
    pocket, fed = film.supplied(stage)
    flows, by = boundary_flows(stage.solution), film.wall_shear(stage)
    return SlipperReport(
        flow=np.array([fed]),
        leakage=sum(flows[edge] for edge in film.shape.lands.open),
        heat=by.heat(),
        contact_load=by.load(),
        active=_active(stage, film.asperities, held=film.is_held(stage.q)),
        friction=film.friction(stage, by),
        pocket_pressure=pocket,
        orifice_heat=fed * (film.chamber_pressure(stage.time) - pocket),
    )


def block_report(film: BlockFilm, stage: FloatingStage) -> BlockReport:
    """Report of the block's film; webs over the ports have neither contact nor heat."""
    solution = stage.solution
    space, flows, by = solution.problem.space, boundary_flows(solution), film.wall_shear(stage)
    is_film = film.is_film(space)
    chambers, suction, delivery = film.inflows(solution, flows)
    return BlockReport(
        flow=chambers,
        leakage=sum(flows[edge] for edge in film.geometry.case_edges),
        heat=by.heat(is_film),
        contact_load=by.load(is_film),
        active=_active(stage, film.asperities),
        torque=film.friction_torque(space, by),
        tilted_torque=film.tilted_torque(stage),
        suction_draw=suction,
        delivery_draw=delivery,
    )


def _active(stage: FloatingStage, asperities: Asperities | None, held: bool = False) -> tuple[Active, ...]:
    """Limiting states of a stage; `held`: a retainer presses."""
    found = []
    contact, outer = np.abs(stage.contact_force).max(), np.abs(stage.outer.force).max()
    if asperities is not None and contact > SHARE * outer:
        found.append(Active.CONTACT)
    if cavitated_fraction(stage.solution) > SHARE:
        found.append(Active.CAVITATION)
    if held:
        found.append(Active.RETAINER)
    return tuple(found) or (Active.LIFT,)


def drawn(report: GapReport) -> float:
    """Total flow (m3/s) of a gap out of chambers and ports."""
    ports = report.suction_draw + report.delivery_draw if isinstance(report, BlockReport) else 0.0
    return float(report.flow.sum()) + ports
