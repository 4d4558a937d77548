"""Passing: bodies that fly past each other are not struck by contacts that only seem to close."""

from __future__ import annotations

import numpy as np

from carom.ecs import ColliderPose, Motion, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.systems.constants import FEW_MEETING, MEET
from carom.systems.continuous import accelerations, fast_of, look_at
from carom.systems.detection.narrow import Found
from carom.systems.kernels.fast_pairs import NEVER, find_far
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.passing import find_nearing, find_seeming
from carom.systems.kernels.swinging import TRUSTED
from carom.systems.kernels.turning_past import find_turning_past
from carom.systems.looked import Looked
from carom.systems.progress import Progress
from carom.systems.stream import Stream


def without_passing(world: World, found: Found, span: float, center: Floats, quick: Booleans) -> tuple[Found, Integers]:
    """Return what is found without what only seems to close within ``span`` seconds, and who is to be looked after.

    Asked are pairs (n, 2) of two that can both be pushed and come far for their size, their centres at ``center``; one
    of them is ``quick``. They are looked after where they meet, where only a few may meet, and a few times in a step.
    Of many only those are looked at who seem to meet.
    """
    pose, motion, pairs = world[ColliderPose], world[Motion], np.empty((len(found.row_a), 2), np.int64)
    count = find_nearing(
        span, found.row_a, found.row_b, found.depth, found.point, pose.body_row, quick, center, motion.linear,
        motion.angular, pairs,
    )  # fmt: skip
    free = fast_of(world, pairs[:count], span, center, free=True)
    if max(len(free[0]), world[Progress].detections) <= FEW_MEETING:
        return without_seeming(world, found, span, center, *free)
    return without_seeming(world, found, span, center, *seeming(world, found, span, center))[0], pairs[:0]


def without_turning_past(world: World, found: Found, span: float) -> Found:
    """Return what is found without new contacts that bodies turn past within ``span`` seconds; all, if that is 0."""
    if not span:  # most often
        return found
    past: Booleans = np.empty(len(found.row_a), np.bool_)
    pose, flight, motion = world[ColliderPose], world[Flight], world[Motion]
    number = find_turning_past(
        span, found.row_a, found.row_b, found.normal, found.depth, found.point, found.old, pose.body_row, flight.reach,
        motion.asleep, world[Stream].passes, flight.detected_center, motion.angular, past,
    )  # fmt: skip
    return found.without(past, number)


def seeming(world: World, found: Found, span: float, center: Floats) -> tuple[Integers, Floats]:
    """Return those of such pairs that seem to meet, by contacts followed straight on, and their numbers."""
    motion, pairs = world[Motion], np.empty((len(found.row_a), 2), np.int64)
    count = find_seeming(
        span, found.row_a, found.row_b, found.normal, found.depth, found.point, world[ColliderPose].body_row, center,
        motion.linear, motion.angular, pairs,
    )  # fmt: skip
    return fast_of(world, pairs[:count], span, center, free=True)


def without_seeming(
    world: World, found: Found, span: float, center: Floats, free: Integers, numbers: Floats
) -> tuple[Found, Integers]:
    """Return what is found without far contacts of those of the pairs who never touch, as they move and turn.

    And the pairs who touch.
    """
    if not len(free):
        return found, free
    motion = world[Motion]
    looked, reaches = Looked.room(numbers.copy()), numbers.copy()
    times = np.zeros(len(free))
    land = look_at(world, free.copy(), center, looked)  # of meshes the sides change places
    foresee_meetings(
        span, False, False, center, world[Transform].rotation, motion.linear, motion.angular, accelerations(world),
        center, world[Transform].rotation, world[Flight].reach, *looked, *land,
        np.ones(len(free), np.bool_), np.zeros(len(free), np.bool_), np.zeros(len(free)), times,
    )  # fmt: skip
    passes = times == NEVER
    reaches[:, TRUSTED] *= MEET  # they are looked at until they are as near as that
    far: Booleans = np.empty(len(found.row_a), np.bool_)
    number = find_far(free[passes], reaches[passes], found.row_a, found.row_b, found.depth, far)
    return found.without(far, number), free[~passes]
