"""The end of a step: inputs are spent, and every number must still be one."""

from __future__ import annotations

from carom.ecs import ExternalForce, Motion, RigidBody, Transform, World, system
from carom.systems.awake import Awake
from carom.systems.kernels.flight import first_not_finite
from carom.systems.kernels.forces import clear_external
from carom.systems.tracing import refuse_not_finite


@system(writes=(ExternalForce,))
def clear_inputs(world: World, dt: float) -> None:
    """Clear external forces, which hold for one step."""
    external = world[ExternalForce]
    clear_external(world.row_numbers(ExternalForce), external.force, external.torque)


@system(reads=(RigidBody, Transform, Motion, Awake))
def check_finite(world: World, dt: float) -> None:
    """Stop at the first NaN or infinity, naming its entity and column."""
    transform, motion, rows = world[Transform], world[Motion], world[Awake].now(world)
    if first_not_finite(rows, transform.position, transform.rotation, motion.linear, motion.angular) >= 0:
        refuse_not_finite(world)
