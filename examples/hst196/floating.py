"""The HST 196 transmission with floating films: how much of the measured loss do its films explain?

    python examples/hst196/floating.py [--rigid | --isothermal] [MEASURED.csv] [--picture FILE.png]

The transmission of `band.py`, every value that is not given in the middle of its range, but films and clearances: these
float by the balance of forces in oil of 60 degC, heat themselves, and open as the walls yield; --isothermal: no heat;
--rigid: rigid walls, oil of one viscosity. A flat valve plate bears no film of this block (it lies on its asperities),
so the plate has the waviness of REF90, an assumption. The losses of both machines add up: each is a share of the pump's
ideal flow.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path

import band
from matplotlib.figure import Figure

from gaps import Effect, Physics
from system import (
    RIGID,
    FloatingOptions,
    OperatingPoint,
    PumpDescription,
    PumpPoint,
    floating_point,
    load_pump,
    lumped_point,
    operating_point,
)

WAVINESS = {"waves": 3, "amplitude": "4 um"}
KEPT = ("pump.dead_volume", "oil.bulk_modulus")
"""Keys that machines with floating films take over from the band; their films and the heating of these are solved."""
STEPS = 72
FIRST_RATIO = 0.95
"""Motor over pump speed at which the motor is solved."""
SWASH = "swash plate's droop"
OIL = "oil's compression, ports"
Machine = Callable[[PumpDescription, OperatingPoint], PumpPoint]


@dataclass(frozen=True)
class Losses:
    """Shares of the pump's ideal flow by name, both machines together; they add up to 1 - `speed_ratio`."""

    speed_ratio: float
    shares: dict[str, float]

    @property
    def leakage(self) -> float:
        """Leakage of the six gaps."""
        return sum(share for name, share in self.shares.items() if name not in (SWASH, OIL))


def floating_pump() -> PumpDescription:
    """Return either machine: its films float, the rest that is not given is in the middle of its range."""
    keys = band.keys_of(band.middle(band.UNKNOWNS), "pump")
    return load_pump(band.PUMP, {key: keys[key] for key in KEPT} | {"valve_plate.waviness": WAVINESS})


def given_pump() -> PumpDescription:
    """Return either machine with films of given thickness, all that is not given in the middle of its range."""
    return load_pump(band.PUMP, band.keys_of(band.middle(band.UNKNOWNS), "pump"))


def losses(pump: PumpDescription, solved: Machine) -> Losses:
    """Return the losses of two machines `pump`, whose points `solved` finds.

    The motor is solved at FIRST_RATIO; its speed follows from the flow that it takes there, proportional to it but for
    leakage, which hardly depends on it: films given, 94.26 % in place of the 94.25 % of `band.efficiency`.
    """
    droop = band.middle(band.NOT_GIVEN)["swash droop at 35 MPa"] * band.LOAD
    point = operating_point(pump, displacement_ratio=1.0 - droop)
    driving = solved(pump, point)
    turned = replace(
        point, delivery_pressure=point.inlet_pressure, inlet_pressure=point.delivery_pressure, displacement_ratio=1.0
    )
    tried = solved(pump, replace(turned, shaft_speed=FIRST_RATIO * point.shaft_speed))
    speed = tried.point.shaft_speed * driving.bench.delivery_flow / tried.bench.inlet_flow
    return _split(driving, tried, speed)


def floating_losses(physics: Physics) -> Losses:
    """Return the losses with floating films of this physics. Raises FilmNotConverged where a film does not settle."""
    options = FloatingOptions(physics, steps=STEPS)
    return losses(floating_pump(), lambda pump, point: floating_point(pump, point, options).pump_point)


def _physics(arguments: list[str]) -> Physics:
    if "--rigid" in arguments:
        return RIGID
    return Physics().without(Effect.HEAT) if "--isothermal" in arguments else Physics()


def _split(driving: PumpPoint, motor: PumpPoint, speed: float) -> Losses:
    """Return the shares of the pump's ideal flow that both machines lose."""
    full = motor.geometric_displacement
    ideal = full * driving.point.shaft_speed / (2.0 * pi)
    swept = driving.geometric_displacement * driving.point.shaft_speed / (2.0 * pi)
    ratio = speed / driving.point.shaft_speed
    shares = {SWASH: 1.0 - swept / ideal}
    for name, machine in (("pump", driving), ("motor", motor)):
        leaks = machine.leakage_flow
        shares |= {
            f"{name}, pistons": leaks.piston / ideal,
            f"{name}, slippers": leaks.slipper / ideal,
            f"{name}, valve plate": leaks.valve_plate / ideal,
        }
    shares[OIL] = 1.0 - ratio - sum(shares.values())
    return Losses(ratio, shares)


def main(arguments: list[str]) -> None:
    """Print the losses with films of given thickness and with floating ones, and what the measurement leaves.

    They are drawn where a picture is named.
    """
    picture = arguments[-1] if "--picture" in arguments else ""
    arguments = arguments[:-2] if picture else arguments
    given, found = losses(given_pump(), lumped_point), floating_losses(_physics(arguments))
    print(f"{'% of the ideal flow':28s}{'films given':>12s}{'floating':>10s}")
    for name, share in found.shares.items():
        print(f"{name:28s}{given.shares[name]:12.2%}{share:10.2%}")
    print(f"{'motor over pump speed':28s}{given.speed_ratio:12.2%}{found.speed_ratio:10.2%}")
    for file in (word for word in arguments if not word.startswith("--")):
        measured = float(band.measured(Path(file)).mean())
        left = found.speed_ratio - measured
        beside = given.speed_ratio - measured
        print(f"measured {measured:.2%}; left by films given {beside:.2%}, by floating ones {left:.2%}")
        print(f"to meet it, floating films would have to leak {1.0 + left / found.leakage:.1f} times as much")

    if picture:
        draw({"films given": given, "floating films": found}, picture)


def draw(of: Mapping[str, Losses], picture: str) -> None:
    """Draw the losses side by side, each as a share of the pump's ideal flow."""
    figure = Figure(figsize=(8.0, 4.0), layout="constrained")
    axes = figure.subplots()
    names = list(next(iter(of.values())).shares)[::-1]
    for number, (name, own) in enumerate(of.items()):
        places = [place + 0.4 * (0.5 - number) for place in range(len(names))]
        axes.barh(places, [100.0 * own.shares[one] for one in names], height=0.38, label=name)
    axes.set(xlabel="loss [% of the ideal flow]", yticks=range(len(names)), yticklabels=names)
    axes.legend()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1:])
