"""Flow diagram of powers: power supplied on the left, its sinks on the right, as ribbons of true width.

The power not delivered is drawn a second time, enlarged, and from there each of its parts runs to its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from swashfilm.output.figures import figure_of
from swashfilm.runs.pump.headline.powers import Power, PowerKind, power_text, share_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INCH = 72.0
WIDTH, ROW, TRUNK, EDGE = 530.0, 17.0, 92.0, 12.0
"""Points: width of the picture, height of a row of text, of the whole power, margin."""
LEFT, SPLIT, LENS, FAN, WATTS, SHARE = 8.0, 150.0, 190.0, 272.0, 480.0, 525.0
"""Points from the left: ends of the ribbons, and the right edges of the numbers."""
SCALES = (1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 30, 40, 60, 80, 100)
INK, SIZE, LONGEST = "#1c2328", 10.0, 31
"""Colour and size of texts; the letters of a name that have room in this size."""
COLOURS = {
    PowerKind.SHAFT: "#7d8a93", PowerKind.DELIVERED: "#4f8a63", PowerKind.FRICTION: "#a3623a",
    PowerKind.LEAKAGE: "#3c7a8c", PowerKind.THROTTLING: "#b8862b", PowerKind.OIL: "#76679c",
    PowerKind.EFFECT: "#a34a6b", PowerKind.OTHER: "#8d989f",
}  # fmt: skip
LOST = "#c3a08c"


@dataclass(frozen=True)
class End:
    """One end of a ribbon, in points: its place across, its upper edge, its width."""

    x: float
    top: float
    width: float


def flow_diagram(shaft: float, parts: Sequence[Power]) -> Figure:
    """Draw the shaft power (W) as the sum of its parts, in this order.

    Negative parts are supplied on the left beside the shaft power; a negative shaft power, of a motor, is a sink.
    """
    drive = Power("shaft power", shaft, PowerKind.SHAFT)
    given = _joined([*([drive] if shaft > 0.0 else []), *(_turned(one) for one in parts if one.watts < 0.0)])
    taken = [*([_turned(drive)] if shaft < 0.0 else []), *(one for one in parts if one.watts > 0.0)]
    whole = sum(one.watts for one in given)
    useful = [one for one in taken if one.kind in (PowerKind.SHAFT, PowerKind.DELIVERED)]
    lost = [one for one in taken if one not in useful]
    rows = len(lost) + 1
    height = TRUNK + 2.0 * EDGE + ROW + max(ROW * rows, ROW * (3 * len(given) + 3))
    figure, axes = _canvas(height)
    top = height - EDGE - ROW
    _draw_given(axes, given, whole, top)
    place = top
    for one in useful:
        width = TRUNK * one.watts / whole
        _ribbon(axes, End(SPLIT, place, width), End(FAN, place, width), COLOURS[one.kind])
        _row(axes, one, shaft, place - 0.5 * width)
        place -= width
    if lost:
        _draw_lost(axes, lost, shaft, whole, place)
    return figure


def _turned(power: Power) -> Power:
    return Power(power.name, -power.watts, power.kind)


def _joined(given: Sequence[Power]) -> list[Power]:
    """Return the supplied powers: the first, and the others as one."""
    first, *others = given
    if len(others) < 2:
        return [first, *others]
    return [first, Power(f"{len(others)} parts", sum(one.watts for one in others), PowerKind.OTHER)]


def _canvas(height: float) -> tuple[Figure, Any]:
    figure = figure_of(WIDTH / INCH, height / INCH)
    figure.set_layout_engine("none")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, WIDTH), ylim=(0.0, height))
    axes.set_axis_off()
    return figure, axes


def _draw_given(axes: Any, given: Sequence[Power], whole: float, top: float) -> None:
    """Draw the supplied power: the first straight on, with its name above; returned power from below."""
    place, below = top, top
    for k, one in enumerate(given):
        width = TRUNK * one.watts / whole
        _ribbon(axes, End(LEFT, below, width), End(SPLIT, place, width), COLOURS[one.kind])
        watts = power_text(one.watts, whole)
        if k == 0:
            axes.text(LEFT, top + 5.0, f"{one.name}  {watts}", fontsize=SIZE, weight="bold", color=INK)
        else:
            words = f"returned  {watts}\n{one.name}"
            axes.text(LEFT, below - width - 3.0, words, fontsize=0.8 * SIZE, color=INK, va="top")
        place -= width
        below -= width + ROW


def _draw_lost(axes: Any, lost: Sequence[Power], shaft: float, whole: float, place: float) -> None:
    """Draw the power not delivered: enlarged from `place` on, and from there to a row for each part."""
    total = sum(one.watts for one in lost)
    width, first = TRUNK * total / whole, min(place, axes.get_ylim()[1] - EDGE - TRUNK) - ROW
    room = ROW * max(len(lost), 6)
    scale = max(one for one in SCALES if one == 1 or one * width <= 0.92 * room)
    lens_top = first - 0.5 * (room - scale * width)
    _ribbon(axes, End(SPLIT, place, width), End(LENS, lens_top, scale * width), LOST)
    words = ["not delivered", f"{power_text(total, whole)}, {share_text(total, shaft)}"]
    words += [f"enlarged {scale} times"] if scale > 1 else []
    axes.text(LEFT, EDGE, "\n".join(words), fontsize=SIZE, color=INK, va="bottom", linespacing=1.4)
    at = lens_top
    for k, one in enumerate(lost):
        own = scale * TRUNK * one.watts / whole
        row = first - ROW * k - 0.5 * (room - ROW * (len(lost) - 1)) * (len(lost) < 6)
        middle = row - 0.5 * ROW if len(lost) >= 6 else row
        thin = min(own, ROW - 4.0)
        _ribbon(axes, End(LENS, at, own), End(FAN, middle + 0.5 * thin, thin), COLOURS[one.kind])
        _row(axes, one, shaft, middle)
        at -= own


def _row(axes: Any, power: Power, shaft: float, middle: float) -> None:
    style = {"fontsize": SIZE, "color": INK, "va": "center_baseline"}
    axes.text(FAN + 6.0, middle, power.name, **style | {"fontsize": SIZE * min(1.0, LONGEST / len(power.name))})
    axes.text(WATTS, middle, power_text(power.watts, shaft), ha="right", **style)
    axes.text(SHARE, middle, share_text(power.watts, shaft), ha="right", **style)


def _ribbon(axes: Any, start: End, end: End, colour: str) -> None:
    """Draw a ribbon between two ends, at least a hairline."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    middle = 0.5 * (start.x + end.x)
    low, last = start.top - start.width, end.top - end.width
    corners = [
        (start.x, start.top), (middle, start.top), (middle, end.top), (end.x, end.top), (end.x, last),
        (middle, last), (middle, low), (start.x, low), (start.x, start.top),
    ]  # fmt: skip
    codes = [Path.MOVETO, *[Path.CURVE4] * 3, Path.LINETO, *[Path.CURVE4] * 3, Path.CLOSEPOLY]
    axes.add_patch(PathPatch(Path(corners, codes), facecolor=colour, edgecolor=colour, linewidth=0.6, alpha=0.85))
