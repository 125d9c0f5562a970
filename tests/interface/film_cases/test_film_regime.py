"""Warnings of films that Reynolds' equation does not describe: turbulent, or with inertia; thick under pressure."""

import pytest

import swashfilm as sf

PAD = """
format = 1
[film]
mesh = { kind = "rectangle", size = ["50 mm", "50 mm"], cells = [16, 2], periodic = "y" }
thickness = "THICKNESS*(2 - x/0.05)"
velocity = ["SPEED m/s", "0 m/s"]
viscosity = "3 mPa s"
[boundary]
left = { pressure = "DROP bar" }
right = { pressure = "0 bar" }
"""
WARM = """
[oil]
density = "860 kg/m3"
temperature = "40 degC"
specific_heat = "1950 J/(kg K)"
thermal_conductivity = "0.13 W/(m K)"
temperature_coefficient = "0.03 1/K"
LAW
[thermal]
fixed_wall = { temperature = "40 degC" }
moving_wall = { temperature = "40 degC" }
"""
ROELANDS = 'pressure_law = "roelands"\npressure_viscosity_coefficient = "20 1/GPa"'


def _names(thickness: float, speed: float = 0.0, drop: float = 0.0, tables: str = "") -> set[str]:
    """Names of the warnings of a pad: least film m, speed m/s, pressure at its inlet bar."""
    text = PAD.replace("THICKNESS", str(thickness)).replace("SPEED", str(speed)).replace("DROP", str(drop))
    return {one["name"] for one in sf.film(text + tables).summary["warnings"]}


@pytest.mark.parametrize(
    ("film", "told"),
    [
        (dict(thickness=20e-6, speed=1.0), set()),  # Reynolds number rho U h/mu 12
        (dict(thickness=20e-6, speed=100.0), {"film_turbulent"}),  # up to 1160, times h/L 0.5
        (dict(thickness=200e-6, speed=5.0), {"film_has_inertia"}),  # 580, times h/L
        (dict(thickness=100e-6, drop=20.0), {"film_has_inertia"}),  # driven by pressure: rho q/mu 860
        (dict(thickness=200e-6, drop=20.0), {"film_turbulent", "film_has_inertia"}),
    ],
)
def test_a_film_beyond_laminar_flow_is_told(film, told):
    assert _names(**film) & {"film_turbulent", "film_has_inertia"} == told


@pytest.mark.parametrize(("law", "told"), [("", True), (ROELANDS, False)])
def test_a_warm_film_of_constant_viscosity_under_pressure_is_told(law, told):
    found = _names(20e-6, drop=800.0, tables=WARM.replace("LAW", law))
    assert ("viscosity_without_pressure" in found) is told
