"""Turns: joints and contacts are swept one after the other, for as long as sweeps follow."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import BEARING_SWEEPS
from carom.systems.kernels.crew import ROOM, share
from carom.systems.kernels.crew_words import describe
from carom.systems.kernels.joint_bearing import sweep_bearing_joints
from carom.systems.kernels.joint_impulses import finish_joints, start_joints, sweep_joints
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.packing import VELOCITY, read_velocities, write_velocities
from carom.systems.kernels.resting import press_groups
from carom.systems.kernels.stirring import some_stir


@kernel("joint_lanes", "lanes", "bodies", "scratch", "stirred", "linear", "angular", makes_arrays=True)
def take_turns(
    crew, begins, swept, most, sweeps, relaxing, h, rate, hardness,
    joints, kinds, joint_asks, joint_row, joint_a, joint_b, joint_lanes,
    groups, ends, levels, run_ends, soft, rigid, index_a, index_b, points, row, asks, scratch, lanes, bodies, crushed,
    joined, stirred, rows, linear, angular,
):  # fmt: skip
    """Go on in a stage of ``sweeps`` over joints, then contacts, of which so many are ``swept``, for ``most`` more.

    Where the stage ``begins``, velocities of ``rows`` are packed, and impulses of the substep before applied, unless it
    is ``relaxing``; where nothing is to follow, those are unpacked. Sweeps that follow those of the stage are over who
    bears what is heavy, and over contacts as they need it (`press_groups`). When relaxing the substep has ended:
    impulses are added to those of the step. Return how many are swept, and whether others are to follow.
    """
    done, follow, parts, velocity = swept, True, len(crew) // ROOM, bodies[VELOCITY]
    stirs, nobody = np.zeros((2, parts), np.bool_), rows[:0]
    if begins:
        write_velocities(rows, linear, angular, velocity)
    if begins and not relaxing:
        start_joints(h, joints, kinds, joint_row, joint_a, joint_b, joint_lanes, bodies)
        if groups:
            share(describe(press_groups, crew, (
                True, 0, 0, sweeps, False, h, ends, levels, run_ends, soft, rigid, index_a, index_b, points,
                row, asks, nobody, scratch, lanes, bodies, linear, angular, crushed, joined, stirred, stirs,
            )))  # fmt: skip
    while follow and done < swept + most:
        if done < sweeps:
            sweep_joints(
                relaxing, h, rate, hardness, joints, kinds, joint_asks, joint_row, joint_a, joint_b, joint_lanes, bodies
            )  # fmt: skip
        elif joints:
            sweep_bearing_joints(
                done, relaxing, h, rate, hardness, joints, kinds, joint_asks, joint_row, joint_a, joint_b,
                crushed, joint_lanes, bodies, stirred,
            )  # fmt: skip
        follow = done + 1 < sweeps
        if groups:
            stirs[:] = False
            share(describe(press_groups, crew, (
                False, done, 1, sweeps, relaxing, h, ends, levels, run_ends, soft, rigid, index_a, index_b, points,
                row, asks, nobody, scratch, lanes, bodies, linear, angular, crushed, joined, stirred, stirs,
            )))  # fmt: skip
            follow |= done + 1 < sweeps + BEARING_SWEEPS and some_stir(stirs, done, parts)
        done += 1
    if not follow:
        if relaxing:
            finish_joints(joints, kinds, joint_row, joint_a, joint_b, joint_lanes, bodies)
        read_velocities(rows, velocity, linear, angular)
    return done, follow
