"""Accounting: what arcs and impulses do to the energy of bodies.

An impulse J changes kinetic energy by J.(v + v')/2, of the velocities before and after all that acts with it; so what
each of many adds to it is exact, whatever the others are.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.going_along import as_set_out
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.impulses import rolled, struck
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lane_vectors import dot, keep, minus, three
from carom.systems.kernels.lanes import address, gather, load, planes, spread, store
from carom.systems.kernels.levers import frame_of
from carom.systems.kernels.packing import VELOCITY
from carom.systems.kernels.resting_balls import struck_balls
from carom.systems.kernels.rubbing import BALLS, IDLE, ROLLING, TWISTING
from carom.systems.kernels.spatial import product, turn

#: Where a body was and how it moved when a part of its arc began: position, velocity, angular velocity, rotation.
KEPT = 13
#: What the parts of an arc add up to: the work of what bends it beside forces (J), the work of forces less that along
#: the way they took (J), what free turning gained (J), and angular momentum times time (3), which turning pushes meet.
BENT, STRAYED, TURNED, SWEPT, ARC = 0, 1, 2, 3, 6


@inlined
def angular_momentum(i, qx, qy, qz, qw, wx, wy, wz, inertia, principal):
    """Return I w of body i turned to q."""
    qx, qy, qz, qw = product(
        qx, qy, qz, qw, principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3]
    )  # fmt: skip
    x, y, z = turn(-qx, -qy, -qz, qw, wx, wy, wz)
    return turn(qx, qy, qz, qw, inertia[i, 0] * x, inertia[i, 1] * y, inertia[i, 2] * z)


@inlined
def kinetic_energy(i, linear, angular, rotation, inverse_mass, inertia, principal):
    """Return the energy of motion and rotation of body i; of what no impulse moves, 0."""
    if i < 0 or inverse_mass[i] == 0.0:
        return 0.0
    wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
    x, y, z = angular_momentum(
        i, rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], wx, wy, wz, inertia, principal
    )
    moving = linear[i, 0] * linear[i, 0] + linear[i, 1] * linear[i, 1] + linear[i, 2] * linear[i, 2]
    return 0.5 * (moving / inverse_mass[i] + x * wx + y * wy + z * wz)


@inlined
def keep_arc(i, lane, kept, center, linear, angular, rotation):
    """Keep where body i is, before it goes on along its arc."""
    for k in range(3):
        kept[lane, k], kept[lane, 3 + k], kept[lane, 6 + k] = center[i, k], linear[i, k], angular[i, k]
    for k in range(4):
        kept[lane, 9 + k] = rotation[i, k]


@inlined
def note_arc(
    i, lane, t, bend, kept, center, rotation, linear, angular, acceleration, angular_acceleration,
    inverse_mass, inertia, principal, pull, arc,
):  # fmt: skip
    """Add up what body i's arc has done in the ``t`` seconds since `keep_arc`; forces accelerate it by ``pull``."""
    if inverse_mass[i] == 0.0:
        return
    bx, by, bz = angular_acceleration[i, 0] * t, angular_acceleration[i, 1] * t, angular_acceleration[i, 2] * t
    qx, qy, qz, qw = kept[lane, 9], kept[lane, 10], kept[lane, 11], kept[lane, 12]
    wx, wy, wz = kept[lane, 6], kept[lane, 7], kept[lane, 8]
    half = 0.5 * bend
    x, y, z = angular_momentum(i, qx, qy, qz, qw, wx + half * bx, wy + half * by, wz + half * bz, inertia, principal)
    for k, swept in enumerate((x, y, z)):
        arc[i, SWEPT + k] += bend * t * swept
    wx, wy, wz = wx + bend * bx, wy + bend * by, wz + bend * bz
    x, y, z = angular_momentum(i, qx, qy, qz, qw, wx, wy, wz, inertia, principal)
    before = x * wx + y * wy + z * wz
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
    half = 0.5 * (1.0 - bend)
    x, y, z = angular_momentum(i, qx, qy, qz, qw, wx - half * bx, wy - half * by, wz - half * bz, inertia, principal)
    for k, swept in enumerate((x, y, z)):
        arc[i, SWEPT + k] += (1.0 - bend) * t * swept
    rest = 1.0 - bend
    wx, wy, wz = wx - rest * bx, wy - rest * by, wz - rest * bz
    x, y, z = angular_momentum(i, qx, qy, qz, qw, wx, wy, wz, inertia, principal)
    arc[i, TURNED] += 0.5 * (x * wx + y * wy + z * wz - before)
    for k in range(3):
        way = 0.5 * (kept[lane, 3 + k] + linear[i, k]) * t  # what the mean velocity makes of the time
        arc[i, BENT] += (acceleration[i, k] - pull[i, k]) * way / inverse_mass[i]
        arc[i, STRAYED] += pull[i, k] * (way - (center[i, k] - kept[lane, k])) / inverse_mass[i]


