"""Parts of the film physics that have no law of their own: only solved films have them."""

from system.effects.catalogue.films import FILM_CHANNELS, FRICTION, LEAKAGE
from system.effects.effect import EffectId, Kind
from system.effects.extension import Entry

E = EffectId
SOLVED_ENTRIES = (
    Entry(
        E.FILM_RUPTURE, Kind.MISSING_PHYSICS, (), (*LEAKAGE, *FRICTION), FILM_CHANNELS,
        "high speed and low pressure", (E.MIXED_FRICTION, E.SHEAR_THINNING),
        "films rupture where their pressure falls to that of a cavity, and carry less there",
        "Jakobsson, Floberg 1957; Olsson 1965",
    ),
    Entry(
        E.WORN_PROFILE, Kind.MISSING_PHYSICS, (), (*LEAKAGE, *FRICTION), FILM_CHANNELS,
        "every speed, by the profile", (E.FILM_THICKNESS, E.ELASTIC_OPENING),
        "the walls of the films have another shape: worn or run in", "profilometer traces of the parts",
    ),
)  # fmt: skip
