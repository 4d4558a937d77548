"""Moments of expectations: a frame, an event, or the end of the run."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

from carom.ecs import World
from carom.ecs.component import Relation
from carom.ecs.components.joint import Joint
from carom.ecs.relations.enter import Enter, Exit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.joint_break import JointBreak
from carom.systems.simulation import Simulation
from carom.worlds.cast import Cast, cast_of
from carom.worlds.comers import comers, kinds_of, senses
from carom.worlds.errors import WordError
from carom.worlds.expectation import Expectation
from carom.worlds.run import MOST_FRAMES

PARTIES: dict[type[Relation], tuple[str, ...]] = {
    Impact: ("a", "b"),
    Enter: ("sensor", "entity"),
    Exit: ("sensor", "entity"),
    JointBreak: ("joint",),
}


@dataclass(frozen=True)
class Event:
    """A row of an event table: which one of those whose parties are of these groups of entities."""

    kind: type[Relation]
    groups: tuple[Cast, ...]
    nth: int
    text: str

    def matching_rows(self, world: World) -> list[int]:
        """Return the rows of the last step that are such events; impacts count whichever of the two is named first."""
        for group in self.groups:
            group.rows(world)  # who has come
        parties = [self.parties(world, row) for row in range(world[self.kind].count)]
        swap = self.kind is Impact
        return [row for row, some in enumerate(parties) if self._fits(some) or (swap and self._fits(some[::-1]))]

    def parties(self, world: World, row: int) -> tuple[int, ...]:
        """Return who (handles) are in a row of the last step."""
        return tuple(int(getattr(world[self.kind], name)[row]) for name in PARTIES[self.kind])

    def _fits(self, parties: tuple[int, ...]) -> bool:
        return all(party in group.known for party, group in zip(parties, self.groups, strict=True))


def read_event(words: Any, world: World) -> Event:
    """Return the event of ``{impact: [a, b], nth}``, ``enter`` or ``exit: [sensor, entity]``, ``break: joint``.

    Raises WordError for names that the world neither has nor will have, and for who is no sensor or joint.
    """
    ((kind, stated),) = ((kind, said) for kind in PARTIES if (said := getattr(words, kind.key)) is not None)
    patterns = (stated,) if isinstance(stated, str) else stated
    groups, coming = [cast_of([pattern], world) for pattern in patterns], comers(world)
    of = groups[0].names
    if kind in (Enter, Exit):
        others = [name for name in of if not senses(name, world, coming)]
        _refuse("sensor", "a collider with sensor: true", others)
    if kind is JointBreak:
        others = [name for name in of if Joint not in kinds_of(name, world, coming)]
        _refuse("joint", "an entity with joint", others)
    name = "break" if kind is JointBreak else kind.key
    return Event(kind, tuple(groups), words.nth, f"{name} {words.nth} of {' and '.join(patterns)}")


def _refuse(what: str, accepted: str, others: list[str]) -> None:
    if others:
        raise WordError(f"is no {what}", received=repr(others[0]), accepted=accepted)


class AtMoment(Expectation, ABC):
    """An expectation that looks once: at a frame, at an event, or at the end where neither is stated."""

    def __init__(self, text: str, expected: str, frame: int | None = None, when: Event | None = None) -> None:
        self.frame, self.when, self.seen = frame, when, 0
        moment = f" at frame {frame}" if frame is not None else "" if when is None else f" at {when.text}"
        super().__init__(text + moment, expected)

    @abstractmethod
    def compare(self, simulation: Simulation, row: int | None) -> None:
        """Look now, note what is seen in `worst`, and fail if that is wrong; a row is that of the event."""

    @property
    def settled(self) -> bool:
        """Whether it has looked, or has failed without."""
        return bool(self.worst) or self.failure is not None

    def begin(self, simulation: Simulation) -> None:
        """Compare at time 0 where that is the time."""
        if self.frame == 0:
            self.compare(simulation, None)

    def observe(self, simulation: Simulation) -> None:
        """Compare when the moment has come."""
        if self.when is None:
            if simulation.frame == self.frame:
                self.compare(simulation, None)
            return
        for row in self.when.matching_rows(simulation.world) if self.seen < self.when.nth else ():
            self.seen += 1
            if self.seen == self.when.nth:
                self.compare(simulation, row)

    def end(self, simulation: Simulation) -> None:
        """Compare where the end is the moment; fail when the moment never came."""
        if self.when is None and self.frame is None:
            self.compare(simulation, None)
        elif self.worst:
            return
        elif self.when is not None:
            self.fail(simulation, f"{self.seen} of {self.when.nth} such events by the end of the run")
        else:
            self.fail(simulation, f"the run ended at frame {simulation.frame}, before frame {self.frame}")


def frame_of(time: float, dt: float) -> int:
    """Return the step that ends at ``time``; raise WordError when none does."""
    if not time / dt <= MOST_FRAMES:
        raise WordError(f"is more than {MOST_FRAMES:,} steps of {dt:g} s away", received=f"{time:g} s")
    frame = round(time / dt)
    if abs(frame * dt - time) > 1e-9 * max(time, dt):
        accepted = f"a multiple of dt = {dt:.9g} s, such as {frame * dt:.9g} s"
        raise WordError("is between two steps", received=f"{time:g} s", accepted=accepted)
    return frame
