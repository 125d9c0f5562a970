"""Doors of the program: each kind of file with the command that reads it, and its mutations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random

from . import structures
from .mutations import BINARY, TEXT, Mutation, placed
from .samples import FOAM, MAP

GOOD = -1
"""Number of the case whose file is not mutated."""
TABLE_POINT = ("--speed", "1500rpm", "--pressure", "20MPa")


@dataclass(frozen=True)
class Door:
    """A file of a sample, and the command line that reads it in the sample's folder.

    kind: of the file, a row of the table; cases: number; every: one in so many has another object than a file in its
    place; whole: one in so many runs as a process of its own.
    """

    name: str
    kind: str
    sample: str
    file: str
    words: tuple[str, ...]
    mutations: tuple[Mutation, ...]
    cases: int
    every: int = 12
    whole: int = 0

    def mutate(self, path: Path, number: int, secret: Path) -> str:
        """Mutate the file in place; return how, in words. The same number gives the same file, GOOD leaves it."""
        if number == GOOD:
            return "nothing"
        draw = Random(f"{self.name} {number}")
        if number % self.every == self.every - 1:
            return placed(path, draw, secret)
        data, told = path.read_bytes(), []
        for _ in range(draw.choice((1, 1, 1, 2))):
            mutation = draw.choice(self.mutations)
            try:
                data = mutation(data, draw)
            except Exception:  # the first mutation has broken the structure that the second one reads
                continue
            told.append(mutation.__name__)
        path.write_bytes(data)
        return ", ".join(told) or "unchanged"


JSON: tuple[Mutation, ...] = (*[structures.json_value] * 12, *TEXT)
NPZ: tuple[Mutation, ...] = (*[structures.arrays] * 5, *BINARY)
HDF5: tuple[Mutation, ...] = (*[structures.variables] * 6, *BINARY)
XLSX: tuple[Mutation, ...] = (*[structures.book_part] * 7, *BINARY)


def doors() -> Iterator[Door]:
    """Yield all doors."""
    yield Door("pump file", "TOML", "plain", "pump.toml", ("check", "pump.toml"), TEXT, 160, whole=40)
    yield Door("scant pump file", "TOML", "plain", "scant.toml", ("check", "scant.toml"), TEXT, 60)
    run = ("run", "scant.toml", "--fidelity", "lumped", "-o", "out")
    yield Door("pump file, run", "TOML", "plain", "scant.toml", run, TEXT, 24)
    yield Door("film case", "TOML", "plain", "film.toml", ("film", "film.toml", "-o", "out"), TEXT, 60, whole=30)
    yield Door("film series", "TOML", "plain", "study.toml", ("check", "study.toml"), TEXT, 60)
    yield Door("gap of a pump", "TOML", "plain", "gap.toml", ("check", "gap.toml"), TEXT, 60)
    yield Door("transient", "TOML", "plain", "transient.toml", ("check", "transient.toml"), TEXT, 60)
    yield Door("reference case", "TOML", "plain", "reference.toml", ("check", "reference.toml"), TEXT, 60)
    yield Door("recording.toml", "TOML", "recording-csv", "recording.toml", ("check", "."), TEXT, 100)
    yield from _recordings()
    yield Door("profile", "CSV", "profiles", "worn.csv", ("check", "pump.toml"), TEXT, 60)
    yield Door("raw trace", "CSV", "profiles", "worn_piston.csv", ("check", "worn.toml"), TEXT, 60)
    yield Door("loss coefficients", "CSV", "profiles", "film_step.csv", ("check", "pump.toml"), TEXT, 60)
    yield Door("flow coefficients", "CSV", "profiles", "slipper_orifice.csv", ("check", "pump.toml"), TEXT, 60)
    yield Door("duty cycle", "CSV", "map", "cycle.csv", ("duty", "m", "cycle.csv", "-o", "out"), TEXT, 60)
    film = ("film", "film.toml", "-o", "out")
    yield Door("film mesh", "VTU", "meshes", "step_pad.vtu", film, (*TEXT, *BINARY), 80)
    yield Door("body mesh", "VTU", "meshes", "slipper.vtu", ("check", "pump.toml"), (*TEXT, *BINARY), 60)
    yield Door("film mesh", "MSH", "meshes", "step_pad.msh", ("film", "step_pad_msh.toml", "-o", "out"), TEXT, 80)
    yield Door("film mesh, binary", "MSH", "meshes", "binary.msh", ("film", "binary_msh.toml", "-o", "out"), BINARY, 40)
    foam = ("coefficients", "case", *FOAM, "--viscosity", "20 mm2/s", "-o", "port.csv")
    for file, cases in (
        ("100/p", 40), ("100/U", 40), ("constant/polyMesh/faces", 40), ("constant/polyMesh/points", 30),
        ("constant/polyMesh/owner", 30), ("constant/polyMesh/boundary", 30), ("system/controlDict", 15),
    ):  # fmt: skip
        yield Door(file, "OpenFOAM", "foam", f"case/{file}", foam, TEXT, cases)
    point = ("run", "ref90", "--fidelity", "table", "--table", "table.json", *TABLE_POINT, "-o", "out")
    yield Door("response table", "JSON", "table", "table.json", point, JSON, 80)
    yield Door("points of a response table", "NPZ", "table", "table.npz", point, NPZ, 60)
    yield Door("cached bodies", "NPZ", "cached", "body.npz", ("cached", "body"), NPZ, 80)
    resumed = (*MAP, "--resume", "begun.partial", "-o", "out")
    yield Door("kept points", "JSON", "map", "begun.partial/points/*", resumed, JSON, 16)
    yield Door("map, duty", "NetCDF", "map", "m/map.nc", ("duty", "m", "cycle.csv", "-o", "out"), HDF5, 60)
    yield Door("map, FMU", "NetCDF", "map", "m/map.nc", ("export", "m", "--to", "fmu", "-o", "out.fmu"), HDF5, 16)
    yield Door("map, CSV", "NetCDF", "map", "m/map.nc", ("export", "m", "--to", "csv", "-o", "out.csv"), HDF5, 40)
    yield Door("results of a film", "NetCDF", "film", "r/results.nc", ("report", "r"), HDF5, 30)
    yield Door("results of a pump", "NetCDF", "run", "r/results.nc", ("report", "r"), HDF5, 30)
    yield from _folders()


def _recordings() -> Iterator[Door]:
    for ending, kind, mutations, cases in (
        ("csv", "CSV", TEXT, 120), ("xlsx", "XLSX", XLSX, 120), ("parquet", "Parquet", BINARY, 120),
        ("mat", "MAT", BINARY, 100), ("tdms", "TDMS", BINARY, 100), ("mf4", "MF4", BINARY, 100),
    ):  # fmt: skip
        sample, file = f"recording-{ending}", f"steady.{ending}"
        yield Door(f"recording in {kind}", kind, sample, file, ("check", "."), mutations, cases)
    yield Door("recording in MAT 7.3", "MAT", "recording-mat73", "steady_v73.mat", ("check", "."), HDF5, 70)
    for ending, kind, mutations in (("csv", "CSV", TEXT), ("xlsx", "XLSX", XLSX)):
        words = ("new", "recording", f"{ending}/steady.{ending}")
        name = f"table of a new recording, {kind}"
        yield Door(name, kind, "tables", f"{ending}/steady.{ending}", words, mutations, 40)


def _folders() -> Iterator[Door]:
    """Yield files of finished runs, whose page is made again."""
    for sample, folder, cases in (("map", "m", 40), ("film", "r", 40), ("film", "s", 30), ("run", "r", 40)):
        words = ("report", folder)
        yield Door(f"summary of {sample} {folder}", "JSON", sample, f"{folder}/summary.json", words, JSON, cases)
    yield Door("captions of a map", "JSON", "map", "m/plots/losses.json", ("report", "m"), JSON, 24)
    yield Door("tables of a run", "CSV", "run", "r/*.csv", ("report", "r"), TEXT, 30)
    yield Door("resolved.toml of a run", "TOML", "run", "r/resolved.toml", ("report", "r"), TEXT, 12)
    yield Door("page of a run", "HTML", "run", "r/report.html", ("report", "r"), TEXT, 12, every=1)
