"""Worlds that are run with all they expect."""

from __future__ import annotations

from collections.abc import Callable

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.witness import Witness
from carom.worlds import LoadedWorld
from carom.worlds.expectation import Outcome


def run(
    world: LoadedWorld, *, to_first_failure: bool = False, each: Callable[[Simulation], None] | None = None
) -> list[Outcome]:
    """Run to the end, or to the first failure, and return what became of each expectation; ``each`` sees every step."""
    simulation = world.simulation
    with observed(simulation, Witness(world), *world.expectations):
        while not world.run.finished(simulation):
            if to_first_failure and not all(item.held for item in world.expectations):
                break
            simulation.step()
            if each is not None:
                each(simulation)
    return [item.outcome() for item in world.expectations]
