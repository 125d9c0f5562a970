"""The [oil] table of a case file: a viscosity from an oil and its temperature."""

from __future__ import annotations

from reynolds.oil import ISO_GRADES, Oil, dynamic_viscosity
from swashfilm.case_table import Table
from swashfilm.fields import Uniform
from system.faults import nearest_choice
from system.units import Dimension

_KEYS = ("kinematic_viscosity_40C", "kinematic_viscosity_100C")


def read_oil(oil: Table) -> Uniform | None:
    """The dynamic viscosity (Pa s) of the table's oil by Walther's law and its density; None, faults told.

    The table holds `grade` or two kinematic viscosities, `density` and `temperature`.
    """
    density = oil.positive("density", Dimension.DENSITY)
    temperature = oil.positive("temperature", Dimension.TEMPERATURE)
    viscosities = _kinematic_viscosities(oil)
    oil.close()
    if viscosities is None or density is None or temperature is None:
        return None
    try:
        # A film at one temperature asks neither bulk modulus nor specific heat: ones stand for them.
        fluid = Oil(*viscosities, density, 1.0, 1.0)
        return Uniform(dynamic_viscosity(fluid, temperature), Dimension.DYNAMIC_VISCOSITY)
    except ValueError as reason:
        oil.fault("temperature", str(reason), "an oil and a temperature for which Walther's law holds")
        return None


def _kinematic_viscosities(oil: Table) -> tuple[float, float] | None:
    """Kinematic viscosities at 40 and 100 degC (m2/s); None with the fault told."""
    grade = oil.get("grade")
    if grade is None:
        at_40, at_100 = (oil.positive(key, Dimension.KINEMATIC_VISCOSITY) for key in _KEYS)
        return None if at_40 is None or at_100 is None else (at_40, at_100)
    if stated := [key for key in _KEYS if oil.get(key) is not None]:
        oil.fault("grade", f"grade beside {' and '.join(stated)}", "the grade or the two viscosities")
        return None
    if not isinstance(grade, str) or grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or {' and '.join(_KEYS)} in its place"
        oil.fault("grade", repr(grade), expected, nearest_choice(str(grade), ISO_GRADES))
        return None
    known = ISO_GRADES[grade]
    return known.kinematic_viscosity_40C, known.kinematic_viscosity_100C
