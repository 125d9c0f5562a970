"""A case of the second or third plant: concealed causes, their score, and the right verdict."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from ..parts import Part

UNKNOWN = "unknown_physics"


class What(Enum):
    """Kind of a secret, and the verdict on it alone."""

    EFFECT = "missing_physics"
    FAULT = "sensor_fault"
    PART = "wrong_parameter"


@dataclass(frozen=True)
class Secret:
    """One concealed cause.

    label: of an effect its field of the plant's Hidden, of a fault "channel.error", of a part its field of the
    plant's pump; id, pair: by which a verdict is to name it, "" for physics in no catalogue; size: SI, at factor 1;
    most: the largest factor such a machine could have.
    """

    what: What
    label: str
    id: str
    pair: str | None
    size: float
    most: float


@dataclass(frozen=True)
class WideCase:
    """One recording; `score` 0: secrets at their own size. `seed`: of all that is drawn."""

    part: Part
    campaign: str
    seed: int
    secrets: tuple[Secret, ...] = ()
    score: float = 0.0

    @property
    def name(self) -> str:
        """Secrets, their score, plant and campaign: one line."""
        concealed = " + ".join(one.label for one in self.secrets) or "nothing"
        grade = f", z {self.score:g}" if self.score else ""
        return f"{concealed}{grade}, {self.part.plant.value}: {self.campaign}, seed {self.seed}"

    @property
    def truth(self) -> str:
        """The verdict that is right: physics before wrong parts before faults."""
        for what in (What.EFFECT, What.PART, What.FAULT):
            own = [one for one in self.secrets if one.what is what]
            if own:
                return UNKNOWN if all(one.id == "" for one in own) else what.value
        return "no_mismatch"

    @property
    def main(self) -> tuple[Secret, ...]:
        """Secrets that a right verdict names: all listed ones, without faults beside physics."""
        own = [one for one in self.secrets if one.id and one.what.value == self.truth]
        return tuple(own) if self.truth != UNKNOWN else ()

    @property
    def beside(self) -> tuple[str, ...]:
        """Ids of faults beside physics: a verdict may name them too."""
        faults = tuple(one.id for one in self.secrets if one.what is What.FAULT)
        return () if self.truth == What.FAULT.value else faults

    @property
    def definition(self) -> tuple[object, ...]:
        """The definition of the case, as plain values."""
        secrets = [(one.label, one.id, one.pair, one.size, one.most) for one in self.secrets]
        return self.part.value, self.campaign, self.seed, self.score, secrets
