"""Impulses of joints: locks exactly, all ways of a joint at once, with what bounds the others in between."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import SLOTS
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_bounds import drive, limit, rub
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
from carom.systems.kernels.joint_motion import added, borne, moved, parting
from carom.systems.kernels.joint_points import WAYS, finish_point, hold_point, moved_point, three_of
from carom.systems.kernels.joint_whirling import going_back, heed_whirling
from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.lane_vectors import dot, three
from carom.systems.kernels.lanes import WIDTH, address, gather, load, planes, scatter, spread, store
from carom.systems.kernels.packing import VELOCITY


@making
def start_joints(h, groups, kinds, row, index_a, index_b, lanes, bodies):
    """Apply the impulses of the substep before."""
    lanes, bodies, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    for g in range(groups):
        start_warm(g, row[g], kinds[g], h, index_a, index_b, lanes, bodies)


@making
def sweep_joints(relaxing, h, rate, hardness, groups, kinds, asks, row, index_a, index_b, lanes, bodies):
    """Solve every group once.

    What is locked goes back to its place at ``rate`` (1/s) times what it is off by, with ``hardness`` of the mass and
    of the impulse that is there (Catto, Soft Constraints, GDC 2011), and stays there when ``relaxing``: the first
    pushes along the axes at the start of the way, the second takes what goes along those at its end, which keeps energy
    (Andersen, Rattle, J. Comput. Phys. 52, 24, 1983). The groups go in their order, and back when relaxing.
    """
    room = np.empty((SLOTS, WIDTH))
    lanes, bodies, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    scratch = address(room)
    for n in range(groups):
        g = groups - 1 - n if relaxing else n
        solve(g, row[g], kinds[g], asks[g], relaxing, h, rate, hardness, index_a, index_b, lanes, bodies, scratch)


@making
def finish_joints(groups, kinds, row, index_a, index_b, lanes, bodies):
    """Add impulses to those of the step, and note how fast each way goes."""
    lanes, bodies, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    for g in range(groups):
        finish(g, row[g], kinds[g], index_a, index_b, lanes, bodies)


@woven
def start_warm(g, r, kind, h, index_a, index_b, lanes, bodies):
    """Apply the impulses of a group in the substep before, as far as they last."""
    slots = slots_of(kind)
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    heed_whirling(g, r, kind, h, a, b, index_a, index_b, lanes, bodies)
    if slots == WAYS:
        a, b = moved_point(r, three_of(r, lanes, of.HOLD), a, b, lanes)
    else:
        zero = spread(0.0)
        push, twist = (zero, zero, zero), (zero, zero, zero)
        for s in range(slots):
            q = slot(r, s)
            j = load(lanes, q + of.HOLD)
            if kind >= KINDS:
                p, locks = bound(r, slots, s), load(lanes, q + of.HELD) * j
                bounds = j - locks + load(lanes, p + of.DRIVE) + load(lanes, p + of.RUB)
                push, twist = borne(p, bounds, push, twist, lanes)
                j = locks
            push, twist = added(s, q, j, push, twist, lanes)
        a, b = moved(g, r, push, twist, a, b, index_a, index_b, lanes, bodies)
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)


@woven
def solve(g, r, kind, asks, relaxing, h, rate, hardness, index_a, index_b, lanes, bodies, scratch):
    """Solve a group once: what is locked, then what bounds the other ways and asks of the locks what it needs.

    Where locks only took notice later, an impulse at the end of an arm would turn bodies far more than it moves them.
    """
    slots = slots_of(kind)
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    if slots == 1:
        a, b = hold(1, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
    elif slots == WAYS:
        push = hold_point(r, rate, hardness, a, b, lanes)
        a, b = moved_point(r, push, a, b, lanes)
    else:
        a, b = hold(6, g, r, rate, hardness, a, b, index_a, index_b, lanes, bodies, scratch)
    for s in range(slots if asks else 0):
        p = bound(r, slots, s)
        if asks & FRICTION_BIT << s:
            a, b = rub(s, g, r, p, h, a, b, index_a, index_b, lanes, bodies)
        if asks & DRIVE_BIT << s:
            a, b = drive(s, g, r, p, relaxing, h, a, b, index_a, index_b, lanes, bodies)
        if asks & LIMIT_BIT << s:
            a, b = limit(s, g, r, p, relaxing, rate, h, a, b, index_a, index_b, lanes, bodies)
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)


@woven
def finish(g, r, kind, index_a, index_b, lanes, bodies):
    """Note how fast each way of a group goes, and add the impulses of the substep to those of the step."""
    slots = slots_of(kind)
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    if slots == WAYS:
        finish_point(r, a, b, lanes)
        return
    along, turning = parting(r, a, b, lanes)
    for s in range(slots):
        q = slot(r, s)
        store(lanes, q + of.SPEED, dot(three(lanes, q + of.AXIS), along if s < 3 else turning))
        store(lanes, q + of.SUM, load(lanes, q + of.SUM) + load(lanes, q + of.HOLD))
        if kind >= KINDS:
            p = bound(r, slots, s)
            store(lanes, p + of.DRIVE_SUM, load(lanes, p + of.DRIVE_SUM) + load(lanes, p + of.DRIVE))
            store(lanes, p + of.RUB_SUM, load(lanes, p + of.RUB_SUM) + load(lanes, p + of.RUB))


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
        if s in (3, 5):
            off = off * load(lanes, r + of.LEVEL)
        rest = -(load(lanes, q + of.HELD) * (speed + going_back(r, rate * off, lanes)))
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
