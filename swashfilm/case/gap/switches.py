"""Switches of the command line for the physics of floating gaps; each sets a key of a case."""

from __future__ import annotations

import argparse

SWITCHES = {
    "--rigid": ("walls", "rigid", "rigid walls"),
    "--isoviscous": ("oil", "isoviscous", "viscosity independent of pressure"),
    "--smooth": ("surfaces", "smooth", "smooth walls without contact of asperities"),
    "--no-cavitation": ("cavitation", "none", "films without cavitation"),
    "--heat": ("heat", "solved", "solved temperature of films and parts"),
}
"""Key of `swashfilm.case.gap.physics`, its value, and its meaning, by switch."""


def add_switches(command: argparse.ArgumentParser) -> None:
    """Add the switches to a command."""
    for switch, (*_, what) in SWITCHES.items():
        command.add_argument(switch, action="store_true", help=f"floating gaps: {what}")


def switched_keys(options: argparse.Namespace) -> dict[str, str]:
    """Return the keys of `physics.SwitchesSection` that the command line sets, such as `walls` to "rigid"."""
    on = {switch for switch in SWITCHES if getattr(options, switch[2:].replace("-", "_"))}
    return {key: value for switch, (key, value, _) in SWITCHES.items() if switch in on}


def switch_of(key: str) -> str:
    """Return the switch of a key."""
    return next(switch for switch, (own, *_) in SWITCHES.items() if own == key)
