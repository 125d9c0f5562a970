"""How the films of a pump are had."""

from enum import Enum


class Fidelity(Enum):
    """Films of given thickness (lumped), as a response table has learnt them (table), or solved over the
    revolution (films).
    """

    LUMPED = "lumped"
    TABLE = "table"
    FILMS = "films"
