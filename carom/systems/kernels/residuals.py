"""Residuals: what a sweep of the resting stage has left open, and which of its limits are at work."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import PUSH_SPEED
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY, dot, minus, three, times
from carom.systems.kernels.lanes import address, choose, gather, larger, load, planes, root, spread, store
from carom.systems.kernels.levers import frame_of, parting_at, parting_of
from carom.systems.kernels.packing import VELOCITY
from carom.systems.kernels.resting_balls import parting_of_balls
from carom.systems.kernels.rubbing import BALLS, IDLE, ROLLING, RUBBING, TWISTING, slip
from carom.systems.kernels.softness import aimed_at, leaving, of_any_load

#: Rows of a group: the largest residual of a point of each manifold and the sum of those of all its points (m/s); how
#: many of its points bear nothing, since they do not pull, and how many overlaps leave at the highest speed; 1 where
#: friction, twisting and rolling friction are all they may be.
LARGEST, SUMMED, OPEN, PUSHED, SLIDING, SPINNING, ROLLS, FOUND = range(8)
BEYOND = 1.0 + 1e-9  # times a limit; up to there it is rounding


@kernel("found")
def find_residuals(begin, end, h, ends, soft, rigid, index_a, index_b, points, row, asks, lanes, bodies, found):
    """Write what the next sweep would change, FOUND rows a group; nothing else is written.

    A point that bears the impulse j and should part at w has the residual |min(w, j / m)|, m being the mass along the
    normal: 0 where it bears and parts as wanted, or bears nothing and parts faster. This is the natural residual of the
    complementarity problem j >= 0, w >= 0, j w = 0 (Cottle, Pang and Stone, The Linear Complementarity Problem, 1992,
    section 5.10; Erleben, Numerical Methods for Linear Complementarity Problems in Physics-Based Animation, 2013),
    in m/s. Where contacts yield w holds that part of it too (`aimed_at`).
    """
    lanes, bodies, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    found = address(found)
    for g in range(begin, end):
        for k in range(FOUND):
            store(found, FOUND * g + k, spread(0.0))
        if asks[g] != IDLE:
            yielding = soft if g < ends[0] else rigid
            a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
            parting, slips = parting_of_any(row[g], asks[g], lanes, a, b)
            total, twisting = look_at_points(
                row[g], points[g], 1.0 / h, yielding, parting, lanes, FOUND * g, found
            )  # fmt: skip
            if asks[g] == BALLS:
                look_at_balls(row[g], total, slips, lanes, FOUND * g, found)
            elif asks[g] >= RUBBING:
                look_at_friction(row[g], asks[g], total, twisting, a, b, lanes, FOUND * g, found)


@woven
def parting_of_any(r, asks, lanes, a, b):
    """Return how bodies part, as `parting_of` does, and how fast balls slip."""
    zero = spread(0.0)
    if asks == BALLS:
        parts, slips = parting_of_balls(r, lanes, a, b)
        return (parts, zero, zero), slips
    return parting_of(r, lanes, a, b), (zero, zero, zero)


@woven
def look_at_points(r, points, per_second, yielding, parting, lanes, to, found):
    """Write what the points of a group have left open; return the sum of their impulses, and times their distances."""
    one, zero, slow = spread(1.0), spread(0.0), leaving(points, yielding, parting)
    total, twisting, largest, summed, opened, pushed = zero, zero, zero, zero, zero, zero
    how = of_any_load(yielding) if points == 1 else yielding
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        depth, before, mass = load(lanes, q + of.DEPTH), load(lanes, q + of.WARM), load(lanes, q + of.MASS)
        there = choose(mass, choose(depth - spread(0.5 * ABSENT), one, zero), zero)
        parts = parting_at(q, lanes, parting) if points > 1 else parting[0]
        target, stiff = aimed_at(depth, before, mass, parts, per_second, slow, how, one)
        after = larger(zero, target)
        change = larger(after - before, before - after)
        left = choose(there, change / larger(stiff, spread(TINY)), zero)
        largest, summed = larger(largest, left), summed + left
        opened = opened + choose(before, zero, there)
        pushed = pushed + choose(depth * yielding[0] - PUSH_SPEED, there, zero)
        total = total + before
        if points > 1:  # else it is the middle
            twisting = twisting + before * load(lanes, q + of.AWAY)
    store(found, to + LARGEST, largest)
    store(found, to + SUMMED, summed)
    store(found, to + OPEN, opened)
    store(found, to + PUSHED, pushed)
    return total, twisting


@woven
def look_at_balls(r, total, slips, lanes, to, found):
    """Write which manifolds of a group of balls, which slip so fast, rub with all that `press_balls` allows."""
    most = load(lanes, r + of.FRICTION) * total
    f = minus(three(lanes, r + of.RUB), times(load(lanes, r + of.GIVE), slips))
    store(found, to + SLIDING, slides(root(dot(f, f)), most))


@woven
def slides(size, most):
    """Return 1 where friction would have to be larger than it can be, else 0."""
    return choose(most, choose(size - most * BEYOND, spread(1.0), spread(0.0)), spread(0.0))


@woven
def look_at_friction(r, asks, total, twisting, a, b, lanes, to, found):
    """Write which manifolds of a group rub, twist and roll with all that `rub` allows."""
    one, zero, friction = spread(1.0), spread(0.0), load(lanes, r + of.FRICTION)
    most, most_twist = friction * total, friction * twisting
    give, give_both, give_across = three(lanes, r + of.GIVE)
    t, u, spin = slip(r, lanes, a, b)
    f, (first, second, _) = three(lanes, r + of.RUB), frame_of(r, lanes)
    along, across = dot(first, f) - (give * t + give_both * u), dot(second, f) - (give_both * t + give_across * u)
    wanted = load(lanes, r + of.SPUN) - load(lanes, r + of.SPIN) * spin
    part = wanted * choose(most_twist, most / larger(most_twist, spread(TINY)), zero)
    size = root(along * along + across * across + part * part)
    sliding = slides(size, most)
    store(found, to + SLIDING, sliding)
    if asks < TWISTING:
        return
    up_to = load(lanes, r + of.SPINNING) * total + most_twist
    store(found, to + SPINNING, choose(up_to, choose(larger(wanted, -wanted) - up_to * BEYOND, one, zero), zero))
    if asks < ROLLING:
        return
    n, (x, y, z), stiff = three(lanes, r + of.NORMAL), three(lanes, r + of.ROLLED), load(lanes, r + of.ROLL)
    most_roll = choose(sliding, zero, load(lanes, r + of.ROLLING) * total)
    turns, up = (b[4] - a[4], b[5] - a[5], b[6] - a[6]), dot(n, (x, y, z))
    x, y, z = (
        x - up * n[0] - stiff * (turns[0] - spin * n[0]),
        y - up * n[1] - stiff * (turns[1] - spin * n[1]),
        z - up * n[2] - stiff * (turns[2] - spin * n[2]),
    )
    size = root(x * x + y * y + z * z)
    store(found, to + ROLLS, choose(most_roll, choose(size - most_roll * BEYOND, one, zero), zero))
