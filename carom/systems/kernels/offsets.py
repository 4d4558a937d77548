"""Where contacts are from the centres of mass of their bodies, and with whose surface their points go."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import LEANING
from carom.systems.kernels.frames import turned_back
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE


@woven
def find_offsets(first, end, a, b, normal, depth, point, body_row, pose_position, center, offset_a, offset_b):
    """Write where the contacts of colliders a and b are from both bodies."""
    ax, ay, az = seat_of(a, body_row[a], center, pose_position)
    bx, by, bz = seat_of(b, body_row[b], center, pose_position)
    for c in range(first, end):
        x, y, z, half = normal[c, 0], normal[c, 1], normal[c, 2], 0.5 * depth[c]
        x, y, z = half * x, half * y, half * z
        px, py, pz = point[c, 0], point[c, 1], point[c, 2]
        offset_a[c, 0], offset_a[c, 1], offset_a[c, 2] = px + x - ax, py + y - ay, pz + z - az
        offset_b[c, 0], offset_b[c, 1], offset_b[c, 2] = px - x - bx, py - y - by, pz - z - bz


@woven
def find_shares(first, end, a, b, normal, shape, pose_rotation, share):
    """Write how much the contact points of colliders a and b go with b."""
    for c in range(first, end):
        if c > first and is_alike(c, c - 1, normal):
            share[c] = share[c - 1]
        else:
            flat_a, flat_b = is_flat(a, c, normal, shape, pose_rotation), is_flat(b, c, normal, shape, pose_rotation)
            share[c] = share_of_b(flat_a, flat_b)


@woven
def seat_of(i, body, center, pose_position):
    """Return what offsets of a collider's contacts begin at: its body's centre of mass, or its own origin."""
    if body >= 0:
        return center[body, 0], center[body, 1], center[body, 2]
    return pose_position[i, 0], pose_position[i, 1], pose_position[i, 2]


@woven
def is_alike(c, o, column):
    """Tell whether two contacts have the same vector there."""
    return column[c, 0] == column[o, 0] and column[c, 1] == column[o, 1] and column[c, 2] == column[o, 2]


@woven
def share_of_b(flat_a, flat_b):
    """Return how much a point goes with b rather than with a, over whose faces it glides where those are ``flat``."""
    share = 0.5
    if flat_a:
        share += 0.5
    if flat_b:
        share -= 0.5
    return share


@woven
def is_flat(i, c, normal, shape, pose_rotation):
    """Tell whether a collider turns a face to contact c, over which its point glides."""
    if shape[i] != BOX_SHAPE:
        return shape[i] == PLANE_SHAPE
    x, y, z = turned_back(pose_rotation, i, normal[c, 0], normal[c, 1], normal[c, 2])
    return is_along_axis(x, y, z)


@woven
def is_flat_where_seated(i, c, lean, shape):
    """Tell whether collider i turns a face to contact c, whose normal ``lean`` has in its frame."""
    return shape[i] == PLANE_SHAPE or (shape[i] == BOX_SHAPE and is_along_axis(lean[c, 0], lean[c, 1], lean[c, 2]))


@woven
def is_along_axis(x, y, z):
    """Tell whether a unit vector is along one of the axes."""
    x, y, z = x * x, y * y, z * z
    return x + y + z - max(x, y, z) <= LEANING * LEANING
