"""Manifolds: runs of contact points that a pair has on one plane, and what the resting stage needs to know of them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import IMMOVABLE, MANIFOLD_POINTS, REGROUPED, SAME_NORMAL, SINGULAR
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BALL, BOX
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS, couplings, pair
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY, about, dot, keep, three
from carom.systems.kernels.lanes import choose, gather, larger, load, root, spread, store
from carom.systems.kernels.levers import coupled, frame_of
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT
from carom.systems.kernels.rubbing import ROLLING, RUBBING, TWISTING


@kernel("start")
def find_manifolds(count, row_a, row_b, body_a, body_b, kind, normal, resting, grouped, start):
    """Write where each manifold begins, and one past the last.

    Return how many there are, whether some are not of balls on exact arcs, whether some are of two balls or of a ball
    and a box, whether bodies may have several side by side: of one pair, or since they have several colliders; and
    whether all that is written was there already, and whether all but a few (REGROUPED) rest that did when they were
    ``grouped``, and no others.
    """
    number, solids, balls, boxes, several, stay, turned = 0, False, False, False, False, True, 0
    for c in range(count):
        solids |= kind[c] < 0
        balls |= kind[c] == BALL
        boxes |= kind[c] == BOX
        several |= (body_a[c] >= 0 and body_a[c] != row_a[c]) or (body_b[c] >= 0 and body_b[c] != row_b[c])
        if number:
            first = start[number - 1]
            if row_a[c] == row_a[first] and row_b[c] == row_b[first] and are_alike(c, first, normal):
                if c - first < MANIFOLD_POINTS:
                    continue
                several = True
        stay &= start[number] == c
        turned += grouped[c] != resting[c]
        start[number] = c
        number += 1
    stay &= start[number] == count
    start[number] = count
    return number, solids, balls, boxes, several, stay, turned <= REGROUPED * number


@woven
def are_alike(c, o, normal):
    """Tell whether two contacts are on one plane, or on planes alike."""
    return normal[c, 0] * normal[o, 0] + normal[c, 1] * normal[o, 1] + normal[c, 2] * normal[o, 2] >= SAME_NORMAL


@kernel("lanes", makes_arrays=True)
def part_masses(
    count, start, row_a, row_b, body_a, body_b, normal, inverse_mass, group_of, lane_of, row, lanes
):  # fmt: skip
    """Let manifolds that two bodies have side by side, on planes alike, move no more mass than four points would.

    Else the springs of all points would bear a body on another so much more stiffly, as those beyond the fourth of a
    pair or those of the four legs of a table, and towers would flutter.
    """
    begin = np.zeros(len(inverse_mass) + 1, np.int64)  # of the manifolds by one of the two bodies
    among = np.empty(count, np.int64)
    for m in range(count):
        c, before, after = start[m], start[max(m - 1, 0)], start[min(m + 1, count - 1)]
        a, b, among[m] = body_a[c], body_b[c], -1
        if a < 0 or b < 0 or inverse_mass[a] == 0.0 or inverse_mass[b] == 0.0:
            continue
        alone = m == 0 or body_a[before] != a or body_b[before] != b
        alone = alone and (m == count - 1 or body_a[after] != a or body_b[after] != b)
        if not alone or a != row_a[c] or b != row_b[c]:  # those of several colliders may be anywhere
            among[m] = a
            begin[a + 1] += 1
    for i in range(len(inverse_mass)):
        begin[i + 1] += begin[i]
    ordered, place = np.empty(begin[len(inverse_mass)], np.int64), begin.copy()
    for m in range(count):
        if among[m] >= 0:
            ordered[place[among[m]]] = m
            place[among[m]] += 1
    for m in ordered:
        c, points = start[m], 0
        for k in ordered[begin[among[m]] : begin[among[m] + 1]]:
            o = start[k]
            points += start[k + 1] - o if body_b[c] == body_b[o] and are_alike(c, o, normal) else 0
        if points > MANIFOLD_POINTS:
            lanes[row[group_of[m]] + of.PART, lane_of[m]] = MANIFOLD_POINTS / points


@woven
def inverse_or_none(rests, x):
    """Return 1 / x where there is something that can move and that rests, else 0."""
    return choose(x, rests / larger(x, spread(TINY)), spread(0.0))


@woven
def prepare(g, r, points, asks, rests, index_a, index_b, lanes, bodies):
    """Write what follows for a group from where its bodies are; masses are 0 where a manifold does not rest.

    What friction, spinning and rolling need is written where the group ``asks`` for them.
    """
    zero = spread(0.0)
    store(lanes, r + of.SWUNG, zero)
    masses_a, masses_b = gather(bodies[MASS_AND_FELT], index_a, g), gather(bodies[MASS_AND_FELT], index_b, g)
    masses_a, inertia_a, movable_a, roll_a = prepare_body(g, r, 0, index_a, masses_a, lanes, bodies)
    masses_b, inertia_b, movable_b, roll_b = prepare_body(g, r, 1, index_b, masses_b, lanes, bodies)
    movable = movable_a + movable_b
    (s_a, q_a, z_a), (s_b, q_b, z_b) = three(lanes, r + of.MIDDLE_A), three(lanes, r + of.MIDDLE_B)
    # An impulse along the normal at the middle has the lever q t - s u.
    tt, tu, uu = inertia_a[0] + inertia_b[0], inertia_a[1] + inertia_b[1], inertia_a[2] + inertia_b[2]
    a_t, a_u = q_a * inertia_a[0] - s_a * inertia_a[1], q_a * inertia_a[1] - s_a * inertia_a[2]
    b_t, b_u = q_b * inertia_b[0] - s_b * inertia_b[1], q_b * inertia_b[1] - s_b * inertia_b[2]
    along = (masses_a[5] + (q_a * a_t - s_a * a_u)) + (masses_b[5] + (q_b * b_t - s_b * b_u))
    by_t, by_u, part = a_t + b_t, a_u + b_u, rests * load(lanes, r + of.PART)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        for o in range(p):
            to = r + MANIFOLD_ROWS + POINT_ROWS * o
            store(lanes, couplings(r, points) + pair(p, o), coupled(lanes, q, to, along, by_t, by_u, (tt, tu, uu)))
        yields = coupled(lanes, q, q, along, by_t, by_u, (tt, tu, uu))
        held = choose(yields - IMMOVABLE * movable, part, zero)  # no impulse where locks all but forbid to part
        store(lanes, q + of.MASS, inverse_or_none(held, yields))
        x, y = load(lanes, q + of.AT), load(lanes, q + of.AT + 1)
        store(lanes, q + of.AWAY, root(x * x + y * y) if asks >= TWISTING else zero)
    if asks >= RUBBING:
        swerve_a, swerve_b = swerving(s_a, q_a, z_a, masses_a, inertia_a), swerving(s_b, q_b, z_b, masses_b, inertia_b)
        for k in range(len(swerve_a)):  # and `VEER`
            store(lanes, r + of.SWERVE + k, swerve_a[k] + swerve_b[k])
    give_a, give_b = give_way(s_a, q_a, z_a, masses_a, inertia_a), give_way(s_b, q_b, z_b, masses_b, inertia_b)
    ktt, ktu, kuu = give_a[0] + give_b[0], give_a[1] + give_b[1], give_a[2] + give_b[2]
    # Where one direction is locked, the other is as good as any.
    trace = ktt + kuu
    locked = SINGULAR * trace * trace - (ktt * kuu - ktu * ktu)
    ktt, ktu, kuu = choose(locked, trace, ktt), choose(locked, zero, ktu), choose(locked, trace, kuu)
    inverse = inverse_or_none(rests, ktt * kuu - ktu * ktu)
    keep(lanes, r + of.GIVE, kuu * inverse, -ktu * inverse, ktt * inverse)
    store(lanes, r + of.SPIN, inverse_or_none(rests, inertia_a[5] + inertia_b[5]) if asks >= TWISTING else zero)
    store(lanes, r + of.ROLL, inverse_or_none(rests, roll_a + roll_b) if asks == ROLLING else zero)


@woven
def prepare_body(g, r, side, index, masses, lanes, bodies):
    """Write what follows from one body of each manifold, which are a (side 0) or b (side 1).

    Return inverse mass and inertia in the frame, each (tt, tu, uu, tn, un, nn), inverse mass and inertia without locks.
    """
    keep(lanes, r + of.MASS_A + 3 * side, masses[0], masses[1], masses[2])
    by_t, by_u, by_n, most = turn_about(g, r, side, index, lanes, bodies)
    t, u, n = frame_of(r, lanes)
    along_t, along_u, along_n = scaled(masses, t), scaled(masses, u), scaled(masses, n)
    return in_frame(t, u, n, along_t, along_u, along_n), in_frame(t, u, n, by_t, by_u, by_n), masses[6], most


@woven
def turn_about(g, r, side, index, lanes, bodies):
    """Write and return how a body of each manifold turns by twists about the axes; and its largest inverse moment."""
    inertia = gather(bodies[INVERSE], index, g)
    t, u, n = frame_of(r, lanes)
    by_t, by_u, by_n = about(inertia, *t), about(inertia, *u), about(inertia, *n)
    turns = r + of.TURN_A + 9 * side
    keep(lanes, turns, by_t[0], by_t[1], by_t[2])
    keep(lanes, turns + 3, by_u[0], by_u[1], by_u[2])
    keep(lanes, turns + 6, by_n[0], by_n[1], by_n[2])
    return by_t, by_u, by_n, inertia[6]


@woven
def scaled(masses, x):
    """Return a vector scaled along the axes."""
    return masses[0] * x[0], masses[1] * x[1], masses[2] * x[2]


@woven
def in_frame(t, u, n, by_t, by_u, by_n):
    """Return a symmetric tensor in the frame: (tt, tu, uu, tn, un, nn)."""
    return dot(t, by_t), dot(u, by_t), dot(u, by_u), dot(n, by_t), dot(n, by_u), dot(n, by_n)


@woven
def swerving(s, q, z, masses, inertia):
    """Return how one body slips along the tangents and spins about the normal, (t, u, n) each, and spins, (n) each.

    The former by an impulse along the normal at the middle and by twists about the tangents, the latter by impulses
    along these. The levers of those three impulses are q t - s u, z u - q n and s n - z t.
    """
    tt, tu, uu, tn, un, nn = inertia
    by_t, by_u, by_n = q * tt - s * tu, q * tu - s * uu, q * tn - s * un
    return (
        masses[3] + (z * by_u - q * by_n), masses[4] + (s * by_n - z * by_t), by_n,
        z * tu - q * tn, s * tn - z * tt, tn,
        z * uu - q * un, s * un - z * tu, un,
        z * un - q * nn, s * nn - z * tn,
    )  # fmt: skip


@woven
def give_way(s, q, z, masses, inertia):
    """Return how one body gives way to an impulse at the middle, along the tangents: (tt, tu, uu).

    The levers there are z u - q n and s n - z t.
    """
    tt, tu, uu, tn, un, nn = inertia
    return (
        masses[0] + (z * (z * uu - q * un) + q * (q * nn - z * un)),
        masses[1] + (z * (s * un - z * tu) + q * (z * tn - s * nn)),
        masses[2] + (s * (s * nn - z * tn) + z * (z * tt - s * tn)),
    )
