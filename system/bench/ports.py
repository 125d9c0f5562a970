"""The ports of the valve plate at the points of a bench map: turned by a cross angle, worn at their grooves."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.pump.chamber.setup import turn_nodes
from system.pump.lumped import port_openings
from system.pump.ports.areas import as_array
from system.pump.ports.wear import PortWear


@dataclass(frozen=True)
class MapPorts:
    """Suction and delivery port at N points, as compiled code reads them.

    suction, delivery: (N, PORT_SIZE); nodes: every point's nodes of a turn, end to end, of point i from firsts[i]
    to firsts[i + 1].
    """

    suction: Array
    delivery: Array
    nodes: Array
    firsts: NDArray[np.int64]


def map_ports(pump: PumpDescription, shift: Array, wear: PortWear[Array], samples: int) -> MapPorts:
    """The ports at N points, later by shift (N,) rad (`SwashDrive.dead_centre_shift`), with their wear.

    Nodes are the breaks of the ports and, of an even number of samples, every second: over steps no
    longer the stages give the pressure as well as the steps do. Equal points share the work.
    """
    rows = np.column_stack([shift, *vars(wear).values()])
    kinds, of_point = np.unique(rows, axis=0, return_inverse=True)
    found = [_kind(pump, *map(float, kind), samples=samples) for kind in kinds]
    by_point = [found[kind] for kind in of_point.ravel()]
    suction, delivery, nodes = zip(*by_point, strict=True)
    firsts = np.cumsum([0, *(own.size for own in nodes)])
    return MapPorts(np.stack(suction), np.stack(delivery), np.concatenate(nodes), firsts)


def _kind(pump: PumpDescription, shift: float, *wear: float, samples: int) -> tuple[Array, Array, Array]:
    suction, delivery = port_openings(pump, shift, PortWear(*wear))
    ends = samples // 2 if samples % 2 == 0 else samples
    return as_array(suction), as_array(delivery), turn_nodes(suction, delivery, ends)[0]
