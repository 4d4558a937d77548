"""Rubbing: friction, spinning and rolling of manifolds, at the middles of their points."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ROLLING_SOLVED
from carom.systems.kernels import groups as of
from carom.systems.kernels.impulses import rolled, struck
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY, dot, keep, plus, spanned, three, times
from carom.systems.kernels.lanes import choose, larger, load, root, smaller, some, spread, store
from carom.systems.kernels.levers import frame_of

# What the manifolds of a group ask for, each more than before; `BALLS` that rub have a way of their own.
IDLE, RESTING, BALLS, RUBBING, TWISTING, ROLLING = 0, 1, 2, 3, 4, 5


@woven
def rub(r, asks, slipping, total, twisting, lanes):
    """Solve friction of a group at the middles of its manifolds, which are ``slipping`` (`slip`).

    Return by how much its impulses along the tangents and its twist about the normal change, and what more than 0
    slides by. ``total`` is the sum of the impulses of each, ``twisting`` that of each times its distance from the
    middle. Friction that slides twists the less: both share one cone (Goyal, Ruina and Papadopoulos, Wear 143, 307,
    1991, as an ellipsoid).
    """
    (first, second, _), friction, zero = frame_of(r, lanes), load(lanes, r + of.FRICTION), spread(0.0)
    (t, u, spin), most = slipping, friction * total
    most_twist, most_spin, per_twist, before, hold = zero, zero, zero, zero, zero
    if asks >= TWISTING:
        most_twist, most_spin = friction * twisting, load(lanes, r + of.SPINNING) * total
        per_twist = choose(most_twist, most / larger(most_twist, spread(TINY)), zero)
        before, hold = load(lanes, r + of.SPUN), load(lanes, r + of.SPIN)
    give, give_both, give_across = three(lanes, r + of.GIVE)
    f = three(lanes, r + of.RUB)
    along, across = dot(first, f), dot(second, f)
    new_along = along - (give * t + give_both * u)
    new_across = across - (give_both * t + give_across * u)
    wanted = before - hold * spin
    part = wanted * per_twist
    size = root(new_along * new_along + new_across * new_across + part * part)
    slides = size - most
    share = choose(slides, most / larger(size, spread(TINY)), spread(1.0))
    new_along, new_across, by_n = new_along * share, new_across * share, zero
    f = spanned(new_along, first, new_across, second)
    keep(lanes, r + of.RUB, f[0], f[1], f[2])
    t, u = new_along - along, new_across - across
    if asks >= TWISTING:
        spin = spin + (load(lanes, r + of.VEER) * t + load(lanes, r + of.VEER + 1) * u)
        up_to = most_spin + choose(slides, smaller(most_twist, larger(wanted, -wanted) * share), most_twist)
        after = smaller(larger(before - hold * spin, -up_to), up_to)
        store(lanes, r + of.SPUN, after)
        by_n = after - before
    return t, u, by_n, slides


@woven
def swerved(r, points, lanes, slipping, push, by_t, by_u):
    """Return what is ``slipping`` after an impulse along the normal at the middle, and twists across it.

    One point, which is the middle, has none of these.
    """
    by = times(push, three(lanes, r + of.SWERVE))
    if points > 1:
        twists = plus(times(by_t, three(lanes, r + of.SWERVE + 3)), times(by_u, three(lanes, r + of.SWERVE + 6)))
        by = plus(by, twists)
    return plus(slipping, by)


@woven
def roll(g, r, sweeps, total, twisting, a, b, index_a, index_b, lanes, bodies):
    """Solve friction and rolling of a group by turns, at most so many; return the velocities of both bodies."""
    (_, _, n), zero, most = frame_of(r, lanes), spread(0.0), load(lanes, r + of.FRICTION) * total
    for _ in range(sweeps):
        slipping = slip(r, lanes, a, b)
        t, u, by_n, slides = rub(r, ROLLING, slipping, total, twisting, lanes)
        a, b = struck(r, lanes, a, b, t, u, zero, zero, zero, by_n)
        # What slides does not roll.
        most_roll = choose(slides, zero, load(lanes, r + of.ROLLING) * total)
        s = (b[4] - a[4], b[5] - a[5], b[6] - a[6])
        spin, (x, y, z) = dot(n, s), three(lanes, r + of.ROLLED)
        up, stiff = dot(n, (x, y, z)), load(lanes, r + of.ROLL)
        wx = x - up * n[0] - stiff * (s[0] - spin * n[0])
        wy = y - up * n[1] - stiff * (s[1] - spin * n[1])
        wz = z - up * n[2] - stiff * (s[2] - spin * n[2])
        size = root(wx * wx + wy * wy + wz * wz)
        share = choose(size - most_roll, most_roll / larger(size, spread(TINY)), spread(1.0))
        wx, wy, wz = wx * share, wy * share, wz * share
        keep(lanes, r + of.ROLLED, wx, wy, wz)
        x, y, z = wx - x, wy - y, wz - z
        a, b = rolled(g, index_a, index_b, bodies, a, b, x, y, z)
        open_rub = t * t + u * u - ROLLING_SOLVED * most * most
        open_roll = x * x + y * y + z * z - ROLLING_SOLVED * most_roll * most_roll
        if not some(larger(open_rub, open_roll)):
            break
    return a, b


@woven
def slip(r, lanes, a, b):
    """Return the velocity of b's surface against a's at the middle, along the tangents, and its spin about the normal.

    What w x r has along t and u is w.(r x t) and w.(r x u), with r x t = z u - q n and r x u = s n - z t.
    """
    t, u, n = frame_of(r, lanes)
    sx, sy, sz = three(lanes, r + of.SURFACE)
    linear = (sx + (b[0] - a[0]), sy + (b[1] - a[1]), sz + (b[2] - a[2]))
    a_t, a_u, a_n = dot(t, a[4:7]), dot(u, a[4:7]), dot(n, a[4:7])
    b_t, b_u, b_n = dot(t, b[4:7]), dot(u, b[4:7]), dot(n, b[4:7])
    (s_a, q_a, z_a), (s_b, q_b, z_b) = three(lanes, r + of.MIDDLE_A), three(lanes, r + of.MIDDLE_B)
    return (
        dot(t, linear) + (z_b * b_u - q_b * b_n) - (z_a * a_u - q_a * a_n),
        dot(u, linear) + (s_b * b_n - z_b * b_t) - (s_a * a_n - z_a * a_t),
        b_n - a_n,
    )
