"""Edits: what code outside the step does between two of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from carom.ecs.component import Component, Record, Resource
from carom.ecs.writes import Written
from carom.systems.awake import Awake
from carom.systems.events import Events
from carom.systems.simulation import Simulation

LIVES, RESTORED = "who lives", "a snapshot restored"


class Done(NamedTuple):
    """What was done, in words, and what was written, where the world keeps a log of that."""

    words: list[str]
    written: Mapping[type[Component], Written]


NOTHING = Done([], {})


class Retelling(Resource):
    """What was done before a frame that is shown again, where it is not done again; None where nothing is."""

    done: Done | None = None


class EditWatch:
    """Tells which components code outside has written since the last look, who came or went, snapshots restored."""

    def __init__(self) -> None:
        self._own: set[type[Record]] = set()
        self._counts = (0, 0)

    def begin(self, simulation: Simulation) -> None:
        """Know what was done before, or by commands of the last step."""
        self._own = set(simulation.world.edited)
        self.pass_over(simulation)

    def pass_over(self, simulation: Simulation) -> None:
        """Leave out who came or went and what was restored until now."""
        self._counts = simulation.world.structure, simulation.world.restored

    def done(self, simulation: Simulation) -> Done:
        """Return what was done between the step that has just been taken and the one before."""
        awake, retelling = simulation.world[Awake], simulation.world.resources.get(Retelling)
        if isinstance(retelling, Retelling) and retelling.done is not None:
            return retelling.done
        events = simulation.world[Events]
        done = sorted(kind.__name__ for kind in awake.edited - self._own - events.edited)
        if awake.restored != self._counts[1]:
            done.append(RESTORED)
        elif events.structure != self._counts[0]:
            done.append(LIVES)
        self.begin(simulation)
        return Done(done, awake.written)
