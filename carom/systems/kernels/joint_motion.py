"""What impulses of joints do to both bodies, and how these move against each other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import slot
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import about, dot, three
from carom.systems.kernels.lanes import gather, spread
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT
from carom.systems.kernels.spatial import cross


@woven
def parting(r, a, b, lanes):
    """Return how fast b moves against a at the anchor of b, and how fast it turns."""
    ax, ay, az = three(lanes, r + of.ARM_A)
    bx, by, bz = three(lanes, r + of.ARM_B)
    px, py, pz = cross(a[4], a[5], a[6], ax, ay, az)
    qx, qy, qz = cross(b[4], b[5], b[6], bx, by, bz)
    along = (b[0] - a[0] + (qx - px), b[1] - a[1] + (qy - py), b[2] - a[2] + (qz - pz))
    return along, (b[4] - a[4], b[5] - a[5], b[6] - a[6])


@woven
def added(s, q, j, push, twist, lanes):
    """Return the push at the anchor and the twist with an impulse along or about way s more."""
    x, y, z = three(lanes, q + of.AXIS)
    if s < 3:
        return (push[0] + j * x, push[1] + j * y, push[2] + j * z), twist
    return push, (twist[0] + j * x, twist[1] + j * y, twist[2] + j * z)


@woven
def moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies):
    """Return the velocities after a push on b at its anchor and a twist, and their opposites on a."""
    mass, inverse = gather(bodies[MASS_AND_FELT], index_a, g), gather(bodies[INVERSE], index_a, g)
    a = moved_one(mass, inverse, r + of.ARM_A, -1.0, push, twist, a, lanes)
    mass, inverse = gather(bodies[MASS_AND_FELT], index_b, g), gather(bodies[INVERSE], index_b, g)
    return a, moved_one(mass, inverse, r + of.ARM_B, 1.0, push, twist, b, lanes)


@woven
def moved_one(mass, inverse, arm, sign, push, twist, v, lanes):
    """Return the velocity of a body after ``sign`` times a push at its arm and a twist."""
    x, y, z = three(lanes, arm)
    tx, ty, tz = cross(x, y, z, push[0], push[1], push[2])
    wx, wy, wz = about(inverse, tx + twist[0], ty + twist[1], tz + twist[2])
    return (
        v[0] + sign * mass[0] * push[0], v[1] + sign * mass[1] * push[1], v[2] + sign * mass[2] * push[2], v[3],
        v[4] + sign * wx, v[5] + sign * wy, v[6] + sign * wz, v[7],
    )  # fmt: skip


@woven
def turning_of(arm, inverse):
    """Return how fast a point at the end of an arm yields by turning alone: the lower half of a matrix."""
    x, y, z = arm
    zero = spread(0.0)
    of_x, of_y, of_z = (zero, z, -y), (-z, zero, x), (y, -x, zero)  # r x e
    by_x, by_y, by_z = about(inverse, zero, z, -y), about(inverse, -z, zero, x), about(inverse, y, -x, zero)
    return dot(of_x, by_x), dot(of_y, by_x), dot(of_y, by_y), dot(of_z, by_x), dot(of_z, by_y), dot(of_z, by_z)


@woven
def speed_of(s, r, a, b, lanes):
    """Return how fast b goes along or about way s."""
    along, turning = parting(r, a, b, lanes)
    return dot(three(lanes, slot(r, s) + of.AXIS), along if s < 3 else turning)


@woven
def borne(p, j, push, twist, lanes):
    """Return the push and the twist with an impulse of what bounds a way more, and what that asks of the locks."""
    x, y, z = three(lanes, p + of.PUSH)
    u, v, w = three(lanes, p + of.TWIST)
    return (
        (push[0] + j * x, push[1] + j * y, push[2] + j * z),
        (twist[0] + j * u, twist[1] + j * v, twist[2] + j * w),
    )


@woven
def given(g, r, p, j, a, b, index_a, index_b, lanes, bodies):
    """Return the velocities after an impulse of what bounds a way."""
    zero = spread(0.0)
    push, twist = borne(p, j, (zero, zero, zero), (zero, zero, zero), lanes)
    return moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies)
