"""[ports] and [ports.delivery] of the pump description: opening of either port of the valve plate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from system.description.parts import GrooveSection, GrooveShape
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.inputs.sections.fields import Angle, Area, FlowFile, Limits, Points, Positive, fields_of
from system.inputs.sections.reader import with_values
from system.inputs.units import Dimension

Webs = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.ANGLE,) * 2, ("middle", "width"), ("90 deg", "4 deg")),
    Limits(fewest=1),
]


@dataclass(frozen=True, kw_only=True)
class DeliverySection:
    """[ports.delivery]: what the delivery port has in place of [ports], angles from its own dead centre."""

    groove_start: Angle | None = None
    groove_end: Angle | None = None
    groove_area: Area | None = None
    kidney_full_start: Angle | None = None
    kidney_full_end: Angle | None = None
    kidney_end: Angle | None = None
    kidney_area: Area | None = None
    coefficient_file: FlowFile | None = None
    grooves: tuple[GrooveSection, ...] = ()
    webs: Webs | None = None


_ONE_GROOVE = ("groove_start", "groove_area")


@dataclass(frozen=True, kw_only=True)
class PortsSection:
    """[ports]: opening of either port over the angle from its own dead centre."""

    groove_start: Angle | None = None  # with groove_area: one groove of that area
    groove_end: Angle  # the kidney begins to open
    groove_area: Area | None = None  # of that groove's throat
    kidney_full_start: Angle  # the block kidney lies within the port
    kidney_full_end: Angle  # the kidney begins to close
    kidney_end: Angle  # the port is closed
    kidney_area: Area  # of the full opening, a chamber
    flow_coefficient: Annotated[float, Limits(above=0.0, most=1.0)]  # of the orifice law
    critical_reynolds: Annotated[float, Positive]  # laminar-turbulent transition of the orifice law
    coefficient_file: FlowFile | None = None  # over opening and Reynolds number; the two above scale it
    grooves: tuple[GrooveSection, ...] = ()  # in place of groove_start and groove_area
    webs: Webs | None = None  # that part the port into several kidneys
    delivery: DeliverySection | None = None  # what differs there

    @property
    def sides(self) -> tuple[PortsSection, PortsSection]:
        """The ports of suction and delivery side, each as if both were it.

        Grooves of the one way of stating them take the place of those of the other.
        """
        if self.delivery is None:
            return self, self
        stated = {key: getattr(self.delivery, key) for key in fields_of(DeliverySection)}
        own = {key: value for key, value in stated.items() if value not in (None, ())}
        if "grooves" in own:
            own = dict.fromkeys(_ONE_GROOVE) | own
        elif own.keys() & set(_ONE_GROOVE):
            own |= {"grooves": ()}
        bare = with_values(self, delivery=None)
        return bare, with_values(bare, **own)

    @property
    def coefficient_tables(self) -> tuple[FlowCoefficients, ...]:
        """Those of [ports] and of the delivery port, each once."""
        stated = (self.coefficient_file, self.delivery.coefficient_file if self.delivery else None)
        return tuple(dict.fromkeys(table for table in stated if table is not None))

    @property
    def web_spans(self) -> tuple[tuple[float, float], ...]:
        """From and to (rad, from the port's own dead centre) of each web."""
        return tuple((middle - 0.5 * width, middle + 0.5 * width) for middle, width in self.webs or ())

    @property
    def relief_grooves(self) -> tuple[GrooveSection, ...]:
        """All grooves, [ports] groove_start and groove_area being one of a known area."""
        if self.groove_start is None or self.groove_area is None:
            return self.grooves
        own = GrooveSection(start=self.groove_start, end=self.groove_end, shape=GrooveShape.AREA, area=self.groove_area)
        return (own, *self.grooves)
