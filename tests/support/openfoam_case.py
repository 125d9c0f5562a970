"""Writer of a small OpenFOAM case: Poiseuille flow in a channel, cells in layers over its height."""

from __future__ import annotations

import numpy as np

LENGTH, HEIGHT, WIDTH, LAYERS = 0.2, 0.01, 0.02, 8
FLOW, DROP = 3e-4, 500.0  # m3/s, Pa
DENSITY = 850.0
WORDS = ["inlet", "outlet", "walls"]


def header(kind: str, name: str) -> str:
    return f"FoamFile\n{{\n version 2.0;\n format ascii;\n class {kind};\n object {name};\n}}\n"


def listed(items) -> str:
    return f"{len(items)}\n(\n" + "\n".join(items) + "\n)\n"


def write_mesh(case):
    """Layers of one cell each over the height: inlet at x = 0, outlet at x = LENGTH, walls all else."""
    y = np.linspace(0.0, HEIGHT, LAYERS + 1)
    points = [f"({a} {b} {c})" for b in y for c in (0.0, WIDTH) for a in (0.0, LENGTH)]

    def at(j, k, i):
        return 4 * j + 2 * k + i

    between = [(at(j, 0, 0), at(j, 1, 0), at(j, 1, 1), at(j, 0, 1)) for j in range(1, LAYERS)]
    inlet = [(at(j, 0, 0), at(j, 1, 0), at(j + 1, 1, 0), at(j + 1, 0, 0)) for j in range(LAYERS)]
    outlet = [(at(j, 0, 1), at(j + 1, 0, 1), at(j + 1, 1, 1), at(j, 1, 1)) for j in range(LAYERS)]
    front = [(at(j, 0, 0), at(j + 1, 0, 0), at(j + 1, 0, 1), at(j, 0, 1)) for j in range(LAYERS)]
    back = [(at(j, 1, 0), at(j, 1, 1), at(j + 1, 1, 1), at(j + 1, 1, 0)) for j in range(LAYERS)]
    ends = [(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0))]
    ends += [(at(LAYERS, 0, 0), at(LAYERS, 1, 0), at(LAYERS, 1, 1), at(LAYERS, 0, 1))]
    faces = [*between, *inlet, *outlet, *front, *back, *ends]
    layers = list(range(LAYERS))
    owner = [*range(LAYERS - 1), *layers * 4, 0, LAYERS - 1]
    mesh = case / "constant" / "polyMesh"
    mesh.mkdir(parents=True)
    (mesh / "points").write_text(header("vectorField", "points") + listed(points))
    shown = [f"4({' '.join(map(str, face))})" for face in faces]
    (mesh / "faces").write_text(header("faceList", "faces") + listed(shown))
    (mesh / "owner").write_text(header("labelList", "owner") + listed(list(map(str, owner))))
    neighbour = [str(j) for j in range(1, LAYERS)]
    (mesh / "neighbour").write_text(header("labelList", "neighbour") + listed(neighbour))
    sizes = [LAYERS, LAYERS, 2 * LAYERS + 2]
    starts = LAYERS - 1 + np.cumsum([0, *sizes])
    parts = [
        f"{name}\n{{\n type patch;\n nFaces {size};\n startFace {start};\n}}"
        for name, size, start in zip(WORDS, sizes, starts, strict=False)
    ]
    (mesh / "boundary").write_text(header("polyBoundaryMesh", "boundary") + listed(parts))


def profile():
    """Means over each layer of the parabola of FLOW."""
    edges = np.linspace(0.0, 1.0, LAYERS + 1)
    return FLOW / (WIDTH * HEIGHT) * np.diff(3.0 * edges**2 - 2.0 * edges**3) * LAYERS


def field(kind, name, dimensions, inside, patches):
    text = header(f"vol{kind.capitalize()}Field", name) + f"dimensions [{dimensions}];\n"
    text += f"internalField nonuniform List<{kind}> {listed(inside)};\nboundaryField\n{{\n"
    for patch, values in patches.items():
        text += f"{patch}\n{{\n type fixedValue;\n value nonuniform List<{kind}> {listed(values)};\n}}\n"
    return text + "}\n"


def write_case(case, dimensions="0 2 -2 0 0 0 0", scale=1.0 / DENSITY, outflow=1.0):
    write_mesh(case)
    (case / "system").mkdir()
    (case / "system" / "controlDict").write_text(header("dictionary", "controlDict") + "application simpleFoam;\n")
    for time, share in (("50", 0.5), ("100", 1.0)):
        folder = case / time
        folder.mkdir()
        speeds = [[f"({share * factor * u} 0 0)" for u in profile()] for factor in (1.0, outflow)]
        still = ["(0 0 0)"] * (2 * LAYERS + 2)
        patches = dict(zip(WORDS, [*speeds, still], strict=True))
        (folder / "U").write_text(field("vector", "U", "0 1 -1 0 0 0 0", speeds[0], patches))
        high = [str(share * DROP * scale)] * LAYERS
        pressures = {"inlet": high, "outlet": ["0"] * LAYERS, "walls": ["0"] * (2 * LAYERS + 2)}
        (folder / "p").write_text(field("scalar", "p", dimensions, high, pressures))
    return case
