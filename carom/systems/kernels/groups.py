"""Groups: up to eight manifolds that share no moving body, so that they can be solved side by side in lanes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import MANIFOLD_POINTS
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import kernel, making, woven
from carom.systems.kernels.lane_vectors import dot, keep, plus, three
from carom.systems.kernels.lanes import WIDTH, address, choose, lane_of, larger, load, pick, spread, store

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

# Rows of each point, after those of the manifold: where it is from the middle along the tangents (along the normal it
# has no lever), depth, normal impulse and its sum over the step; then the mass along the normal, and how far it is from
# the middle.
AT, DEPTH, WARM, SUM, POINT_FILLED = 0, 2, 3, 4, 5
MASS, AWAY, POINT_ROWS = 5, 6, 7
# After those of all points a row for each two of them: how fast a unit impulse at either parts the bodies at the other.

ABSENT = -1e300  # m, the depth of a point that a lane does not have
LANES = tuple(range(WIDTH))
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
    """Write what contacts hold into the lanes of their groups.

    Of friction and rolling only their sums are of use: all points share them alike.
    """
    rows, zero, one = address(lanes), spread(0.0), spread(1.0)
    begin, end = part_of(crew, len(order))
    for g in order[begin:end]:
        r, at, sizes = row[g], places_of(g, 0, first, size), lane_of(numbers_at(size[g], LANES))
        keep(rows, r + RUBBED, zero, zero, zero)
        store(rows, r + RESTS, zero)
        store(rows, r + TOGETHER, zero)
        store(rows, r + SHARE, choose(sizes, one / larger(sizes, one), zero))
        store(rows, r + BALL, choose(sizes, choose(lane_of(numbers_at(kind, at)) + 0.5, one, zero), zero))
        store(rows, r + FRICTION, read_one(friction, at, sizes))
        store(rows, r + RESTITUTION, read_one(restitution, at, sizes))
        store(rows, r + ROLLING, read_one(rolling, at, sizes))
        store(rows, r + SPINNING, read_one(spinning, at, sizes))
        x, y, z = read_three(surface, at, sizes)
        keep(rows, r + SURFACE, x, y, z)
        n, pushed, rolled = read_three(normal, at, sizes), (zero, zero, zero), (zero, zero, zero)
        for p in range(points[g]):
            q, at, there = r + MANIFOLD_ROWS + POINT_ROWS * p, places_of(g, p, first, size), sizes - float(p)
            store(rows, q + WARM, read_one(warm_normal, at, there))
            store(rows, q + SUM, zero)
            pushed = plus(pushed, read_three(warm_friction, at, there))
            rolled = plus(rolled, read_three(warm_rolling, at, there))
        t, u = tangents_of(n)
        keep(rows, r + NORMAL, n[0], n[1], n[2])
        keep(rows, r + TANGENT, t[0], t[1], t[2])
        keep(rows, r + TANGENT + 3, u[0], u[1], u[2])
        store(rows, r + RUB, dot(pushed, t))
        store(rows, r + RUB + 1, dot(pushed, u))
        along = dot(n, rolled)
        store(rows, r + SPUN, along)
        keep(rows, r + ROLLED, rolled[0] - along * n[0], rolled[1] - along * n[1], rolled[2] - along * n[2])
        place_points(g, r, points[g], first, size, offset_a, offset_b, depth, lanes)


@woven
def places_of(g, p, first, size):
    """Return where the p-th contacts of a group's manifolds are, the last ones of those that have fewer."""
    return (
        place_of(g, 0, p, first, size), place_of(g, 1, p, first, size), place_of(g, 2, p, first, size),
        place_of(g, 3, p, first, size), place_of(g, 4, p, first, size), place_of(g, 5, p, first, size),
        place_of(g, 6, p, first, size), place_of(g, 7, p, first, size),
    )  # fmt: skip


@woven
def place_of(g, lane, p, first, size):
    """Return where the p-th contact of a manifold is; anywhere, where there is no manifold."""
    return max(0, first[g, lane] + min(p, size[g, lane] - 1))


@woven
def numbers_at(column, at):
    """Return eight whole numbers of a column."""
    return (
        column[at[0]], column[at[1]], column[at[2]], column[at[3]],
        column[at[4]], column[at[5]], column[at[6]], column[at[7]],
    )  # fmt: skip


@woven
def read_one(column, at, there):
    """Return the numbers of a column at eight places, 0 where there is none."""
    return choose(there, pick(address(column), 1, 0, at), spread(0.0))


@woven
def read_three(column, at, there):
    """Return the vectors of a column as `read_one` does numbers."""
    rows, zero = address(column), spread(0.0)
    return (
        choose(there, pick(rows, 3, 0, at), zero),
        choose(there, pick(rows, 3, 1, at), zero),
        choose(there, pick(rows, 3, 2, at), zero),
    )


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
    rows, zero, sizes = address(lanes), spread(0.0), lane_of(numbers_at(size[g], LANES))
    t, u, n = three(rows, r + TANGENT), three(rows, r + TANGENT + 3), three(rows, r + NORMAL)
    of_a, of_b = (zero, zero, zero), (zero, zero, zero)
    for p in range(points):
        q, at, there = r + MANIFOLD_ROWS + POINT_ROWS * p, places_of(g, p, first, size), sizes - float(p)
        a, b = read_three(offset_a, at, there), read_three(offset_b, at, there)
        along, across = dot(t, b), dot(u, b)
        of_a, of_b = plus(of_a, (dot(t, a), dot(u, a), dot(n, a))), plus(of_b, (along, across, dot(n, b)))
        store(rows, q + AT, along)
        store(rows, q + AT + 1, across)
        store(rows, q + DEPTH, choose(there, pick(address(depth), 1, 0, at), spread(ABSENT)))
    share = load(rows, r + SHARE)
    keep(rows, r + MIDDLE_A, share * of_a[0], share * of_a[1], share * of_a[2])
    keep(rows, r + MIDDLE_B, share * of_b[0], share * of_b[1], share * of_b[2])
    for p in range(points):
        q, there = r + MANIFOLD_ROWS + POINT_ROWS * p, sizes - float(p)
        store(rows, q + AT, choose(there, load(rows, q + AT) - share * of_b[0], zero))
        store(rows, q + AT + 1, choose(there, load(rows, q + AT + 1) - share * of_b[1], zero))


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
