"""The fidelity proof: the plant is the film simulation, the diagnosis has the lumped one.

    python benchmarks/proof_films.py                      diagnoses every plant, a table of what came out
    python benchmarks/proof_films.py --film-tables        the same with elastic walls as the film solver has them
    python benchmarks/proof_films.py --plant NAME         only this one
    python benchmarks/proof_films.py --write NAME FOLDER  writes its recording, for `swashfilm diagnose`
    python benchmarks/proof_films.py --make NAME          solves the plant's films anew, half a minute to one

A diagnosis takes 10 to 70 s of process time.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from time import process_time

ROOT = Path(__file__).resolve().parents[1]
HEAD = ("plant", "said", "status", "size", "held out: before / after, of the noise", "chi2", "s")


def main() -> int:
    """Do what the command line asks."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from proof.film_plant import cases, make

    plants = {plant.case.value: plant for plant in cases()}
    if options.make:
        make(plants[options.make])
    elif options.write:
        name, folder = options.write
        _write(plants[name], Path(folder), options.seed)
    else:
        chosen = [plants[options.plant]] if options.plant else list(plants.values())
        print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|", flush=True)
        for plant in chosen:
            print("| " + " | ".join(_diagnosed(plant, options.seed, options.film_tables)) + " |", flush=True)
    return 0


def _options() -> argparse.Namespace:
    names = ("rigid", "viscosity_pressure", "elastic_slipper")
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--plant", choices=names, help="only this plant")
    reader.add_argument("--film-tables", action="store_true", help="elastic walls by the film solver's tables")
    reader.add_argument("--seed", type=int, default=3, help="of calibrations and noise (3)")
    reader.add_argument("--write", nargs=2, metavar=("NAME", "FOLDER"), help="write one recording")
    reader.add_argument("--make", choices=names, help="solve a plant anew")
    return reader.parse_args()


def _write(plant, folder: Path, seed: int) -> None:
    from proof.film_plant import readings
    from proof.writing import write_recording

    folder.mkdir(parents=True, exist_ok=True)
    campaign, read = readings(plant, seed)
    write_recording(folder, f"film plant {plant.case.value}", read, campaign.circuit)


def _diagnosed(plant, seed: int, film_tables: bool) -> tuple[str, ...]:
    """A row of the table."""
    from diagnosis.scant_pump import load_known_pump
    from swashfilm.diagnose_run import checked_recording, run_diagnosis
    from system.physics.catalogue import CATALOGUE, with_films_solved

    known, begun = load_known_pump("ref90"), process_time()
    with tempfile.TemporaryDirectory() as folder:
        _write(plant, Path(folder), seed)
        catalogue = with_films_solved(known.pump) if film_tables else CATALOGUE
        recording = checked_recording(Path(folder), known)
        found = run_diagnosis(known, recording, Path(folder), lambda *told: None, catalogue=catalogue)
    said = ", ".join(
        f"{one.effect.value} ({one.pair.value})" if one.pair else one.effect.value for one in found.effects
    )
    sizes = "; ".join(
        f"{size.name} {size.value:.3g} +- {size.sigma:.2g}" for one in found.effects for size in one.parameters
    )
    fit = found.fit
    ratios = ", ".join(
        f"{name.value} {fit.before[name] / fit.noise[name]:.2f} / {fit.after[name] / fit.noise[name]:.2f}"
        for name in fit.before
    )
    chi2 = " / ".join(f"{one.objective / one.residual.size:.2f}" for one in (found.before, found.after))
    spent = f"{process_time() - begun:.0f}"
    return plant.case.value, said or found.kind.value, found.status.value, sizes, ratios, chi2, spent


if __name__ == "__main__":
    sys.exit(main())
