"""A file that the command writes: its place, its text, its schema for editors; nothing is overwritten."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from shlex import quote

from swashfilm.console.schemas import write_new
from system.inputs.faults import Fault, InputFaults


@dataclass(frozen=True)
class NewFile:
    """A file to write: its place, its kind of schema, its text without the schema line, and its message to the user."""

    path: Path
    kind: str
    text: str
    told: tuple[str, ...]

    def write(self) -> Path:
        """Write the file, and the schema of its kind beside it if absent, and return its path.

        Raises InputFaults for a folder that cannot be written to, and for a file that exists by now.
        """
        try:
            write_new(self.path, self.kind, self.text)
        except OSError as reason:
            fault = Fault("file", f"cannot be written: {reason}", "a folder that can be written to")
            raise InputFaults(str(self.path), [fault]) from None
        return self.path


def place_faults(path: Path, option: str) -> list[Fault]:
    """Return the fault of an invalid place for a new file."""
    if path.suffix.lower() != ".toml":
        return [Fault(option, f"'{path}'", "a name that ends in .toml", f"{path.stem}.toml")]
    if not path.parent.is_dir():
        return [Fault(option, f"'{path}'", f"a folder that exists, not '{path.parent}'")]
    if path.exists():
        numbered = (path.with_stem(f"{path.stem}-{k}") for k in range(2, 1000))
        free = next((str(one) for one in numbered if not one.exists()), "")
        near = free if option == "--output" or not free else f"-o {quote(free)}"
        return [Fault(option, f"'{path}', which exists", "a new file: none is overwritten", near)]
    return []
