"""Cases of single films, drawn at random: free films with every switch of the physics, and gaps of ref90."""

from __future__ import annotations

from typing import Any

from .draw import Draw

GRADES = [f"ISO VG {grade}" for grade in (10, 15, 22, 32, 46, 68, 100, 150)]
Tables = dict[str, Any]


def film_case(number: int) -> Tables:
    """Return the tables of a film case."""
    draw = Draw("film", number)
    return _gap(draw) if draw.chance(0.2) else _free(draw)


def _gap(draw: Draw) -> Tables:
    """A gap of ref90 at a given position, under given chamber pressure, at any shaft angle."""
    gap = draw.one_of(["piston", "slipper", "valve_plate"])
    film: Tables = {"gap": gap, "pump": "ref90", "shaft_angle": f"{draw.even(0, 360)} deg"}
    position: Tables = {"eccentricity_ratio": draw.even(0.0, 0.95)}
    if gap != "piston":
        thickness = draw.wide(2.0, 40.0)
        steepest = 0.8 * thickness * 1e-6 / (0.0148 if gap == "slipper" else 0.0535)
        position = {
            "film_thickness": f"{thickness} um",
            "slope_x": f"{draw.even(-0.7, 0.7) * steepest:.4g} rad",
            "slope_y": f"{draw.even(-0.7, 0.7) * steepest:.4g} rad",
        }
    point = {
        "speed": f"{draw.wide(50, 4000)} rpm",
        "pressure": f"{draw.wide(30, 450)} bar",
        "displacement_ratio": draw.even(0.05, 1.0),
        "temperature": f"{draw.even(10, 100)} degC",
    }
    switches = {
        "walls": draw.one_of(["rigid", "elastic"]),
        "oil": draw.one_of(["isoviscous", "pressure_viscosity"]),
        "surfaces": draw.one_of(["rough", "smooth"]),
    }
    if gap == "valve_plate":
        switches["walls"] = "rigid"  # between elastic bodies this one takes minutes of processor time
    if switches["walls"] == "rigid":
        switches["oil"] = "isoviscous"
    return {"format": 1, "film": film, "operating": point, "position": position, "physics": switches}


def _free(draw: Draw) -> Tables:
    """A plane film with some of: roughness, contact, elastic walls, heat, laws of the oil, load, time."""
    round_film = draw.chance(0.3)
    size = draw.wide(2.0, 50.0)
    film, names = _annulus(draw, size) if round_film else _rectangle(draw, size)
    thermal, in_time, loaded = draw.chance(0.2), draw.chance(0.12), draw.chance(0.12)
    film["thickness"] = _thickness(draw, size * 1e-3, in_time)
    film["velocity"] = _velocity(draw, round_film, size * 1e-3)
    film["cavitation"] = draw.one_of(["jfo", "jfo", "jfo", "reynolds", "none"])
    level = draw.one_of([0.0, 0.0, -0.8])
    film["cavitation_pressure"] = f"{level} bar"
    if not in_time and draw.chance(0.25):
        film["squeeze"] = f"{draw.sign() * draw.wide(1e-6, 1e-2)} m/s"
    if loaded and not in_time:
        film["load"] = f"{draw.wide(1.0, 3000.0)} N"
    case: Tables = {"format": 1, "film": film, "boundary": _boundary(draw, names)}
    _oil(draw, case, thermal)
    _walls(draw, case)
    if film["cavitation"] == "none" and not thermal and "roughness" not in case and draw.chance(0.5):
        film["order"] = 2
    if thermal:
        case["thermal"] = _thermal(draw)
    if in_time:
        end = draw.wide(1e-4, 1e-1)
        case["time"] = {"end": f"{end} s", "step": f"{end / draw.whole(8, 25):.4g} s", "outputs": 2}
    return case


def _rectangle(draw: Draw, size: float) -> tuple[Tables, list[str]]:
    other = size * draw.wide(0.2, 5.0)
    mesh: Tables = {
        "kind": "rectangle",
        "size": [f"{size} mm", f"{other:.4g} mm"],
        "cells": [draw.whole(4, 40), draw.whole(3, 24)],
        "cell": draw.one_of(["triangle", "quadrilateral"]),
    }
    names = ["left", "right", "bottom", "top"]
    if draw.chance(0.3):
        mesh["periodic"] = draw.one_of(["x", "y"])
        names = names[2:] if mesh["periodic"] == "x" else names[:2]
    return {"mesh": mesh}, names


