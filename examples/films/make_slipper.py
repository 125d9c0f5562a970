"""Writes slipper.vtu: a slipper with its socket, in millimetres, with cell data that marks film, pocket and held.

Hexahedra of a section (radius, height) turned about z; the sliding face lies at z = 0, the slipper under it.
"""

from pathlib import Path

import meshio
import numpy as np

AROUND = 24
radius = np.array([0.45, 2.5, 4.5, 6.0, 7.4, 9.25, 11.1, 12.95, 14.8])  # orifice .. pocket 7.4 .. rim
height = np.array([-18.0, -15.0, -12.0, -9.0, -4.5, 0.0])  # socket's edge .. flange's back -9 .. face

# Cells of the section: the whole flange, and the wall of the socket on its back.
column, row = np.meshgrid(np.arange(len(radius) - 1), np.arange(len(height) - 1), indexing="ij")
solid = (height[row] >= -9.0) | ((radius[column] >= 7.4) & (radius[column] < 11.1))
column, row = column[solid], row[solid]

angle = 2.0 * np.pi * np.arange(AROUND) / AROUND
r, z, a = np.meshgrid(radius, height, angle, indexing="ij")
places = np.column_stack([(r * np.cos(a)).ravel(), (r * np.sin(a)).ravel(), z.ravel()])
point = np.arange(places.shape[0]).reshape(r.shape)


def around(corners):
    """Return cells of all sectors over section points [(column, row), ..]: quadrilaterals of 2, hexahedra of 4."""
    here = [point[i, k, :] for i, k in corners]
    there = [np.roll(part, -1, axis=-1) for part in here]
    return np.stack([*here, *(there if len(corners) == 4 else there[::-1])], axis=-1).reshape(-1, 2 * len(corners))


hexahedra = around([(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)])
across, along = np.arange(len(radius) - 1), np.arange(len(height) - 1)
top, back, socket = len(height) - 1, 3, 4  # rows of face and flange's back, column of the socket's wall
land, inside = across[across >= socket], across[across < socket]
faces = {
    "film": around([(land, top), (land + 1, top)]),
    "pocket": around([(inside, top), (inside + 1, top)]),
    "held": np.vstack(  # the socket, on the ball
        [around([(inside, back), (inside + 1, back)]), around([(socket, along[:back]), (socket, along[:back] + 1)])]
    ),
}
used, hexahedra = np.unique(hexahedra, return_inverse=True)
quads = np.searchsorted(used, np.vstack(list(faces.values())))
names = np.repeat(list(faces), [len(part) for part in faces.values()])
meshio.write_points_cells(
    Path(__file__).with_name("slipper.vtu"),
    places[used],
    [("quad", quads), ("hexahedron", hexahedra.reshape(-1, 8))],
    cell_data={name: [(names == name).astype(int), np.zeros(hexahedra.size // 8, dtype=int)] for name in faces},
)
