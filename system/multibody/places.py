"""Places of the joints of the rotating group: from the pump file, or assumed and listed."""

from dataclasses import dataclass

from system.description.assumptions import Assumption, Taken
from system.description.parts import RetainerKind, Stroking
from system.description.pump import PumpDescription
from system.films.parts import ball_plane_height, retainer_kind, spline_height
from system.inputs.units import Dimension


@dataclass(frozen=True)
class GroupPlaces:
    """Heights (m) over the valve plate.

    pivot: intersection of the shaft with the plane of the ball centres, also the ball guide's centre; spline:
    lateral support of the block on the shaft; middles of front and rear bearing. arm m, of the actuator's pin
    from the tilt axis; strokes: sense in which its force tilts the plate. retained: the spring presses the
    slippers through the retainer, or else rests on the shaft.
    """

    pivot: float
    spline: float
    front: float
    rear: float
    arm: float
    strokes: Stroking
    retained: bool
    taken: tuple[Assumption, ...]


def group_places(pump: PumpDescription) -> GroupPlaces:
    """The places of a pump's joints, every value stated or assumed."""
    taken = Taken()
    pivot = ball_plane_height(pump)
    spline = spline_height(pump, taken)
    rear, front = _bearings(pump, pivot, taken)
    retained = retainer_kind(pump, taken) is RetainerKind.SPRING
    arm, strokes = actuator_arm(pump, taken), stroking(pump, taken)
    return GroupPlaces(pivot, spline, front, rear, arm, strokes, retained, tuple(taken.assumptions))


def slippers_reach(pump: PumpDescription) -> float:
    """From the shaft to the slippers' rims, m."""
    return pump.pump.pitch_radius + pump.slipper.land_outer_radius


def actuator_arm(pump: PumpDescription, taken: Taken) -> float:
    """Distance (m) of the actuator's pin from the tilt axis, stated or assumed."""
    reach = slippers_reach(pump)
    return taken.value("actuator.arm", pump.actuator.arm, reach, "out to the slippers' rims", Dimension.LENGTH)


def stroking(pump: PumpDescription, taken: Taken) -> Stroking:
    """Sense in which the actuator's pressure tilts the plate, stated or assumed."""
    if pump.actuator.strokes is not None:
        return pump.actuator.strokes
    taken.note("actuator.strokes", Stroking.UP.value, "control pressure holds the plate against the pump's moment")
    return Stroking.UP


def _bearings(pump: PumpDescription, pivot: float, taken: Taken) -> tuple[float, float]:
    """Heights (m) of rear and front bearing; left out: where a side force in the plane of the ball centres divides
    between them by the stated shares."""
    stated, share = pump.bearings, pump.bearings.front_share
    rear, front = stated.rear_position, stated.front_position
    reason = "where a side force in the plane of the ball centres gives front_share and rear_share"
    if rear is None:
        level = 0.0 if front is None or share == 1.0 else (pivot - share * front) / (1.0 - share)
        why = "in the face of the valve plate" if front is None else reason
        rear = taken.value("bearings.rear_position", None, level, why, Dimension.LENGTH)
    reach = (pivot - rear) / share if share > 0.0 else 2.0 * pivot
    return rear, taken.value("bearings.front_position", front, rear + reach, reason, Dimension.LENGTH)
