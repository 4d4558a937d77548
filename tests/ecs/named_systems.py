"""Systems made on the spot."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from carom.ecs import System, World, system


def named(name: str, function: Callable[[World], object] = lambda world: None, **declared: Any) -> System:
    """Return a system of that name that calls a function of the world."""

    def run(world: World, dt: float) -> None:
        function(world)

    run.__name__ = name
    return system(**declared)(run)
