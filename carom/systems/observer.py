"""Observers: what looks at a simulation after every step, without a hand in it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation


class Observer(Protocol):
    """Something that watches: a recorder, a film, a check. It sees a read-only world."""

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""

    def observe(self, simulation: Simulation) -> None:
        """See the world after a step."""

    def end(self, simulation: Simulation) -> None:
        """Finish, also after an error or an interrupt."""


@contextmanager
def observed(simulation: Simulation, *observers: Observer) -> Iterator[None]:
    """Let these see the world as it is now and after every step within this context; all are ended however it ends."""
    before, simulation.observers = simulation.observers, [*simulation.observers, *observers]
    with ExitStack() as ending:
        ending.callback(setattr, simulation, "observers", before)
        for observer in observers:
            ending.callback(observer.end, simulation)
            observer.begin(simulation)
        yield


@contextmanager
def unobserved(simulation: Simulation) -> Iterator[None]:
    """Let nobody see or hear of the steps a simulation takes within this context, and no breakpoint stop them."""
    before = simulation.observers, simulation.hearers, simulation.breakpoints
    simulation.observers, simulation.hearers, simulation.breakpoints = [], [], []
    try:
        yield
    finally:
        simulation.observers, simulation.hearers, simulation.breakpoints = before
