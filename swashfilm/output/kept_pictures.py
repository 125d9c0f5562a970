"""Pictures of a run: kept as numbered files in its folder, and made ready to stand in its page."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from pathlib import Path

PLOTS = "plots"


def keep_pictures(folder: Path, stem: str, pictures: Mapping[str, bytes]) -> dict[str, str]:
    """Write PNG pictures as plots/STEM-1.png on and captions as plots/STEM.json; return `kept_pictures`."""
    (folder / PLOTS).mkdir(exist_ok=True)
    captions = {}
    for number, (caption, png) in enumerate(pictures.items(), start=1):
        name = f"{stem}-{number}.png"
        (folder / PLOTS / name).write_bytes(png)
        captions[name] = caption
    (folder / PLOTS / f"{stem}.json").write_text(json.dumps(captions, indent=2) + "\n", encoding="utf-8")
    return kept_pictures(folder, stem)


def kept_pictures(folder: Path, stem: str) -> dict[str, str]:
    """What `keep_pictures` wrote, by caption, base64 as a page holds it; raises OSError where it is not there."""
    captions = json.loads((folder / PLOTS / f"{stem}.json").read_text("utf-8"))
    return {
        caption: base64.b64encode((folder / PLOTS / name).read_bytes()).decode("ascii")
        for name, caption in captions.items()
    }
