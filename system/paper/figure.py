"""Figures and tables of the paper as reproduced here, and the curves that replace them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from reynolds.numerics.arrays import Array
from system.inputs.shown import shown_in


class Figure(Enum):
    """A figure or table of the paper by its name on the command line, with its content."""

    TABLE1 = ("table1", "the simulated pump (the paper's Table 1 is lost; what its text states)")
    FIG2 = ("fig2", "overall efficiency at rated speed")
    FIG3 = ("fig3", "efficiencies and losses of Cases 1 to 3")
    FIG8 = ("fig8", "film between piston and cylinder")
    FIG9 = ("fig9", "slipper film over displacement")
    FIG10 = ("fig10", "flow area of the ports over a turn")
    FIG11 = ("fig11", "chamber pressure at 5 and 35 MPa")
    FIG13 = ("fig13", "tuned friction coefficients at rated speed")
    FIG15 = ("fig15", "relative locus of ball guide and retainer")
    FIG16 = ("fig16", "hydro-mechanical loss over pressure")
    FIG17 = ("fig17", "shares of the pairs at full displacement")
    FIG18 = ("fig18", "losses of the pairs over pressure")
    FIG19 = ("fig19", "ball guide-retainer loss by equation and by multibody forces")
    FIG20 = ("fig20", "shares over displacement at 5 MPa and rated speed")
    FIG21 = ("fig21", "shares over pressure at 28 % and rated speed")
    FIG22 = ("fig22", "shares over speed at 28 % and 5 MPa")
    EQUATIONS = ("equations", "equations that print otherwise than they can be")

    title: str

    def __new__(cls, name: str, title: str) -> Figure:
        """A member whose value is its name alone."""
        member = object.__new__(cls)
        member._value_ = name
        member.title = title
        return member

    @classmethod
    def named(cls, name: str) -> Figure:
        """The figure of a name on the command line. Raises KeyError for an unknown name."""
        return {figure.value: figure for figure in cls}[name]


DRAWINGS = {
    "fig1": "test circuit and bed",
    "fig4": "structure of the pump",
    "fig5": "locus of a slipper",
    "fig6": "ball guide and retainer",
    "fig7": "co-simulation model",
    "fig12": "joints between the parts",
    "fig14": "co-simulation structure",
}
"""Figures of the paper that are drawings without numbers."""


class Unit(Enum):
    """Unit of a number: SI unit, the unit shown, and the factor between them; of pressures as requested."""

    NUMBER = ("1", "1", 1.0)
    SHARE = ("1 as a share", "%", 100.0)
    PRESSURE = ("Pa", "MPa", 1e-6)
    POWER = ("W", "W", 1.0)
    FILM = ("m, of a film", "um", 1e6)
    LENGTH = ("m", "mm", 1e3)
    AREA = ("m2", "mm2", 1e6)
    ANGLE = ("rad", "deg", 57.29577951308232)
    SPEED = ("rad/s", "r/min", 9.549296585513721)
    DISPLACEMENT = ("m3/rev", "mL/rev", 1e6)
    FLOW = ("m3/s", "L/min", 6e4)
    FORCE = ("N", "N", 1.0)

    @property
    def si(self) -> str:
        """The SI unit."""
        return self.value[0].split()[0].rstrip(",")

    @property
    def shown(self) -> str:
        """The unit it is shown in."""
        return shown_in("Pa").unit if self is Unit.PRESSURE else self.value[1]

    @property
    def factor(self) -> float:
        """Shown number over SI number."""
        return shown_in("Pa").factor if self is Unit.PRESSURE else self.value[2]


@dataclass(frozen=True)
class FigureAxis:
    """Quantity along an axis; its numbers are SI."""

    words: str
    unit: Unit


@dataclass(frozen=True)
class Curve:
    """Points (n,) in SI; sigma (n,): uncertainty of each, None where it is computed."""

    name: str
    x: Array
    y: Array
    sigma: Array | None = None


@dataclass(frozen=True)
class FigureField:
    """Values (m, n) over x (n,) and y (m,)."""

    axis: FigureAxis
    x: Array
    y: Array
    values: Array


class PanelKind(Enum):
    """As lines, over a logarithmic axis, stacked, to one scale both ways, as a field, or as bars."""

    LINES = "lines"
    LOGARITHMIC = "logarithmic"
    STACKED = "stacked"
    TRUE_SCALE = "true scale"
    FIELD = "field"
    BARS = "bars"


@dataclass(frozen=True)
class Panel:
    """One picture of a figure; curves of a field are points marked on it, of bars one bar each."""

    title: str
    kind: PanelKind
    x: FigureAxis
    y: FigureAxis
    curves: tuple[Curve, ...] = ()
    field: FigureField | None = None