@kernel("earlier")
def count_from(groups, points, row, asks, lanes, earlier):
    """Write what impulses of a substep are counted from as it begins: from none.

    Those of the substep before are applied as they were then (`as_set_out`): by how much that is more along the
    tangents stands beside them.
    """
    lanes, earlier = address(lanes), address(earlier)
    for g in range(groups):
        if asks[g] == IDLE or asks[g] == BALLS:
            continue
        r, total = row[g], spread(0.0)
        for p in range(points[g]):
            total = total + load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.WARM)
        (t, u, _), f = frame_of(r, lanes), three(lanes, r + of.RUB)
        along, across = as_set_out(r, dot(t, f), dot(u, f), total, lanes)
        x, y, z = minus(three(lanes, r + of.LAG), (along - dot(t, f), across - dot(u, f), spread(0.0)))
        keep(earlier, r + of.LAG, x, y, z)


@kernel("work")
def find_work(begin, end, index_a, index_b, points, row, asks, lanes, bodies, earlier, momenta, work):
    """Write what impulses since ``earlier`` did to the bodies (J): two rows a group, along the normals and across.

    ``momenta`` are the momentum and the angular momentum of each body that impulses move, the mean of before and after.
    What counts is by how much its velocities changed: the solver takes inertia for what it was when it was prepared.
    """
    lanes, bodies, earlier = address(lanes), planes(bodies), address(earlier)
    momenta, work, index_a, index_b = address(momenta), address(work), address(index_a), address(index_b)
    zero = spread(0.0)
    for g in range(begin, end):
        r = row[g]
        if asks[g] == IDLE:
            store(work, 2 * g, zero)
            store(work, 2 * g + 1, zero)
            continue
        p_a, p_b = gather(momenta, index_a, g), gather(momenta, index_b, g)
        total, by_t, by_u = zero, zero, zero
        for p in range(points[g]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            j = gained(q + of.WARM, lanes, earlier)
            total = total + j
            if asks[g] != BALLS:
                by_t, by_u = by_t + j * load(lanes, q + of.AT + 1), by_u - j * load(lanes, q + of.AT)
        rest_a, rest_b = at_rest(gather(bodies[VELOCITY], index_a, g)), at_rest(gather(bodies[VELOCITY], index_b, g))
        if asks[g] == BALLS:
            a, b = struck_balls(r, lanes, rest_a, rest_b, total, (zero, zero, zero))
        else:
            x, y, _ = gained_three(r + of.LAG, lanes, earlier)
            a, b = struck(r, lanes, rest_a, rest_b, x, y, total, by_t, by_u, zero)
        store(work, 2 * g, given(p_a, a) + given(p_b, b))
        f = gained_three(r + of.RUB, lanes, earlier)
        if asks[g] == BALLS:
            a, b = struck_balls(r, lanes, rest_a, rest_b, zero, f)
        else:
            t, u, _ = frame_of(r, lanes)
            by_n = gained(r + of.SPUN, lanes, earlier) if asks[g] >= TWISTING else zero
            a, b = struck(r, lanes, rest_a, rest_b, dot(t, f), dot(u, f), zero, zero, zero, by_n)
        if asks[g] == ROLLING:
            x, y, z = gained_three(r + of.ROLLED, lanes, earlier)
            a, b = rolled(g, index_a, index_b, bodies, a, b, x, y, z)
        store(work, 2 * g + 1, given(p_a, a) + given(p_b, b))


@woven
def at_rest(v):
    """Return what is packed with velocities, which are none."""
    zero = spread(0.0)
    return zero, zero, zero, v[3], zero, zero, zero, v[7]


@woven
def gained(row, lanes, earlier):
    """Return by how much a row has grown."""
    return load(lanes, row) - load(earlier, row)


@woven
def gained_three(row, lanes, earlier):
    """Return by how much three rows have grown."""
    return gained(row, lanes, earlier), gained(row + 1, lanes, earlier), gained(row + 2, lanes, earlier)


@woven
def given(momenta, change):
    """Return the energy that a change of velocities gives a body."""
    return dot(momenta[:3], change[:3]) + dot(momenta[4:7], change[4:7])
