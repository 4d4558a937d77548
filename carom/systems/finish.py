"""The end of a step: inputs are spent, and every number must still be one."""

from __future__ import annotations

import numpy as np

from carom.ecs import ExternalForce, Motion, NonFiniteError, RigidBody, Transform, World, system
from carom.systems.kernels.flight import first_not_finite
from carom.systems.kernels.forces import clear_external


@system(writes=(ExternalForce,))
def clear_inputs(world: World, dt: float) -> None:
    """Clear external forces, which hold for one step."""
    external = world[ExternalForce]
    clear_external(world.row_numbers(ExternalForce), external.force, external.torque)


@system(reads=(Transform, Motion))
def check_finite(world: World, dt: float) -> None:
    """Stop at the first NaN or infinity, naming its entity and column."""
    find_not_finite(world)


def find_not_finite(world: World, system: str | None = None) -> None:
    """Raise NonFiniteError for the first body whose pose or velocity is not finite."""
    transform, motion = world[Transform], world[Motion]
    rows = world.row_numbers(RigidBody)
    row = first_not_finite(rows, transform.position, transform.rotation, motion.linear, motion.angular)
    if row < 0:
        return
    for kind, names in ((Motion, ("linear", "angular")), (Transform, ("position", "rotation"))):
        for name in names:
            values = getattr(world[kind], name)[row]
            if not np.isfinite(values).all():
                column = f"{kind.__name__}.{name}"
                raise NonFiniteError(world.frame, column, world.name(world.entity(row)), str(values.tolist()), system)
