"""Gap of a ball to another ball, a box or a half space, and the exact time at which it closes."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ROOT_GAP, ROOT_STEPS
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.spatial import cross, spun, turn

BALL, BOX, HALF_SPACE = 0, 1, 2
NEVER = 1e300


@woven
def gap_of_balls(dx, dy, dz, reach):
    """Return (gap, normal) between two balls, the first at d from the other, whose radii make up ``reach``."""
    distance = sqrt(dx * dx + dy * dy + dz * dz)
    if distance == 0.0:
        return -reach, 0.0, 1.0, 0.0  # concentric: any direction parts them equally fast
    inverse = 1.0 / distance
    return distance - reach, dx * inverse, dy * inverse, dz * inverse


@inlined
def gap_of_ball(kind, x, y, z, radius, ox, oy, oz, qx, qy, qz, qw, ex, ey, ez):
    """Return (gap, normal) between a ball at x and another body at o; the unit normal points from that to the ball.

    ``kind`` says how to read the extent e: BALL (radius, -, -), BOX (half edges, turned by q), HALF_SPACE (normal).
    """
    dx, dy, dz = x - ox, y - oy, z - oz
    if kind == HALF_SPACE:
        return ex * dx + ey * dy + ez * dz - radius, ex, ey, ez
    if kind == BALL:
        return gap_of_balls(dx, dy, dz, radius + ex)
    lx, ly, lz = turn(-qx, -qy, -qz, qw, dx, dy, dz)
    cx, cy, cz = min(max(lx, -ex), ex), min(max(ly, -ey), ey), min(max(lz, -ez), ez)
    nx, ny, nz = lx - cx, ly - cy, lz - cz
    squared = nx * nx + ny * ny + nz * nz
    if squared > 0.0:
        distance = sqrt(squared)
        nx, ny, nz = turn(qx, qy, qz, qw, nx / distance, ny / distance, nz / distance)
        return distance - radius, nx, ny, nz
    sx, sy, sz = ex - abs(lx), ey - abs(ly), ez - abs(lz)  # centre inside: out by the nearest face
    if sx <= sy and sx <= sz:
        nx, ny, nz, distance = (1.0 if lx >= 0.0 else -1.0), 0.0, 0.0, -sx
    elif sy <= sz:
        nx, ny, nz, distance = 0.0, (1.0 if ly >= 0.0 else -1.0), 0.0, -sy
    else:
        nx, ny, nz, distance = 0.0, 0.0, (1.0 if lz >= 0.0 else -1.0), -sz
    nx, ny, nz = turn(qx, qy, qz, qw, nx, ny, nz)
    return distance - radius, nx, ny, nz


@inlined
def first_touch(
    kind, x, y, z, radius, vx, vy, vz, ax, ay, az,
    ox, oy, oz, qx, qy, qz, qw, ex, ey, ez, ux, uy, uz, bx, by, bz, wx, wy, wz,
    bend, horizon,
):  # fmt: skip
    """Return the seconds until the gap closes, or NEVER within ``horizon``.

    Both bodies move on arcs p + v t + bend a t^2, the other one also turns at w. The gap to a convex body curves down
    at most by the relative acceleration (and what turning adds), so that the parabola with that curvature meets zero
    no later than the gap itself: its root is a safe step, and Newton's method where it matters. For a half space the
    parabola is the gap.
    """
    rax, ray, raz = 2.0 * bend * (ax - bx), 2.0 * bend * (ay - by), 2.0 * bend * (az - bz)
    turning = sqrt(wx * wx + wy * wy + wz * wz)
    t = 0.0
    for _ in range(ROOT_STEPS):
        curve = bend * t * t
        px, py, pz = x + vx * t + ax * curve, y + vy * t + ay * curve, z + vz * t + az * curve
        cx, cy, cz = ox + ux * t + bx * curve, oy + uy * t + by * curve, oz + uz * t + bz * curve
        rx, ry, rz, rw = qx, qy, qz, qw
        if turning > 0.0:
            rx, ry, rz, rw = spun(qx, qy, qz, qw, wx, wy, wz, t)
        gap, nx, ny, nz = gap_of_ball(kind, px, py, pz, radius, cx, cy, cz, rx, ry, rz, rw, ex, ey, ez)
        sx, sy, sz = vx - ux + rax * t, vy - uy + ray * t, vz - uz + raz * t
        reach = gap + radius
        curvature = sqrt(rax * rax + ray * ray + raz * raz)
        if turning > 0.0:
            tx, ty, tz = cross(wx, wy, wz, px - nx * reach - cx, py - ny * reach - cy, pz - nz * reach - cz)
            sx, sy, sz = sx - tx, sy - ty, sz - tz
            lever = sqrt(ex * ex + ey * ey + ez * ez) + abs(reach)
            curvature += turning * (turning * lever + 2.0 * sqrt(sx * sx + sy * sy + sz * sz))
        if kind == HALF_SPACE:
            curvature = -(nx * rax + ny * ray + nz * raz)
        slope = nx * sx + ny * sy + nz * sz
        if gap <= ROOT_GAP and slope < 0.0:
            return t
        gap = max(gap, 0.0)
        inside = slope * slope + 2.0 * curvature * gap
        if inside < 0.0:
            return NEVER
        if slope < 0.0:
            step = 2.0 * gap / (sqrt(inside) - slope)
        elif curvature > 0.0:
            step = (slope + sqrt(inside)) / curvature
        else:
            return NEVER
        t += step
        if t > horizon:
            return NEVER
        if step < 1e-16 * horizon:
            return t
    return t


@inlined
def pose_of_other(p, o, center, rotation, other_position, other_rotation):
    """Return where what a ball of pair p meets is and how it is turned: body o, or, with o < 0, what stands there."""
    if o >= 0:
        return (
            center[o, 0], center[o, 1], center[o, 2],
            rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3],
        )  # fmt: skip
    return (
        other_position[p, 0], other_position[p, 1], other_position[p, 2],
        other_rotation[p, 0], other_rotation[p, 1], other_rotation[p, 2], other_rotation[p, 3],
    )  # fmt: skip
