"""Pressing: the points of manifolds along their normals, a group at a time."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import POINT_SWEEPS
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS, couplings, pair
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY
from carom.systems.kernels.lanes import choose, larger, load, smaller, spread, store
from carom.systems.kernels.levers import parting_at
from carom.systems.kernels.softness import aimed_at, borne, leaving

# Rows of each point while it is solved: its impulse, what that would be were the others to stay as they are, the mass
# that counts along the normal, the same where it presses, and how fast the point parts when others bear by that.
IMPULSE, TARGET, STIFF, BEARS, OTHERS, SCRATCH_ROWS = 0, 1, 2, 3, 4, 5
FAR = 1e300  # N s, more than any point lacks


@woven
def press_points(points, r, per_second, yielding, bearing, limit, parting, lanes, scratch):
    """Solve the points of a group, of which bodies are ``parting`` so (`parting_of`).

    Return the sum of the impulses, that of each times its distance from the middle, by how much the sum has changed,
    the twists about the tangents that come with it, more than 0 where one changes how fast its point parts by more
    than the ``limit`` (m/s), and where one is loaded (`borne`).
    Each point has a target, the impulse that is `aimed_at`; others move it, and the bodies learn of all at once. What
    all need alike comes first, then one after the other what it lacks.
    """
    zero = spread(0.0)
    slow = leaving(points, yielding, parting)
    for p in range(points):
        q, x = r + MANIFOLD_ROWS + POINT_ROWS * p, SCRATCH_ROWS * p
        depth, before, mass = load(lanes, q + of.DEPTH), load(lanes, q + of.WARM), load(lanes, q + of.MASS)
        parts = parting_at(q, lanes, parting) if points > 1 else parting[0]
        target, stiff = aimed_at(depth, before, mass, parts, per_second, slow, yielding, bearing)
        store(scratch, x + IMPULSE, before)
        store(scratch, x + TARGET, target)
        store(scratch, x + STIFF, stiff)
    if points > 1:
        share_out(points, r, lanes, scratch)
    sweeps = POINT_SWEEPS if points > 1 else 1
    for sweep in range(sweeps):
        for p in range(points):
            after = larger(zero, load(scratch, SCRATCH_ROWS * p + TARGET))
            j = after - load(scratch, SCRATCH_ROWS * p + IMPULSE)
            store(scratch, SCRATCH_ROWS * p + IMPULSE, after)
            for o in range(points):
                if o > p or (o < p and sweep < sweeps - 1):  # nobody asks for what those before lack in the end
                    x = SCRATCH_ROWS * o
                    coupling = load(scratch, x + STIFF) * load(lanes, couplings(r, points) + pair(max(p, o), min(p, o)))
                    store(scratch, x + TARGET, load(scratch, x + TARGET) - coupling * j)
    total, twisting, push, by_t, by_u, excess, bears = zero, zero, zero, zero, zero, zero, zero
    for p in range(points):
        q, after = r + MANIFOLD_ROWS + POINT_ROWS * p, load(scratch, SCRATCH_ROWS * p + IMPULSE)
        before, mass = load(lanes, q + of.WARM), load(lanes, q + of.MASS)
        j = after - before
        store(lanes, q + of.WARM, after)
        total, push = total + after, push + j
        excess = larger(excess, larger(j, -j) - limit * mass)
        bears = larger(bears, borne(before, after, mass, per_second))
        if points > 1:  # else it is the middle
            twisting = twisting + after * load(lanes, q + of.AWAY)
            by_t, by_u = by_t + j * load(lanes, q + of.AT + 1), by_u - j * load(lanes, q + of.AT)
    return total, twisting, push, by_t, by_u, excess, bears


@woven
def share_out(points, r, lanes, scratch):
    """Give the points of a manifold that press, or did, what all of them lack at least, each by its mass.

    Else the first of them would bear what all do, and what lands squarely would turn. Where some lack what others have
    too much of, nothing is shared. It is one step of Galerkin's method along these masses.
    """
    zero, one, given, number = spread(0.0), spread(1.0), spread(TINY), spread(0.0)
    least, most = spread(FAR), spread(-FAR)
    for p in range(points):
        x = SCRATCH_ROWS * p
        before, target = load(scratch, x + IMPULSE), load(scratch, x + TARGET)
        presses, lacks = larger(before, target), target - before
        store(scratch, x + BEARS, choose(presses, load(scratch, x + STIFF), zero))
        least, most = choose(presses, smaller(least, lacks), least), choose(presses, larger(most, lacks), most)
        number = number + choose(presses, one, zero)
    for p in range(points):
        x, others = SCRATCH_ROWS * p, zero
        for o in range(points):
            if o != p:
                coupling = load(lanes, couplings(r, points) + pair(max(p, o), min(p, o)))
                others = others + load(scratch, SCRATCH_ROWS * o + BEARS) * coupling
        store(scratch, x + OTHERS, others)
        given = given + load(scratch, x + BEARS) * (one + others)
    share = number * (larger(zero, least) + smaller(zero, most)) / given
    for p in range(points):
        x = SCRATCH_ROWS * p
        by_others = load(scratch, x + STIFF) * load(scratch, x + OTHERS)
        store(scratch, x + IMPULSE, load(scratch, x + IMPULSE) + share * load(scratch, x + BEARS))
        store(scratch, x + TARGET, load(scratch, x + TARGET) - share * by_others)
