"""Systems: functions over columns that declare what they touch, and when they run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from carom.ecs.access import Access, Kind
from carom.ecs.errors import DeclarationError

if TYPE_CHECKING:
    from carom.ecs.world import World

Function = Callable[["World", float], None]
Condition = Callable[["World"], bool]


@dataclass(frozen=True, eq=False)
class System:
    """A function ``(world, dt)`` with its declared access; with ``when`` it runs only where that holds."""

    function: Function
    reads: tuple[Kind, ...]
    writes: tuple[Kind, ...]
    adds: tuple[Kind, ...]
    when: Condition | None = None

    @property
    def name(self) -> str:
        """The function's name."""
        return self.function.__name__

    @property
    def purpose(self) -> str:
        """The first line of the function's docstring."""
        return (self.function.__doc__ or "").strip().split("\n")[0]

    def __call__(self, world: World, dt: float) -> None:
        """Run the function as it is."""
        self.function(world, dt)

    def guarded(self, world: World, dt: float) -> None:
        """Run the function seeing only what it declares: reads read-only, everything undeclared refused."""
        self._access.call(world, self.function, dt)

    @cached_property
    def _access(self) -> Access:
        return Access(
            f"system '{self.name}'",
            self.reads,
            (*self.writes, *self.adds),
            "reads=, writes= or adds= of @system",
            "move the component to writes= (or adds=) of @system",
        )

    @cached_property
    def question(self) -> Question | None:
        """What is asked before the system runs; None where it always does."""
        return None if self.when is None else Question(self.when, f"system '{self.name}'", "the system", (self,))


def system(
    *,
    reads: tuple[Kind, ...] = (),
    writes: tuple[Kind, ...] = (),
    adds: tuple[Kind, ...] = (),
    when: Condition | None = None,
) -> Callable[[Function], System]:
    """Declare a function ``(world, dt)`` as a system; ``adds`` is for columns that several systems accumulate into.

    ``when`` is asked each time just before the system would run: ``when=every(10)``, or a function of the world that
    looks at what the system declares.
    """
    return lambda function: System(function, reads, writes, adds, when)


def every(count: int) -> Condition:
    """Return the condition that holds in every ``count``-th frame; dt stays that of one frame."""
    if count < 1:
        raise DeclarationError(f"every() counts in frames, 1 or more; received {count}")

    def due(world: World) -> bool:
        return world.frame % count == 0

    due.__name__ = f"every({count})"
    return due


class Question:
    """A condition as ``owner`` asks it: it reads what ``systems`` declare, and ``declares`` says who that is."""

    def __init__(self, condition: Condition, owner: str, declares: str, systems: tuple[System, ...]) -> None:
        kinds = dict.fromkeys(kind for one in systems for kind in (*one.reads, *one.writes, *one.adds))
        self.condition = condition
        self._sight = Access(
            f"condition '{named(condition)}' of {owner}",
            tuple(kinds),
            (),
            f"reads= of {declares}",
            "a condition only looks; write in the system",
        )

    def guarded(self, world: World) -> bool:
        """Ask it, refusing what nobody declares, and all writing."""
        return bool(self._sight.call(world, self.condition))


def named(condition: Condition) -> str:
    """Return the name of a condition; an object that is called has that of its class."""
    return str(getattr(condition, "__name__", type(condition).__name__))
