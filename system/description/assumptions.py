"""Values assumed where a pump file leaves a key out, each with its name and reason."""

from dataclasses import dataclass

from system.inputs.units import Dimension, format_quantity


@dataclass(frozen=True)
class Assumption:
    """An assumed value of a key that the pump file leaves out: path, value as people read it, and the reason."""

    path: str
    value: str
    reason: str

    def __str__(self) -> str:
        return f"{self.path}: taken {self.value} ({self.reason})"


class Taken:
    """Collects assumed values."""

    def __init__(self) -> None:
        self.assumptions: list[Assumption] = []

    def value(
        self, path: str, stated: float | None, usual: float, reason: str, dimension: Dimension | None = None
    ) -> float:
        """The stated value, or the usual one, noted with its reason."""
        if stated is not None:
            return stated
        shown = f"{usual:.4g}" if dimension is None else format_quantity(usual, dimension, digits=4)
        self.note(path, shown, reason)
        return usual

    def note(self, path: str, value: str, reason: str) -> None:
        """Note the assumed value of a path, as people read it."""
        self.assumptions.append(Assumption(path, value, reason))
