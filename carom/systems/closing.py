"""Closing: which manifolds may strike on the arcs that bodies fly, and for how long detection holds for them."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, World
from carom.ecs.column import Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.broad import BroadPhase
from carom.systems.kernels.closing import find_closing
from carom.systems.kernels.crew import threads_of
from carom.systems.resting import Resting
from carom.systems.stream import Stream
from carom.systems.threads import crew_for


def closing(world: World, span: float, *, began: bool) -> tuple[Integers, float, bool]:
    """Return which manifolds may strike within ``span`` seconds, as `find_closing` tells it; until when; if any.

    Until the first moment (s, at most ``span``) at which a body may be where detection has not looked. Unless the
    substep has just begun, nobody asks solids: all of them may strike.
    """
    motion, flight, contact, resting = world[Motion], world[Flight], world[Contact], world[Resting]
    watched = world[BroadPhase].watched(world)
    crew = crew_for(world, max(resting.count, len(watched)))
    soon = np.array([(span, 0.0)] * threads_of(crew))
    find_closing(
        crew, resting.count, resting.groups, resting.solids and began, span, resting.rows(world), watched,
        world[Stream].motion, flight.center, flight.detected_center, flight.reach,
        motion.linear, motion.angular, flight.acceleration,
        resting.index_a, resting.index_b, resting.points, resting.row, resting.group_of, resting.lane_of, resting.start,
        contact.kind, contact.ball, contact.other, contact.other_position, contact.other_rotation,
        contact.radius, contact.extent, contact.restitution, contact.resting, resting.lanes, resting.bodies,
        resting.closes, soon,
    )  # fmt: skip
    times, numbers = zip(*soon.tolist(), strict=True)
    return resting.closes, min(times), any(numbers)
