"""The end of a step: inputs are spent, and every number must still be one."""

from __future__ import annotations

import numpy as np

from carom.ecs import (
    Component,
    ExternalForce,
    Force,
    Motion,
    NonFiniteError,
    RigidBody,
    Transform,
    World,
    system,
)
from carom.ecs.column import Integers
from carom.systems.awake import Awake
from carom.systems.kernels.flight import first_not_finite
from carom.systems.kernels.forces import clear_external


@system(writes=(ExternalForce,))
def clear_inputs(world: World, dt: float) -> None:
    """Clear external forces, which hold for one step."""
    external = world[ExternalForce]
    clear_external(world.row_numbers(ExternalForce), external.force, external.torque)


@system(reads=(RigidBody, Transform, Motion, Awake))
def check_finite(world: World, dt: float) -> None:
    """Stop at the first NaN or infinity, naming its entity and column."""
    find_not_finite(world)


def find_not_finite(world: World, system: str | None = None) -> None:
    """Raise NonFiniteError for the first body whose pose or velocity is not finite.

    Right after a ``system``, the sums of forces are looked at first: there a NaN is one system from where it began.
    """
    transform, motion = world[Transform], world[Motion]
    rows = world[Awake].now(world)
    if system is not None:
        _name_not_finite(world, rows, ((Force, ("force", "torque", "drag", "drag_flow")),), system)
    if first_not_finite(rows, transform.position, transform.rotation, motion.linear, motion.angular) >= 0:
        _name_not_finite(world, rows, ((Motion, ("linear", "angular")), (Transform, ("position", "rotation"))), system)


def _name_not_finite(
    world: World, rows: Integers, kinds: tuple[tuple[type[Component], tuple[str, ...]], ...], system: str | None
) -> None:
    for kind, names in kinds:
        for name in names:
            values = getattr(world[kind], name)[rows]
            bad = np.nonzero(~np.isfinite(values.reshape(len(rows), -1)).all(axis=1))[0]
            if len(bad):
                entity, column = world.name(world.entity(rows[bad[0]])), f"{kind.__name__}.{name}"
                raise NonFiniteError(world.frame, column, entity, str(values[bad[0]].tolist()), system)
