"""How far two cores are apart, from wherever the search begins."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_LEAST, BRACKET, CURVED_FROM
from carom.systems.kernels.cores import most_overlap
from carom.systems.kernels.distance import APART, FAR, MEETING
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.simplex import nearest_on_simplex
from carom.systems.kernels.smooth import is_round, settle

MOST_STEPS = 64


@inlined
def near(core, place, vertices, nx, ny, nz, reach, corner, name, weight, seen):
    """Return (state, distance, unit direction from first to second, point of the first) of two cores.

    ``state`` is that of `distance_apart`, and so is the algorithm; here the corners come from `most_overlap`, the first
    along n, and round cores have no end of them: the distance is believed once it is known to BRACKET.
    """
    wx, wy, wz, ax, ay, az = most_overlap(core, place, vertices, nx, ny, nz)
    corner[0], corner[1], corner[2] = wx, wy, wz
    seen[0], seen[1], seen[2] = ax, ay, az
    name[0], name[1] = 0, 0
    weight[0] = 1.0
    x, y, z, px, py, pz = wx, wy, wz, ax, ay, az
    count, squared, curved = 1, x * x + y * y + z * z, is_round(core)
    for step in range(1, MOST_STEPS):
        if squared <= APART_LEAST * APART_LEAST:
            return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        wx, wy, wz, ax, ay, az = most_overlap(core, place, vertices, -x, -y, -z)
        bound = x * wx + y * wy + z * wz  # the distance is at least this over the length of x
        if bound > 0.0 and bound * bound > squared * reach * reach:
            return FAR, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if squared - bound <= BRACKET * sqrt(squared):
            break
        if curved and squared - bound <= CURVED_FROM * sqrt(squared):
            curved, distance = False, -sqrt(squared)
            found, nx, ny, nz = settle(core, place, vertices, x / distance, y / distance, z / distance)
            if found:
                wx, wy, wz, ax, ay, az = most_overlap(core, place, vertices, nx, ny, nz)
                return APART, -(wx * nx + wy * ny + wz * nz), nx, ny, nz, ax, ay, az
        for d in range(3):
            corner[3 * count + d] = wx if d == 0 else wy if d == 1 else wz
            seen[3 * step + d] = ax if d == 0 else ay if d == 1 else az
        name[2 * count], name[2 * count + 1] = step, step
        count = nearest_on_simplex(corner, name, weight, count + 1)
        if count == 4:
            return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        vx = vy = vz = qx = qy = qz = 0.0
        for k in range(count):
            vx, vy, vz = (
                vx + weight[k] * corner[3 * k],
                vy + weight[k] * corner[3 * k + 1],
                vz + weight[k] * corner[3 * k + 2],
            )
            a = 3 * name[2 * k]
            qx, qy, qz = qx + weight[k] * seen[a], qy + weight[k] * seen[a + 1], qz + weight[k] * seen[a + 2]
        nearer = vx * vx + vy * vy + vz * vz
        if nearer >= squared:
            break
        x, y, z, squared, px, py, pz = vx, vy, vz, nearer, qx, qy, qz
    distance = sqrt(squared)
    nx, ny, nz = -x / distance, -y / distance, -z / distance
    wx, wy, wz, _, _, _ = most_overlap(core, place, vertices, nx, ny, nz)
    return APART, -(wx * nx + wy * ny + wz * nz), nx, ny, nz, px, py, pz
