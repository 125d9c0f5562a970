"""Switches of the command line for the physics of floating gaps; each sets a key of a case."""

from __future__ import annotations

import argparse
from collections.abc import Collection

SWITCHES = {
    "--rigid": ({"walls": "rigid", "oil": "isoviscous"}, "rigid walls, and viscosity independent of pressure"),
    "--isoviscous": ({"oil": "isoviscous"}, "viscosity independent of pressure"),
    "--isothermal": ({"heat": "none"}, "films and parts at the temperature of the case"),
    "--smooth": ({"surfaces": "smooth"}, "smooth walls without contact of asperities"),
    "--no-cavitation": ({"cavitation": "none"}, "films without cavitation"),
}
"""Keys of `swashfilm.case.gap.physics` with their values, and the meaning, by switch.

Rigid walls also switch off the law of viscosity over pressure: under a rigid edge the viscosity would have no bound.
"""


def add_switches(command: argparse.ArgumentParser) -> None:
    """Add the switches to a command."""
    for switch, (_, what) in SWITCHES.items():
        command.add_argument(switch, action="store_true", help=f"floating gaps: {what}")


def add_floating_options(command: argparse.ArgumentParser) -> None:
    """Add angles, cells and switches of floating gaps to a command."""
    what = "floating gaps: angles per turn, a multiple of the pistons (about 360)"
    command.add_argument("--steps", metavar="N", help=what)
    command.add_argument("--finer", metavar="X", help="floating gaps: factor on the cells each way (.5)")
    add_switches(command)


def switched_keys(options: argparse.Namespace) -> dict[str, str]:
    """Return the keys of `physics.SwitchesSection` that the command line sets, such as `walls` to "rigid".

    Each switches an effect off.
    """
    on = {switch for switch in SWITCHES if getattr(options, switch[2:].replace("-", "_"))}
    return {key: value for switch, (keys, _) in SWITCHES.items() if switch in on for key, value in keys.items()}


def switches_of(stated: Collection[str]) -> list[str]:
    """Return the switches that set these keys; one that sets all keys of another replaces both."""
    found = {switch: set(keys) for switch, (keys, _) in SWITCHES.items() if set(keys) <= set(stated)}
    return [switch for switch, keys in found.items() if not any(keys < more for more in found.values())]
