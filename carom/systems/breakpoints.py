"""Breakpoints: conditions at which a simulation stops, before the step that met one is committed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, NamedTuple, Protocol

from carom.ecs import NonFiniteError, World, restore_snapshot, take_snapshot
from carom.ecs.errors import CaromError
from carom.systems.observer import unobserved

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation


class Met(NamedTuple):
    """What a condition has found: its values in words, and of which entities (handles) they are, none for a world."""

    values: str
    entities: tuple[int, ...] = ()


class Breakpoint(Protocol):
    """A condition that is asked after each step, with all of the world to look at and nothing of it to change."""

    text: str

    def met(self, world: World) -> Met | None:
        """Return what was found, None where the condition does not hold."""


class StoppedError(CaromError):
    """A step met a breakpoint: the world stands as it was before that step, ``frame``.

    ``met`` is what was found after it and ``names`` whom it was found of; `tried` takes that step to look at.
    """

    def __init__(self, breakpoint: Breakpoint, met: Met, world: World, time: float) -> None:
        self.breakpoint, self.met, self.frame, self.time = breakpoint, met, world.frame, time
        self.names = [world.name(entity) for entity in met.entities]
        super().__init__(
            f"frame {self.frame} at {time:.6g} s: {breakpoint.text}: {met.values}; the world stands at frame "
            f"{self.frame - 1}, before that step"
        )


def look(breakpoints: list[Breakpoint], simulation: Simulation) -> StoppedError | None:
    """Return the stop at the first breakpoint that holds, None where none does."""
    world = simulation.world
    with world.faces(None):  # as within a system: else columns are guarded on each look
        found = next(((one, met) for one in breakpoints if (met := one.met(world)) is not None), None)
    return None if found is None else StoppedError(*found, world, simulation.time)


@contextmanager
def tried(simulation: Simulation) -> Iterator[None]:
    """Let the world be what the next step makes of it within this context, and then again what it was.

    Nobody observes that step and nothing breaks it: so the step that met a breakpoint is looked at. One that makes a
    NaN is seen as far as it came.
    """
    before = take_snapshot(simulation.world)
    with unobserved(simulation), suppress(NonFiniteError):
        simulation.step()
    try:
        yield
    finally:
        restore_snapshot(simulation.world, before)
