"""A drawn matplotlib figure as a plotly figure: the same panels, labels, units and colours, with hover and zoom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING, Any

from swashfilm.output.touch.panels import Panel, layout_of, panels_of, words
from swashfilm.output.touch.traces import Untranslated, traces_of

if TYPE_CHECKING:
    import plotly.graph_objects as go
    from matplotlib.figure import Figure


def touchable(figure: Figure) -> go.Figure | None:
    """Return the figure in plotly, None if a part of it has no counterpart here.

    The figure must have been drawn, so that its layout is final. Lines, bands, bars, error bars, scatter, spans, texts
    and fields kept by `keep_field` are translated; other patches, images and contours are not.
    """
    import plotly.graph_objects as go

    panels = panels_of(figure)
    try:
        traces = [trace for panel in panels for trace in traces_of(panel)]
    except Untranslated:
        return None
    if not traces:
        return None
    legends = dict(_legends(figure, panels, traces))
    return go.Figure(data=traces, layout=layout_of(figure, panels) | legends)


def _legends(figure: Figure, panels: Sequence[Panel], traces: Sequence[dict[str, Any]]) -> Iterator[tuple[str, Any]]:
    """Yield a legend of the layout for each column of the figure's ones; its traces name it afterwards."""
    yield "showlegend", True
    keys = ("legend" if number == 1 else f"legend{number}" for number in count(1))
    for legend, own in _found(figure, panels):
        box = legend.get_window_extent().transformed(figure.transFigure.inverted())
        names = [words(text.get_text()) for text in legend.get_texts()]
        long = -(-len(names) // legend._ncols)
        columns = [names[k : k + long] for k in range(0, len(names), long)]
        for number, column in enumerate(columns):
            key = next(keys)
            for name in column:
                alike = [one for one in traces if one["name"] == name and (own is None or one["yaxis"] in own)]
                for k, trace in enumerate(alike):
                    trace |= {"legend": key, "legendgroup": f"{key} {name}", "showlegend": k == 0}
            yield key, {
                "x": max(0.0, box.x0 + number * box.width / len(columns)), "y": min(box.y1, 1.0), "xanchor": "left",
                "yanchor": "top", "bgcolor": "rgba(0,0,0,0)", "font": {"size": 11}, "tracegroupgap": 0,
            }  # fmt: skip


def _found(figure: Figure, panels: Sequence[Panel]) -> Iterator[tuple[Any, set[str] | None]]:
    """Yield (legend, names of the y axes whose traces it lists; None for all)."""
    for legend in figure.legends:
        yield legend, None
    for panel in panels:
        legend = panel.axes.get_legend()
        if legend is not None:
            yield legend, {one.y for one in panels if one.x == panel.x}
