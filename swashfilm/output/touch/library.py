"""Parts that a page with interactive figures embeds once: plotly.js, packed, the script that draws, and its styles."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from swashfilm.output.touch.packing import packed


@cache
def embedded() -> str:
    """Return the HTML at the end of a page; works from a file, without any network."""
    from plotly.offline import get_plotlyjs

    style, script = ((files(__package__) / name).read_text("utf-8") for name in ("touch.css", "touch.js"))
    library = f'<script type="text/plain" id="plotly">{packed(get_plotlyjs())}</script>'
    return f"<style>\n{style}</style>\n{library}\n<script>\n{script}</script>\n"
