"""Panels of a matplotlib figure as axes of a plotly layout."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PIXELS = 104.0
"""Pixels per inch of a figure, so that ten inches fill the page."""
LEAST_HEIGHT = 240.0
BUTTONS = 30
"""Pixels above titles for the buttons of a figure, which cover what is below them."""
TITLES = (("left", 0.0), ("center", 0.5), ("right", 1.0))
"""Places of a panel's titles along its width."""
PLAIN = ("ScalarFormatter", "LogFormatterSciNotation", "NullFormatter")
"""Formatters of numbers; the labels of others are kept as they are."""


@dataclass(frozen=True)
class Panel:
    """Axes of a figure with the names of their plotly axes; titles with units, also of a shared axis."""

    axes: Any
    x: str
    y: str
    titles: tuple[str, str]
    over: str = ""  # y axis of the panel that this one, a twin, lies on
    shared: tuple[str, str] = ("", "")


def words(text: str) -> str:
    """Return a text of matplotlib for plotly, which interprets tags in it."""
    return escape(text.replace("$", ""), quote=False).replace("\n", "<br>")


def panels_of(figure: Figure) -> list[Panel]:
    """Return the panels, colour bars excepted; twins share the x axis of the one below them."""
    shown = [axes for axes in figure.axes if axes.get_label() != "<colorbar>" and axes.get_visible()]
    found: list[Panel] = []
    for number, axes in enumerate(shown, start=1):
        own = "" if number == 1 else str(number)
        below = next((one for one in found if _twins(one.axes, axes)), None)
        x, over = (below.x, below.y) if below else (f"x{own}", "")
        titled = [_titled(axes, shown, letter) for letter in "xy"]
        titles = tuple(words(getattr(one, f"get_{letter}label")()) for one, letter in zip(titled, "xy", strict=True))
        shared = tuple(
            "" if one is axes else f"{letter}{shown.index(one) + 1 if shown.index(one) else ''}"
            for one, letter in zip(titled, "xy", strict=True)
        )
        found.append(Panel(axes, x, f"y{own}", (titles[0], titles[1]), over, (shared[0], shared[1])))
    return found


def _twins(below: Any, axes: Any) -> bool:
    return bool(below.get_shared_x_axes().joined(below, axes)) and np.allclose(below.bbox.bounds, axes.bbox.bounds)


def _titled(axes: Any, shown: Sequence[Any], letter: str) -> Any:
    """Return the axes with the title of a shared axis: these, or the first sharing ones that have a title."""
    group = getattr(axes, f"get_shared_{letter}_axes")()
    if getattr(axes, f"get_{letter}label")():
        return axes
    return next((one for one in shown if group.joined(axes, one) and getattr(one, f"get_{letter}label")()), axes)


def layout_of(figure: Figure, panels: Sequence[Panel]) -> dict[str, Any]:
    """Return axes, titles and texts of a figure, its height in pixels, and its width that of the page."""
    width, height = figure.get_size_inches()
    tall = max(LEAST_HEIGHT, PIXELS * height * 10.0 / max(width, 8.0))
    titled = any(panel.axes.get_title(where) for panel in panels for where, _ in TITLES)
    above = BUTTONS if titled or _legend_at_top(figure, panels, 1.0 - BUTTONS / tall) else 0
    layout: dict[str, Any] = {
        "height": tall + above,
        "margin": {"l": 0, "r": 0, "t": above, "b": 0, "autoexpand": False},
        "hovermode": "closest",
        "barmode": "overlay",
        "uirevision": "kept",
    }
    annotations: list[dict[str, Any]] = []
    for panel in panels:
        box = panel.axes.bbox.transformed(figure.transFigure.inverted())
        if not panel.over:
            layout[_key(panel.x)] = _axis(panel, "x", panel.y, (box.x0, box.x1))
        layout[_key(panel.y)] = _axis(panel, "y", panel.x, (box.y0, box.y1))
        if panel.over:
            layout[_key(panel.y)] |= {"overlaying": panel.over, "side": "right", "showgrid": False, "tickmode": "auto"}
        elif panel.axes.get_aspect() != "auto":
            layout[_key(panel.y)] |= {"scaleanchor": panel.x, "constrain": "domain"}
        annotations += _texts(panel)
    layout["annotations"] = annotations
    return layout


def _legend_at_top(figure: Figure, panels: Sequence[Panel], top: float) -> bool:
    """True if a legend reaches above the part `top` of the figure's height, where the buttons are."""
    own = [one for panel in panels if (one := panel.axes.get_legend()) is not None]
    boxes = (one.get_window_extent().transformed(figure.transFigure.inverted()) for one in [*figure.legends, *own])
    return any(box.y1 > top for box in boxes)


def _key(name: str) -> str:
    return f"{name[0]}axis{name[1:]}"


def _axis(panel: Panel, letter: str, anchor: str, domain: tuple[float, float]) -> dict[str, Any]:
    axes, place = panel.axes, "xy".index(letter)
    own, ends = getattr(axes, f"{letter}axis"), getattr(axes, f"get_{letter}lim")()
    logarithmic = own.get_scale() == "log"
    found: dict[str, Any] = {
        "domain": [max(0.0, domain[0]), min(1.0, domain[1])],
        "anchor": anchor,
        "type": "log" if logarithmic else "linear",
        "range": [float(end) for end in (np.log10(ends) if logarithmic else ends)],
        "title": {"text": words(own.get_label_text()), "font": {"size": 12}, "standoff": 4},
        "showline": True,
        "zeroline": False,
        "ticks": "outside",
        "showticklabels": any(label.get_visible() for label in own.get_ticklabels() if label.get_text()),
    }
    if panel.shared[place]:
        found["matches"] = panel.shared[place]
    if type(own.get_major_formatter()).__name__ not in PLAIN:
        found |= {"tickvals": list(own.get_majorticklocs()), "ticktext": tick_texts(own)}
    return found


def tick_texts(axis: Any) -> list[str]:
    """Return the texts at an axis' ticks."""
    return [words(label.get_text()) for label in axis.get_ticklabels()]


def _texts(panel: Panel) -> Iterator[dict[str, Any]]:
    """Yield titles and texts of a panel as annotations."""
    axes = panel.axes
    for where, at in TITLES:
        if title := axes.get_title(where):
            place = {"xref": f"{panel.x} domain", "yref": f"{panel.y} domain", "x": at, "y": 1.0, "yanchor": "bottom"}
            yield place | {"text": words(title), "showarrow": False, "xanchor": where, "font": {"size": 12}}
    of_contours = {id(text) for one in axes.collections for text in getattr(one, "labelTexts", ())}
    for text in axes.texts:
        if id(text) in of_contours:
            continue
        in_data = text.get_transform().contains_branch_seperately(axes.transData)
        refs = [
            f"{name}" if inside else f"{name} domain" for name, inside in zip((panel.x, panel.y), in_data, strict=True)
        ]
        x, y = text.xy if hasattr(text, "xyann") else text.get_position()
        across, up = text.get_horizontalalignment(), text.get_verticalalignment()
        yield {
            "xref": refs[0], "yref": refs[1], "x": float(x), "y": float(y), "text": words(text.get_text()),
            "showarrow": False, "xanchor": across, "font": {"size": 11},
            "yanchor": {"center": "middle", "baseline": "bottom", "center_baseline": "middle"}.get(up, up),
        }  # fmt: skip
