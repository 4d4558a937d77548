"""Groups: up to eight manifolds that share no moving body, so that they can be solved side by side in lanes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import MANIFOLD_POINTS
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import kernel, making, woven
from carom.systems.kernels.lane_vectors import dot, keep, three
from carom.systems.kernels.lanes import WIDTH, address, choose, load, spread, store

# Rows of eight numbers that a group has, a lane each manifold. First what is filled in when contacts are found: the
# frame, which is two tangents and the normal, each the cross product of the other two; friction, restitution,
# resistance to rolling and spinning (m), 1 where it is of a ball on an exact arc (2 where the group is of two balls
# each), one by its points, and the impulses: friction along the tangents, spinning, rolling, and friction summed over
# the step; then the velocity of b's surface against a's; 1 where it rests, and where it did before (2 on a joint);
# the middle of the points from both bodies, in the frame.
TANGENT, NORMAL, FRICTION, RESTITUTION, ROLLING, SPINNING, BALL, SHARE = 0, 6, 9, 10, 11, 12, 13, 14
RUB, SPUN, ROLLED, RUBBED, SURFACE, RESTS, TOGETHER, MIDDLE_A, MIDDLE_B, FILLED = 15, 17, 18, 21, 24, 27, 28, 29, 32, 35
# Then what follows from where the bodies are: inverse masses along the axes; how unit twists about the axes of the
# frame turn either body; the inverse of the inverse mass along the tangents (a symmetric 2 x 2), the inertia about the
# normal, and about any axis across it; at last 1 where a point may close within the substep.
MASS_A, MASS_B, TURN_A, TURN_B, GIVE, SPIN, ROLL, CLOSES, MANIFOLD_ROWS = 35, 38, 41, 50, 59, 62, 63, 64, 65

# Before that is known its rows hold vectors of the world for a while: both offsets of each point, and friction.
PLACES, PUSHED = 35, 59

# Rows of each point, after those of the manifold: where it is from the middle along the tangents (along the normal it
# has no lever), depth, normal impulse and its sum over the step; then the mass along the normal, and how far it is from
# the middle.
AT, DEPTH, WARM, SUM, POINT_FILLED = 0, 2, 3, 4, 5
MASS, AWAY, POINT_ROWS = 5, 6, 7
# After those of all points a row for each two of them: how fast a unit impulse at either parts the bodies at the other.

ABSENT = -1e300  # m, the depth of a point that a lane does not have
BUCKETS = 256  # of manifolds that are shuffled


@kernel(
    "group_of",
    "lane_of",
    "index_a",
    "index_b",
    "first",
    "size",
    "points",
    "row",
    "ends",
    "run_ends",
    "order",
    makes_arrays=True,
)
def group_manifolds(
    count, start, a, b, body_a, body_b, inverse_mass, nobody,
    group_of, lane_of, index_a, index_b, first, size, points, row, ends, run_ends, order,
):  # fmt: skip
    """Put manifolds into groups that, one after the other, do what the manifolds would in a shuffled order.

    A manifold's level is one more than any level before it of its bodies; those of a level share no moving body. What
    colors are taken for instead, as few as can be, makes neighbours wait for each other and pyramids flutter; so does
    an order that runs through a pile from one end to the other have hundreds of levels. Those with something that
    cannot move come last.

    Return (groups, rows of all, levels). ``row`` is where the rows of a group begin, ``ends`` (2,) where the groups of
    either kind end, ``run_ends`` where each run of groups does that have as many points: a level has `MANIFOLD_POINTS`
    of them, the most points first. ``nobody`` is the index of what has no body. Where levels do not matter, groups are
    gone through in ``order``: by where in the contact table they begin, so that bodies of one are still in the cache
    when they are met in the next.
    """
    shuffled = shuffle(count, start, a, b)
    reached = np.zeros((2, len(inverse_mass)), np.int64)
    level, stands = np.empty(count, np.int64), np.empty(count, np.int64)
    levels = 0
    for m in shuffled:
        i, o = body_a[start[m]], body_b[start[m]]
        moving_a, moving_b = is_moving(i, inverse_mass), is_moving(o, inverse_mass)
        stands[m] = 0 if moving_a and moving_b else 1
        level[m] = 0
        if moving_a:
            level[m] = reached[stands[m], i]
        if moving_b:
            level[m] = max(level[m], reached[stands[m], o])
        if moving_a:
            reached[stands[m], i] = level[m] + 1
        if moving_b:
            reached[stands[m], o] = level[m] + 1
        levels = max(levels, level[m] + 1)
    begin = np.zeros(2 * levels * MANIFOLD_POINTS + 1, np.int64)
    for m in range(count):
        begin[(stands[m] * levels + level[m] + 1) * MANIFOLD_POINTS - (start[m + 1] - start[m]) + 1] += 1
    for k in range(1, len(begin)):
        begin[k] += begin[k - 1]
    by_level = np.empty(count, np.int64)
    for m in range(count):  # within a level in their order: neighbours' bodies are near each other in memory
        k = (stands[m] * levels + level[m] + 1) * MANIFOLD_POINTS - (start[m + 1] - start[m])
        by_level[begin[k]] = m
        begin[k] += 1
    group, lane, rows, last, begun = -1, WIDTH, 0, -1, 0
    ends[0], run_ends[: 2 * levels * MANIFOLD_POINTS] = 0, 0
    for m in by_level:
        if lane == WIDTH or stands[m] * levels + level[m] != last:
            if stands[m] * levels + level[m] != last:
                begun += 1
            group, lane, last = group + 1, 0, stands[m] * levels + level[m]
            row[group], points[group] = rows, start[m + 1] - start[m]
            run_ends[begun * MANIFOLD_POINTS - points[group]] = group + 1
            rows += couplings(0, points[group]) + pair(points[group], 0)
            for k in range(WIDTH):
                index_a[group, k], index_b[group, k], first[group, k], size[group, k] = nobody, nobody, -1, 0
        if not stands[m]:
            ends[0] = group + 1
        i, o = body_a[start[m]], body_b[start[m]]
        index_a[group, lane], index_b[group, lane] = i if i >= 0 else nobody, o if o >= 0 else nobody
        first[group, lane], group_of[m], lane_of[m] = start[m], group, lane
        size[group, lane] = start[m + 1] - start[m]
        lane += 1
    ends[1] = group + 1
    for k in range(1, begun * MANIFOLD_POINTS):
        run_ends[k] = max(run_ends[k], run_ends[k - 1])
    gone = 0
    for m in range(count):
        if lane_of[m] == 0:
            order[gone] = group_of[m]
            gone += 1
    return group + 1, rows, begun


@woven
def couplings(r, points):
    """Return the first row after those of the points of a group."""
    return r + MANIFOLD_ROWS + POINT_ROWS * points


@woven
def pair(p, o):
    """Return which row after `couplings` is of points p and o, of which p comes later."""
    return p * (p - 1) // 2 + o


@making
def shuffle(count, start, a, b):
    """Return the manifolds in an order without order, in which those that stay keep their places.

    By who they are of, not where in the table: rows change when a world is made compact.
    """
    bucket, begin = np.empty(count, np.int64), np.zeros(BUCKETS + 1, np.int64)
    for m in range(count):
        c = start[m]
        bucket[m] = ((a[c] & INDEX_MASK) * 40503 + (b[c] & INDEX_MASK) * 30011) % 65521 % BUCKETS
        begin[bucket[m] + 1] += 1
    for k in range(BUCKETS):
        begin[k + 1] += begin[k]
    order = np.empty(count, np.int64)
    for m in range(count):
        order[begin[bucket[m]]] = m
        begin[bucket[m]] += 1
    return order


@woven
def is_moving(i, inverse_mass):
    """Tell whether i is a body that impulses move."""
    return i >= 0 and inverse_mass[i] > 0.0


@shared("lanes")
def fill_groups(
    crew, order, first, size, row, points, normal, depth, offset_a, offset_b, kind,
    friction, restitution, rolling, spinning, surface, warm_normal, warm_friction, warm_rolling, lanes,
):  # fmt: skip
    """Write what contacts hold into the lanes of their groups."""
    rows = address(lanes)
    begin, end = part_of(crew, len(order))
    for g in order[begin:end]:
        r = row[g]
        for k in range(FILLED):
            store(rows, r + k, spread(0.0))
        for k in range(3):
            store(rows, r + PUSHED + k, spread(0.0))
        for p in range(points[g]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            for k in range(POINT_FILLED):
                store(rows, q + k, spread(0.0))
            store(rows, q + DEPTH, spread(ABSENT))
        for lane in range(WIDTH):
            if first[g, lane] >= 0:
                fill_lane(
                    r, lane, first[g, lane], size[g, lane], normal, kind,
                    friction, restitution, rolling, spinning, surface, warm_normal, warm_friction, warm_rolling, lanes,
                )  # fmt: skip
        n, pushed, rolled = three(rows, r + NORMAL), three(rows, r + PUSHED), three(rows, r + ROLLED)
        t, u = tangents_of(n)
        keep(rows, r + TANGENT, t[0], t[1], t[2])
        keep(rows, r + TANGENT + 3, u[0], u[1], u[2])
        store(rows, r + RUB, dot(pushed, t))
        store(rows, r + RUB + 1, dot(pushed, u))
        along = dot(n, rolled)
        store(rows, r + SPUN, along)
        keep(rows, r + ROLLED, rolled[0] - along * n[0], rolled[1] - along * n[1], rolled[2] - along * n[2])
        place_points(g, r, points[g], first, size, offset_a, offset_b, depth, lanes)


@woven
def fill_lane(
    r, lane, c, count, normal, kind,
    friction, restitution, rolling, spinning, surface, warm_normal, warm_friction, warm_rolling, lanes,
):  # fmt: skip
    """Write what the ``count`` contacts of a manifold, from c on, hold into its lane, vectors as they are in the world.

    Of friction and rolling only their sums are of use: all points share them alike.
    """
    lanes[r + FRICTION, lane], lanes[r + RESTITUTION, lane] = friction[c], restitution[c]
    lanes[r + ROLLING, lane], lanes[r + SPINNING, lane] = rolling[c], spinning[c]
    lanes[r + BALL, lane], lanes[r + SHARE, lane] = 1.0 if kind[c] >= 0 else 0.0, 1.0 / count
    for k in range(3):
        lanes[r + NORMAL + k, lane], lanes[r + SURFACE + k, lane] = normal[c, k], surface[c, k]
        pushed, rolled = 0.0, 0.0
        for p in range(count):
            pushed, rolled = pushed + warm_friction[c + p, k], rolled + warm_rolling[c + p, k]
        lanes[r + PUSHED + k, lane], lanes[r + ROLLED + k, lane] = pushed, rolled
    for p in range(count):
        lanes[r + MANIFOLD_ROWS + POINT_ROWS * p + WARM, lane] = warm_normal[c + p]


@woven
def tangents_of(n):
    """Return two tangents to the normals of a group.

    Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6 (1), 2017, as `plane_axes`.
    """
    x, y, z = n
    sign = choose(-z, spread(-1.0), spread(1.0))
    p = -1.0 / (sign + z)
    q = x * y * p
    return (1.0 + sign * x * x * p, sign * q, -sign * x), (q, sign + y * y * p, -y)


@woven
def place_points(g, r, points, first, size, offset_a, offset_b, depth, lanes):
    """Write where the points of a group are in its frame, and how deep."""
    rows, zero = address(lanes), spread(0.0)
    for k in range(6 * points):
        store(rows, r + PLACES + k, zero)
    for lane in range(WIDTH):
        for p in range(size[g, lane]):
            c, q = first[g, lane] + p, r + PLACES + 6 * p
            for k in range(3):
                lanes[q + k, lane], lanes[q + 3 + k, lane] = offset_a[c, k], offset_b[c, k]
            lanes[r + MANIFOLD_ROWS + POINT_ROWS * p + DEPTH, lane] = depth[c]
    share = load(rows, r + SHARE)
    for k in range(3):
        axis, of_a, of_b = three(rows, r + TANGENT + 3 * k), zero, zero
        for p in range(points):
            q = r + PLACES + 6 * p
            of_a, of_b = of_a + dot(axis, three(rows, q)), of_b + dot(axis, three(rows, q + 3))
        of_a, of_b = share * of_a, share * of_b
        store(rows, r + MIDDLE_A + k, of_a)
        store(rows, r + MIDDLE_B + k, of_b)
        for p in range(points if k < 2 else 0):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            there = load(rows, q + DEPTH) - spread(0.5 * ABSENT)
            store(rows, q + AT + k, choose(there, dot(axis, three(rows, r + PLACES + 6 * p + 3)) - of_b, zero))


@shared("lanes", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling")
def hand_over(
    crew, order, first, size, row, lanes, impulse, friction_impulse, warm_normal, warm_friction, warm_rolling
):
    """Write the impulses that the resting stage has found back into the contact table."""
    begin, end = part_of(crew, len(order))
    for g in order[begin:end]:
        r = row[g]
        for lane in range(WIDTH):
            share, spun = lanes[r + SHARE, lane], lanes[r + SPUN, lane]
            rub, rub_across = share * lanes[r + RUB, lane], share * lanes[r + RUB + 1, lane]
            for p in range(size[g, lane]):
                c, q = first[g, lane] + p, r + MANIFOLD_ROWS + POINT_ROWS * p
                warm_normal[c] = lanes[q + WARM, lane]
                impulse[c] += lanes[q + SUM, lane]
                lanes[q + SUM, lane] = 0.0
                for k in range(3):
                    t = r + TANGENT + k
                    warm_friction[c, k] = rub * lanes[t, lane] + rub_across * lanes[t + 3, lane]
                    friction_impulse[c, k] += share * lanes[r + RUBBED + k, lane]
                    warm_rolling[c, k] = share * (spun * lanes[r + NORMAL + k, lane] + lanes[r + ROLLED + k, lane])
            for k in range(3):
                lanes[r + RUBBED + k, lane] = 0.0
