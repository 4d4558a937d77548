"""Where joints are: the axes along and about which they hold, where b is on them, and how bodies yield there."""

from __future__ import annotations

from math import pi

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import CONES, KINDS, LINES, POINTS, slot
from carom.systems.kernels.joint_points import find_yielding_of_point, place_point
from carom.systems.kernels.joint_yielding import SCRATCH_ROWS, find_yielding
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_angles import arc_tangent, nearest_turn
from carom.systems.kernels.lane_vectors import TINY, dot, keep, three
from carom.systems.kernels.lanes import (
    WIDTH,
    address,
    choose,
    gather,
    larger,
    load,
    planes,
    root,
    smaller,
    spread,
    store,
)
from carom.systems.kernels.packing import POSE
from carom.systems.kernels.spatial import product, turn


@kernel("lanes", makes_arrays=True)
def measure_joints(weigh, groups, kinds, row, index_a, index_b, lanes, bodies):
    """Find the axes of joints where their bodies are now, where b is on them, and how bodies yield along them.

    ``weigh`` tells that masses are not those of the last time.
    """
    lanes, bodies, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    room = np.empty((SCRATCH_ROWS, WIDTH))
    scratch = address(room)
    for g in range(groups):
        r, kind, bounded = row[g], kinds[g] % KINDS, kinds[g] >= KINDS
        a, b = gather(bodies[POSE], index_a, g), gather(bodies[POSE], index_b, g)
        d = between(r, lanes, a, b)
        if kind == LINES:
            place_line(r, lanes, a, d)
            find_yielding(1, g, r, bounded, index_a, index_b, lanes, bodies, scratch)
        elif kind == POINTS:
            place_point(r, lanes, d)
            find_yielding_of_point(g, r, weigh, index_a, index_b, lanes, bodies)
        else:
            place_frame(r, kind, lanes, a, b, d)
            find_yielding(6, g, r, bounded, index_a, index_b, lanes, bodies, scratch)


@woven
def between(r, lanes, a, b):
    """Write the arms to the anchor of b, and return how far it is from that of a."""
    ax, ay, az = three(lanes, r + of.LEVER_A)
    ax, ay, az = turn(a[4], a[5], a[6], a[7], ax, ay, az)
    bx, by, bz = three(lanes, r + of.LEVER_B)
    bx, by, bz = turn(b[4], b[5], b[6], b[7], bx, by, bz)
    x, y, z = b[0] - a[0] + bx, b[1] - a[1] + by, b[2] - a[2] + bz
    keep(lanes, r + of.ARM_A, x, y, z)  # so that what b gets a loses about any point
    keep(lanes, r + of.ARM_B, bx, by, bz)
    return x - ax, y - ay, z - az


@woven
def place_line(r, lanes, a, d):
    """Measure along the line between the anchors; where they meet, along the one of before."""
    q = slot(r, 0)
    x, y, z = three(lanes, q + of.AXIS)
    length = root(dot(d, d))
    there = length - TINY
    scale = 1.0 / larger(length, spread(TINY))
    keep(
        lanes,
        q + of.AXIS,
        choose(there, d[0] * scale, x),
        choose(there, d[1] * scale, y),
        choose(there, d[2] * scale, z),
    )
    store(lanes, q + of.PLACE, length)


@woven
def place_frame(r, kind, lanes, a, b, d):
    """Measure along the axes of a's frame, and about those of both."""
    fx, fy, fz = three(lanes, r + of.FRAME_A)
    px, py, pz, pw = product(a[4], a[5], a[6], a[7], fx, fy, fz, load(lanes, r + of.FRAME_A + 3))
    fx, fy, fz = three(lanes, r + of.FRAME_B)
    qx, qy, qz, qw = product(b[4], b[5], b[6], b[7], fx, fy, fz, load(lanes, r + of.FRAME_B + 3))
    x, y, z = axes_of(px, py, pz, pw)
    for s in range(3):
        axis = x if s == 0 else y if s == 1 else z
        keep(lanes, slot(r, s) + of.AXIS, axis[0], axis[1], axis[2])
        store(lanes, slot(r, s) + of.PLACE, dot(axis, d))
    qx, qy, qz, qw = product(-px, -py, -pz, pw, qx, qy, qz, qw)  # from b's frame to a's
    if kind == CONES:
        place_cone(r, lanes, x, y, z, qx, qy, qz, qw)
    else:
        place_angles(r, lanes, x, y, z, qx, qy, qz, qw)


