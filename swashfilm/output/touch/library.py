"""Parts that a page with interactive figures embeds once: plotly.js, packed, the script that draws, and its styles."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from swashfilm.output.touch.packing import packed

SCRIPTS = ("unpacked.js", "choices.js", "units.js", "theme.js", "touch.js")
"""Parts of the script, each of which uses those before it."""


@cache
def embedded() -> str:
    """Return the HTML at the end of a page; works from a file, without any network."""
    from plotly.offline import get_plotlyjs

    style, *parts = ((files(__package__) / "script" / name).read_text("utf-8") for name in ("touch.css", *SCRIPTS))
    script = f'"use strict";\n(() => {{\n{"".join(parts)}}})();\n'  # a scope of its own
    library = f'<script type="text/plain" id="plotly">{packed(get_plotlyjs())}</script>'
    return f"<style>\n{style}</style>\n{library}\n<script>\n{script}</script>\n"
