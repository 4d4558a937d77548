"""Directions and places given in the frame of a row, in the world and back."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import product, spun, turn


@inlined
def turned(rotation, row, x, y, z):
    """Return a direction of the row's frame in the world."""
    return turn(rotation[row, 0], rotation[row, 1], rotation[row, 2], rotation[row, 3], x, y, z)


@inlined
def turned_back(rotation, row, x, y, z):
    """Return a direction of the world in the row's frame."""
    return turn(-rotation[row, 0], -rotation[row, 1], -rotation[row, 2], rotation[row, 3], x, y, z)


@inlined
def placed(position, rotation, row, x, y, z):
    """Return a place of the row's frame in the world."""
    x, y, z = turned(rotation, row, x, y, z)
    return position[row, 0] + x, position[row, 1] + y, position[row, 2] + z


@inlined
def put(side, i, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation):
    """Write where a shape of pair p is ``time`` seconds on, as its body moves and turns now."""
    x, y, z = local_position[p, side, 0], local_position[p, side, 1], local_position[p, side, 2]
    lx, ly, lz, lw = (
        local_rotation[p, side, 0], local_rotation[p, side, 1], local_rotation[p, side, 2], local_rotation[p, side, 3]
    )  # fmt: skip
    if i >= 0:
        qx, qy, qz, qw = spun(
            turns[i, 0], turns[i, 1], turns[i, 2], turns[i, 3], angular[i, 0], angular[i, 1], angular[i, 2], time
        )
        x, y, z = turn(qx, qy, qz, qw, x, y, z)
        x, y, z = x + center[i, 0], y + center[i, 1], z + center[i, 2]
        x, y, z = x + time * linear[i, 0], y + time * linear[i, 1], z + time * linear[i, 2]
        lx, ly, lz, lw = product(qx, qy, qz, qw, lx, ly, lz, lw)
    position[side, 0], position[side, 1], position[side, 2] = x, y, z
    rotation[side, 0], rotation[side, 1], rotation[side, 2], rotation[side, 3] = lx, ly, lz, lw


@inlined
def put_both(i, o, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation):
    """Write where both shapes of pair p are, of bodies i and o, as `put` does."""
    put(0, i, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
    put(1, o, time, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)


@inlined
def put_on(n, side, i, x, y, z, center, rotation, places):
    """Write a place of the world as the n-th of a side: in the frame of body i about its centre, if there is one."""
    if i >= 0:
        x, y, z = turned_back(rotation, i, x - center[i, 0], y - center[i, 1], z - center[i, 2])
    places[n, side, 0], places[n, side, 1], places[n, side, 2] = x, y, z
