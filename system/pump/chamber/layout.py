"""Columns of the arrays of the compiled chamber by name, and the pressure at which a cavity opens.

The column of a quantity of several paths, ports or gaps is that of the first; the others follow in their order.
"""

PATHS = 5
"""Number of paths out of the chamber."""
DELIVERY, SUCTION, PISTON, SLIPPER, VALVE_PLATE = range(PATHS)
PORTS = 2
"""Number of ports, the first paths."""
GAPS = 3
"""Number of gaps, the last paths."""
FIRST_GAP = PISTON

WAYS = 16
"""Columns of the ways out at a shaft angle."""
CONDUCTANCE, DRAG_FLOW, ORIFICE, BEHIND, AREA, FLOW_SCALE = 0, 3, 6, 10, 12, 14
"""Of each gap its conductance in m3/(s Pa) and its drag flow in m3/s; of each port both coefficients of its
orifice, the pressure in Pa behind it, its area in m2 and its `flow_scale`."""
TABLE = 7
"""Rows of a chamber's table over the turn: CONDUCTANCE, DRAG_FLOW as among the ways, then the volume's growth."""
GROWTH = 6

INTEGRALS = 16
"""Columns of the integrals over a turn."""
OUTFLOW, WORK, PATH_ENERGY, DRAG_ENERGY, PORT_ENERGY = 0, 5, 6, 11, 14
"""Mass out by each path, work -p dV, energy left in each path, work of the drag flow on each gap's walls, energy
that flows into each port."""

CAVITY_PRESSURE = 1e3 - 101325.0
"""Gauge pressure in Pa at which a cavity opens (1 kPa absolute): oil bears no tension. Its vapour pressure is lower
still, and dissolved air leaves it earlier; neither changes a chamber pressure shown in bar."""
CAVITY_SOFTNESS = 1e3
"""Fall of the pressure in Pa below CAVITY_PRESSURE while the void grows to the oil's own volume."""
