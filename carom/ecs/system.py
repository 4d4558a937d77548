"""Systems: functions over columns that declare what they touch."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from carom.ecs.component import Record, Resource
from carom.ecs.errors import AccessError

if TYPE_CHECKING:
    from carom.ecs.world import World

Kind = type[Record] | type[Resource]
Function = Callable[["World", float], None]

#: Set while a system runs guarded, so that kernels expect read-only arrays.
GUARDED: ContextVar[bool] = ContextVar("guarded", default=False)


@dataclass(frozen=True, eq=False)
class System:
    """A function ``(world, dt)`` with its declared access."""

    function: Function
    reads: tuple[Kind, ...]
    writes: tuple[Kind, ...]
    adds: tuple[Kind, ...]

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
        faces = world.guards.get(self)
        if faces is None:
            faces = world.guards[self] = Declared(self, world)
        with world.faces(faces):
            token = GUARDED.set(True)
            try:
                self.function(world, dt)
            except ValueError as fault:
                if "read-only" not in str(fault):
                    raise
                kinds = ", ".join(kind.__name__ for kind in self.reads if issubclass(kind, Record))
                raise AccessError(
                    f"system '{self.name}' writes to a column it declares to read ({kinds}); "
                    f"move the component to writes= (or adds=) of @system"
                ) from fault
            finally:
                GUARDED.reset(token)


class Declared(dict[Any, Any]):
    """The tables and resources one system may touch."""

    def __init__(self, system: System, world: World) -> None:
        super().__init__()
        self.system = system
        for kind in (*system.reads, *system.writes, *system.adds):
            if issubclass(kind, Record):
                table = world.table(kind)
                self[kind] = table.live if kind in system.writes or kind in system.adds else table.view
            elif kind in world.resources:
                self[kind] = world.resources[kind]

    def __missing__(self, key: Any) -> Any:
        if not (isinstance(key, type) and issubclass(key, (Record, Resource))):
            raise KeyError(key)
        declared = ", ".join(kind.__name__ for kind in self) or "nothing"
        raise AccessError(
            f"system '{self.system.name}' touches {key.__name__} but declares only {declared}; "
            f"add {key.__name__} to reads=, writes= or adds= of @system"
        )


def system(
    *,
    reads: tuple[Kind, ...] = (),
    writes: tuple[Kind, ...] = (),
    adds: tuple[Kind, ...] = (),
) -> Callable[[Function], System]:
    """Declare a function ``(world, dt)`` as a system; ``adds`` is for columns that several systems accumulate into."""
    return lambda function: System(function, reads, writes, adds)
