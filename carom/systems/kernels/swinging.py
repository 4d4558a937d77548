"""Swinging: how fast shapes move as their bodies turn. What turns about its own axis stays where it is."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.cores import ELLIPSOID_SHAPE
from carom.systems.kernels.frames import turned, turned_back
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.spatial import cross
from carom.systems.kernels.unrolling import rolls

#: Numbers of a pair: how far either core reaches from the centre of its body, which is the smaller, and how far a
#: contact is trusted; how far from the axes about which their bodies turn either core reaches, how fast turning moves
#: the smaller as seen from the other, and how both bodies turn about their own axes.
NUMBERS = 13
REACH, SMALLER, TRUSTED, LEVER, SWING, SPIN = 0, 2, 3, 4, 6, 7


@woven
def reach_of(c, i, local_position, bound_center, bound_half, position, center):
    """Return how far (m) the core of collider c, what it is without its roundness, reaches from the centre of body i.

    Roundness does not count, since it turns without effect; nor does what has no body and never turns.
    """
    if i < 0:
        return 0.0
    away, off, half = 0.0, 0.0, 0.0
    for k in range(3):
        away += (position[c, k] - center[i, k]) ** 2
        off += (bound_center[c, k] - local_position[c, k]) ** 2
        half += bound_half[c, k] * bound_half[c, k]
    return sqrt(away) + sqrt(off) + sqrt(half)


@woven
def lever_of(c, i, reach, wx, wy, wz, shape, size, position, rotation, center):
    """Return how far (m) the core of collider c of body i, which reaches so far, moves for each radian about w.

    That is how far its origin is from the axis through the centre, and what turns around that origin: of a shape of
    revolution its own axis.
    """
    speed = sqrt(wx * wx + wy * wy + wz * wz)
    if i < 0 or speed == 0.0:
        return reach
    x, y, z = position[c, 0] - center[i, 0], position[c, 1] - center[i, 1], position[c, 2] - center[i, 2]
    ax, ay, az = cross(wx, wy, wz, x, y, z)
    around, own = sqrt(ax * ax + ay * ay + az * az), (reach - sqrt(x * x + y * y + z * z)) * speed
    if is_of_revolution(c, shape, size):
        x, y, z = turned(rotation, c, 0.0, 1.0, 0.0)
        ax, ay, az = cross(wx, wy, wz, x, y, z)
        own *= sqrt(ax * ax + ay * ay + az * az) / speed
    return (around + own) / speed


@woven
def is_of_revolution(c, shape, size):
    """Tell whether a collider is the same however it is turned about its axis."""
    return rolls(c, shape) and (shape[c] != ELLIPSOID_SHAPE or size[c, 0] == size[c, 2])


@woven
def spin_of(i, turns, angular):
    """Return how fast body i turns (rad/s) about its own axes."""
    return turned_back(turns, i, angular[i, 0], angular[i, 1], angular[i, 2])


@woven
def swing_about(x, y, z, found_x, found_y, found_z, lever, reach):
    """Return how fast (m/s) a core moves as its body turns at (x, y, z), rad/s, about its own axes.

    About the axis about which that turned when its pair was found it has its ``lever``, about others its ``reach``: on
    the body it stays the axis it was, wherever that has turned to.
    """
    squared = found_x * found_x + found_y * found_y + found_z * found_z
    part = (x * found_x + y * found_y + z * found_z) / squared if squared > 0.0 else 0.0
    x, y, z = x - part * found_x, y - part * found_y, z - part * found_z
    return abs(part) * sqrt(squared) * lever + sqrt(x * x + y * y + z * z) * reach


@woven
def swing_of(p, side, x, y, z, numbers):
    """Return how fast (m/s) one of pair p moves as its body turns at (x, y, z), as `swing_about`."""
    spin = SPIN + 3 * side
    return swing_about(
        x, y, z, numbers[p, spin], numbers[p, spin + 1], numbers[p, spin + 2],
        numbers[p, LEVER + side], numbers[p, REACH + side],
    )  # fmt: skip


@woven
def swing_now(p, side, i, turns, angular, numbers):
    """Return how fast (m/s) one of pair p, of body i or none, moves as that turns now."""
    if i < 0:
        return 0.0
    x, y, z = spin_of(i, turns, angular)
    return swing_of(p, side, x, y, z, numbers)
