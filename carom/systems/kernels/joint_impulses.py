"""Impulses of joints: locks exactly, all ways of a joint at once; then limits, drives and friction, one by one."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import SLOTS
from carom.systems.constants import BOUNCE_SPEED
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import (
    DRIVE_BIT,
    FRICTION_BIT,
    KINDS,
    LIMIT_BIT,
    bound,
    factor,
    slot,
    slots_of,
)
from carom.systems.kernels.joint_points import WAYS, finish_point, hold_point, moved_point, three_of
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY, about, dot, three
from carom.systems.kernels.lanes import WIDTH, address, choose, gather, larger, load, scatter, smaller, spread, store
from carom.systems.kernels.packing import INVERSE, MASS_AND_FELT, VELOCITY
from carom.systems.kernels.spatial import cross


@kernel("bodies")
def start_joints_warm(groups, kinds, row, index_a, index_b, lanes, bodies):
    """Apply the impulses of the substep before."""
    lanes, bodies, index_a, index_b = address(lanes), address(bodies), address(index_a), address(index_b)
    for g in range(groups):
        r, slots, bounded = row[g], slots_of(kinds[g]), kinds[g] >= KINDS
        a, b = gather(bodies, index_a, g, VELOCITY), gather(bodies, index_b, g, VELOCITY)
        if slots == WAYS:
            a, b = moved_point(r, three_of(r, lanes, of.HOLD), a, b, lanes)
        else:
            zero = spread(0.0)
            push, twist = (zero, zero, zero), (zero, zero, zero)
            for s in range(slots):
                q = slot(r, s)
                j = load(lanes, q + of.HOLD)
                if bounded:
                    p = bound(r, slots, s)
                    j = j + load(lanes, p + of.DRIVE) + load(lanes, p + of.RUB)
                push, twist = added(s, q, j, push, twist, lanes)
            a, b = moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies)
        scatter(bodies, index_a, g, VELOCITY, a)
        scatter(bodies, index_b, g, VELOCITY, b)


@kernel("lanes", "bodies")
def solve_joints(relaxing, h, rate, hardness, groups, kinds, asks, row, index_a, index_b, lanes, bodies):
    """Solve every group once.

    What is locked goes back to its place at ``rate`` (1/s) times what it is off by, with ``hardness`` of the mass and
    of the impulse that is there (Catto, Soft Constraints, GDC 2011), and stays there when ``relaxing``: the first
    pushes along the axes at the start of the way, the second takes what goes along those at its end, which keeps energy
    (Andersen, Rattle, J. Comput. Phys. 52, 24, 1983). The groups go in their order, and back when relaxing.
    """
    lanes, bodies, index_a, index_b = address(lanes), address(bodies), address(index_a), address(index_b)
    room = np.empty((SLOTS, WIDTH))
    scratch = address(room)
    for n in range(groups):
        g = groups - 1 - n if relaxing else n
        r, slots = row[g], slots_of(kinds[g])
        a, b = gather(bodies, index_a, g, VELOCITY), gather(bodies, index_b, g, VELOCITY)
        if slots == 1:
            a, b = hold(1, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
        elif slots == WAYS:
            push = hold_point(r, rate, hardness, a, b, lanes)
            a, b = moved_point(r, push, a, b, lanes)
        else:
            a, b = hold(6, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
        if kinds[g] >= KINDS and asks[g]:
            for s in range(slots):
                p = bound(r, slots, s)
                if asks[g] & FRICTION_BIT << s:
                    a, b = rub(s, g, r, p, hardness, h, a, b, index_a, index_b, lanes, bodies)
                if asks[g] & DRIVE_BIT << s:
                    a, b = drive(s, g, r, p, relaxing, hardness, h, a, b, index_a, index_b, lanes, bodies)
                if asks[g] & LIMIT_BIT << s:
                    a, b = limit(s, g, r, p, relaxing, rate, hardness, h, a, b, index_a, index_b, lanes, bodies)
            if slots == 1:
                a, b = hold(1, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
            else:
                a, b = hold(6, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
        scatter(bodies, index_a, g, VELOCITY, a)
        scatter(bodies, index_b, g, VELOCITY, b)


@kernel("lanes")
def finish_joints(groups, kinds, row, index_a, index_b, lanes, bodies):
    """Note how fast each way goes, and add the impulses of the substep to those of the step."""
    lanes, bodies, index_a, index_b = address(lanes), address(bodies), address(index_a), address(index_b)
    for g in range(groups):
        r, slots, bounded = row[g], slots_of(kinds[g]), kinds[g] >= KINDS
        a, b = gather(bodies, index_a, g, VELOCITY), gather(bodies, index_b, g, VELOCITY)
        if slots == WAYS:
            finish_point(r, a, b, lanes)
            continue
        along, turning = parting(r, a, b, lanes)
        for s in range(slots):
            q = slot(r, s)
            store(lanes, q + of.SPEED, dot(three(lanes, q + of.AXIS), along if s < 3 else turning))
            store(lanes, q + of.SUM, load(lanes, q + of.SUM) + load(lanes, q + of.HOLD))
            if bounded:
                p = bound(r, slots, s)
                store(lanes, p + of.DRIVE_SUM, load(lanes, p + of.DRIVE_SUM) + load(lanes, p + of.DRIVE))
                store(lanes, p + of.RUB_SUM, load(lanes, p + of.RUB_SUM) + load(lanes, p + of.RUB))


@woven
def parting(r, a, b, lanes):
    """Return how fast b moves against a at the anchor of b, and how fast it turns."""
    ax, ay, az = three(lanes, r + of.ARM_A)
    bx, by, bz = three(lanes, r + of.ARM_B)
    px, py, pz = cross(a[4], a[5], a[6], ax, ay, az)
    qx, qy, qz = cross(b[4], b[5], b[6], bx, by, bz)
    along = (b[0] - a[0] + (qx - px), b[1] - a[1] + (qy - py), b[2] - a[2] + (qz - pz))
    return along, (b[4] - a[4], b[5] - a[5], b[6] - a[6])


@woven
def added(s, q, j, push, twist, lanes):
    """Return the push at the anchor and the twist with an impulse along or about way s more."""
    x, y, z = three(lanes, q + of.AXIS)
    if s < 3:
        return (push[0] + j * x, push[1] + j * y, push[2] + j * z), twist
    return push, (twist[0] + j * x, twist[1] + j * y, twist[2] + j * z)


@woven
def moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies):
    """Return the velocities after a push on b at its anchor and a twist, and their opposites on a."""
    a = moved_one(
        gather(bodies, index_a, g, MASS_AND_FELT),
        gather(bodies, index_a, g, INVERSE),
        r + of.ARM_A,
        -1.0,
        push,
        twist,
        a,
        lanes,
    )
    b = moved_one(
        gather(bodies, index_b, g, MASS_AND_FELT),
        gather(bodies, index_b, g, INVERSE),
        r + of.ARM_B,
        1.0,
        push,
        twist,
        b,
        lanes,
    )
    return a, b


@woven
def moved_one(mass, inverse, arm, sign, push, twist, v, lanes):
    """Return the velocity of a body after ``sign`` times a push at its arm and a twist."""
    x, y, z = three(lanes, arm)
    tx, ty, tz = cross(x, y, z, push[0], push[1], push[2])
    wx, wy, wz = about(inverse, tx + twist[0], ty + twist[1], tz + twist[2])
    return (
        v[0] + sign * mass[0] * push[0], v[1] + sign * mass[1] * push[1], v[2] + sign * mass[2] * push[2], v[3],
        v[4] + sign * wx, v[5] + sign * wy, v[6] + sign * wz, v[7],
    )  # fmt: skip


@woven
def hold(slots, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch):
    """Solve what is locked, of all ways at once; return the velocities."""
    along, turning = parting(r, a, b, lanes)
    zero = spread(0.0)
    push, twist = (zero, zero, zero), (zero, zero, zero)
    for s in range(slots):
        q = slot(r, s)
        speed = dot(three(lanes, q + of.AXIS), along if s < 3 else turning)
        off = load(lanes, q + of.PLACE) - load(lanes, q + of.AT)
        rest = -(load(lanes, q + of.HELD) * (speed + rate * off))
        for k in range(s):
            rest = rest - load(lanes, factor(r, slots, s, k)) * load(scratch, k)
        store(scratch, s, rest)
    for n in range(slots):
        s = slots - 1 - n
        q = slot(r, s)
        j = load(scratch, s) * load(lanes, factor(r, slots, s, s))
        for k in range(s + 1, slots):
            j = j - load(lanes, factor(r, slots, k, s)) * load(scratch, k)
        store(scratch, s, j)
        before = load(lanes, q + of.HOLD)
        held = load(lanes, q + of.HELD)
        j = hardness * j - held * ((1.0 - hardness) * before)
        store(lanes, q + of.HOLD, before + j)
        push, twist = added(s, q, j, push, twist, lanes)
    return moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies)


@woven
def speed_of(s, r, a, b, lanes):
    """Return how fast b goes along or about way s."""
    along, turning = parting(r, a, b, lanes)
    return dot(three(lanes, slot(r, s) + of.AXIS), along if s < 3 else turning)


@woven
def given(s, g, r, j, a, b, index_a, index_b, lanes, bodies):
    """Return the velocities after an impulse along or about one way."""
    zero = spread(0.0)
    push, twist = added(s, slot(r, s), j, (zero, zero, zero), (zero, zero, zero), lanes)
    return moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies)


@woven
def per(give):
    """Return 1 / give, 0 where nothing gives way."""
    return choose(give - TINY, 1.0 / larger(give, spread(TINY)), spread(0.0))


@woven
def giving(p, hardness, lanes):
    """Return how fast a way gives way to a unit impulse, while what is locked holds with ``hardness``."""
    alone = load(lanes, p + of.ALONE)
    return alone - hardness * (alone - load(lanes, p + of.GIVE))


@woven
def rub(s, g, r, p, hardness, h, a, b, index_a, index_b, lanes, bodies):
    """Let friction stop a way, as far as it can."""
    before, most = load(lanes, p + of.RUB), load(lanes, p + of.RUBS) * h
    after = before - speed_of(s, r, a, b, lanes) * per(giving(p, hardness, lanes))
    after = larger(-most, smaller(most, after))
    store(lanes, p + of.RUB, after)
    return given(s, g, r, after - before, a, b, index_a, index_b, lanes, bodies)


@woven
def drive(s, g, r, p, relaxing, hardness, h, a, b, index_a, index_b, lanes, bodies):
    """Let spring and damper, or the motor, act on a way, stepped implicitly: stable however stiff they are.

    Their impulse is -h (k (x + h v' - target) + c (v' - speed)) for the velocity v' after it, the most force at most
    (Catto, Soft Constraints, GDC 2011). Springs have acted before the way; ``relaxing`` is none of theirs.
    """
    before, stiff, damping = load(lanes, p + of.DRIVE), load(lanes, p + of.STIFFNESS), load(lanes, p + of.DAMPING)
    soft = larger(damping + stiff * h, spread(TINY))  # 0 in lanes without a joint
    off = load(lanes, slot(r, s) + of.PLACE) - load(lanes, p + of.TARGET)
    wanted = (damping * load(lanes, p + of.WANTED) - stiff * off) / soft
    give = giving(p, hardness, lanes)
    after = (give * before - (speed_of(s, r, a, b, lanes) - wanted)) * per(
        give + load(lanes, p + of.YIELDS) / (soft * h)
    )
    most = load(lanes, p + of.MOST) * h
    after = larger(-most, smaller(most, after)) * load(lanes, p + of.IS_DRIVEN)
    if relaxing:
        after = choose(stiff, before, after)
    store(lanes, p + of.DRIVE, after)
    return given(s, g, r, after - before, a, b, index_a, index_b, lanes, bodies)


@woven
def limit(s, g, r, p, relaxing, rate, hardness, h, a, b, index_a, index_b, lanes, bodies):
    """Let no way go past the limit that is nearer, within the substep; bounce what has reached it."""
    q, zero = slot(r, s), spread(0.0)
    place, before = load(lanes, q + of.PLACE), load(lanes, q + of.HOLD)
    above, below = place - load(lanes, p + of.LOWER), load(lanes, p + of.UPPER) - place
    sign = choose(above - below, spread(-1.0), spread(1.0))
    gap = smaller(above, below)
    opening, held = sign * speed_of(s, r, a, b, lanes), sign * before
    wanted = choose(gap, -gap / h, -gap * rate)
    if relaxing:
        came = -(sign * load(lanes, q + of.SPEED))
        bounces = choose(held, choose(came - BOUNCE_SPEED, came * load(lanes, p + of.BOUNCE), zero), zero)
        wanted = choose(bounces, bounces, wanted)
    after = larger(zero, held + (wanted - opening) * per(giving(p, hardness, lanes)))
    limited = load(lanes, p + of.IS_LIMITED)
    j = choose(limited, sign * after - before, zero)
    store(lanes, q + of.HOLD, before + j)
    return given(s, g, r, j, a, b, index_a, index_b, lanes, bodies)
