"""Expectations of how a run goes: what comes about, in which order, and by when all is at rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans
from carom.systems.bodies import dynamic_rows
from carom.systems.simulation import Simulation
from carom.worlds.cast import Cast, cast_of
from carom.worlds.condition import Condition
from carom.worlds.errors import WordError
from carom.worlds.expect_moment import Event, frame_of, read_event
from carom.worlds.expect_words import SettledWords
from carom.worlds.expectation import Expectation
from carom.worlds.run import speeds


class Eventually(Expectation):
    """``eventually`` a condition: it holds at the start or after some step, for each entity that it speaks of."""

    def __init__(self, condition: Condition) -> None:
        self.condition, self.looks = condition, condition.looks
        super().__init__(f"eventually: {condition.text}", f"eventually {condition.text}")
        self.held_by: Booleans | None = None
        self.nearest = np.zeros(0)
        self.said: list[str] = []

    @property
    def settled(self) -> bool:
        """Whether it has held for all, or has failed."""
        return self.failure is not None or (self.held_by is not None and bool(self.held_by.all()))

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Note for whom it holds, and how near the others came."""
        if self.settled:
            return
        there, holds, margin = self.condition.evaluate(simulation.world)
        holds, margin = holds & there, np.where(there, margin, -np.inf)
        if self.held_by is None:
            self.held_by, self.nearest, self.said = (
                np.zeros_like(holds),
                np.full(len(holds), -np.inf),
                [""] * len(holds),
            )
        for index in np.nonzero(margin > self.nearest)[0].tolist():
            self.nearest[index], self.said[index] = margin[index], self.condition.values(simulation.world, index)
        self.held_by |= holds
        self.worst = self.said[int(np.argmin(self.nearest))]

    def end(self, simulation: Simulation) -> None:
        """Fail where it has never held."""
        missing = [] if self.held_by is None else np.nonzero(~self.held_by)[0].tolist()
        if missing:
            index, world = missing[0], simulation.world
            absent = f"never asked, since {self.condition.absence(world, index)}"
            said = f"nearest {self.said[index]} by the end of the run" if self.said[index] else absent
            self.fail(simulation, said, self.condition.of(index))


class Settled(Expectation):
    """``settles_by`` a time: from then to the end no body is faster than ``speed``, nor any point of it by turning."""

    def __init__(self, stated: float | SettledWords, simulation: Simulation) -> None:
        words = stated if isinstance(stated, SettledWords) else SettledWords.model_validate({"time": stated})
        self.frame, self.speed = frame_of(words.time, simulation.settings.dt), words.speed
        self.among = among(words.entities, simulation.world)
        whom = "" if words.entities is None else f" of {', '.join(words.entities)}"
        super().__init__(
            f"settles_by: {words.time:g} s{whom}", f"no speed over {words.speed:g} m/s from frame {self.frame}"
        )
        self.fastest = -1.0

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """From its time on, look at every body that obeys forces."""
        world = simulation.world
        rows = dynamic_rows(world) if simulation.frame >= self.frame else np.zeros(0, np.int64)
        if self.among is not None:
            rows = rows[np.isin(rows, self.among.rows(world))]
        if not len(rows):
            return
        found = speeds(world, rows)
        index = int(np.argmax(found))
        name = world.name(world.entity(int(rows[index])))
        received = f"{found[index]:.3g} m/s, {name}"
        if found[index] > self.fastest:
            self.fastest, self.worst = float(found[index]), received
        if not found[index] <= self.speed:
            self.fail(simulation, received, [name])

    def end(self, simulation: Simulation) -> None:
        """Fail where the time, or whoever it speaks of, never came."""
        if simulation.frame < self.frame:
            self.fail(simulation, f"the run ended at frame {simulation.frame}, before frame {self.frame}")
        if self.among is not None and not self.among.known:
            self.fail(simulation, f"never asked, since {self.among.absence(simulation.world)}")


class Order(Expectation):
    """``order`` of events: each comes, and none before the one stated before it."""

    def __init__(self, words: Sequence[Any], world: World) -> None:
        if len(words) < 2:
            raise WordError("must be two events or more", received=str(len(words)))
        self.events: list[Event] = [read_event(each, world) for each in words]
        self.seen, self.times = [0] * len(words), [np.inf] * len(words)
        text = ", then ".join(event.text for event in self.events)
        super().__init__(f"order: {text}", text)

    def observe(self, simulation: Simulation) -> None:
        """Note which events have come, and fail at the first that came too early."""
        world = simulation.world
        for number, event in enumerate(self.events):
            for row in event.matching_rows(world) if self.seen[number] < event.nth else ():
                self.seen[number] += 1
                if self.seen[number] == event.nth:
                    self.times[number] = float(world[event.kind].time[row])  # type: ignore[attr-defined]
        for number in range(1, len(self.events)):
            before, now = self.times[number - 1 : number + 1]
            if now < before:
                self.fail(
                    simulation, f"{self.events[number].text} at {now:.6g} s, before {self.events[number - 1].text}"
                )
        self.worst = ", ".join(f"{time:.6g} s" for time in self.times if time < np.inf)

    def end(self, simulation: Simulation) -> None:
        """Fail where one never came."""
        for event, time in zip(self.events, self.times, strict=True):
            if time == np.inf:
                self.fail(simulation, f"no {event.text} by the end of the run")


def among(patterns: Sequence[str] | None, world: World) -> Cast | None:
    """Return whom names or patterns mean, None for everybody; raise WordError for a name that nobody will have."""
    return None if patterns is None else cast_of(patterns, world)