def _annulus(draw: Draw, size: float) -> tuple[Tables, list[str]]:
    mesh = {
        "kind": "annulus",
        "inner_radius": f"{size * draw.even(0.2, 0.9):.4g} mm",
        "outer_radius": f"{size} mm",
        "cells": [draw.whole(3, 16), draw.whole(12, 72)],
        "cell": draw.one_of(["triangle", "quadrilateral"]),
    }
    return {"mesh": mesh}, ["inner", "outer"]


def _thickness(draw: Draw, size: float, in_time: bool) -> str:
    """A film tilted, wavy and stepped; in time it also breathes."""
    least, tilt, wave = draw.wide(0.5, 50.0), draw.even(0.0, 2.0), draw.even(0.0, 0.9)
    shape = f"1 + {tilt}*abs(x - {draw.sign() * size})/{size} + {wave}*cos({draw.whole(1, 4)}*pi*x/{size})"
    shape += f"*cos({draw.whole(0, 3)}*pi*y/{size} + {draw.even(0, 3)})"
    if draw.chance(0.3):
        shape += f" + where(x > {draw.even(-0.5, 0.8) * size:.3g}, {draw.wide(0.2, 30.0)}, 0)"
    if in_time:
        shape += f" + {draw.even(0.0, 0.09)}*sin({draw.wide(30, 3000)}*t)"
    return f"{least}e-6*({shape})"


def _velocity(draw: Draw, round_film: bool, size: float) -> list[str]:
    speed = draw.sign() * draw.wide(0.01, 30.0) if draw.chance(0.85) else 0.0
    if round_film and draw.chance(0.7):
        return [f"{-speed / size:.4g}*y", f"{speed / size:.4g}*x"]
    return [f"{speed} m/s", f"{speed * draw.even(-0.5, 0.5):.3g} m/s"]


def _boundary(draw: Draw, names: list[str]) -> Tables:
    kept = [name for name in names if draw.chance(0.8)] or names[:1]
    found = {}
    for name in kept:
        pressure = draw.wide(0.1, 400.0) if draw.chance(0.4) else 0.0
        found[name] = {"pressure": f"{pressure} bar"}
    return found


def _oil(draw: Draw, case: Tables, thermal: bool) -> None:
    oil: Tables = {}
    if thermal or draw.chance(0.5):
        oil |= {"grade": draw.one_of(GRADES), "density": "860 kg/m3", "temperature": f"{draw.even(10, 90)} degC"}
    else:
        case["film"]["viscosity"] = f"{draw.wide(2, 500)} mPa s"
    if thermal:
        oil |= {"specific_heat": "1950 J/(kg K)", "thermal_conductivity": "0.13 W/(m K)"}
    if draw.chance(0.3):
        oil |= {"pressure_law": "roelands", "pressure_viscosity_coefficient": f"{draw.even(10, 25)} 1/GPa"}
    if draw.chance(0.15):
        oil |= {"density_law": "bulk_modulus", "bulk_modulus": f"{draw.even(0.8, 2.0)} GPa"}
    if draw.chance(0.15):
        oil |= {"shear_law": "eyring", "eyring_stress": f"{draw.wide(1, 20)} MPa"}
    if oil:
        case["oil"] = oil


def _walls(draw: Draw, case: Tables) -> None:
    if draw.chance(0.2):
        case["elastic"] = {"winkler": f"{draw.wide(1e12, 1e15)} Pa/m"}
    if not draw.chance(0.25):
        return
    case["roughness"] = {"moving": f"{draw.wide(0.05, 1.0)} um", "fixed": f"{draw.wide(0.05, 1.0)} um"}
    if draw.chance(0.3):
        case["roughness"] |= {"peklenik": draw.wide(0.2, 6.0), "lay_angle": f"{draw.even(0, 90)} deg"}
    if draw.chance(0.5):
        case["contact"] = {
            "asperity_density": "2e10 1/m2",
            "asperity_radius": "5 um",
            "composite_modulus": f"{draw.wide(10, 200)} GPa",
            "friction_coefficient": draw.even(0.02, 0.2),
        }


def _thermal(draw: Draw) -> Tables:
    """At least one wall absorbs heat."""
    held: Tables = {"temperature": f"{draw.even(20, 80)} degC"}
    cooled = {"heat_transfer_coefficient": f"{draw.wide(100, 1e4)} W/(m2 K)", "outer_temperature": "40 degC"}
    return {
        "fixed_wall": draw.one_of([held, cooled]),
        "moving_wall": draw.one_of(["adiabatic", "turning", held, cooled]),
        "inlet_temperature": f"{draw.even(10, 90)} degC",
        "levels": draw.whole(3, 8),
    }
