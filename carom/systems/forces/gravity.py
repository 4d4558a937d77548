"""Gravity: the uniform field of the settings."""

from __future__ import annotations

from carom.ecs import Force, RigidBody, World, system
from carom.systems.awake import Awake
from carom.systems.kernels.forces import add_weight
from carom.systems.settings import Settings


@system(reads=(RigidBody, Settings, Awake), adds=(Force,))
def apply_gravity(world: World, dt: float) -> None:
    """Add mass times the world's gravity, times what each body makes of it."""
    gravity, body = world[Settings].gravity, world[RigidBody]
    if any(gravity):
        add_weight(world[Awake].now(world), body.mass, body.gravity_scale, *gravity, world[Force].force)
