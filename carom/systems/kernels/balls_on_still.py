"""Contacts of balls with boxes and half spaces that belong to no body, a group at a time."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BOX, HALF_SPACE
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import lane_of, numbers_at, pick, pick_one, pick_three
from carom.systems.kernels.lane_vectors import TINY, dot, keep, minus
from carom.systems.kernels.lanes import address, choose, larger, root, smaller, some, spread, store, which
from carom.systems.kernels.spatial import turn


@woven
def are_on_still(at, there, kind, other):
    """Tell whether the manifolds of a group, at places in the table, are all of balls on such boxes and half spaces."""
    kinds, others = lane_of(numbers_at(kind, at)), lane_of(numbers_at(other, at))
    return not some(choose(there, larger((BOX - 0.5) - kinds, others + 0.5), spread(0.0)))


@woven
def measure_on_still(
    r, at, there, center, kind, ball, sign, radius, extent, other_position, other_rotation, lanes
):  # fmt: skip
    """Measure the contacts of a group where the balls are; as `measure_ball` does, one by one.

    Return which are beyond two faces of a box, each a bit: those that touch it do so at an edge or a corner.
    """
    zero, one, balls = spread(0.0), spread(1.0), numbers_at(ball, at)
    to, e = pick_three(center, balls, there), pick_three(extent, at, there)
    to = minus(to, pick_three(other_position, at, there))
    flat = lane_of(numbers_at(kind, at)) - (HALF_SPACE - 0.5)
    turns, size = address(other_rotation), pick_one(radius, at, there)
    qx, qy, qz, qw = pick(turns, 4, 0, at), pick(turns, 4, 1, at), pick(turns, 4, 2, at), pick(turns, 4, 3, at)
    x, y, z = turn(-qx, -qy, -qz, qw, to[0], to[1], to[2])
    beyond = (larger(x, -x) - e[0], larger(y, -y) - e[1], larger(z, -z) - e[2])
    off = (
        x - smaller(larger(x, -e[0]), e[0]),
        y - smaller(larger(y, -e[1]), e[1]),
        z - smaller(larger(z, -e[2]), e[2]),
    )
    distance = root(dot(off, off))
    length = larger(distance, spread(TINY))
    n, inside = (off[0] / length, off[1] / length, off[2] / length), choose(distance, zero, choose(flat, zero, there))
    if some(inside):
        distance, n = nearest_face(x, y, z, beyond, inside, distance, n)
    n = turn(qx, qy, qz, qw, n[0], n[1], n[2])
    n = (choose(flat, e[0], n[0]), choose(flat, e[1], n[1]), choose(flat, e[2], n[2]))
    gap, against = choose(flat, dot(e, to), distance) - size, -pick_one(sign, at, there)
    keep(lanes, r + of.NORMAL, against * n[0], against * n[1], against * n[2])
    store(lanes, r + MANIFOLD_ROWS + of.DEPTH, choose(there, -gap, spread(ABSENT)))
    faces = choose(beyond[0], one, zero) + choose(beyond[1], one, zero) + choose(beyond[2], one, zero)
    return which(choose(flat, zero, choose(there, faces - 1.5, zero)))


@woven
def nearest_face(x, y, z, beyond, inside, distance, n):
    """Return how far balls are and the way out, of those whose centre is ``inside`` a box by its nearest face."""
    zero, one = spread(0.0), spread(1.0)
    by_x = choose(larger(beyond[1] - beyond[0], beyond[2] - beyond[0]), zero, one)
    by_y = choose(by_x, zero, choose(beyond[2] - beyond[1], zero, one))
    by_z = one - by_x - by_y
    out = (
        by_x * choose(-x, -one, one),
        by_y * choose(-y, -one, one),
        by_z * choose(-z, -one, one),
    )
    depth = by_x * beyond[0] + by_y * beyond[1] + by_z * beyond[2]
    return choose(inside, depth, distance), (
        choose(inside, out[0], n[0]), choose(inside, out[1], n[1]), choose(inside, out[2], n[2])
    )  # fmt: skip
