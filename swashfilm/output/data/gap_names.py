"""Names of a gap's pictures, files and limits."""

from collections.abc import Sequence

FIELDS = "fields"


TITLES = {"piston": "piston-cylinder", "slipper": "slipper-swash plate", "valve_plate": "valve plate-cylinder"}


LARGEST_RIGID_PRESSURE = 100e6
"""Pa. At it the viscosity of mineral oil is several times its low value, and steel deforms by micrometres."""


def kind_folder(chambers: Sequence[int]) -> str:
    """Return the folder of the gaps of chambers (from 0) of a less common kind: its first chamber's number."""
    return f"chamber_{chambers[0] + 1}"


def vtu_name(gap: str, k: int) -> str:
    """Return the file name of a gap's film at its k-th angle."""
    return f"{gap}_{k:03d}.vtu"
