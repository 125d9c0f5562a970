"""Good samples of every kind of file, made once in a folder: a case is a copy of one of them with a file mutated."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
POINTS = ("--speeds", "1000,2000rpm", "--pressures", "10,30MPa", "--displacements", "0.5,1.0", "--check", "2")
MAP = ("map", "ref90", "--fidelity", "lumped", *POINTS, "--workers", "1")
BOX = ("--speed", "1000..2000rpm", "--pressure", "10..30MPa", "--displacement", "1.0", "--temperature", "50degC")
FOAM = ("--inlet", "inlet", "--outlet", "outlet", "--throat-area", "400 mm2", "--density", "850 kg/m3")
CYCLE = "time [s],speed [rpm],pressure [bar],displacement ratio [1]\n0,1000,150,0.6\n5,1500,250,0.9\n9,2000,120,1\n"
HEADS = ("speed_rpm", "p_out_bar", "Q_out_lpm", "torque_Nm")
RECORDING = """format = 1
title = "bench"
pump = "ref90"
pressure_reference = "gauge"
[steady]
file = "{file}"
{part}[channel]
speed = {{ column = "speed_rpm", unit = "rpm", sigma = 0.5 }}
p_out = {{ column = "p_out_bar", unit = "bar", sigma = 0.15 }}
Q_out = {{ column = "Q_out_lpm", unit = "L/min", sigma = 0.08 }}
torque = {{ column = "torque_Nm", unit = "N m", sigma = 0.25 }}
"""
TABLES = ("csv", "xlsx", "parquet", "mat", "mat73", "tdms", "mf4")
BODY = '\n[slipper.body]\nmesh = "slipper.vtu"\nunit = "mm"\n'
WORN = '\n[bore]\nprofile = "worn.csv"\n'


def make_samples(folder: Path) -> None:
    """Fill a folder with one folder of files for each kind; existing ones are kept."""
    sys.path.insert(0, str(ROOT / "tests" / "support"))
    makers: dict[str, Callable[[Path], None]] = {
        "plain": _plain,
        "meshes": _meshes,
        "profiles": _profiles,
        "foam": _foam,
        "tables": _tables,
        "map": _map,
        "table": _table,
        "film": _film,
        "run": _run,
        "cached": _cached,
        **{f"recording-{ending}": partial(_recording, ending=ending) for ending in TABLES},
    }
    for name, make in makers.items():
        if not (folder / name).is_dir():
            beside = folder / f"{name}.new"
            shutil.rmtree(beside, ignore_errors=True)
            beside.mkdir(parents=True)
            make(beside)
            beside.rename(folder / name)


def _plain(place: Path) -> None:
    for source, name in (
        ("pumps/ref90_worn.toml", "pump.toml"), ("films/linear_slider.toml", "film.toml"),
        ("films/stribeck_study.toml", "study.toml"), ("transients/destroke.toml", "transient.toml"),
        ("references/film_step.toml", "reference.toml"), ("films/ref90_slipper.toml", "gap.toml"),
    ):  # fmt: skip
        shutil.copyfile(EXAMPLES / source, place / name)
    (place / "scant.toml").write_text(
        'name = "own"\nformat = 1\n[pump]\npistons = 7\ndisplacement = "45 cm3/rev"\n[oil]\ngrade = "ISO VG 46"\n'
        '[operating]\nspeed = "1500 rpm"\npressure = "28 MPa"\n',
        "utf-8",
    )


def _meshes(place: Path) -> None:
    import meshio

    shutil.copyfile(EXAMPLES / "films" / "step_pad.toml", place / "film.toml")
    shutil.copyfile(EXAMPLES / "films" / "step_pad.vtu", place / "step_pad.vtu")
    shutil.copyfile(EXAMPLES / "films" / "slipper.vtu", place / "slipper.vtu")
    read = meshio.read(place / "step_pad.vtu")
    tags = [np.ones(len(block.data), dtype=np.int32) for block in read.cells]
    plain = meshio.Mesh(read.points, read.cells, cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags})
    meshio.write(place / "step_pad.msh", plain, file_format="gmsh22", binary=False)
    meshio.write(place / "binary.msh", plain, file_format="gmsh22", binary=True)
    for name in ("step_pad.msh", "binary.msh"):
        text = (place / "film.toml").read_text("utf-8").replace("step_pad.vtu", name)
        text = text.replace('"film_thickness"', '"1e-5*(2 - x/0.01)"')
        (place / f"{name.partition('.')[0]}_msh.toml").write_text(text, "utf-8")
    (place / "pump.toml").write_text((EXAMPLES / "pumps" / "ref90_worn.toml").read_text("utf-8") + BODY, "utf-8")


def _profiles(place: Path) -> None:
    text = (EXAMPLES / "pumps" / "ref90_edges.toml").read_text("utf-8").replace("../references/", "")
    (place / "pump.toml").write_text(text + WORN, "utf-8")
    for name in ("film_step.csv", "slipper_orifice.csv"):
        shutil.copyfile(EXAMPLES / "references" / name, place / name)
    (place / "worn.csv").write_text("# measured\nplace [mm],material taken off [um]\n0,4\n20,1.5\n45,0\n", "utf-8")
    for name in ("worn_piston.csv", "new_piston.csv"):
        shutil.copyfile(EXAMPLES / "films" / name, place / name)
    worn = (EXAMPLES / "films" / "worn_piston.toml").read_text("utf-8").replace("../pumps/", "")
    (place / "worn.toml").write_text(worn, "utf-8")
    shutil.copyfile(EXAMPLES / "pumps" / "ref90_worn.toml", place / "ref90_worn.toml")


def _tables(place: Path) -> None:
    for ending in ("csv", "xlsx"):
        (place / ending).mkdir()
        _recording(place / ending, ending)
        (place / ending / "recording.toml").unlink()


def _foam(place: Path) -> None:
    from openfoam_case import write_case

    write_case(place / "case")


def _map(place: Path) -> None:
    _done([*MAP, "-o", str(place / "m")])
    (place / "cycle.csv").write_text(CYCLE, "utf-8")
    shutil.copytree(place / "m" / "points", place / "begun.partial" / "points")


def _table(place: Path) -> None:
    _done(["table", "ref90", *BOX, "--points", "12", "--held-out", "4", "-o", str(place / "t")])
    for name in ("table.json", "table.npz"):
        (place / "t" / name).rename(place / name)


def _film(place: Path) -> None:
    _done(["film", str(EXAMPLES / "films" / "linear_slider.toml"), "-o", str(place / "r")])
    _done(["film", str(EXAMPLES / "films" / "stribeck_study.toml"), "-o", str(place / "s")])


def _run(place: Path) -> None:
    _done(["run", "ref90", "--fidelity", "lumped", "-o", str(place / "r")])


def _cached(place: Path) -> None:
    from reynolds.numerics.cache import kept

    kept("body", lambda: {"compliance": np.eye(40), "weights": np.ones(40)}, place)


def _recording(place: Path, ending: str) -> None:
    draw = np.random.default_rng(1)
    rows = np.column_stack([
        np.repeat([1000.0, 1500.0, 2000.0], 4), np.tile([100.0, 200.0, 300.0, 350.0], 3),
    ])  # fmt: skip
    flow = 0.09 * rows[:, 0] - 0.01 * rows[:, 1] + 0.05 * draw.standard_normal(len(rows))
    torque = 1.45 * rows[:, 1] + 10.0 + 0.2 * draw.standard_normal(len(rows))
    columns = dict(zip(HEADS, [*rows.T, flow, torque], strict=True))
    name = {"mat73": "steady_v73.mat"}.get(ending, f"steady.{ending}")
    part = 'group = "run"\n' if ending == "tdms" else ""
    (place / "recording.toml").write_text(RECORDING.format(file=name, part=part), "utf-8")
    _WRITERS[ending](place / name, columns)


Columns = dict[str, np.ndarray]


def _csv(path: Path, columns: Columns) -> None:
    lines = [",".join(columns), *(",".join(f"{x:.6g}" for x in row) for row in zip(*columns.values(), strict=True))]
    path.write_text("\n".join(lines) + "\n", "utf-8")


def _xlsx(path: Path, columns: Columns) -> None:
    from openpyxl import Workbook

    book = Workbook()
    for row in (list(columns), *zip(*columns.values(), strict=True)):
        book.active.append(row if isinstance(row, list) else [float(cell) for cell in row])
    book.save(path)


def _parquet(path: Path, columns: Columns) -> None:
    import pyarrow
    from pyarrow import parquet

    parquet.write_table(pyarrow.table(columns), path)


def _mat(path: Path, columns: Columns) -> None:
    from scipy.io import savemat

    savemat(path, columns, do_compression=True)


def _mat73(path: Path, columns: Columns) -> None:
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in columns.items():
            file[name] = values[None, :]
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")


def _tdms(path: Path, columns: Columns) -> None:
    import nptdms

    with nptdms.TdmsWriter(path) as file:
        file.write_segment([nptdms.ChannelObject("run", name, values) for name, values in columns.items()])


def _mf4(path: Path, columns: Columns) -> None:
    import asammdf

    time = np.arange(len(next(iter(columns.values()))), dtype=float)
    signals = [asammdf.Signal(samples=x, timestamps=time, name=name) for name, x in columns.items()]
    with asammdf.MDF(version="4.10") as file:
        file.append(signals)
        file.save(path)


_WRITERS: dict[str, Callable[[Path, Columns], None]] = {
    "csv": _csv, "xlsx": _xlsx, "parquet": _parquet, "mat": _mat, "mat73": _mat73, "tdms": _tdms, "mf4": _mf4,
}  # fmt: skip


def _done(words: list[str]) -> None:
    """Run a command that must succeed."""
    from swashfilm.__main__ import main

    if code := main(words):
        raise RuntimeError(f"swashfilm {' '.join(words)} ended with {code}")
