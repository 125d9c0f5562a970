"""How the films of a pump are had."""

from enum import Enum


class Fidelity(Enum):
    """Films of given thickness (lumped), or solved over the revolution (films)."""

    LUMPED = "lumped"
    FILMS = "films"
