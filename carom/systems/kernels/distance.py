"""Distance of two polyhedra that are apart."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_ERROR, APART_LEAST, APART_STEPS
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.simplex import nearest_on_simplex

FAR, APART, MEETING = 0, 1, 2


@inlined
def outermost(v, begin, end, x, y, z):
    """Return the vertex farthest along a direction, the first of several, and how far it is."""
    best, most = begin, v[3 * begin] * x + v[3 * begin + 1] * y + v[3 * begin + 2] * z
    for k in range(begin + 1, end):
        along = v[3 * k] * x + v[3 * k + 1] * y + v[3 * k + 2] * z
        if along > most:
            best, most = k, along
    return best, most


@inlined
def distance_apart(v, middle, end, reach, corner, name, weight):
    """Return (state, distance, unit direction, point of the first) of two sets of vertices.

    ``v`` holds three numbers per vertex: the first set up to ``middle``, the second up to ``end``. FAR: farther than
    ``reach``, and no nearer than the distance told. MEETING: they overlap, nearly touch, or rounding leaves the
    distance in doubt by more than APART_ERROR. Gilbert, Johnson and Keerthi (van den Bergen, Collision Detection in
    Interactive 3D Environments, 4.3); it ends when a vertex comes up again, or no step comes nearer, so always.
    """
    x, y, z = v[3 * middle] - v[0], v[3 * middle + 1] - v[1], v[3 * middle + 2] - v[2]
    corner[0], corner[1], corner[2] = x, y, z
    name[0], name[1] = 0, middle
    weight[0] = 1.0
    count, squared = 1, x * x + y * y + z * z
    px, py, pz = v[0], v[1], v[2]
    for _ in range(APART_STEPS):
        if squared <= APART_LEAST * APART_LEAST:
            return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        i, forth = outermost(v, 0, middle, x, y, z)
        j, back = outermost(v, middle, end, -x, -y, -z)
        bound = -back - forth  # the distance is at least this over the length of x
        if bound > 0.0 and bound * bound > squared * reach * reach:
            return FAR, bound / sqrt(squared), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        known = False
        for k in range(count):
            known = known or (name[2 * k] == i and name[2 * k + 1] == j)
        if known or squared - bound <= 1e-15 * squared:
            break
        for d in range(3):
            corner[3 * count + d] = v[3 * j + d] - v[3 * i + d]
        name[2 * count], name[2 * count + 1] = i, j
        count = nearest_on_simplex(corner, name, weight, count + 1)
        if count == 4:
            return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        nx = ny = nz = qx = qy = qz = 0.0
        for k in range(count):
            nx, ny, nz = (
                nx + weight[k] * corner[3 * k],
                ny + weight[k] * corner[3 * k + 1],
                nz + weight[k] * corner[3 * k + 2],
            )
            a = 3 * name[2 * k]
            qx, qy, qz = qx + weight[k] * v[a], qy + weight[k] * v[a + 1], qz + weight[k] * v[a + 2]
        nearer = nx * nx + ny * ny + nz * nz
        if nearer >= squared:
            break
        x, y, z, squared, px, py, pz = nx, ny, nz, nearer, qx, qy, qz
    distance = sqrt(squared)
    x, y, z = x / distance, y / distance, z / distance
    i, forth = outermost(v, 0, middle, x, y, z)
    j, back = outermost(v, middle, end, -x, -y, -z)
    if distance + back + forth > APART_ERROR:
        return MEETING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return APART, distance, x, y, z, px, py, pz
