"""Groups: up to eight manifolds that share no moving body, so that they can be solved side by side in lanes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import MANIFOLD_POINTS
from carom.systems.kernels.balls import BALL as TWO_BALLS
from carom.systems.kernels.kernel import kernel, making, woven
from carom.systems.kernels.lanes import WIDTH

# Rows of eight numbers that a group has, a lane each manifold: what is read most often stands together, at the end.
# Resistance to rolling (m), the inertia about any axis across the normal, the impulse of rolling; 1 where a point may
# close within the substep; resistance to spinning (m), the inertia about the normal, the impulse of spinning; the
# velocity of b's surface against a's; inverse masses along the axes; how a unit impulse along the normal at the middle
# of the points, and unit twists about the tangents, change how fast surfaces slip there along these and spin about the
# normal (3 x 3), and how impulses along the tangents change the latter; how unit twists about the axes of the frame
# turn either body; tangents; the middle of the points from both bodies, in the frame; the part of the mass that counts
# at a point (`part_masses`); 1 of a ball that another box bears (`is_borne_beside`); how much points go with b, what
# land adds to that (`goes_with_b`); how far (m) they are outside the cores of a and b, which turn, -1 of what turns
# beneath its points (`is_smooth`); by how much (rad) bodies have turned since all this was found, and how far the face
# has turned on beyond the frame; how the normal turns between what is round (`write_curve`). Groups that `are_even` do
# without all of these. One row is nobody's: groups of four points have an odd number, so that each kind of row comes to
# stand in all sets of the first cache, and not in every fourth (a twentieth of the time they take).
ROLLING, ROLL, ROLLED, CLOSES, SPINNING, SPIN, SPUN, SURFACE, MASS_A, MASS_B = 0, 1, 2, 5, 6, 7, 8, 9, 12, 15
SWERVE, VEER, TURN_A, TURN_B, TANGENT, MIDDLE_A, MIDDLE_B, PART, BESIDE = 18, 27, 29, 38, 47, 53, 56, 59, 60
GOES, LAND, CORE_A, CORE_B, SWUNG, LAG, CURVE, SPARED = 61, 62, 63, 64, 65, 66, 69, 73
# Friction summed over the step; one by its points; restitution; 1 where it is of a ball on an exact arc (2 where the
# group is of two balls each, 3 where `are_even`); 1 where it rests, and what was before (`RESTED`).
RUBBED, SHARE, RESTITUTION, BALL, RESTS, TOGETHER = 73, 76, 77, 78, 79, 80
# The impulse of friction; the normal, which is the cross product of the tangents; the inverse of the inverse mass along
# the tangents (a symmetric 2 x 2); friction. Even groups have one such mass, and behind it how far along the normal
# points are from the centres of both balls.
RUB, NORMAL, GIVE, LEVER_A, LEVER_B, FRICTION, MANIFOLD_ROWS = 81, 84, 87, 88, 89, 90, 91

# Rows of each point, after those of the manifold: depth, normal impulse, the mass along the normal; the sum of its
# impulse over the step; where it is from the middle along the tangents (along the normal it has no lever), how far:
# even groups do without these, too.
DEPTH, WARM, MASS, SUM, AT, AWAY, POINT_ROWS = 0, 1, 2, 3, 4, 6, 7
# After those of all points a row for each two of them: how fast a unit impulse at either parts the bodies at the other.

ABSENT = -1e300  # m, the depth of a point that a lane does not have
BUCKETS = 256  # of manifolds that are shuffled
RUNS = MANIFOLD_POINTS + 1  # of groups of a level: by their points, the most first, and at last those that are idle
# Of bodies: moved by no impulse, or by those of some axes more than by others, or alike about all and without locks.
UNKNOWN, STILL, UNEVEN, EVEN = -1, 0, 1, 2


@kernel(
    "group_of",
    "lane_of",
    "index_a",
    "index_b",
    "first",
    "size",
    "points",
    "row",
    "even",
    "ends",
    "run_ends",
    makes_arrays=True,
)
def group_manifolds(
    count, start, a, b, body_a, body_b, kind, rolling, spinning, surface, resting,
    inverse_mass, inverse_inertia, freedom, nobody,
    group_of, lane_of, index_a, index_b, first, size, points, row, even, ends, run_ends,
):  # fmt: skip
    """Put manifolds into groups that, one after the other, do what the manifolds would in a shuffled order.

    A manifold's level is one more than any level before it of its bodies; those of a level share no moving body. What
    colors are taken for instead, as few as can be, makes neighbours wait for each other and pyramids flutter; so does
    an order that runs through a pile from one end to the other have hundreds of levels. Those with something that
    cannot move come last.

    Return (groups, rows of all, levels). ``row`` is where the rows of a group begin, or would, were they all there:
    those that are ``even``, of two balls each that are alike about all axes and do no more than rub, lack the first
    `SPARED` and the last from `AT` on. ``ends`` (2,) is where the groups of either kind end, ``run_ends`` where each
    run of groups does that have as many points; a level has so many `RUNS`. Where they fill a group or more, those
    that were not ``resting`` before come last in their level, idle: groups in which nobody rests have nothing to solve.
    ``nobody`` is the index of what has no body.
    """
    shuffled = shuffle(count, start, a, b)
    # What is gone through without order is kept small, and what is asked for together side by side.
    reached = np.zeros(2 * nobody + 2, np.int32)
    movers, level, levels = np.empty((count, 2), np.int32), np.empty(count, np.int32), 0
    known = np.full(nobody, UNKNOWN, np.int8)
    form, alike, stands = np.empty(count, np.int32), np.empty(count, np.bool_), np.empty(count, np.bool_)
    for m in range(count):
        c, least = start[m], EVEN
        for side, i in enumerate((body_a[c], body_b[c])):
            how = what_moves(i, known, inverse_mass, inverse_inertia, freedom)
            movers[m, side], least = i if how != STILL else nobody, min(least, how)
        stands[m] = least == STILL
        alike[m] = least == EVEN and kind[c] == TWO_BALLS and only_rubs(c, rolling, spinning, surface)
        form[m] = MANIFOLD_POINTS - (0 if alike[m] else start[m + 1] - c)
    for m in shuffled:
        first_height = nobody + 1 if stands[m] else 0
        i, o = first_height + movers[m, 0], first_height + movers[m, 1]
        lowest = max(reached[i], reached[o])
        reached[i] = reached[o] = lowest + 1
        reached[first_height + nobody] = 0
        level[m] = lowest
        levels = max(levels, lowest + 1)
    idle = np.zeros(2 * levels, np.int32)
    for m in range(count):
        level[m] += stands[m] * levels
        idle[level[m]] += not resting[start[m]]
    kinds = MANIFOLD_POINTS + 1  # in a level by their points, the most first, and at last those that are even
    forms = 2 * kinds  # then the same of those that are idle
    begin = np.zeros(2 * levels * forms + 1, np.int64)
    for m in range(count):
        form[m] += level[m] * forms + (0 if resting[start[m]] or idle[level[m]] < WIDTH else kinds)
        begin[form[m] + 1] += 1
    for k in range(1, len(begin)):
        begin[k] += begin[k - 1]
    by_form = np.empty(count, np.int32)
    for m in range(count):  # within a level in their order: neighbours' bodies are near each other in memory
        by_form[begin[form[m]]] = m
        begin[form[m]] += 1
    group, lane, rows, last, begun = -1, WIDTH, 0, -1, 0
    ends[0], run_ends[: 2 * levels * RUNS] = 0, 0
    for m in by_form:
        many = start[m + 1] - start[m]
        if lane == WIDTH or level[m] != last or alike[m] != even[group] or many > points[group]:
            if level[m] != last:
                begun += 1
            group, lane, last = group + 1, 0, level[m]
            row[group], points[group], even[group] = rows, many, alike[m]
            run_ends[begun * RUNS - (1 if form[m] % forms >= kinds else 1 + points[group])] = group + 1
            rows += couplings(0, points[group]) + pair(points[group], 0)
            if alike[m]:
                row[group], rows = row[group] - SPARED, rows - SPARED - (POINT_ROWS - AT)
            for k in range(WIDTH):
                index_a[group, k], index_b[group, k], first[group, k], size[group, k] = nobody, nobody, -1, 0
        if not stands[m]:
            ends[0] = group + 1
        i, o = movers[m, 0], movers[m, 1]
        if stands[m]:  # whom nothing moves may still move
            i, o = body_a[start[m]], body_b[start[m]]
        index_a[group, lane], index_b[group, lane] = i if i >= 0 else nobody, o if o >= 0 else nobody
        first[group, lane], group_of[m], lane_of[m] = start[m], group, lane
        size[group, lane] = many
        lane += 1
    ends[1] = group + 1
    for k in range(1, begun * RUNS):
        run_ends[k] = max(run_ends[k], run_ends[k - 1])
    return group + 1, rows, begun


@woven
def only_rubs(c, rolling, spinning, surface):
    """Tell whether contact c resists no rolling and no spinning, and no surface runs like a belt."""
    still = surface[c, 0] == 0.0 and surface[c, 1] == 0.0 and surface[c, 2] == 0.0
    return still and rolling[c] == 0.0 and spinning[c] == 0.0


@woven
def what_moves(i, known, inverse_mass, inverse_inertia, freedom):
    """Return whether impulses move body i, or nobody, and how; it is written into ``known``."""
    if i < 0:
        return STILL
    if known[i] == UNKNOWN:
        known[i] = STILL
        if inverse_mass[i] > 0.0:
            free = freedom[i, 0] + freedom[i, 1] + freedom[i, 2] + freedom[i, 3] + freedom[i, 4] + freedom[i, 5] == 6.0
            alike = inverse_inertia[i, 0] == inverse_inertia[i, 1] == inverse_inertia[i, 2]
            known[i] = EVEN if free and alike else UNEVEN
    return known[i]


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
    bucket, begin = np.empty(count, np.int32), np.zeros(BUCKETS + 1, np.int64)
    for m in range(count):
        c = start[m]
        bucket[m] = ((a[c] & INDEX_MASK) * 40503 + (b[c] & INDEX_MASK) * 30011) % 65521 % BUCKETS
        begin[bucket[m] + 1] += 1
    for k in range(BUCKETS):
        begin[k + 1] += begin[k]
    order = np.empty(count, np.int32)
    for m in range(count):
        order[begin[bucket[m]]] = m
        begin[bucket[m]] += 1
    return order
