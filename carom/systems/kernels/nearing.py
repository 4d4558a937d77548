"""How far two cores are apart, from wherever the search begins."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_LEAST, CURVED_FROM
from carom.systems.kernels.cores import most_overlap
from carom.systems.kernels.distance import APART, FAR, MEETING
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.simplex import nearest_on_simplex
from carom.systems.kernels.smooth import is_round, settle

MOST_STEPS = 64


@inlined
def near(core, place, vertices, nx, ny, nz, reach, bracket, corner, name, weight, seen):
    """Return (state, distance, unit direction from first to second, point of the first) of two cores.

    ``state`` is that of `distance_apart`, and so is the algorithm; here the corners come from `most_overlap`, the first
    along n, and round cores have no end of them: the distance is believed once it is known to ``bracket``, m.
    """
    x, y, z, px, py, pz = most_overlap(core, place, vertices, nx, ny, nz)
    corner[0], corner[1], corner[2] = x, y, z
    seen[0], seen[1], seen[2] = px, py, pz
    name[0], name[1] = 0, 0
    weight[0] = 1.0
    count, squared, curved, apart = 1, x * x + y * y + z * z, is_round(core), -1e300
    qx, qy, qz = px, py, pz
    for step in range(1, MOST_STEPS):
        if squared <= APART_LEAST * APART_LEAST:
            break
        length = sqrt(squared)
        mx, my, mz = -x / length, -y / length, -z / length
        wx, wy, wz, ax, ay, az = most_overlap(core, place, vertices, mx, my, mz)
        here = -(mx * wx + my * wy + mz * wz)  # they are apart by no less, and by no more than the length
        if here > reach:
            return FAR, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if here > apart:  # of thin simplexes later ones may be worse
            apart, nx, ny, nz, qx, qy, qz = here, mx, my, mz, px, py, pz
        if length - apart <= bracket:
            break
        if curved and length - here <= CURVED_FROM:
            curved = False
            found, sx, sy, sz = settle(core, place, vertices, mx, my, mz)
            if found:
                wx, wy, wz, ax, ay, az = most_overlap(core, place, vertices, sx, sy, sz)
                return APART, -(wx * sx + wy * sy + wz * sz), sx, sy, sz, ax, ay, az
        for d in range(3):
            corner[3 * count + d] = wx if d == 0 else wy if d == 1 else wz
            seen[3 * step + d] = ax if d == 0 else ay if d == 1 else az
        name[2 * count], name[2 * count + 1] = step, step
        count = nearest_on_simplex(corner, name, weight, count + 1)
        if count == 4:
            break
        x = y = z = px = py = pz = 0.0
        for k in range(count):
            x, y, z = (
                x + weight[k] * corner[3 * k],
                y + weight[k] * corner[3 * k + 1],
                z + weight[k] * corner[3 * k + 2],
            )
            a = 3 * name[2 * k]
            px, py, pz = px + weight[k] * seen[a], py + weight[k] * seen[a + 1], pz + weight[k] * seen[a + 2]
        nearer = x * x + y * y + z * z
        if nearer >= squared:
            break
        squared = nearer
    if apart <= APART_LEAST:
        return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return APART, apart, nx, ny, nz, qx, qy, qz
