"""Phases: systems in order under one name, and a frame on its way through them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from time import perf_counter_ns
from typing import TYPE_CHECKING, Any, Final

from carom.ecs.commands import apply_commands
from carom.ecs.errors import DeclarationError
from carom.ecs.system import Condition, Function, Question, System
from carom.ecs.timings import COMMANDS

if TYPE_CHECKING:
    from carom.ecs.world import World

Repeat = Callable[["World"], int]
AfterSystem = Callable[[System], None]
Step = tuple[Any, str, Question | None, Function | None]


class Phase:
    """Systems in order under one name, run ``repeat(world)`` times with the time step divided among the repeats.

    ``when`` is asked before each repeat, and where it does not hold that was the last; it reads what the systems of the
    phase declare. A phase may stand within another, between systems: it is run in each repeat of that one.
    """

    def __init__(
        self, name: str, *parts: System | Phase, repeat: Repeat | None = None, when: Condition | None = None
    ) -> None:
        for stray in parts:
            if not isinstance(stray, System | Phase):
                raise DeclarationError(
                    f"phase '{name}' takes systems, received {getattr(stray, '__name__', repr(stray))}; "
                    f"write @system(reads=..., writes=...) above the function"
                )
        self.name: Final = name
        self.parts: Final = parts
        self.repeat: Final = repeat
        self.when: Final = when
        systems = tuple(system for _, system in self)
        self.question: Final = (
            None if when is None else Question(when, f"phase '{name}'", "one of its systems", systems)
        )
        #: The parts as a frame goes through them, in which looking an attribute up takes as long as the rest: each with
        #: its name, what is asked before, and what it does; a phase within has only itself.
        self.steps: Final[tuple[Step, ...]] = tuple(
            (part, part.name, part.question, part.function) if isinstance(part, System) else (part, "", None, None)
            for part in parts
        )

    def __iter__(self) -> Iterator[tuple[Phase, System]]:
        for part in self.parts:
            if isinstance(part, Phase):
                yield from part
            else:
                yield self, part

    def exchanged(self, exchange: Callable[[System], tuple[System, ...]]) -> Phase:
        """Return this phase with each system exchanged for others."""
        parts: list[System | Phase] = []
        for part in self.parts:
            parts += (part.exchanged(exchange),) if isinstance(part, Phase) else exchange(part)
        return Phase(self.name, *parts, repeat=self.repeat, when=self.when)


class Frame:
    """One frame on its way through phases; ``began`` is when (ns) the system that runs did.

    One reading of the clock ends a system and begins the next, so that nothing is left out. An object and not a
    function within another that calls itself: a frame leaves nothing behind for the garbage collector, which would halt
    a game for 40 ms once in a while.
    """

    __slots__ = "after", "began", "calls", "checked", "spent", "world"

    def __init__(
        self, world: World, checked: bool, after: AfterSystem | None, spent: dict[str, int], calls: dict[str, int]
    ) -> None:
        self.world, self.checked, self.after, self.spent, self.calls = world, checked, after, spent, calls
        self.began = perf_counter_ns()

    def go_through(self, phases: tuple[Phase, ...], dt: float) -> None:
        """Run phases, and the commands asked for in each behind it."""
        world = self.world
        for phase in phases:
            if self.run(phase, dt):
                world.running = None
                apply_commands(world)
                now = perf_counter_ns()
                self.spent[COMMANDS] += now - self.began
                self.calls[COMMANDS] += 1
                self.began = now

    def run(self, phase: Phase, dt: float) -> bool:
        """Run a phase of ``dt`` seconds; tell whether it has run at all."""
        world, checked, after, spent, calls = self.world, self.checked, self.after, self.spent, self.calls
        repeats, asked = 1 if phase.repeat is None else phase.repeat(world), phase.question
        share, began, clock = dt / max(repeats, 1), self.began, perf_counter_ns
        for done in range(repeats):
            if asked is not None and not (asked.guarded if checked else asked.condition)(world):
                self.began = began
                return done > 0
            for part, name, question, function in phase.steps:
                if function is None:
                    world.running = None
                    self.began = began
                    self.run(part, share)
                    began = self.began
                    continue
                world.running = part
                if question is not None and not (question.guarded if checked else question.condition)(world):
                    continue
                if checked:
                    part.guarded(world, share)
                else:
                    function(world, share)
                now = clock()
                spent[name] += now - began
                calls[name] += 1
                began = now
                if after is not None:
                    after(part)
                    began = clock()
        self.began = began
        return True
