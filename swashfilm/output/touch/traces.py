"""Plotly traces of a matplotlib panel."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.touch.fields import GridField, kept_field
from swashfilm.output.touch.packing import short
from swashfilm.output.touch.panels import Panel, tick_texts, words

DASHES = {"-": "solid", "--": "dash", ":": "dot", "-.": "dashdot"}
SIGNS = {
    "o": "circle", ".": "circle", ",": "circle", "s": "square", "^": "triangle-up", "v": "triangle-down",
    "x": "x-thin-open",
    "+": "cross-thin-open", "*": "star", "D": "diamond", "d": "diamond", "<": "triangle-left", ">": "triangle-right",
    "|": "line-ns-open", "_": "line-ew-open", "P": "cross", "X": "x",
}  # fmt: skip
STEPS = {"steps-pre": "vh", "steps": "vh", "steps-mid": "hvh", "steps-post": "hv", "default": "linear"}
PIXELS = 1.4  # per point, of lines and marks
MOST = 2000
"""Points of a line; of a longer one, the highest and the lowest in each of as many equal parts as pixels."""


class Untranslated(Exception):
    """An artist without a counterpart in plotly."""


def traces_of(panel: Panel) -> list[dict[str, Any]]:
    """Return the traces of a panel in the order of drawing; raise Untranslated for an artist without a counterpart."""
    axes, place = panel.axes, {"xaxis": panel.x, "yaxis": panel.y}
    bars = {id(bar): group for group in axes.containers for bar in _patches(group)}
    fields = [kept_field(one) for one in axes.collections]
    found: list[dict[str, Any]] = []
    for one, field in zip(axes.collections, fields, strict=True):
        if field is not None:
            found += _field(one, field, panel)
        elif type(one).__name__ not in ("QuadContourSet", "TriContourSet") or not any(fields):
            found += _collection(one, panel)
    groups = {id(group): group for group in bars.values()}
    found += [_bars(group, panel) for group in groups.values()]
    found += [_span(one, panel) for one in axes.patches if id(one) not in bars]
    found += [_line(one, panel) for one in axes.lines]
    if axes.images or axes.tables or axes.artists:
        raise Untranslated
    return [trace | place for trace in found]


def _patches(group: Any) -> list[Any]:
    return list(getattr(group, "patches", []))


def colour(given: Any) -> str:
    """Return a matplotlib colour as plotly reads it."""
    from matplotlib.colors import to_hex, to_rgba

    red, green, blue, alpha = to_rgba(given)
    if alpha == 1.0:
        return to_hex(given)
    return f"rgba({255 * red:.0f},{255 * green:.0f},{255 * blue:.0f},{alpha:.3g})"


def scale_of(colours: Any) -> list[list[Any]]:
    """Return a matplotlib colour map as plotly's list of (place, colour)."""
    return [[place, colour(colours(place))] for place in np.linspace(0.0, 1.0, 17).tolist()]


def _name(artist: Any) -> str:
    label = str(artist.get_label())
    return "" if label.startswith("_") else words(label)


def _hover(panel: Panel, name: str, extra: str = "") -> dict[str, Any]:
    """Return name and hover text of a trace: both coordinates with the titles of their axes."""
    parts = [f"{title or letter}: %{{{letter}:.6~g}}" for title, letter in zip(panel.titles, "xy", strict=True)]
    return {"name": name, "showlegend": False, "hovertemplate": f"{'<br>'.join(parts)}{extra}<extra>{name}</extra>"}


def _numbers(values: Any) -> Array:
    """Return values with nan in place of masked ones."""
    return np.atleast_1d(np.asarray(np.ma.filled(np.ma.asarray(values, dtype=float), np.nan)))


