"""Fidelity of a pump's films."""

from enum import Enum


class Fidelity(Enum):
    """Films of given thickness (lumped), solved at given positions (films), found by balance of forces (floating),
    or as a table of solved points has learnt them (table).
    """

    LUMPED = "lumped"
    FILMS = "films"
    FLOATING = "floating"
    TABLE = "table"
