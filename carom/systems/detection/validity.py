"""Validity: points that cannot be contacts are kept from the solver, counted, and named in checked mode."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.access import GUARDED
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import CaromError
from carom.systems.constants import UNIT_NORMAL
from carom.systems.detection.answered import Answered
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.validity import NOT_FINITE, NOT_UNIT, TOO_DEEP, TOO_FAR, refuse_points
from carom.systems.shapes.shape import BY_NUMBER
from carom.systems.threads import crew_for

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Points

FAULTS = {
    NOT_FINITE: "its numbers are not finite",
    NOT_UNIT: f"its normal has the length {{value:.9g}}; accepted: 1 within {UNIT_NORMAL:g}",
    TOO_DEEP: "its depth is {value:.6g} m; accepted: at most {limit:.6g} m, which the two sizes allow",
    TOO_FAR: "its gap is {value:.6g} m; accepted: at most {limit:.6g} m, which the step can close",
}


class ContactError(CaromError):
    """A pair was measured to have a contact that cannot be."""


def keep_sound(world: World, pairs: Integers, reaches: Floats, points: Points) -> int:
    """Drop and count the points that cannot be contacts, return how many are left; raise ContactError when checked."""
    collider, pose = world[Collider], world[ColliderPose]
    n = len(pairs)
    fault, value, limit = np.empty(n, np.int64), np.empty(n), np.empty(n)
    crew = crew_for(world, n)
    numbers = np.zeros((threads_of(crew), 2), np.int64)
    refuse_points(
        crew, pairs, reaches, collider.shape, collider.size,
        collider.position, collider.bound_center, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, points.start, points.count,
        points.feature, points.normal, points.depth, points.point, fault, value, limit, numbers,
    )  # fmt: skip
    kept, dropped = map(sum, zip(*numbers.tolist(), strict=True))
    if dropped:
        world[Answered].refused += dropped
        if GUARDED.get():
            p = int(np.nonzero(fault)[0][0])
            one, other = (described(world, int(row)) for row in pairs[p])
            what = FAULTS[int(fault[p])].format(value=value[p], limit=limit[p])
            raise ContactError(
                f"a contact of {one} and {other} cannot be: {what}; please report it with the world file, "
                "unchecked runs leave it out"
            )
    return kept


def described(world: World, row: int) -> str:
    """Return the shape and name of a collider for messages."""
    return f"{BY_NUMBER[int(world[Collider].shape[row])].key} '{world.name(int(world.entities(row)))}'"