def _thinned(x: Array, y: Array) -> tuple[Array, Array]:
    """Return at most MOST points of a line: the ends, and the least and the largest of each part of it."""
    if len(y) <= MOST:
        return x, y
    parts = np.array_split(np.arange(1, len(y) - 1), MOST // 2 - 1)
    of_ends = [[part[np.argmin(y[part])], part[np.argmax(y[part])]] for part in parts]
    kept = np.unique([0, *np.ravel(of_ends), len(y) - 1])
    return x[kept], y[kept]


def _line(line: Any, panel: Panel) -> dict[str, Any]:
    x, y = (_numbers(one) for one in line.get_data(orig=False))
    for k, inside in enumerate(line.get_transform().contains_branch_seperately(panel.axes.transData)):
        if not inside:  # a line across the panel
            low, high = (panel.axes.get_xlim, panel.axes.get_ylim)[k]()
            x, y = (low + (high - low) * x, y) if k == 0 else (x, low + (high - low) * y)
    x, y = _thinned(x, y)
    sign, style = line.get_marker(), line.get_linestyle()
    lines, marks = style in DASHES, sign not in ("None", "none", "", " ", None)
    opacity = line.get_alpha()
    trace = {
        "type": "scatter",
        "x": short(x),
        "y": short(y),
        "mode": "+".join(kind for kind, on in (("lines", lines), ("markers", marks)) if on) or "none",
        "opacity": 1.0 if opacity is None else opacity,
        "cliponaxis": bool(line.get_clip_on()),
    }
    if lines:
        shape = STEPS[line.get_drawstyle()]
        width = PIXELS * line.get_linewidth()
        trace["line"] = {"color": colour(line.get_color()), "width": width, "dash": DASHES[style], "shape": shape}
    if marks:
        if not isinstance(sign, str) or sign not in SIGNS:
            raise Untranslated
        size = PIXELS * line.get_markersize() * (0.5 if sign in ".," else 1.0)
        face = line.get_markerfacecolor()
        hollow = isinstance(face, str) and face == "none" and not SIGNS[sign].endswith("-open")
        trace["marker"] = {
            "color": colour(line.get_markeredgecolor() if hollow or sign in "x+|_" else face), "size": size,
            "symbol": SIGNS[sign] + ("-open" if hollow else ""),
        }  # fmt: skip
    return trace | _hover(panel, _name(line))


def _collection(one: Any, panel: Panel) -> Iterator[dict[str, Any]]:
    kind = type(one).__name__
    if kind in ("FillBetweenPolyCollection", "PolyCollection"):
        yield _area(one, panel)
    elif kind == "LineCollection":
        yield _segments(one, panel)
    elif kind == "PathCollection":
        yield _scatter(one, panel)
    else:
        raise Untranslated


def _joined(pieces: list[Array]) -> tuple[Array, Array]:
    """Return the coordinates of polygons or segments one after the other, nan between them."""
    gap = np.full((1, 2), np.nan)
    joined = np.concatenate([part for piece in pieces for part in (piece, gap)]) if pieces else gap
    return joined[:, 0], joined[:, 1]


def _area(area: Any, panel: Panel) -> dict[str, Any]:
    if area.get_array() is not None or not all(area.get_transform().contains_branch_seperately(panel.axes.transData)):
        raise Untranslated
    x, y = _joined([np.column_stack(_thinned(*path.vertices.T)) for path in area.get_paths()])
    edge = {"mode": "lines", "line": {"width": 0}, "fill": "toself", "fillcolor": colour(area.get_facecolor()[0])}
    shown = _hover(panel, _name(area)) | {"hoverinfo": "skip"}
    del shown["hovertemplate"]
    return {"type": "scatter", "x": short(x), "y": short(y)} | edge | shown


def _segments(lines: Any, panel: Panel) -> dict[str, Any]:
    if not all(lines.get_transform().contains_branch_seperately(panel.axes.transData)):
        raise Untranslated
    x, y = _joined([path.vertices for path in lines.get_paths()])
    look = {"color": colour(lines.get_color()[0]), "width": PIXELS * float(lines.get_linewidth()[0])}
    return {"type": "scatter", "x": short(x), "y": short(y), "mode": "lines", "line": look} | _hover(
        panel, _name(lines)
    )


def _scatter(dots: Any, panel: Panel) -> dict[str, Any]:
    x, y = _numbers(dots.get_offsets()).T
    sizes = PIXELS * np.sqrt(dots.get_sizes())
    marker: dict[str, Any] = {"size": short(sizes) if len(sizes) > 1 else float(sizes[0])}
    extra = ""
    if dots.get_array() is not None:
        marker |= {"color": short(dots.get_array()), **_colours(dots)}
        extra = "<br>%{marker.color:.5~g}"
        if dots.colorbar is not None:
            title = bar_title(dots, panel)
            extra = f"<br>{title}: %{{marker.color:.5~g}}"
            marker |= _bar(dots, panel, title) | {"showscale": True}
    else:
        faces = dots.get_facecolor() if len(dots.get_facecolor()) else dots.get_edgecolor()
        colours = [colour(one) for one in faces]
        marker["color"] = colours[0] if len(colours) == 1 else colours
    return {"type": "scatter", "x": short(x), "y": short(y), "mode": "markers", "marker": marker} | _hover(
        panel, _name(dots), extra
    )


def bar_title(artist: Any, panel: Panel) -> str:
    """Return the meaning of an artist's colours: the label of its colour bar, otherwise the title of its panel."""
    bar = artist.colorbar
    label = "" if bar is None else bar.ax.get_ylabel() or bar.ax.get_xlabel()
    return words(label or panel.axes.get_title())


def _colours(artist: Any) -> dict[str, Any]:
    """Return colour scale, ends and colour bar of an artist."""
    low, high = artist.get_clim()
    return {"colorscale": scale_of(artist.get_cmap()), "cmin": float(low), "cmax": float(high), "showscale": False}


def _stretched(scale: list[list[Any]], levels: Array) -> list[list[Any]]:
    """Return a colour scale in which each step between levels has the same share of the colours."""
    shares = np.linspace(0.0, 1.0, len(levels))
    places = np.interp([place for place, _ in scale], shares, (levels - levels[0]) / (levels[-1] - levels[0]))
    return [[float(f"{place:.4g}"), shade] for place, (_, shade) in zip(places, scale, strict=True)]


def _field(artist: Any, field: GridField, panel: Panel) -> list[dict[str, Any]]:
    """Return a field as areas between its levels, or as a smooth map."""
    title = bar_title(artist, panel)
    look = _colours(artist)
    look = {"zmin": look.pop("cmin"), "zmax": look.pop("cmax"), "colorscale": look["colorscale"]}
    hover = _hover(panel, "", f"<br>{title}: %{{z:.5~g}}") | _bar(artist, panel, title)
    grid = {"x": short(field.x), "y": short(field.y), "z": short(field.values, 4)}
    if field.levels is None:
        return [{"type": "heatmap", "zsmooth": "best", **grid, **look, **hover}]
    look["colorscale"] = _stretched(look["colorscale"], field.levels)
    labels = {"coloring": "heatmap", "showlabels": True, "labelfont": {"size": 10, "color": "white"}}
    lines = {"ncontours": len(field.levels), "contours": labels, "line": {"color": "white", "width": 0.5}}
    return [{"type": "contour", **lines, **grid, **look, **hover}]


def _bar(artist: Any, panel: Panel, title: str) -> dict[str, Any]:
    """Return the colour bar of a field in the place of the static one."""
    if artist.colorbar is None:
        return {"showscale": False}
    to_figure = panel.axes.figure.get_figure(root=True).transFigure.inverted()
    box = artist.colorbar.ax.bbox.transformed(to_figure)
    place = {"x": box.x0, "xanchor": "left", "y": 0.5 * (box.y0 + box.y1), "yanchor": "middle", "len": box.height}
    return {
        "colorbar": place | {"thickness": 10, "xpad": 0, "ypad": 0, "tickfont": {"size": 10}, "title": {"text": ""}}
    }


def _bars(group: Any, panel: Panel) -> dict[str, Any]:
    lying = group.orientation == "horizontal"
    boxes = np.array([(bar.get_x(), bar.get_y(), bar.get_width(), bar.get_height()) for bar in group.patches])
    x, y, width, height = boxes.T
    place, thick, base, size = (y + 0.5 * height, height, x, width) if lying else (x + 0.5 * width, width, y, height)
    along, across = ("x", "y") if lying else ("y", "x")
    axis = getattr(panel.axes, f"{across}axis")
    ticks, texts = axis.get_majorticklocs(), tick_texts(axis)
    named = 0 < len(ticks) == len(texts)  # an inner panel of a shared axis has no texts
    names = [texts[int(np.argmin(np.abs(ticks - at)))] if named else "" for at in place]
    faces = [colour(bar.get_facecolor()) for bar in group.patches]
    name, title = _name(group), panel.titles[0 if lying else 1]
    return {
        "type": "bar", "orientation": "h" if lying else "v", across: short(place), along: short(size),
        "base": short(base), "width": short(thick),
        "marker": {"color": faces[0] if len(set(faces)) == 1 else faces, "line": {"width": 0}},
        "customdata": [[text, value] for text, value in zip(names, short(size), strict=True)], "name": name,
        "hovertemplate": f"%{{customdata[0]}}<br>{title}: %{{customdata[1]:.6~g}}<extra>{name}</extra>",
        "showlegend": False,
    }  # fmt: skip


def _span(patch: Any, panel: Panel) -> dict[str, Any]:
    """Return a rectangle across the panel, or in it, as an area without hover."""
    if type(patch).__name__ != "Rectangle":
        raise Untranslated
    corners = patch.get_path().vertices
    corners = panel.axes.transData.inverted().transform(patch.get_transform().transform(corners))
    face, edge = patch.get_facecolor(), patch.get_edgecolor()
    return {
        "type": "scatter", "x": short(corners[:, 0]), "y": short(corners[:, 1]), "mode": "lines", "fill": "toself",
        "fillcolor": colour(face), "line": {"color": colour(edge), "width": PIXELS * patch.get_linewidth()},
        "name": _name(patch), "showlegend": False, "hoverinfo": "skip",
    }  # fmt: skip
