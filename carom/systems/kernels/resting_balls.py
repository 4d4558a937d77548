"""Resting contacts of two balls each, a group at a time: what most numbers of a group are for, balls do without.

Where balls touch is on the line between their centres, so that only friction turns them, and all directions across the
line are alike.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import HEAVY
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import MANIFOLD_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY, cross, dot, keep, minus, plus, three, times
from carom.systems.kernels.lanes import choose, gather, larger, load, root, scatter, smaller, spread, store
from carom.systems.kernels.manifolds import inverse_or_none
from carom.systems.kernels.packing import EVEN_INERTIA, INVERSE_MASS, VELOCITY
from carom.systems.kernels.softness import aimed_at, borne


@woven
def are_even(r, lanes):
    """Tell whether a group is of balls that are alike about all axes and do no more than rub."""
    return lanes[r + of.BALL, 0] > 2.0


@woven
def weigh_balls(g, r, rests, index_a, index_b, lanes, bodies):
    """Write the masses that count along the normal and across it; 0 where a manifold does not rest."""
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    z_a, z_b = load(lanes, r + of.LEVER_A), load(lanes, r + of.LEVER_B)
    yields = a[INVERSE_MASS] + b[INVERSE_MASS]
    gives = yields + (a[EVEN_INERTIA] * z_a * z_a + b[EVEN_INERTIA] * z_b * z_b)
    store(lanes, r + MANIFOLD_ROWS + of.MASS, inverse_or_none(rests, yields))
    store(lanes, r + of.GIVE, inverse_or_none(rests, gives))


@woven
def follow_normals(r, lanes):
    """Take what is no longer across the normals out of friction."""
    n, f = three(lanes, r + of.NORMAL), three(lanes, r + of.RUB)
    f = minus(f, times(dot(n, f), n))
    keep(lanes, r + of.RUB, f[0], f[1], f[2])


@woven
def parting_of_balls(r, lanes, a, b):
    """Return how fast balls part, and the velocity of b's surface against a's across the normal."""
    n, way = three(lanes, r + of.NORMAL), minus(b, a)
    z_a, z_b = load(lanes, r + of.LEVER_A), load(lanes, r + of.LEVER_B)
    parts = dot(n, way)
    rolls = cross(minus(times(z_b, b[4:7]), times(z_a, a[4:7])), n)
    return parts, plus(minus(way, times(parts, n)), rolls)


@woven
def struck_balls(r, lanes, a, b, j, f):
    """Return velocities of both balls after an impulse along the normal and one across it."""
    n, z_a, z_b = three(lanes, r + of.NORMAL), load(lanes, r + of.LEVER_A), load(lanes, r + of.LEVER_B)
    push, turn = plus(times(j, n), f), cross(n, f)
    return (
        moved(a, -a[INVERSE_MASS], -a[EVEN_INERTIA] * z_a, push, turn),
        moved(b, b[INVERSE_MASS], b[EVEN_INERTIA] * z_b, push, turn),
    )


@woven
def moved(v, mass, lever, push, turn):
    """Return velocities after a push, and a turn by a lever."""
    return (
        v[0] + mass * push[0], v[1] + mass * push[1], v[2] + mass * push[2], v[3],
        v[4] + lever * turn[0], v[5] + lever * turn[1], v[6] + lever * turn[2], v[7],
    )  # fmt: skip


@woven
def press_balls_warm(g, r, index_a, index_b, lanes, bodies):
    """Apply the impulses of a group."""
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    a, b = struck_balls(r, lanes, a, b, load(lanes, r + MANIFOLD_ROWS + of.WARM), three(lanes, r + of.RUB))
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)


@woven
def press_balls(g, r, per_second, yielding, bearing, limit, index_a, index_b, lanes, bodies):
    """Solve a group once, as `press_points` and `rub` do: what parts balls does not rub them, so that both are one.

    Return more than 0 where that changes how fast they part by more than the ``limit`` (m/s), where they are loaded
    (`borne`), and where one is so much heavier that the other bears it (`outweighs`).
    """
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    q, zero = r + MANIFOLD_ROWS, spread(0.0)
    depth, before, mass = load(lanes, q + of.DEPTH), load(lanes, q + of.WARM), load(lanes, q + of.MASS)
    parts, slips = parting_of_balls(r, lanes, a, b)
    after = larger(zero, aimed_at(depth, before, mass, parts, per_second, yielding[0], yielding, bearing)[0])
    store(lanes, q + of.WARM, after)
    f = three(lanes, r + of.RUB)
    new = minus(f, times(load(lanes, r + of.GIVE), slips))
    most, size = load(lanes, r + of.FRICTION) * after, root(dot(new, new))
    new = times(choose(size - most, most / larger(size, spread(TINY)), spread(1.0)), new)
    keep(lanes, r + of.RUB, new[0], new[1], new[2])
    a, b = struck_balls(r, lanes, a, b, after - before, minus(new, f))
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)
    return parted_by(after - before, a, b) - limit, borne(before, after, mass, per_second), outweighs(a, b)


@woven
def outweighs(a, b):
    """Return more than 0 where one of two bodies that move is more than HEAVY times as heavy as the other."""
    of_heavy, of_light = smaller(a[INVERSE_MASS], b[INVERSE_MASS]), larger(a[INVERSE_MASS], b[INVERSE_MASS])
    return choose(of_heavy, of_light - HEAVY * of_heavy, spread(0.0))


@woven
def parted_by(j, a, b):
    """Return by how much (m/s) an impulse changes how fast the centres of two bodies part, or close."""
    return larger(j, -j) * (a[INVERSE_MASS] + b[INVERSE_MASS])
