"""Where colliders are and how far they may reach within the step."""

from __future__ import annotations

from math import sqrt

from carom.ecs import Collider, ColliderPose, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.components.flight import Flight
from carom.ecs.hierarchy import compose
from carom.systems.awake import Awake
from carom.systems.compound import bodies_of
from carom.systems.kernels.broad import foresee_reach, place_bounds
from carom.systems.settings import Settings


@system(reads=(Parent, Motion, RigidBody, Collider, Settings, Awake), writes=(Transform, ColliderPose, Flight))
def place_colliders(world: World, dt: float) -> None:
    """Place every collider and bound what it can reach within the step."""
    reach_within(world, dt)


def reach_within(world: World, dt: float) -> None:
    """Place every collider and bound what it can reach within the next ``dt`` seconds; who is carried goes along."""
    compose(world)
    transform, motion, body, flight = world[Transform], world[Motion], world[RigidBody], world[Flight]
    collider, pose = world[Collider], world[ColliderPose]
    gravity = world[Settings].gravity
    pull = sqrt(sum(g * g for g in gravity))
    foresee_reach(
        world[Awake].now(world), dt, pull, transform.position, transform.rotation, motion.linear,
        body.center_of_mass, body.inertia, body.inverse_mass, motion.linear_acceleration,
        flight.reach, flight.detected_center,
    )  # fmt: skip
    place_bounds(
        world.row_numbers(Collider), dt, bodies_of(world), motion.angular, flight.reach, flight.detected_center,
        transform.position, transform.rotation, collider.position, collider.rotation,
        collider.bound_center, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, pose.lower, pose.upper, pose.body_row, pose.moved,
    )  # fmt: skip
