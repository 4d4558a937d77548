"""Damping: each body's own rate of coming to rest, for what no law of a medium describes."""

from __future__ import annotations

from carom.ecs import Force, RigidBody, World, system
from carom.systems.awake import Awake
from carom.systems.kernels.forces import add_damping


@system(reads=(RigidBody, Awake), adds=(Force,))
def apply_damping(world: World, dt: float) -> None:
    """Add each body's damping as a rate; it draws to rest in the world, not in the wind."""
    body, force = world[RigidBody], world[Force]
    add_damping(
        world[Awake].now(world), body.mass, body.inverse_mass, body.linear_damping, body.angular_damping,
        force.drag, force.angular_drag,
    )  # fmt: skip
