"""The command line's switches of the physics of floating gaps, each a key that a case has too."""

from __future__ import annotations

import argparse

SWITCHES = {
    "--rigid": ("walls", "rigid", "walls that do not give way"),
    "--isoviscous": ("oil", "isoviscous", "oil that pressure does not stiffen"),
    "--smooth": ("surfaces", "smooth", "smooth walls, which never touch"),
    "--no-cavitation": ("cavitation", "none", "films that do not cavitate"),
    "--heat": ("heat", "solved", "films and parts that warm"),
}
"""Key of `swashfilm.case.gap.physics`, its value, and what that means, by switch."""


def add_switches(command: argparse.ArgumentParser) -> None:
    """Give a command the switches."""
    for switch, (*_, what) in SWITCHES.items():
        command.add_argument(switch, action="store_true", help=f"floating gaps: {what}")


def switched_keys(options: argparse.Namespace) -> dict[str, str]:
    """What the command line says of the keys that `physics_case.read_physics` reads: `walls` to "rigid"."""
    on = {switch for switch in SWITCHES if getattr(options, switch[2:].replace("-", "_"))}
    return {key: value for switch, (key, value, _) in SWITCHES.items() if switch in on}


def switch_of(key: str) -> str:
    """The switch that stands for a key."""
    return next(switch for switch, (own, *_) in SWITCHES.items() if own == key)