@woven
def axes_of(x, y, z, w):
    """Return the axes of a frame that is turned by a unit quaternion."""
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
        (2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
        (2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
    )


@woven
def place_angles(r, lanes, x, y, z, qx, qy, qz, qw):
    """Measure turns as angles about x, then y, then z; an axis here is that whose angular velocity is the angle's rate.

    They are the basis dual to x of a, y between the turns and z of b (Goldstein, Classical Mechanics, 4.9). Unless y is
    locked, it is that of the two ways to turn there which goes on where angles were before, also beyond a quarter turn
    about y, at which x and z are one. Their axes grow without end there: of those that are locked then, less is taken.
    """
    u, v, w = axes_of(qx, qy, qz, qw)
    level = root(u[0] * u[0] + v[0] * v[0])  # cosine of the second angle
    first, second, third = arc_tangent(-w[1], w[2]), arc_tangent(w[0], level), arc_tangent(-v[0], u[0])
    near = way_to(r, lanes, first, second, third)
    bends = spread(1.0) - load(lanes, slot(r, 4) + of.HELD)
    over = choose(near - way_to(r, lanes, first + pi, pi - second, third + pi), bends, spread(0.0))
    store_angle(r, 3, lanes, choose(over, first + pi, first))
    store_angle(r, 4, lanes, choose(over, pi - second, second))
    store_angle(r, 5, lanes, choose(over, third + pi, third))
    level = choose(over, -level, level)
    inverse = choose(over, spread(-1.0), spread(1.0)) / larger(larger(level, -level), spread(1e-6))
    s, c, tangent = -w[1] * inverse, w[2] * inverse, w[0] * inverse
    level, sine = choose(bends, level, spread(1.0)), bends * w[0]
    (of_x, by_x), (of_z, by_z) = lengths_of(r, 3, lanes, level, sine), lengths_of(r, 5, lanes, level, sine)
    keep_turned(r, 3, lanes, x, y, z, of_x, of_x * (tangent * s) - by_x * c, -(of_x * (tangent * c)) - by_x * s)
    keep_turned(r, 4, lanes, x, y, z, spread(0.0), c, s)
    keep_turned(r, 5, lanes, x, y, z, spread(0.0), -(of_z * (s * inverse)) - by_z * c, of_z * (c * inverse) - by_z * s)
    store(lanes, r + of.LEVEL, level)


@woven
def lengths_of(r, s, lanes, level, sine):
    """Return how much of the axis of way s, and of that about which the second turn is, is to be taken.

    A lock of way s by the angle e off holds sin(e) cos(second) at 0, as what it is off by is noise where the cosine is.
    """
    q, one = slot(r, s), spread(1.0)
    off = larger(-one, smaller(one, load(lanes, q + of.PLACE) - load(lanes, q + of.AT)))
    held = load(lanes, q + of.HELD)
    return choose(held, level, one), held * (sine * off)


@woven
def way_to(r, lanes, first, second, third):
    """Return how far three angles are from those of before, but for whole turns, altogether."""
    total = spread(0.0)
    for s, angle in ((3, first), (4, second), (5, third)):
        before = load(lanes, slot(r, s) + of.PLACE)
        off = nearest_turn(angle, before) - before
        total = total + larger(off, -off)
    return total


@woven
def place_cone(r, lanes, x, y, z, qx, qy, qz, qw):
    """Measure the twist about x, and the angle between both x axes."""
    store(lanes, r + of.LEVEL, spread(1.0))
    off, along = root(qy * qy + qz * qz), root(qx * qx + qw * qw)
    store_angle(r, 3, lanes, 2.0 * arc_tangent(qx, qw))
    store(lanes, slot(r, 4) + of.PLACE, 2.0 * arc_tangent(off, along))
    store(lanes, slot(r, 5) + of.PLACE, spread(0.0))
    (ux, uy, uz), _, _ = axes_of(qx, qy, qz, qw)  # x of b, in the frame of a
    half = 1.0 / larger(1.0 + ux, spread(1e-6))
    keep_turned(r, 3, lanes, x, y, z, spread(1.0), uy * half, uz * half)
    sine = root(uy * uy + uz * uz)
    swings, scale = sine - TINY, 1.0 / larger(sine, spread(TINY))
    v, w = choose(swings, -(uz * scale), spread(1.0)), choose(swings, uy * scale, spread(0.0))
    keep_turned(r, 4, lanes, x, y, z, spread(0.0), v, w)
    keep_turned(r, 5, lanes, x, y, z, spread(0.0), -w, v)  # square to both, for friction alone


@woven
def store_angle(r, s, lanes, angle):
    """Write an angle that goes on where it was before."""
    q = slot(r, s) + of.PLACE
    store(lanes, q, nearest_turn(angle, load(lanes, q)))


@woven
def keep_turned(r, s, lanes, x, y, z, u, v, w):
    """Write an axis that is (u, v, w) in the frame x, y, z."""
    keep(
        lanes, slot(r, s) + of.AXIS,
        u * x[0] + v * y[0] + w * z[0], u * x[1] + v * y[1] + w * z[1], u * x[2] + v * y[2] + w * z[2],
    )  # fmt: skip
