"""Joints of who bears what is heavy: swept on along with contacts, which would outweigh them, and nobody else's."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import SLOTS
from carom.systems.kernels.joint_groups import end_of
from carom.systems.kernels.joint_impulses import solve
from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.lanes import WIDTH, address, choose, load, planes, some, store, which
from carom.systems.kernels.packing import INVERSE_MASS, VELOCITY
from carom.systems.kernels.stirring import (
    LAST_BEARING,
    LAST_STIRRED,
    SIDE_ROWS,
    are_bearing,
    put_velocities_aside,
    put_velocities_back,
)


@making
def sweep_bearing_joints(
    sweep, relaxing, h, rate, hardness, groups, kinds, asks, row, index_a, index_b, crushed, lanes, bodies, stirred,
):  # fmt: skip
    """Solve the joints of bodies that are swept on in this sweep once more, as `sweep_joints` does.

    Whom they hold is swept as often from now on. A group is solved whole, and whose joints are not concerned get back
    what they had: no bit hangs on whom a joint is in a group with.
    """
    most = 0
    for g in range(groups):
        most = max(most, end_of(row[g], kinds[g]) - row[g])
    room, pages, velocity = np.empty((SLOTS, WIDTH)), np.empty((most + 2 * SIDE_ROWS, WIDTH)), bodies[VELOCITY]
    lanes, bodies, of_a, of_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    scratch, kept = address(room), address(pages)
    for n in range(groups):
        g = groups - 1 - n if relaxing else n
        concerned = are_bearing(g, sweep, index_a, index_b, stirred)
        if not some(concerned):
            continue
        r, rows = row[g], end_of(row[g], kinds[g]) - row[g]
        for k in range(rows):
            store(kept, k, load(lanes, r + k))
        put_velocities_aside(g, of_a, rows, bodies, kept)
        put_velocities_aside(g, of_b, rows + SIDE_ROWS, bodies, kept)
        solve(g, r, kinds[g], asks[g], relaxing, h, rate, hardness, of_a, of_b, lanes, bodies, scratch)
        for k in range(rows):
            store(lanes, r + k, choose(concerned, load(lanes, r + k), load(kept, k)))
        put_velocities_back(concerned, g, of_a, rows, bodies, kept)
        put_velocities_back(concerned, g, of_b, rows + SIDE_ROWS, bodies, kept)
        spread_bearing(g, which(concerned), index_a, index_b, velocity, crushed, stirred)


@woven
def spread_bearing(g, concerned, index_a, index_b, velocity, crushed, stirred):
    """Have those that joints of some lanes of a group, each a bit, hold swept as often as the others whom they hold."""
    for lane in range(WIDTH):
        if not concerned >> lane & 1:
            continue
        a, b = index_a[g, lane], index_b[g, lane]
        until = max(stirred[LAST_BEARING, a], stirred[LAST_BEARING, b])
        for i in (a, b):
            if velocity[i, INVERSE_MASS] > 0.0 and not crushed[i]:
                stirred[LAST_BEARING, i], stirred[LAST_STIRRED, i] = until, max(stirred[LAST_STIRRED, i], until)
