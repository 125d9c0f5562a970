"""Draw the gallery: run its examples, shrink one picture of each result, write docs/gallery.md.

    python docs/site/gallery.py [NAME ..]

With names, only these examples are run; the others keep their pictures.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import matplotlib
from PIL import Image

import swashfilm as sf
from swashfilm.output.figures import png_of

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PICTURES = DOCS / "gallery"
WIDTH, COLOURS, ACROSS = 420, 64, 3


@dataclass(frozen=True)
class Example:
    """A command, and the picture that stands for its result.

    picture: a file of the run folder, or a method of the result that draws; part: left, top, right, bottom as shares of
    the picture.
    """

    name: str
    title: str
    command: str
    picture: str
    part: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)


BENCH = "examples/recordings/bench_pump.toml"
EXAMPLES = (
    Example("journal", "Journal bearing with a cavity", "film examples/films/journal_bearing.toml", "plot_fields"),
    Example("stribeck", "Stribeck curve of rough walls", "film examples/films/stribeck_study.toml", "plot_stribeck"),
    Example("squeeze", "Film that ruptures in time", "film examples/films/oscillating_squeeze.toml", "plot_fields"),
    Example("plate", "Elastic plate under its film", "film examples/films/bending_plate.toml", "plot_fields"),
    Example("warm", "Film that warms along its way", "film examples/films/warm_slider.toml", "plot_fields"),
    Example("slipper", "Slipper of a pump", "film examples/films/ref90_slipper.toml", "plot_fields"),
    Example("valve-plate", "Valve plate, block tilted", "film examples/films/ref90_valve_plate.toml", "plot_fields"),
    Example("pump", "Pump with its films", "run ref90", "pump.png", (0.22, 0.0, 1.0, 1.0)),
    Example("powers", "Where the shaft power goes", "run ref90", "plot_powers"),
    Example("losses", "Losses of the friction pairs", "run ref90", "plot_losses"),
    Example("chamber", "Chamber pressure over a turn", "run ref90 --fidelity lumped", "plot_chamber"),
    Example("map", "Loss map", "map ref90 --fidelity lumped", "plot_losses"),
    Example("destroke", "Swash plate that swings back", "transient examples/transients/destroke.toml", "plot_plate"),
    Example("orifice", "Flow of a slipper bore", "reference examples/references/slipper_orifice.toml", "flow_1.png"),
    Example("diagnose", "Cause of a mismatch", f"diagnose {BENCH} examples/recordings/open-06", "plot_effect"),
    Example("calibrate", "Friction coefficients", f"calibrate {BENCH} examples/recordings/open-01", "plot_friction"),
    Example("reproduce", "Published statements beside our numbers", "reproduce all --fidelity lumped", "plot_verdicts"),
)


def main(names: list[str]) -> int:
    """Write docs/gallery.md and the pictures of the named examples, or of all."""
    PICTURES.mkdir(exist_ok=True)
    for example in EXAMPLES:
        if not names or example.name in names:
            draw(example)
    (DOCS / "gallery.md").write_text(page(), encoding="utf-8")
    return 0


def draw(example: Example) -> None:
    """Run an example and leave its thumbnail in docs/gallery."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "run"
        command = [sys.executable, "-m", "swashfilm", *example.command.split(), "-o", str(folder)]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        whole = Image.open(io.BytesIO(picture(folder, example.picture))).convert("RGB")
    (wide, tall), (left, top, right, bottom) = whole.size, example.part
    shown = whole.crop((round(left * wide), round(top * tall), round(right * wide), round(bottom * tall)))
    shown.thumbnail((WIDTH, WIDTH))
    shown.quantize(COLOURS).save(PICTURES / f"{example.name}.png", optimize=True)


def picture(folder: Path, name: str) -> bytes:
    """Return a picture of a run folder as PNG: its file of that name, or what that method of its result draws."""
    if (file := folder / name).suffix:
        return file.read_bytes()
    axes = getattr(sf.open(folder), name)()
    return png_of(axes[0].figure)


def page() -> str:
    """The gallery as Markdown: a table of pictures, each with its title and command."""
    lines = [
        "# Gallery",
        "",
        "Each picture shows the result of the command beneath it. "
        "`make gallery` runs all of them and writes this page.",
        "",
        "| " + " | ".join(" " for _ in range(ACROSS)) + " |",
        "|" + "---|" * ACROSS,
    ]
    for start in range(0, len(EXAMPLES), ACROSS):
        row = EXAMPLES[start : start + ACROSS]
        lines.append("| " + " | ".join(f"![{one.title}](gallery/{one.name}.png)" for one in row) + " |")
        lines.append("| " + " | ".join(f"**{one.title}** `swashfilm {one.command}`" for one in row) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
