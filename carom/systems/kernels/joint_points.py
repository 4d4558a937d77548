"""Joints that lock a point along all three axes of the world and nothing else: the most of them, with nothing general.

What `find_yielding` and `hold` do for any axes is done here for those of the world, to the same bits.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import IMMOVABLE
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import factor, slot
from carom.systems.kernels.joint_motion import turning_of
from carom.systems.kernels.joint_whirling import going_back
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import about, three
from carom.systems.kernels.lanes import choose, gather, load, spread, store
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT
from carom.systems.kernels.spatial import cross

WAYS = 3


@woven
def place_point(r, lanes, d):
    """Write where b is; the axes have been written once."""
    for s in range(WAYS):
        store(lanes, slot(r, s) + of.PLACE, d[s])


@woven
def find_yielding_of_point(g, r, weigh, index_a, index_b, lanes, bodies):
    """Factor the matrix of how fast the point yields to unit impulses; ``weigh`` bodies whose masses are not known."""
    inert = factor(r, WAYS, WAYS, 0)
    if weigh:
        mass_a, mass_b = gather(bodies[MASS_AND_FELT], index_a, g), gather(bodies[MASS_AND_FELT], index_b, g)
        for k in range(3):
            store(lanes, inert + of.MASS_A + k, mass_a[k])
            store(lanes, inert + of.MASS_B + k, mass_b[k])
    mass_a, mass_b = three(lanes, inert + of.MASS_A), three(lanes, inert + of.MASS_B)
    inverse_a, inverse_b = gather(bodies[INVERSE], index_a, g), gather(bodies[INVERSE], index_b, g)
    a, b = turning_of(three(lanes, r + of.ARM_A), inverse_a), turning_of(three(lanes, r + of.ARM_B), inverse_b)
    for k in range(6):
        store(lanes, inert + of.INVERSE_A + k, inverse_a[k])
        store(lanes, inert + of.INVERSE_B + k, inverse_b[k])
    xx, yy, zz = a[0] + b[0] + (mass_a[0] + mass_b[0]), a[2] + b[2] + (mass_a[1] + mass_b[1]), a[5] + b[5]
    zz = zz + (mass_a[2] + mass_b[2])
    yx, zx, zy = a[1] + b[1], a[3] + b[3], a[4] + b[4]
    d, x = pivot(xx, xx)
    low_yx, low_zx = yx * x, zx * x
    e, y = pivot(yy, yy - low_yx * low_yx * d)
    low_zy = (zy - low_zx * low_yx * d) * y
    _, z = pivot(zz, zz - low_zx * low_zx * d - low_zy * low_zy * e)
    o = factor(r, WAYS, 0, 0)
    for k, value in enumerate((x, low_yx, y, low_zx, low_zy, z)):
        store(lanes, o + k, value)


@woven
def pivot(whole, left):
    """Return a pivot and its inverse, both 0 where it is rounding."""
    solid = choose(left - whole * IMMOVABLE, spread(1.0), spread(0.0))
    return left * solid, solid / choose(solid, left, spread(1.0))


@woven
def hold_point(r, rate, hardness, a, b, lanes):
    """Solve all three ways at once; return the push on b at its anchor."""
    px, py, pz = parting_of_point(r, a, b, lanes)
    x, y, z = three_of(r, lanes, of.PLACE)
    x = -(px + going_back(r, rate * x, lanes))
    y = -(py + going_back(r, rate * y, lanes))
    z = -(pz + going_back(r, rate * z, lanes))
    o = factor(r, WAYS, 0, 0)
    low_yx, low_zx, low_zy = load(lanes, o + 1), load(lanes, o + 3), load(lanes, o + 4)
    y = y - low_yx * x
    z = (z - low_zx * x - low_zy * y) * load(lanes, o + 5)
    y = y * load(lanes, o + 2) - low_zy * z
    x = x * load(lanes, o) - low_yx * y - low_zx * z
    bx, by, bz = three_of(r, lanes, of.HOLD)
    soft = 1.0 - hardness
    x, y, z = hardness * x - soft * bx, hardness * y - soft * by, hardness * z - soft * bz
    for s, value in enumerate((bx + x, by + y, bz + z)):
        store(lanes, slot(r, s) + of.HOLD, value)
    return x, y, z


@woven
def moved_point(r, push, a, b, lanes):
    """Return the velocities after a push on b at its anchor, and its opposite on a."""
    inert = factor(r, WAYS, WAYS, 0)
    a = pushed(inert + of.MASS_A, inert + of.INVERSE_A, r + of.ARM_A, -1.0, push, a, lanes)
    return a, pushed(inert + of.MASS_B, inert + of.INVERSE_B, r + of.ARM_B, 1.0, push, b, lanes)


@woven
def pushed(masses, inverses, arm, sign, push, v, lanes):
    """Return the velocity of a body after ``sign`` times a push at its arm."""
    mx, my, mz = three(lanes, masses)
    x, y, z = three(lanes, arm)
    x, y, z = cross(x, y, z, push[0], push[1], push[2])
    wx, wy, wz = about((*three(lanes, inverses), *three(lanes, inverses + 3)), x, y, z)
    return (
        v[0] + sign * mx * push[0], v[1] + sign * my * push[1], v[2] + sign * mz * push[2], v[3],
        v[4] + sign * wx, v[5] + sign * wy, v[6] + sign * wz, v[7],
    )  # fmt: skip


@woven
def finish_point(r, a, b, lanes):
    """Note how fast each way goes, and add the impulses of the substep to those of the step."""
    for s, value in enumerate(parting_of_point(r, a, b, lanes)):
        q = slot(r, s)
        store(lanes, q + of.SPEED, value)
        store(lanes, q + of.SUM, load(lanes, q + of.SUM) + load(lanes, q + of.HOLD))


@woven
def parting_of_point(r, a, b, lanes):
    """Return how fast b moves against a at the anchor of b."""
    ax, ay, az = three(lanes, r + of.ARM_A)
    bx, by, bz = three(lanes, r + of.ARM_B)
    px, py, pz = cross(a[4], a[5], a[6], ax, ay, az)
    qx, qy, qz = cross(b[4], b[5], b[6], bx, by, bz)
    return b[0] - a[0] + (qx - px), b[1] - a[1] + (qy - py), b[2] - a[2] + (qz - pz)


@woven
def three_of(r, lanes, row):
    """Return the same row of all three ways."""
    return load(lanes, slot(r, 0) + row), load(lanes, slot(r, 1) + row), load(lanes, slot(r, 2) + row)
