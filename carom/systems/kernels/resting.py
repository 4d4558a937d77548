"""The resting stage: impulses that hold contacts, by soft steps over groups of manifolds."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import POINT_SWEEPS, PUSH_SPEED, ROLL_SWEEPS, ROLLING_SOLVED
from carom.systems.kernels import groups as of
from carom.systems.kernels.gate import wait_for_all
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY, about, dot, keep, three
from carom.systems.kernels.lanes import (
    address,
    choose,
    gather,
    larger,
    load,
    root,
    scatter,
    smaller,
    some,
    spread,
    store,
)
from carom.systems.kernels.packing import INVERSE, VELOCITY

IDLE, RESTING, RUBBING, TWISTING, ROLLING = (
    0,
    1,
    2,
    3,
    4,
)  # what the manifolds of a group ask for, each more than before


@woven
def pushed(v, mass, x, y, z):
    """Return velocities after an impulse at the centre; ``mass`` is the inverse along the axes."""
    return v[0] + mass[0] * x, v[1] + mass[1] * y, v[2] + mass[2] * z, v[3], v[4], v[5], v[6], v[7]


@woven
def turned(v, j, x, y, z):
    """Return velocities after a turn by j times (x, y, z)."""
    return v[0], v[1], v[2], v[3], v[4] + j * x, v[5] + j * y, v[6] + j * z, v[7]


@woven
def turned_by_row(v, j, lanes, row):
    """Return velocities after a turn by j times three rows."""
    x, y, z = three(lanes, row)
    return turned(v, j, x, y, z)


@woven
def rubbed(r, lanes, a, b, along, across):
    """Return velocities of both bodies after an impulse along the tangents at the middle of a manifold."""
    tx, ty, tz = three(lanes, r + of.TANGENT)
    ux, uy, uz = three(lanes, r + of.TANGENT + 3)
    x, y, z = along * tx + across * ux, along * ty + across * uy, along * tz + across * uz
    a = pushed(a, three(lanes, r + of.MASS_A), -x, -y, -z)
    b = pushed(b, three(lanes, r + of.MASS_B), x, y, z)
    a = turned_by_row(turned_by_row(a, -along, lanes, r + of.TURN_T_A), -across, lanes, r + of.TURN_U_A)
    b = turned_by_row(turned_by_row(b, along, lanes, r + of.TURN_T_B), across, lanes, r + of.TURN_U_B)
    return a, b


@kernel("gate", "bodies")
def start_warm(part, parts, gate, levels, level_ends, index_a, index_b, points, row, asks, lanes, bodies):
    """Apply the impulses of the substep before.

    One of ``parts`` threads takes every so many groups of a level, and waits at the ``gate`` for the others after it.
    """
    lanes, bodies, index_a, index_b = address(lanes), address(bodies), address(index_a), address(index_b)
    for level in range(levels):
        for g in range((level_ends[level - 1] if level else 0) + part, level_ends[level], parts):
            if asks[g] != IDLE:
                press_warm(g, row[g], points[g], asks[g], index_a, index_b, lanes, bodies)
        if parts > 1:
            wait_for_all(gate, parts, level + 1)


@woven
def press_warm(g, r, points, asks, index_a, index_b, lanes, bodies):
    """Apply the impulses of a group."""
    a, b = gather(bodies, index_a, g, VELOCITY), gather(bodies, index_b, g, VELOCITY)
    total = spread(0.0)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        j = load(lanes, q + of.WARM)
        total = total + j
        a = turned_by_row(a, -j, lanes, q + of.TURN_A)
        b = turned_by_row(b, j, lanes, q + of.TURN_B)
    nx, ny, nz = three(lanes, r + of.NORMAL)
    a = pushed(a, three(lanes, r + of.MASS_A), -total * nx, -total * ny, -total * nz)
    b = pushed(b, three(lanes, r + of.MASS_B), total * nx, total * ny, total * nz)
    a, b = rubbed(r, lanes, a, b, load(lanes, r + of.RUB), load(lanes, r + of.RUB + 1))
    if asks >= TWISTING:
        j = load(lanes, r + of.SPUN)
        a, b = turned_by_row(a, -j, lanes, r + of.TURN_N_A), turned_by_row(b, j, lanes, r + of.TURN_N_B)
    if asks == ROLLING:
        x, y, z = three(lanes, r + of.ROLLED)
        one = spread(1.0)
        ax, ay, az = about(gather(bodies, index_a, g, INVERSE), x, y, z)
        bx, by, bz = about(gather(bodies, index_b, g, INVERSE), x, y, z)
        a, b = turned(a, -one, ax, ay, az), turned(b, one, bx, by, bz)
    scatter(bodies, index_a, g, VELOCITY, a)
    scatter(bodies, index_b, g, VELOCITY, b)


@kernel("gate", "lanes", "bodies")
def press_groups(
    part, parts, gate, sweeps, h, ends, levels, level_ends, soft, rigid,
    index_a, index_b, points, row, asks, lanes, bodies,
):  # fmt: skip
    """Solve every group that rests ``sweeps`` times over, sharing the groups of a level as `start_warm` does.

    ``soft`` and ``rigid`` say how contacts of two moving bodies and of one yield (`press`). Those with something that
    cannot move come last, so that what is under a pile has the last word.
    """
    lanes, bodies, index_a, index_b = address(lanes), address(bodies), address(index_a), address(index_b)
    for sweep in range(sweeps):
        for level in range(levels):
            for g in range((level_ends[level - 1] if level else 0) + part, level_ends[level], parts):
                if asks[g] != IDLE:
                    rate, hardness, give_way = soft if g < ends[0] else rigid
                    press(
                        g, row[g], points[g], asks[g], 1.0 / h, rate, hardness, give_way,
                        index_a, index_b, lanes, bodies,
                    )  # fmt: skip
            if parts > 1:
                wait_for_all(gate, parts, sweep * levels + level + 1)


@kernel("lanes")
def sum_impulses(begin, end, points, row, lanes):
    """Add the impulses of the substep to those of the step."""
    lanes = address(lanes)
    for g in range(begin, end):
        r = row[g]
        for p in range(points[g]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            store(lanes, q + of.SUM, load(lanes, q + of.SUM) + load(lanes, q + of.WARM))
        along, across = load(lanes, r + of.RUB), load(lanes, r + of.RUB + 1)
        for k in range(3):
            t, u = load(lanes, r + of.TANGENT + k), load(lanes, r + of.TANGENT + 3 + k)
            store(lanes, r + of.RUBBED + k, load(lanes, r + of.RUBBED + k) + (along * t + across * u))


@woven
def press(g, r, points, asks, per_second, rate, hardness, give_way, index_a, index_b, lanes, bodies):
    """Solve a group once: the points of each manifold one after the other, then friction, spinning and rolling.

    Overlap leaves at ``rate`` (1/s) times itself. A soft contact is a spring and a damper, stepped implicitly, of which
    ``hardness`` (part of the mass) and ``give_way`` (part of the impulse given up) remain: Catto, Soft Constraints, GDC
    2011, and Solver2D, 2024 (soft step). A gap may close until the end of the substep. Friction that slides twists the
    less: both share one cone (Goyal, Ruina and Papadopoulos, Wear 143, 307, 1991, as an ellipsoid).
    """
    a, b = gather(bodies, index_a, g, VELOCITY), gather(bodies, index_b, g, VELOCITY)
    n = three(lanes, r + of.NORMAL)
    mass_a, mass_b = three(lanes, r + of.MASS_A), three(lanes, r + of.MASS_B)
    one, zero = spread(1.0), spread(0.0)
    for _ in range(POINT_SWEEPS if points > 1 else 1):
        for p in range(points):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            off = n[0] * (b[0] - a[0]) + n[1] * (b[1] - a[1]) + n[2] * (b[2] - a[2])
            off = off + (dot(three(lanes, q + of.LEVER_B), b[4:7]) - dot(three(lanes, q + of.LEVER_A), a[4:7]))
            depth, before = load(lanes, q + of.DEPTH), load(lanes, q + of.WARM)
            off = off - choose(-depth, depth * per_second, smaller(depth * rate, spread(PUSH_SPEED)))
            hard, yields = choose(-depth, one, spread(hardness)), choose(-depth, zero, spread(give_way))
            after = larger(zero, before - hard * load(lanes, q + of.MASS) * off - yields * before)
            store(lanes, q + of.WARM, after)
            j = after - before
            a = turned_by_row(pushed(a, mass_a, -j * n[0], -j * n[1], -j * n[2]), -j, lanes, q + of.TURN_A)
            b = turned_by_row(pushed(b, mass_b, j * n[0], j * n[1], j * n[2]), j, lanes, q + of.TURN_B)
    if asks >= RUBBING:
        a, b = rub(g, r, points, asks, a, b, n, index_a, index_b, lanes, bodies)
    scatter(bodies, index_a, g, VELOCITY, a)
    scatter(bodies, index_b, g, VELOCITY, b)


@woven
def rub(g, r, points, asks, a, b, n, index_a, index_b, lanes, bodies):
    """Solve friction of a group at the middles of its manifolds; return the velocities of both bodies."""
    total, twisting = spread(0.0), spread(0.0)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        j = load(lanes, q + of.WARM)
        total, twisting = total + j, twisting + j * load(lanes, q + of.AWAY)
    friction = load(lanes, r + of.FRICTION)
    most = friction * total
    most_twist, most_spin = friction * twisting, load(lanes, r + of.SPINNING) * total
    give, give_both, give_across = three(lanes, r + of.GIVE)
    along, across = load(lanes, r + of.RUB), load(lanes, r + of.RUB + 1)
    for _ in range(ROLL_SWEEPS if asks == ROLLING else 1):
        s = slip(r, lanes, a, b)
        t, u = dot(three(lanes, r + of.TANGENT), s), dot(three(lanes, r + of.TANGENT + 3), s)
        new_along = along - (give * t + give_both * u)
        new_across = across - (give_both * t + give_across * u)
        s = (b[4] - a[4], b[5] - a[5], b[6] - a[6])
        spin, before, hold = dot(n, s), load(lanes, r + of.SPUN), load(lanes, r + of.SPIN)
        wanted = before - hold * spin
        part = choose(most_twist, wanted * most / larger(most_twist, spread(TINY)), spread(0.0))
        size = root(new_along * new_along + new_across * new_across + part * part)
        share = choose(size - most, most / larger(size, spread(TINY)), spread(1.0))
        new_along, new_across = new_along * share, new_across * share
        t, u = new_along - along, new_across - across
        a, b = rubbed(r, lanes, a, b, t, u)
        along, across = new_along, new_across
        if asks < TWISTING:
            break
        s = (b[4] - a[4], b[5] - a[5], b[6] - a[6])
        spin = dot(n, s)
        up_to = most_spin + choose(size - most, smaller(most_twist, larger(wanted, -wanted) * share), most_twist)
        after = smaller(larger(before - hold * spin, -up_to), up_to)
        store(lanes, r + of.SPUN, after)
        j = after - before
        a, b = turned_by_row(a, -j, lanes, r + of.TURN_N_A), turned_by_row(b, j, lanes, r + of.TURN_N_B)
        if asks < ROLLING:
            break
        # What slides does not roll.
        most_roll = choose(size - most, spread(0.0), load(lanes, r + of.ROLLING) * total)
        x, y, z = three(lanes, r + of.ROLLED)
        up, stiff = dot(n, (x, y, z)), load(lanes, r + of.ROLL)
        wx = x - up * n[0] - stiff * (s[0] - spin * n[0])
        wy = y - up * n[1] - stiff * (s[1] - spin * n[1])
        wz = z - up * n[2] - stiff * (s[2] - spin * n[2])
        size = root(wx * wx + wy * wy + wz * wz)
        share = choose(size - most_roll, most_roll / larger(size, spread(TINY)), spread(1.0))
        wx, wy, wz = wx * share, wy * share, wz * share
        keep(lanes, r + of.ROLLED, wx, wy, wz)
        x, y, z = wx - x, wy - y, wz - z
        one = spread(1.0)
        ax, ay, az = about(gather(bodies, index_a, g, INVERSE), x, y, z)
        bx, by, bz = about(gather(bodies, index_b, g, INVERSE), x, y, z)
        a, b = turned(a, -one, ax, ay, az), turned(b, one, bx, by, bz)
        open_rub = t * t + u * u - ROLLING_SOLVED * most * most
        open_roll = x * x + y * y + z * z - ROLLING_SOLVED * most_roll * most_roll
        if not some(larger(open_rub, open_roll)):
            break
    store(lanes, r + of.RUB, along)
    store(lanes, r + of.RUB + 1, across)
    return a, b


@woven
def slip(r, lanes, a, b):
    """Return the velocity of b's surface against a's at the middle of a manifold."""
    sx, sy, sz = three(lanes, r + of.SURFACE)
    ax, ay, az = three(lanes, r + of.MIDDLE_A)
    bx, by, bz = three(lanes, r + of.MIDDLE_B)
    return (
        sx + (b[0] - a[0]) + (b[5] * bz - b[6] * by) - (a[5] * az - a[6] * ay),
        sy + (b[1] - a[1]) + (b[6] * bx - b[4] * bz) - (a[6] * ax - a[4] * az),
        sz + (b[2] - a[2]) + (b[4] * by - b[5] * bx) - (a[4] * ay - a[5] * ax),
    )
