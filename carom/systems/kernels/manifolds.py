"""Manifolds: runs of contact points that a pair has on one plane, and what the resting stage needs to know of them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import IMMOVABLE, MANIFOLD_POINTS, SAME_NORMAL, SINGULAR
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY, about, crossed, dot, keep, three
from carom.systems.kernels.lanes import choose, gather, larger, load, root, spread, store
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT


@kernel("start")
def find_manifolds(count, row_a, row_b, normal, start):
    """Write where each manifold begins, and one past the last; return how many there are."""
    number = 0
    for c in range(count):
        if number:
            first = start[number - 1]
            if row_a[c] == row_a[first] and row_b[c] == row_b[first] and c - first < MANIFOLD_POINTS:
                x, y, z = normal[first, 0], normal[first, 1], normal[first, 2]
                if x * normal[c, 0] + y * normal[c, 1] + z * normal[c, 2] >= SAME_NORMAL:
                    continue
        start[number] = c
        number += 1
    start[number] = count
    return number


@woven
def inverse_or_none(rests, x):
    """Return 1 / x where there is something that can move and that rests, else 0."""
    return choose(x, rests / larger(x, spread(TINY)), spread(0.0))


@woven
def prepare(g, r, points, rests, index_a, index_b, lanes, bodies):
    """Write what follows for a group from where its bodies are; masses are 0 where a manifold does not rest."""
    n, t, u = three(lanes, r + of.NORMAL), three(lanes, r + of.TANGENT), three(lanes, r + of.TANGENT + 3)
    share, zero = load(lanes, r + of.SHARE), spread(0.0)
    for p in range(points):
        store(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.MASS, zero)
    ktt, ktu, kuu, spin, roll, movable = zero, zero, zero, zero, zero, zero
    for side in range(2):
        index = index_a if side == 0 else index_b
        masses = gather(bodies, index, g, MASS_AND_FELT)
        inertia = gather(bodies, index, g, INVERSE)
        keep(lanes, r + of.MASS_A + 3 * side, masses[0], masses[1], masses[2])
        along = masses[0] * n[0] * n[0] + masses[1] * n[1] * n[1] + masses[2] * n[2] * n[2]
        x, y, z = zero, zero, zero
        for p in range(points):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            ox, oy, oz = three(lanes, q + of.OFFSET_A + 3 * side)
            x, y, z = x + ox, y + oy, z + oz
            lever = three(lanes, q + of.LEVER_A + 3 * side)
            wx, wy, wz = about(inertia, lever[0], lever[1], lever[2])
            keep(lanes, q + of.TURN_A + 3 * side, wx, wy, wz)
            store(lanes, q + of.MASS, load(lanes, q + of.MASS) + (along + dot(lever, (wx, wy, wz))))
        middle = (x * share, y * share, z * share)
        keep(lanes, r + of.MIDDLE_A + 3 * side, middle[0], middle[1], middle[2])
        lever_t, lever_u = crossed(middle, t), crossed(middle, u)
        turn_t = about(inertia, lever_t[0], lever_t[1], lever_t[2])
        turn_u = about(inertia, lever_u[0], lever_u[1], lever_u[2])
        turn_n = about(inertia, n[0], n[1], n[2])
        keep(lanes, r + of.TURN_T_A + 6 * side, turn_t[0], turn_t[1], turn_t[2])
        keep(lanes, r + of.TURN_U_A + 6 * side, turn_u[0], turn_u[1], turn_u[2])
        keep(lanes, r + of.TURN_N_A + 3 * side, turn_n[0], turn_n[1], turn_n[2])
        ktt = ktt + (dot(masses, (t[0] * t[0], t[1] * t[1], t[2] * t[2])) + dot(lever_t, turn_t))
        kuu = kuu + (dot(masses, (u[0] * u[0], u[1] * u[1], u[2] * u[2])) + dot(lever_u, turn_u))
        ktu = ktu + (dot(masses, (t[0] * u[0], t[1] * u[1], t[2] * u[2])) + dot(lever_u, turn_t))
        spin, roll, movable = spin + dot(n, turn_n), roll + inertia[6], movable + masses[6]
    middle = three(lanes, r + of.MIDDLE_B)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        yields = load(lanes, q + of.MASS)
        held = choose(yields - IMMOVABLE * movable, rests, zero)  # no impulse where locks all but forbid to part
        store(lanes, q + of.MASS, inverse_or_none(held, yields))
        x, y, z = three(lanes, q + of.OFFSET_B)
        away = crossed((x - middle[0], y - middle[1], z - middle[2]), n)
        store(lanes, q + of.AWAY, root(dot(away, away)))
    # Where one direction is locked, the other is as good as any.
    trace = ktt + kuu
    locked = SINGULAR * trace * trace - (ktt * kuu - ktu * ktu)
    ktt, ktu, kuu = choose(locked, trace, ktt), choose(locked, zero, ktu), choose(locked, trace, kuu)
    inverse = inverse_or_none(rests, ktt * kuu - ktu * ktu)
    keep(lanes, r + of.GIVE, kuu * inverse, -ktu * inverse, ktt * inverse)
    store(lanes, r + of.SPIN, inverse_or_none(rests, spin))
    store(lanes, r + of.ROLL, inverse_or_none(rests, roll))
