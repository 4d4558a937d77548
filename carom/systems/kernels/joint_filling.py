"""From the columns of joints into the lanes of their groups."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import LOCKED
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import bound, end_of, slot, slots_of
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.lanes import WIDTH, address, spread, store
from carom.systems.kernels.spatial import product, turn


@kernel("lanes")
def fill_joints(
    groups, kinds, asks, index_a, index_b, first, place, row, nobody, center_of_mass,
    row_a, row_b, position_of, rotation_of, anchor_a, anchor_b, frame_a, frame_b, mode, lower, upper, restitution,
    stiffness, damping, target, speed, most, friction, impulse, drive_impulse, friction_impulse,
    position, velocity, lanes,
):  # fmt: skip
    """Write what joints hold into the lanes of their groups; of what stands, anchors and frames are in the world.

    ``row_a`` and ``row_b`` are the rows of whom each joint holds (-1 for the world).
    """
    rows = address(lanes)
    for g in range(groups):
        r, slots, bounded = row[g], slots_of(kinds[g]), kinds[g] >= of.KINDS
        for k in range(end_of(r, kinds[g]) - r):
            store(rows, r + k, spread(0.0))
        for s in range(slots if bounded else 0):
            store(rows, bound(r, slots, s) + of.DAMPING, spread(1.0))  # divides also where nobody is
        for lane in range(WIDTH):
            lanes[r + of.FRAME_A + 3, lane] = lanes[r + of.FRAME_B + 3, lane] = 1.0
            i = first[g, lane]
            if i < 0:
                continue
            a, b = row_a[place[g, lane]], row_b[place[g, lane]]
            write_side(
                r + of.LEVER_A, r + of.FRAME_A, lane, i, index_a[g, lane] == nobody, a, center_of_mass,
                position_of, rotation_of, anchor_a, frame_a, lanes,
            )  # fmt: skip
            write_side(
                r + of.LEVER_B, r + of.FRAME_B, lane, i, index_b[g, lane] == nobody, b, center_of_mass,
                position_of, rotation_of, anchor_b, frame_b, lanes,
            )  # fmt: skip
            for s in range(slots):
                q = slot(r, s)
                if kinds[g] == of.POINTS:
                    lanes[q + of.AXIS + s, lane] = 1.0
                lanes[q + of.PLACE, lane] = position[i, s]
                if mode[i, s] == LOCKED:
                    lanes[q + of.HELD, lane], lanes[q + of.AT, lane] = 1.0, lower[i, s]
                lanes[q + of.HOLD, lane], lanes[q + of.SPEED, lane] = impulse[i, s], velocity[i, s]
                if bounded:
                    write_bounds(
                        bound(r, slots, s), lane, i, s, asks[g], lower, upper, restitution, stiffness, damping,
                        target, speed, most, friction, drive_impulse, friction_impulse, lanes,
                    )  # fmt: skip


@inlined
def write_side(lever, frame, lane, i, stands, row, center_of_mass, position, rotation, anchor, frames, lanes):
    """Write the lever and the frame of joint i on one of the two that it holds."""
    x, y, z = anchor[i, 0], anchor[i, 1], anchor[i, 2]
    qx, qy, qz, qw = frames[i, 0], frames[i, 1], frames[i, 2], frames[i, 3]
    if not stands:
        x, y, z = x - center_of_mass[row, 0], y - center_of_mass[row, 1], z - center_of_mass[row, 2]
    elif row >= 0:
        tx, ty, tz, tw = rotation[row, 0], rotation[row, 1], rotation[row, 2], rotation[row, 3]
        x, y, z = turn(tx, ty, tz, tw, x, y, z)
        x, y, z = x + position[row, 0], y + position[row, 1], z + position[row, 2]
        qx, qy, qz, qw = product(tx, ty, tz, tw, qx, qy, qz, qw)
    for k, value in enumerate((x, y, z)):
        lanes[lever + k, lane] = value
    for k, value in enumerate((qx, qy, qz, qw)):
        lanes[frame + k, lane] = value


@inlined
def write_bounds(
    q, lane, i, s, asks, lower, upper, restitution, stiffness, damping, target, speed, most, friction,
    drive_impulse, friction_impulse, lanes,
):  # fmt: skip
    """Write what bounds a way, of that which the group asks for."""
    if asks & of.LIMIT_BIT << s:
        lanes[q + of.LOWER, lane], lanes[q + of.UPPER, lane] = lower[i, s], upper[i, s]
        lanes[q + of.BOUNCE, lane] = restitution[i]
    if asks & of.DRIVE_BIT << s:
        if damping[i, s] < np.inf:  # else it is rigid
            lanes[q + of.STIFFNESS, lane], lanes[q + of.DAMPING, lane] = stiffness[i, s], damping[i, s]
            lanes[q + of.YIELDS, lane] = 1.0
        lanes[q + of.TARGET, lane], lanes[q + of.WANTED, lane] = target[i, s], speed[i, s]
        lanes[q + of.MOST, lane], lanes[q + of.DRIVE, lane] = most[i, s], drive_impulse[i, s]
    if asks & of.FRICTION_BIT << s:
        lanes[q + of.RUBS, lane], lanes[q + of.RUB, lane] = friction[i, s], friction_impulse[i, s]
