"""Force functions: Python functions of a world that are forces, for one simulation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from carom.ecs import Force, Motion, RigidBody, System, Transform, World, system
from carom.ecs.column import Floats, Integers

ForceFunction = Callable[[World, Integers], npt.ArrayLike]


def force_system(function: ForceFunction, name: str | None = None) -> System:
    """Return the system that adds what ``(world, rows) -> forces (n, 3) in N`` returns, called like the function."""

    def push(world: World, dt: float) -> None:
        rows = world.row_numbers(RigidBody, Motion)
        force: Floats = world[Force].force
        force[rows] += np.asarray(function(world, rows), np.float64)

    push.__name__ = name or str(getattr(function, "__name__", "force_function"))
    push.__doc__ = function.__doc__
    return system(reads=(Transform, Motion, RigidBody), adds=(Force,))(push)
