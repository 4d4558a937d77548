"""Packing: what the resting stage knows of bodies, in planes of rows that lanes are gathered from."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import STALE_TURN
from carom.systems.kernels.crew import eights_of, shared
from carom.systems.kernels.freedom import inverse_inertia_of
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lane_columns import are_all, in_a_row, take_four, take_freedom, take_one, take_three
from carom.systems.kernels.lane_widths import BLOCK, PLANES
from carom.systems.kernels.lanes import WIDTH, address, choose, gather_four, larger, planes, scatter, some, spread
from carom.systems.kernels.spatial import inverse_inertia_in_world, product

# The planes, each of eight numbers a body: what one sweep reads of neighbours lies side by side.
# Velocity: linear (3), inverse mass, angular (3), inverse inertia about the first axis, which for balls is that about
# all. The way since contacts were measured: linear (3), 1 if it is kinematic and turned, else 0, angular (3), a gap.
# Inverse inertia in the world frame: upper half (6), the largest moment. Inverse mass along the axes (3), acceleration
# by forces (3), inverse mass without locks. Until it sets out, the way gives place to the pose: centre (3), a gap,
# rotation (4); and while arcs are bent, to what velocities have changed by (3).
VELOCITY, WAY, INVERSE, MASS_AND_FELT = range(PLANES)
CENTER = POSE = CHANGE = WAY
FELT = 3  # where what forces do begins
INVERSE_MASS, ANGULAR, EVEN_INERTIA = 3, 4, 7  # where what is angular begins, and what velocities lie beside
DRIVEN = 3  # what the way lies beside


@kernel("found", makes_arrays=True)
def find_bound(rows, nobody, groups, index_a, index_b, joint_groups, joint_a, joint_b, found):
    """Write which bodies among ``rows`` contacts or joints in groups are of; return how many they are."""
    bound, count = np.zeros(nobody + 1, np.bool_), 0
    for many, of_a, of_b in ((groups, index_a, index_b), (joint_groups, joint_a, joint_b)):
        for g in range(many):
            for lane in range(WIDTH):
                bound[of_a[g, lane]] = bound[of_b[g, lane]] = True
    for i in rows:
        if bound[i]:
            found[count] = i
            count += 1
    return count


@shared("bodies", "apart", makes_arrays=True)
def pack_bodies(
    crew, rows, weigh, center_of_mass, center, linear, angular, felt,
    inverse_mass, inverse_inertia, principal, freedom, rotation, bodies, apart,
):  # fmt: skip
    """Write where bodies are, their velocities, inverse masses and inertias; the world is at its origin.

    Without ``weigh`` masses are what they were, as is inertia that is even, and nobody asks for what forces do.
    Tell in ``apart``, of which each thread has one, whether a centre of mass is not at the origin.
    """
    nobody = bodies.shape[1] - 1
    for plane in range(PLANES):
        for k in range(BLOCK):
            bodies[plane, nobody, k] = 0.0
    bodies[POSE, nobody, BLOCK - 1] = 1.0
    index, packed, zero, centred = np.empty((1, WIDTH), np.int64), planes(bodies), spread(0.0), True
    one, three, four, six = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 4)), np.empty((WIDTH, 6))
    begin, end = eights_of(crew, len(rows))
    rows = rows[begin:end]
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        for lane in range(WIDTH):  # the last again where there are fewer, as `take_one` reads them
            index[0, lane] = rows[min(n + lane, len(rows) - 1)]
        v, w = take_three(linear, rows, n, near, three), take_three(angular, rows, n, near, three)
        if centred and not (near and are_all(0.0, center_of_mass, 3, rows[n])):
            x, y, z = take_three(center_of_mass, rows, n, near, three)
            centred = not some(larger(larger(larger(x, -x), larger(y, -y)), larger(z, -z)))
        c, q = take_three(center, rows, n, near, three), take_four(rotation, rows, n, near, four)
        scatter(packed[POSE], address(index), 0, (c[0], c[1], c[2], zero, q[0], q[1], q[2], q[3]))
        m = take_one(inverse_mass, rows, n, near, one)
        ix, iy, iz = take_three(inverse_inertia, rows, n, near, three)
        scatter(packed[VELOCITY], address(index), 0, (v[0], v[1], v[2], m, w[0], w[1], w[2], ix))
        uneven = larger(larger(ix - iy, iy - ix), larger(iy - iz, iz - iy))
        turns = some(uneven)
        if not (weigh or turns):
            continue
        free = take_freedom(freedom, rows, n, near, six)
        if weigh:
            f = take_three(felt, rows, n, near, three)
            masses = (m * free[0], m * free[1], m * free[2], f[0], f[1], f[2], m, zero)
            scatter(packed[MASS_AND_FELT], address(index), 0, masses)
        inverse = (ix * free[3], zero, zero, ix * free[4], zero, ix * free[5])
        if turns:
            a = take_four(principal, rows, n, near, four)
            inverse = inverse_of(q, a, ix, iy, iz, uneven, inverse)
        xx, xy, xz, yy, yz, zz = inverse
        scatter(packed[INVERSE], address(index), 0, (xx, xy, xz, yy, yz, zz, larger(larger(ix, iy), iz), zero))
        if turns and some(choose(uneven, 3.0 - (free[3] + free[4] + free[5]), zero)):
            for i in index[0]:
                pack_held(i, inverse_inertia, principal, freedom, rotation, bodies)
    apart[crew[1]] = not centred


@woven
def inverse_of(q, axes, ix, iy, iz, uneven, even):
    """Return the inverse inertia of eight bodies turned to q in the world, as `held_inverse`, where it is not even."""
    qx, qy, qz, qw = product(q[0], q[1], q[2], q[3], axes[0], axes[1], axes[2], axes[3])
    xx, xy, xz, yy, yz, zz = inverse_inertia_in_world(qx, qy, qz, qw, ix, iy, iz)
    return (
        choose(uneven, xx, even[0]), choose(uneven, xy, even[1]), choose(uneven, xz, even[2]),
        choose(uneven, yy, even[3]), choose(uneven, yz, even[4]), choose(uneven, zz, even[5]),
    )  # fmt: skip


@inlined
def pack_held(i, inverse_inertia, principal, freedom, rotation, bodies):
    """Write the inverse inertia of a body, which may have locked axes of rotation."""
    inverse = inverse_inertia_of(i, inverse_inertia, principal, freedom, rotation)
    for k, value in enumerate(inverse):
        bodies[INVERSE, i, k] = value


@woven
def felt_of(plane, index, g):
    """Return the acceleration by forces of the bodies of a group."""
    return gather_four(plane, index, g, FELT)[:3]


@kernel()
def are_placed(rows, center, rotation, bodies):
    """Tell whether bodies are where they were packed."""
    for i in rows:
        for k in range(3):
            if bodies[CENTER, i, k] != center[i, k]:
                return False
        for k in range(4):
            if bodies[POSE, i, ANGULAR + k] != rotation[i, k]:
                return False
    return True


@kernel("bodies")
def pack_moving(rows, linear, angular, felt, bodies):
    """Write the velocities of bodies and what they feel, which are where they were packed."""
    for i in rows:
        for k in range(3):
            bodies[VELOCITY, i, k], bodies[VELOCITY, i, ANGULAR + k] = linear[i, k], angular[i, k]
            bodies[MASS_AND_FELT, i, FELT + k] = felt[i, k]


@kernel("velocity")
def pack_velocities(rows, linear, angular, velocity):
    """Write the velocities of bodies into their plane."""
    write_velocities(rows, linear, angular, velocity)


@woven
def write_velocities(rows, linear, angular, velocity):
    """Do what `pack_velocities` does, within a kernel."""
    for i in rows:  # all is read before any of it is written, which goes two by two then
        v, w = first_three(i, linear), first_three(i, angular)
        velocity[i, 0], velocity[i, 1], velocity[i, 2] = v
        velocity[i, ANGULAR], velocity[i, ANGULAR + 1], velocity[i, ANGULAR + 2] = w


@woven
def read_velocities(rows, velocity, linear, angular):
    """Read the velocities of bodies back."""
    for i in rows:
        x, y, z = first_three(i, velocity)
        u, v, w = velocity[i, ANGULAR], velocity[i, ANGULAR + 1], velocity[i, ANGULAR + 2]
        linear[i, 0], linear[i, 1], linear[i, 2] = x, y, z
        angular[i, 0], angular[i, 1], angular[i, 2] = u, v, w


@woven
def first_three(i, column):
    """Return the first three numbers of a row."""
    return column[i, 0], column[i, 1], column[i, 2]


@woven
def write_ways(rows, start_center, center, turned, inverse_mass, bodies):
    """Write how far bodies have moved and turned since their contacts were measured."""
    for k in range(BLOCK):
        bodies[WAY, bodies.shape[1] - 1, k] = 0.0
    for i in rows:
        for k in range(3):
            bodies[WAY, i, k], bodies[WAY, i, ANGULAR + k] = center[i, k] - start_center[i, k], turned[i, k]
        turns = turned[i, 0] != 0.0 or turned[i, 1] != 0.0 or turned[i, 2] != 0.0
        bodies[WAY, i, DRIVEN] = turns and inverse_mass[i] == 0.0


@woven
def weigh_anew(rows, turned, inverse_inertia, principal, freedom, rotation, bodies):
    """Write the inverse inertia of bodies that have turned by more than STALE_TURN.

    As it was it would not fit where contacts are by now: what presses on an axis would turn a rod about that.
    """
    for i in rows:
        x, y, z = first_three(i, turned)
        if x * x + y * y + z * z > STALE_TURN * STALE_TURN:
            ix, iy, iz = first_three(i, inverse_inertia)
            if not (ix == iy and iy == iz):
                pack_held(i, inverse_inertia, principal, freedom, rotation, bodies)
