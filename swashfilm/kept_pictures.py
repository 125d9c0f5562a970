"""Pictures of a run: kept as numbered files in its folder, and made ready to stand in its page."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path


def keep_pictures(folder: Path, stem: str, pictures: Mapping[str, bytes]) -> dict[str, str]:
    """Write PNG pictures as plots/STEM-1.png on; return them by caption, base64 as a page holds them."""
    (folder / "plots").mkdir(exist_ok=True)
    for number, png in enumerate(pictures.values(), start=1):
        (folder / "plots" / f"{stem}-{number}.png").write_bytes(png)
    return {caption: base64.b64encode(png).decode("ascii") for caption, png in pictures.items()}
