"""Fidelity of a pump's films."""

from enum import Enum


class Fidelity(Enum):
    """Films of given thickness (lumped), solved at given positions (fixed), at positions by balance of forces
    (floating), or by a response table (table).
    """

    LUMPED = "lumped"
    FIXED = "fixed"
    FLOATING = "floating"
    TABLE = "table"
