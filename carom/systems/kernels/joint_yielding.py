"""How bodies yield at a joint: the matrix of what unit impulses along its ways do to each other, factored."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.ecs.components.joint import SLOTS
from carom.systems.constants import HELD, IMMOVABLE
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import bound, factor, slot
from carom.systems.kernels.joint_motion import added
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import about, dot, keep, three
from carom.systems.kernels.lanes import choose, gather, larger, load, spread, store
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT
from carom.systems.kernels.spatial import cross

# Rows of the scratch: for each way, its axis by the inverse masses, its lever about a and b, what unit impulses turn
# them by; then the triangle of how fast each yields to the other, and of what is left of it along the diagonal.
BY_MASS, ARM, TURNS, OF_EACH = 0, 3, 9, 15
MATRIX = OF_EACH * SLOTS
DIAGONAL, COLUMN, SCRATCH_ROWS = MATRIX + SLOTS * (SLOTS + 1) // 2, MATRIX + 27, MATRIX + 33


@woven
def find_yielding(slots, g, r, bounded, index_a, index_b, lanes, bodies, scratch):
    """Factor the matrix of how fast locked ways yield to unit impulses, and find what others give while those hold.

    L D L^T (Golub and Van Loan, Matrix Computations, 4.1), of which ways that are not locked have rows of the identity.
    A pivot that is rounding is one that nothing moves along: it gets no impulse. So is one of a way that locks of the
    bodies forbid, whose axis is off that of the world by rounding.
    """
    mass_a, mass_b = gather(bodies[MASS_AND_FELT], index_a, g), gather(bodies[MASS_AND_FELT], index_b, g)
    inverse_a, inverse_b = gather(bodies[INVERSE], index_a, g), gather(bodies[INVERSE], index_b, g)
    arm_a, arm_b = three(lanes, r + of.ARM_A), three(lanes, r + of.ARM_B)
    for s in range(slots):
        e, o = three(lanes, slot(r, s) + of.AXIS), OF_EACH * s
        if s < 3:
            m = (mass_a[0] + mass_b[0]) * e[0], (mass_a[1] + mass_b[1]) * e[1], (mass_a[2] + mass_b[2]) * e[2]
            of_a, of_b = (
                cross(arm_a[0], arm_a[1], arm_a[2], e[0], e[1], e[2]),
                cross(arm_b[0], arm_b[1], arm_b[2], e[0], e[1], e[2]),
            )
        else:
            m, of_a, of_b = (spread(0.0), spread(0.0), spread(0.0)), e, e
        keep(scratch, o + BY_MASS, m[0], m[1], m[2])
        keep(scratch, o + ARM, of_a[0], of_a[1], of_a[2])
        keep(scratch, o + ARM + 3, of_b[0], of_b[1], of_b[2])
        x, y, z = about(inverse_a, of_a[0], of_a[1], of_a[2])
        keep(scratch, o + TURNS, x, y, z)
        x, y, z = about(inverse_b, of_b[0], of_b[1], of_b[2])
        keep(scratch, o + TURNS + 3, x, y, z)
    for i in range(slots):
        e = three(lanes, slot(r, i) + of.AXIS)
        of_a, of_b = three(scratch, OF_EACH * i + ARM), three(scratch, OF_EACH * i + ARM + 3)
        for j in range(i + 1):
            o = OF_EACH * j
            total = dot(of_a, three(scratch, o + TURNS)) + dot(of_b, three(scratch, o + TURNS + 3))
            if i < 3:
                total = total + dot(e, three(scratch, o + BY_MASS))
            store(scratch, triangle(i, j), total)
    for j in range(slots):
        held = load(lanes, slot(r, j) + of.HELD)
        whole = load(scratch, triangle(j, j))
        pivot = whole
        for k in range(j):
            low = load(lanes, factor(r, slots, j, k))
            pivot = pivot - low * low * load(scratch, DIAGONAL + k)
        least = larger(whole * IMMOVABLE, least_of(j, slots, scratch))
        solid = choose(pivot - least, held, spread(0.0))
        store(scratch, DIAGONAL + j, pivot * solid)
        inverse = solid / choose(solid, pivot, spread(1.0))
        store(lanes, factor(r, slots, j, j), inverse)
        for i in range(j + 1, slots):
            low = load(scratch, triangle(i, j))
            for k in range(j):
                low = low - load(lanes, factor(r, slots, i, k)) * load(lanes, factor(r, slots, j, k)) * load(
                    scratch, DIAGONAL + k
                )
            store(lanes, factor(r, slots, i, j), low * inverse * load(lanes, slot(r, i) + of.HELD))
    if bounded:
        for s in range(slots):
            give, least = load(scratch, triangle(s, s)), least_of(s, slots, scratch)
            for j in range(slots):
                rest = load(scratch, triangle(max(s, j), min(s, j))) * load(lanes, slot(r, j) + of.HELD)
                for k in range(j):
                    rest = rest - load(lanes, factor(r, slots, j, k)) * load(scratch, COLUMN + k)
                store(scratch, COLUMN + j, rest)
                give = give - rest * rest * load(lanes, factor(r, slots, j, j))
            store(lanes, bound(r, slots, s) + of.GIVE, choose(give - least, give, spread(0.0)))
            find_direction(slots, s, r, lanes, scratch)


@woven
def find_direction(slots, s, r, lanes, scratch):
    """Write a unit impulse on way s with what it asks of the locks, so that nothing moves along these."""
    free, zero = spread(1.0) - load(lanes, slot(r, s) + of.HELD), spread(0.0)
    push, twist = added(s, slot(r, s), free, (zero, zero, zero), (zero, zero, zero), lanes)
    for n in range(slots):
        j = slots - 1 - n
        asked = load(scratch, COLUMN + j) * load(lanes, factor(r, slots, j, j))
        for k in range(j + 1, slots):
            asked = asked - load(lanes, factor(r, slots, k, j)) * load(scratch, COLUMN + k)
        store(scratch, COLUMN + j, asked)
        push, twist = added(j, slot(r, j), -(free * asked), push, twist, lanes)
    p = bound(r, slots, s)
    keep(lanes, p + of.PUSH, push[0], push[1], push[2])
    keep(lanes, p + of.TWIST, twist[0], twist[1], twist[2])


@woven
def least_of(s, slots, scratch):
    """Return how fast way s would yield by rounding alone, of what all ways along axes, or about them, do together."""
    first = s // 3 * 3
    total = spread(0.0)
    for k in range(first, min(first + 3, slots)):
        total = total + load(scratch, triangle(k, k))
    return HELD * total


@woven
def triangle(i, j):
    """Return the row of the scratch that holds how fast way i yields to way j, j <= i."""
    return MATRIX + i * (i + 1) // 2 + j
