"""Sweeping on: where a sweep over contacts has stirred bodies, those that they touch are swept again, and nobody else.

A group is swept whole, and whom nobody stirs gets back what he had: no bit hangs on whom he is in a group with.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import BEARING, BEARING_SWEEPS, MANIFOLD_POINTS
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import LANES, lane_of, numbers_at
from carom.systems.kernels.lane_vectors import three
from carom.systems.kernels.lanes import WIDTH, choose, gather, larger, load, scatter, store
from carom.systems.kernels.packing import ANGULAR, INVERSE_MASS, VELOCITY
from carom.systems.kernels.rubbing import BALLS

NEVER = -1  # the sweep that stirs nobody
# Rows of what is known of bodies: the last sweep by which each was stirred, and in which it bears what is heavy.
LAST_STIRRED, LAST_BEARING = 0, 1
# Rows of what manifolds had before: impulses of points, of friction, spinning and rolling, and the velocities of both
# bodies, linear and angular.
WARM, RUB, SIDE_ROWS = 0, MANIFOLD_POINTS, 6
SPUN, ROLLED, OF_A, OF_B, KEPT_ROWS = (RUB + k for k in (3, 4, 7, 7 + SIDE_ROWS, 7 + 2 * SIDE_ROWS))


@woven
def are_stirred(g, since, index_a, index_b, stirred):
    """Tell of each manifold of a group whether a sweep since then has stirred one of its bodies."""
    return last_of(g, index_a, index_b, stirred[LAST_STIRRED]) - (since - 0.5)


@woven
def are_bearing(g, sweep, index_a, index_b, stirred):
    """Tell of each manifold of a group whether one of its bodies bears what is heavy, and is swept therefore."""
    return last_of(g, index_a, index_b, stirred[LAST_BEARING]) - (sweep - 1.5)


@woven
def last_of(g, index_a, index_b, sweeps):
    """Return the later of the sweeps that the bodies of each manifold of a group have."""
    of_a = lane_of(numbers_at(sweeps, numbers_at(index_a[g], LANES)))
    of_b = lane_of(numbers_at(sweeps, numbers_at(index_b[g], LANES)))
    return larger(of_a, of_b)


@woven
def put_aside(g, r, points, asks, index_a, index_b, lanes, bodies, kept):
    """Keep what solving a group changes."""
    for p in range(points):
        store(kept, WARM + p, load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.WARM))
    for k in range(3):
        store(kept, RUB + k, load(lanes, r + of.RUB + k))
    if asks != BALLS:
        store(kept, SPUN, load(lanes, r + of.SPUN))
        for k in range(3):
            store(kept, ROLLED + k, load(lanes, r + of.ROLLED + k))
    put_velocities_aside(g, index_a, OF_A, bodies, kept)
    put_velocities_aside(g, index_b, OF_B, bodies, kept)


@woven
def put_velocities_aside(g, index, at, bodies, kept):
    """Keep the velocities of the bodies on one side in so many rows, SIDE_ROWS, from there."""
    v = gather(bodies[VELOCITY], index, g)
    for k in range(3):
        store(kept, at + k, v[k])
        store(kept, at + 3 + k, v[ANGULAR + k])


@woven
def put_back(concerned, g, r, points, asks, summed, index_a, index_b, lanes, bodies, kept):
    """Give manifolds of a group that are not ``concerned`` back what they had: no bit hangs on whom they are with.

    By what impulses of the others have changed, so have those of the step, where they are ``summed``.
    """
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        more = put_row_back(concerned, q + of.WARM, WARM + p, lanes, kept)
        if summed:
            store(lanes, q + of.SUM, load(lanes, q + of.SUM) + more)
    for k in range(3):
        more = put_row_back(concerned, r + of.RUB + k, RUB + k, lanes, kept)
        if summed:
            store(lanes, r + of.RUBBED + k, load(lanes, r + of.RUBBED + k) + more)
    if asks != BALLS:
        put_row_back(concerned, r + of.SPUN, SPUN, lanes, kept)
        for k in range(3):
            put_row_back(concerned, r + of.ROLLED + k, ROLLED + k, lanes, kept)
    put_velocities_back(concerned, g, index_a, OF_A, bodies, kept)
    put_velocities_back(concerned, g, index_b, OF_B, bodies, kept)


@woven
def put_row_back(concerned, row, at, lanes, kept):
    """Give one row back; return by how much it has changed."""
    before = load(kept, at)
    after = choose(concerned, load(lanes, row), before)
    store(lanes, row, after)
    return after - before


@woven
def put_velocities_back(concerned, g, index, at, bodies, kept):
    """Give the velocities of the bodies on one side back."""
    v = gather(bodies[VELOCITY], index, g)
    x, y, z = three(kept, at)
    u, w, q = three(kept, at + 3)
    back = (
        choose(concerned, v[0], x), choose(concerned, v[1], y), choose(concerned, v[2], z), v[3],
        choose(concerned, v[4], u), choose(concerned, v[5], w), choose(concerned, v[6], q), v[7],
    )  # fmt: skip
    scatter(bodies[VELOCITY], index, g, back)


@woven
def stir(g, sweep, lanes, index_a, index_b, velocity, crushed, stirred):
    """Note that a sweep has stirred the bodies of some lanes of a group, each a bit, or that one to come will have.

    What cannot move never is, nor what is crushed, which no impulse can help.
    """
    for lane in range(WIDTH):
        for i in (index_a[g, lane], index_b[g, lane]):
            if lanes >> lane & 1 and velocity[i, INVERSE_MASS] > 0.0 and not crushed[i]:
                stirred[LAST_STIRRED, i] = max(stirred[LAST_STIRRED, i], sweep)


@woven
def bear(g, r, points, sweeps, per_second, bears, heavy, index_a, index_b, lanes, velocity, crushed, stirred):
    """Have the bodies of some lanes of a group, each a bit, swept on that bear what is heavy; tell whether any is.

    A sweep leaves bodies so much the farther from what they bear the heavier that is: they are swept once more for each
    time that their load is BEARING; those who bear a ``heavy`` one themselves, and others no more than one of them.
    """
    spreads = False
    for lane in range(WIDTH):
        if not bears >> lane & 1:
            continue
        a, b, load = index_a[g, lane], index_b[g, lane], 0.0
        for p in range(points):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            if lanes[q + of.MASS, lane] > 0.0:
                load = max(load, lanes[q + of.WARM, lane] / lanes[q + of.MASS, lane])
        until = sweeps - 2 + int(min(load * per_second / BEARING, BEARING_SWEEPS))
        if not heavy >> lane & 1:
            until = min(until, max(stirred[LAST_BEARING, a], stirred[LAST_BEARING, b]))
        for i in (a, b):
            if until > stirred[LAST_BEARING, i] and velocity[i, INVERSE_MASS] > 0.0 and not crushed[i]:
                stirred[LAST_BEARING, i], spreads = until, True
                stirred[LAST_STIRRED, i] = max(stirred[LAST_STIRRED, i], until)
    return spreads


@woven
def some_stir(stirs, sweep, parts):
    """Tell whether others are to follow a sweep, by what any thread has told."""
    follow = False
    for part in range(parts):
        follow |= stirs[sweep % 2, part]
    return follow
