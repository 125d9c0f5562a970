"""A drawn matplotlib figure as a plotly figure: the same panels, labels, units and colours, with hover and zoom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from swashfilm.output.touch.panels import Panel, layout_of, panels_of
from swashfilm.output.touch.traces import Untranslated, traces_of

if TYPE_CHECKING:
    import plotly.graph_objects as go
    from matplotlib.figure import Figure


def touchable(figure: Figure) -> go.Figure | None:
    """Return the figure in plotly, None where it holds anything without a counterpart here.

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
    """Yield a legend of the layout for each one of the figure; traces with its names belong to it afterwards."""
    yield "showlegend", True
    for number, (legend, own) in enumerate(_found(figure, panels), start=1):
        key = "legend" if number == 1 else f"legend{number}"
        box = legend.get_window_extent()
        left, top = figure.transFigure.inverted().transform((box.x0, box.y1))
        names = [text.get_text() for text in legend.get_texts()]
        for name in names:
            alike = [one for one in traces if one.get("name") == name and (own is None or one["yaxis"] in own)]
            for k, trace in enumerate(alike):
                trace |= {"legend": key, "legendgroup": f"{key} {name}", "showlegend": k == 0}
        row = len(names) <= legend._ncols
        yield key, {
            "x": min(max(left, 0.0), 1.0), "y": min(max(top, 0.0), 1.0), "xanchor": "left", "yanchor": "top",
            "bgcolor": "rgba(0,0,0,0)", "orientation": "h" if row else "v", "font": {"size": 11}, "tracegroupgap": 0,
        }  # fmt: skip


def _found(figure: Figure, panels: Sequence[Panel]) -> Iterator[tuple[Any, set[str] | None]]:
    """Yield (legend, names of the y axes whose traces it lists; None for all)."""
    for legend in figure.legends:
        yield legend, None
    for panel in panels:
        legend = panel.axes.get_legend()
        if legend is not None:
            yield legend, {one.y for one in panels if one.x == panel.x}
