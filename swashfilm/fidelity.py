"""How the films of a pump are had."""

from enum import Enum


class Fidelity(Enum):
    """Films of given thickness (lumped), solved over the revolution (films), or as a table of solved points has
    learnt them (table).
    """

    LUMPED = "lumped"
    FILMS = "films"
    TABLE = "table"
