"""The fidelity proof: the plant is the film simulation, the diagnosis has the lumped one.

    python benchmarks/proof_films.py                      diagnoses every plant, a table of what came out
    python benchmarks/proof_films.py --film-tables        the same with elastic walls as the film solver has them
    python benchmarks/proof_films.py --plant NAME         only this one
    python benchmarks/proof_films.py --write NAME FOLDER  writes its recording, for `swashfilm diagnose`
    python benchmarks/proof_films.py --make NAME          solves the plant's films anew, half a minute to ten

A diagnosis takes 10 to 70 s of process time.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Do what the command line asks."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from proof.film_plant import cases, make
    from proof.film_trial import HEAD, diagnosed, write_film_recording

    plants = {plant.case.value: plant for plant in cases()}
    if options.make:
        make(plants[options.make])
    elif options.write:
        name, folder = options.write
        write_film_recording(plants[name], Path(folder), options.seed)
    else:
        chosen = [plants[options.plant]] if options.plant else list(plants.values())
        print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|", flush=True)
        for plant in chosen:
            print("| " + " | ".join(diagnosed(plant, options.seed, options.film_tables)) + " |", flush=True)
    return 0


def _options() -> argparse.Namespace:
    names = ("rigid", "viscosity_pressure", "elastic_slipper", "warm", "elastic_and_warm")
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--plant", choices=names, help="only this plant")
    reader.add_argument("--film-tables", action="store_true", help="elastic walls by the film solver's tables")
    reader.add_argument("--seed", type=int, default=3, help="of calibrations and noise (3)")
    reader.add_argument("--write", nargs=2, metavar=("NAME", "FOLDER"), help="write one recording")
    reader.add_argument("--make", choices=names, help="solve a plant anew")
    return reader.parse_args()


if __name__ == "__main__":
    sys.exit(main())
