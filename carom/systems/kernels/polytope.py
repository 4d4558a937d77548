"""A polytope within the difference of two cores: its corners, its faces, and what it grows from."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import EVEN, LEAN, SLIVER
from carom.systems.kernels.cores import most_overlap
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import across, cross

NONE: Any = np.int64(0)  # a plain 0 Numba would take for a kind of its own, and compile twice what is handed it
MOST_CORNERS, MOST_FACES = 160, 512
CORNER = 6  # numbers of a corner: itself, then the point of the first core that it comes from
AROUND, HALF_ROOT = 0.5, sqrt(0.75)  # how far the first corners are sought beside the direction to begin with
LEAN_X, LEAN_Y, LEAN_Z = 0.36 * LEAN, 0.48 * LEAN, 0.8 * LEAN


@inlined
def add_corner(core, place, vertices, x, y, z, corner, c):
    """Write the corner farthest along a unit vector: itself, then the point of the first core.

    Of several as far the two cores choose by one and the same slight lean, so that corners are never within a face or
    edge of the difference, where they would fold the polytope.
    """
    corner[c], corner[c + 1], corner[c + 2], corner[c + 3], corner[c + 4], corner[c + 5] = most_overlap(
        core, place, vertices, x + LEAN_X, y + LEAN_Y, z + LEAN_Z
    )


@inlined
def add_face(corner, i, j, k, face, plane, faces):
    """Write the face (i, j, k), counter-clockwise from outside; return how many faces there are now."""
    a, b, c = CORNER * i, CORNER * j, CORNER * k
    ux, uy, uz = corner[b] - corner[a], corner[b + 1] - corner[a + 1], corner[b + 2] - corner[a + 2]
    vx, vy, vz = corner[c] - corner[a], corner[c + 1] - corner[a + 1], corner[c + 2] - corner[a + 2]
    x, y, z = cross(ux, uy, uz, vx, vy, vz)
    squared = x * x + y * y + z * z
    if squared <= SLIVER * SLIVER * (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz):
        return faces
    scale = 1.0 / sqrt(squared)
    x, y, z = x * scale, y * scale, z * scale
    f = 4 * faces
    plane[f], plane[f + 1], plane[f + 2] = x, y, z
    plane[f + 3] = x * corner[a] + y * corner[a + 1] + z * corner[a + 2]
    face[3 * faces], face[3 * faces + 1], face[3 * faces + 2] = i, j, k
    return faces + 1


@inlined
def begin(core, place, vertices, x, y, z, corner, face, plane):
    """Write the first four corners and faces; return how many faces there are, 0 for a difference without volume.

    Three corners are around the unit vector n, where the answer is likely to be, and one opposite; where these are all
    but in a line or plane, one is sought across it.
    """
    vx, vy, vz, wx, wy, wz = across(x, y, z)
    add_corner(core, place, vertices, x + AROUND * vx, y + AROUND * vy, z + AROUND * vz, corner, 0 * CORNER)
    add_corner(core, place, vertices, -x, -y, -z, corner, 1 * CORNER)
    ux, uy, uz = corner[6] - corner[0], corner[7] - corner[1], corner[8] - corner[2]
    widest, length = 0.0, ux * ux + uy * uy + uz * uz
    nx, ny, nz = 0.0, 0.0, 0.0
    for side in range(5):
        ahead = 1.0 if side == 0 else 0.0
        along_v = -0.5 * AROUND if side == 0 else 1.0 if side == 1 else -1.0 if side == 2 else 0.0
        along_w = HALF_ROOT * AROUND if side == 0 else 1.0 if side == 3 else -1.0 if side == 4 else 0.0
        sx, sy, sz = ahead * x + along_v * vx, ahead * y + along_v * vy, ahead * z + along_v * vz
        add_corner(core, place, vertices, sx + along_w * wx, sy + along_w * wy, sz + along_w * wz, corner, 3 * CORNER)
        mx, my, mz = cross(ux, uy, uz, corner[18] - corner[0], corner[19] - corner[1], corner[20] - corner[2])
        squared = mx * mx + my * my + mz * mz
        if squared > widest:
            widest, nx, ny, nz = squared, mx, my, mz
            for d in range(6):
                corner[12 + d] = corner[18 + d]
            if widest > EVEN * EVEN * length * length:
                break
    if not widest > SLIVER * SLIVER * length * length:
        return NONE
    scale = 1.0 / sqrt(widest)
    nx, ny, nz, highest = nx * scale, ny * scale, nz * scale, 0.0
    for side in range(3):
        sx, sy, sz = nx, ny, nz
        if side == 0:
            along_v, along_w = -0.5 * AROUND, -HALF_ROOT * AROUND
            sx, sy, sz = (
                x + along_v * vx + along_w * wx,
                y + along_v * vy + along_w * wy,
                z + along_v * vz + along_w * wz,
            )
        elif side == 2:
            sx, sy, sz = -nx, -ny, -nz
        add_corner(core, place, vertices, sx, sy, sz, corner, 4 * CORNER)
        height = nx * (corner[24] - corner[0]) + ny * (corner[25] - corner[1]) + nz * (corner[26] - corner[2])
        if abs(height) > abs(highest):
            highest = height
            for d in range(6):
                corner[18 + d] = corner[24 + d]
            if abs(highest) > EVEN * sqrt(length):
                break
    if abs(highest) <= SLIVER * sqrt(length):
        return NONE
    i, j = (0, 1) if highest > 0.0 else (1, 0)
    faces = NONE
    for a, b, c in ((j, i, 2), (i, j, 3), (j, 2, 3), (2, i, 3)):
        faces = add_face(corner, a, b, c, face, plane, faces)
    return faces
