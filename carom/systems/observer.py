"""Observers: what looks at a simulation after every step, without a hand in it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
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
def unobserved(simulation: Simulation) -> Iterator[None]:
    """Let nobody see or hear of the steps a simulation takes within this context, and no breakpoint stop them."""
    before = simulation.observers, simulation.hearers, simulation.breakpoints
    simulation.observers, simulation.hearers, simulation.breakpoints = [], [], []
    try:
        yield
    finally:
        simulation.observers, simulation.hearers, simulation.breakpoints = before
