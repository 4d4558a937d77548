"""Access: in checked mode a function of the world sees what it declares, and nothing else."""

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

#: Set while a function runs guarded, so that kernels expect read-only arrays.
GUARDED: ContextVar[bool] = ContextVar("guarded", default=False)


@dataclass(frozen=True, eq=False)
class Access:
    """What somebody may touch; ``to_touch`` and ``to_write`` end the messages for those who do more."""

    who: str
    reads: tuple[Kind, ...]
    writes: tuple[Kind, ...]
    to_touch: str
    to_write: str

    def call(self, world: World, function: Callable[..., Any], *arguments: Any) -> Any:
        """Call ``function(world, ...)`` with reads read-only and everything undeclared refused."""
        faces = world.guards.get(self)
        if faces is None:
            faces = world.guards[self] = Declared(self, world)
        with world.faces(faces):
            token = GUARDED.set(True)
            try:
                return function(world, *arguments)
            except ValueError as fault:
                if "read-only" not in str(fault):
                    raise
                kinds = ", ".join(kind.__name__ for kind in self.reads if issubclass(kind, Record))
                raise AccessError(
                    f"{self.who} writes to a column it declares to read ({kinds}); {self.to_write}"
                ) from fault
            finally:
                GUARDED.reset(token)


class Declared(dict[Any, Any]):
    """The tables and resources that an access holds."""

    def __init__(self, access: Access, world: World) -> None:
        super().__init__()
        self.access = access
        for kind in (*access.reads, *access.writes):
            if issubclass(kind, Record):
                table = world.table(kind)
                self[kind] = table.live if kind in access.writes else table.view
            elif kind in world.resources:
                self[kind] = world.resources[kind]

    def __missing__(self, key: Any) -> Any:
        if not (isinstance(key, type) and issubclass(key, (Record, Resource))):
            raise KeyError(key)
        declared = ", ".join(kind.__name__ for kind in self) or "nothing"
        raise AccessError(
            f"{self.access.who} touches {key.__name__} but declares only {declared}; "
            f"add {key.__name__} to {self.access.to_touch}"
        )
