"""Tolerances of a pump that its file states."""

from dataclasses import dataclass
from typing import Annotated

from system.inputs.sections.fields import Positive, Spread
from system.inputs.units import Dimension


@dataclass(frozen=True, kw_only=True)
class ToleranceSection:
    """[tolerance]: one sigma of what is uncertain, relative but where said; `system.description.tolerances` takes
    the rest.
    """

    film_thickness: Spread | None = None
    eccentricity_ratio: Spread | None = None  # absolute
    bulk_modulus: Spread | None = None
    viscosity: Spread | None = None
    viscosity_slope: Annotated[float, Dimension.TEMPERATURE_COEFFICIENT, Positive] | None = None  # of its logarithm
    friction: Spread | None = None
    guide_friction: Spread | None = None  # ball guide and retainer
    bearing_friction: Spread | None = None
    displacement: Spread | None = None
    dead_volume: Spread | None = None
    flow_coefficient: Spread | None = None
    stand_out_share: Spread | None = None  # absolute
    inlet_share: Spread | None = None  # absolute; of the inlet's temperature in that of the films
