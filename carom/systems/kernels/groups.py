"""Groups: up to eight manifolds that share no moving body, so that they can be solved side by side in lanes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import MANIFOLD_POINTS
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lanes import WIDTH, address, spread, store
from carom.systems.kernels.spatial import plane_axes

# Rows of eight numbers that a group has, a lane each manifold. First what is filled in when contacts are found: the
# normal, two tangents, friction, restitution, resistance to rolling and spinning (m), 1 where it is of a ball on an
# exact arc, one by its points, and the impulses: friction along the tangents, spinning, rolling, and friction summed
# over the step; then the velocity of b's surface against a's; the radii of two balls on arcs; 1 where it rests, and
# where it did before.
NORMAL, TANGENT, FRICTION, RESTITUTION, ROLLING, SPINNING, BALL, SHARE = 0, 3, 9, 10, 11, 12, 13, 14
RUB, SPUN, ROLLED, RUBBED, SURFACE, RADIUS_A, RADIUS_B, RESTS, TOGETHER, FILLED = 15, 17, 18, 21, 24, 27, 28, 29, 30, 31
# Then what follows from where the bodies are: inverse masses along the axes, the middle of the points from both bodies,
# how a unit impulse there along the tangents, and a twist about the normal, turn either body; the inverse of the
# inverse mass along the tangents (a symmetric 2 x 2), the inertia about the normal, and about any axis across it; at
# last 1 where a point may close within the substep.
MASS_A, MASS_B, MIDDLE_A, MIDDLE_B, TURN_T_A, TURN_U_A, TURN_T_B, TURN_U_B = 31, 34, 37, 40, 43, 46, 49, 52
TURN_N_A, TURN_N_B, GIVE, SPIN, ROLL, CLOSES, MANIFOLD_ROWS = 55, 58, 61, 64, 65, 66, 67

# Rows of each point, after those of the manifold: where it is from both bodies, depth, normal impulse and its sum over
# the step; then its levers (r x n), how a unit impulse turns either body, the mass along the normal, and how far it is
# from the middle.
OFFSET_A, OFFSET_B, DEPTH, WARM, SUM, POINT_FILLED = 0, 3, 6, 7, 8, 9
LEVER_A, LEVER_B, TURN_A, TURN_B, MASS, AWAY, POINT_ROWS = 9, 12, 15, 18, 21, 22, 23

ABSENT = -1e300  # m, the depth of a point that a lane does not have
BUCKETS = 256  # of manifolds that are shuffled


@kernel("group_of", "lane_of", "index_a", "index_b", "first", "size", "points", "row", "ends", "level_ends")
def group_manifolds(
    count, start, a, b, body_a, body_b, inverse_mass, nobody,
    group_of, lane_of, index_a, index_b, first, size, points, row, ends, level_ends,
):  # fmt: skip
    """Put manifolds into groups that, one after the other, do what the manifolds would in a shuffled order.

    A manifold's level is one more than any level before it of its bodies; those of a level share no moving body. What
    colors are taken for instead, as few as can be, makes neighbours wait for each other and pyramids flutter; so does
    an order that runs through a pile from one end to the other have hundreds of levels. Those with something that
    cannot move come last.

    Return (groups, rows of all, levels). Of a level first come those with the most points. ``row`` is where the rows of
    a group begin, ``ends`` (2,) where the groups of either kind end, ``level_ends`` where those of each level do;
    ``nobody`` is the index of what has no body.
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
    order = np.empty(count, np.int64)
    for m in shuffled:
        k = (stands[m] * levels + level[m] + 1) * MANIFOLD_POINTS - (start[m + 1] - start[m])
        order[begin[k]] = m
        begin[k] += 1
    group, lane, rows, last, begun = -1, WIDTH, 0, -1, 0
    ends[0] = 0
    for m in order:
        if lane == WIDTH or stands[m] * levels + level[m] != last:
            if stands[m] * levels + level[m] != last:
                level_ends[begun] = level_ends[begun - 1] if begun else 0
                begun += 1
            group, lane, last = group + 1, 0, stands[m] * levels + level[m]
            level_ends[begun - 1] = group + 1
            row[group], points[group] = rows, start[m + 1] - start[m]
            rows += MANIFOLD_ROWS + POINT_ROWS * points[group]
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
    return group + 1, rows, begun


