"""Assumptions of a pump: every value that its file leaves out."""

from gaps.films.physics import Physics
from system.description.assumptions import Assumption, Taken
from system.description.pump import PumpDescription
from system.description.tolerances import tolerances
from system.films.heat import all_taken
from system.films.parts import floating_parts
from system.films.rotor import rotor
from system.multibody.places import group_places
from system.multibody.plate_motion import swinging_plate
from system.pump.operating import operating_point


def assumptions(pump: PumpDescription) -> tuple[Assumption, ...]:
    """Every value that floating gaps, rotating group, swash plate and diagnosis take where the pump file states
    none, each path once. An actuator is not among them: only a transient has one.
    """
    plate = Taken()
    swinging_plate(pump, plate)
    group = rotor(pump, operating_point(pump))
    taken = (
        *all_taken(group, floating_parts(pump), Physics(heat=True)),
        *group_places(pump).taken,
        *plate.assumptions,
        *tolerances(pump)[1],
    )
    return tuple({one.path: one for one in taken}.values())
