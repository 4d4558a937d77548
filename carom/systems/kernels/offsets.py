"""Where contacts are from the centres of mass of their bodies."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import woven


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
def seat_of(i, body, center, pose_position):
    """Return what offsets of a collider's contacts begin at: its body's centre of mass, or its own origin."""
    if body >= 0:
        return center[body, 0], center[body, 1], center[body, 2]
    return pose_position[i, 0], pose_position[i, 1], pose_position[i, 2]


@woven
def is_alike(c, o, column):
    """Tell whether two contacts have the same vector there."""
    return column[c, 0] == column[o, 0] and column[c, 1] == column[o, 1] and column[c, 2] == column[o, 2]