@inlined
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


@kernel("lanes")
def fill_groups(
    count, groups, start, group_of, lane_of, row, points, normal, depth, offset_a, offset_b, kind,
    friction, restitution, rolling, spinning, surface, warm_normal, warm_friction, warm_rolling, lanes,
):  # fmt: skip
    """Write what contacts hold into the lanes of their groups."""
    rows = address(lanes)
    for g in range(groups):
        for k in range(FILLED):
            store(rows, row[g] + k, spread(0.0))
        for p in range(points[g]):
            q = row[g] + MANIFOLD_ROWS + POINT_ROWS * p
            for k in range(POINT_FILLED):
                store(rows, q + k, spread(0.0))
            store(rows, q + DEPTH, spread(ABSENT))
    for m in range(count):
        r, lane, c = row[group_of[m]], lane_of[m], start[m]
        write_normal(r, lane, normal[c, 0], normal[c, 1], normal[c, 2], lanes)
        lanes[r + FRICTION, lane], lanes[r + RESTITUTION, lane] = friction[c], restitution[c]
        lanes[r + ROLLING, lane], lanes[r + SPINNING, lane] = rolling[c], spinning[c]
        lanes[r + BALL, lane], lanes[r + SHARE, lane] = 1.0 if kind[c] >= 0 else 0.0, 1.0 / (start[m + 1] - c)
        for k in range(3):
            lanes[r + SURFACE + k, lane] = surface[c, k]
        fx, fy, fz, wx, wy, wz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for p in range(start[m + 1] - c):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            write_point(q, lane, c + p, offset_a, offset_b, depth, lanes)
            lanes[q + WARM, lane] = warm_normal[c + p]
            fx, fy, fz = fx + warm_friction[c + p, 0], fy + warm_friction[c + p, 1], fz + warm_friction[c + p, 2]
            wx, wy, wz = wx + warm_rolling[c + p, 0], wy + warm_rolling[c + p, 1], wz + warm_rolling[c + p, 2]
        for k in range(2):
            t = r + TANGENT + 3 * k
            lanes[r + RUB + k, lane] = fx * lanes[t, lane] + fy * lanes[t + 1, lane] + fz * lanes[t + 2, lane]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        along = nx * wx + ny * wy + nz * wz
        lanes[r + SPUN, lane] = along
        lanes[r + ROLLED, lane] = wx - along * nx
        lanes[r + ROLLED + 1, lane] = wy - along * ny
        lanes[r + ROLLED + 2, lane] = wz - along * nz


@woven
def write_normal(r, lane, nx, ny, nz, lanes):
    """Write a normal and its tangents into the lane of a manifold."""
    tx, ty, tz, ux, uy, uz = plane_axes(nx, ny, nz)
    for k, value in enumerate((nx, ny, nz, tx, ty, tz, ux, uy, uz)):
        lanes[r + NORMAL + k, lane] = value


@woven
def write_point(q, lane, c, offset_a, offset_b, depth, lanes):
    """Write where contact c is, and how deep, into the lane of its manifold."""
    for k in range(3):
        lanes[q + OFFSET_A + k, lane], lanes[q + OFFSET_B + k, lane] = offset_a[c, k], offset_b[c, k]
    lanes[q + DEPTH, lane] = depth[c]


@kernel("lanes", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling")
def hand_over(
    count, start, group_of, lane_of, row, lanes, impulse, friction_impulse, warm_normal, warm_friction, warm_rolling
):
    """Write the impulses that the resting stage has found back into the contact table."""
    for m in range(count):
        r, lane = row[group_of[m]], lane_of[m]
        share, spun = lanes[r + SHARE, lane], lanes[r + SPUN, lane]
        rub, rub_across = share * lanes[r + RUB, lane], share * lanes[r + RUB + 1, lane]
        for c in range(start[m], start[m + 1]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * (c - start[m])
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
