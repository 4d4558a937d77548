"""Where colliders are and how far they may reach within the step."""

from __future__ import annotations

from math import hypot

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.hierarchy import compose
from carom.systems.awake import Awake
from carom.systems.compound import bodies_of
from carom.systems.kernels.broad import foresee_reach, place_bounds
from carom.systems.kernels.narrow import reach_of_pairs
from carom.systems.settings import Settings
from carom.systems.stream import Stream


@system(reads=(Parent, Motion, RigidBody, Collider, Settings, Awake), writes=(Transform, ColliderPose, Flight, Stream))
def place_colliders(world: World, dt: float) -> None:
    """Place every collider and bound what it can reach within the step."""
    reach_within(world, dt)


def reach_within(world: World, dt: float, rows: Integers | None = None) -> None:
    """Place every collider and bound what it can reach within the next ``dt`` seconds; who is carried goes along.

    How far bodies reach is found anew of these rows, by default of those that are awake.
    """
    compose(world)
    transform, motion, body, flight = world[Transform], world[Motion], world[RigidBody], world[Flight]
    stream = world[Stream]
    pull = hypot(*world[Settings].gravity)
    foresee_reach(
        world[Awake].now(world) if rows is None else rows, dt, pull, transform.position, transform.rotation,
        motion.linear, body.center_of_mass, body.inertia, body.inverse_mass, motion.linear_acceleration,
        flight.reach, flight.detected_center, stream.motion, stream.gone,
    )  # fmt: skip
    stream.passes = dt * hypot(*stream.motion[0].tolist())
    bound(world, world.row_numbers(Collider), bodies_of(world), dt, flight.reach, flight.detected_center)


def bound(world: World, rows: Integers, bodies: Integers, dt: float, reach: Floats, center: Floats) -> None:
    """Place colliders (rows) and bound them by how far from their centres of mass the ``bodies`` they are of reach."""
    transform, collider, pose, passes = world[Transform], world[Collider], world[ColliderPose], world[Stream].passes
    place_bounds(
        rows, dt, bodies, world[Motion].angular, reach, passes, center,
        transform.position, transform.rotation, collider.position, collider.rotation,
        collider.bound_center, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, pose.lower, pose.upper, pose.turning, pose.body_row, pose.moved,
    )  # fmt: skip
    if passes and len(world[Awake].sleepers):
        sleepers = rows[world[Motion].asleep[pose.body_row[rows]] & (pose.body_row[rows] >= 0)]
        pose.lower[sleepers] -= passes
        pose.upper[sleepers] += passes


def reaches_of(world: World, pairs: Integers, reach: Floats) -> Floats:
    """Return how near (m) each of ``pairs`` (n, 2) of collider rows must come, as bodies ``reach``, to be a contact."""
    reaches = np.empty(len(pairs))
    reach_of_pairs(pairs, world[ColliderPose].body_row, reach, world[Motion].asleep, world[Stream].passes, reaches)
    return reaches
