"""What joints have borne in a step: forces and torques, how far they are off, and which of them break."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.ecs.components.joint import LIMITED, LOCKED, SLOTS
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import KINDS, bound, slot, slots_of
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lanes import WIDTH


@kernel("effort", "force", "torque", "limit")
def clear_loads(rows, effort, force, torque, limit):
    """Begin a step in which joints have borne nothing yet."""
    for i in rows:
        for s in range(SLOTS):
            effort[i, s], limit[i, s] = 0.0, 0
        for k in range(3):
            force[i, k], torque[i, k] = 0.0, 0.0


@kernel(
    "lanes", "impulse", "drive_impulse", "friction_impulse", "position", "velocity",
    "limit", "effort", "force", "torque",
)  # fmt: skip
def hand_joints_over(
    groups, kinds, first, row, dt, mode, lanes,
    impulse, drive_impulse, friction_impulse, position, velocity, limit, effort, force, torque,
):  # fmt: skip
    """Write what the lanes have found of joints into their columns, and add the impulses to the means of the step.

    ``effort`` (n, 6) is that of drives; ``force`` (N) and ``torque`` (N m) are all that b gets at its anchor.
    """
    for g in range(groups):
        r, slots, bounded = row[g], slots_of(kinds[g]), kinds[g] >= KINDS
        for lane in range(WIDTH):
            i = first[g, lane]
            if i < 0:
                continue
            for s in range(slots):
                q = slot(r, s)
                impulse[i, s], position[i, s] = lanes[q + of.HOLD, lane], lanes[q + of.PLACE, lane]
                velocity[i, s] = lanes[q + of.SPEED, lane]
                whole = lanes[q + of.SUM, lane] / dt
                lanes[q + of.SUM, lane] = 0.0
                if bounded:
                    p, limits = bound(r, slots, s), 0.0
                    if mode[i, s] == LIMITED:
                        limit[i, s] = -1 if whole > 0.0 else 1 if whole < 0.0 else 0
                        whole, limits = 0.0, whole
                    drive_impulse[i, s], friction_impulse[i, s] = lanes[p + of.DRIVE, lane], lanes[p + of.RUB, lane]
                    driven, rubs = lanes[p + of.DRIVE_SUM, lane] / dt, lanes[p + of.RUB_SUM, lane] / dt
                    effort[i, s] += driven
                    for k in range(3):
                        force[i, k] += (limits + driven + rubs) * lanes[p + of.PUSH + k, lane]
                        torque[i, k] += (limits + driven + rubs) * lanes[p + of.TWIST + k, lane]
                    lanes[p + of.DRIVE_SUM, lane], lanes[p + of.RUB_SUM, lane] = 0.0, 0.0
                for k in range(3):
                    if s < 3:
                        force[i, k] += whole * lanes[q + of.AXIS + k, lane]
                    else:
                        torque[i, k] += whole * lanes[q + of.AXIS + k, lane]


@kernel("gap", "twist", "margin", "breaks")
def judge_joints(
    rows, mode, lower, upper, position, force, torque, break_force, break_torque, gap, twist, margin, breaks
):
    """Tell of joints how far locked and limited ways are off, and what part of their strength is left.

    Return how many break: those of which none is. ``breaks`` says which, one for each of ``rows``.
    """
    number = 0
    for n, i in enumerate(rows):
        along, about, pulls, twists = 0.0, 0.0, 0.0, 0.0
        for s in range(SLOTS):
            off = 0.0
            if mode[i, s] == LOCKED:
                off = position[i, s] - lower[i, s]
            elif mode[i, s] == LIMITED:
                off = max(0.0, lower[i, s] - position[i, s], position[i, s] - upper[i, s])
            if s < 3:
                along += off * off
            else:
                about += off * off
        for k in range(3):
            pulls += force[i, k] * force[i, k]
            twists += torque[i, k] * torque[i, k]
        gap[i], twist[i] = sqrt(along), sqrt(about)
        margin[i] = 1.0 - max(sqrt(pulls) / break_force[i], sqrt(twists) / break_torque[i])
        breaks[n] = margin[i] < 0.0
        number += breaks[n]
    return number
