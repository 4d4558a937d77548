"""Force laws: what a world states about its forces, and the list each force system works through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeVar

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.rigid_body import RigidBody
from carom.ecs.errors import DeclarationError, EntityError
from carom.ecs.world import World
from carom.systems.parameters import parameter, vector
from carom.systems.registry import enter

LAWS: dict[str, type[Law]] = {}
L = TypeVar("L", bound="Law")

__all__ = ["LAWS", "Forces", "Law", "parameter", "vector"]


@dataclass(frozen=True)
class Law:
    """One force of a world; parameters are fields declared by `parameter`, and ``key`` is its word in files."""

    key: ClassVar[str] = ""
    steady: ClassVar[bool] = True  # the same as long as the body stays where it is, so that it may fall asleep
    conservative: ClassVar[bool] = False  # it has a potential energy, see `energy`

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "key" in vars(cls):
            enter(LAWS, cls.key, cls, clash="force laws have the key", mend="give one of them another key")

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return the potential energy (J) of bodies of these masses (n,) with these centres of mass (n, 3)."""
        raise NotImplementedError

    def refuse_unless(self, fits: bool, word: str, fault: str) -> None:
        """Raise DeclarationError, which says what is wrong with a word, unless it fits."""
        if not fits:
            raise DeclarationError(f"{self.key}.{word}: {fault}")


@dataclass
class Forces(Resource):
    """The force laws of a world, each with the entities it acts on (None: every body)."""

    entries: dict[type[Law], list[tuple[Any, tuple[int, ...] | None]]] = field(default_factory=dict)

    def add(self, law: Law, entities: tuple[int, ...] | None = None) -> None:
        """Let a law act from now on."""
        self.entries.setdefault(type(law), []).append((law, entities))

    @property
    def count(self) -> int:
        """How many laws there are."""
        return sum(map(len, self.entries.values()))

    def acting(self, kind: type[L], world: World) -> Sequence[tuple[L, Integers]]:
        """Return each law of a kind with the rows of the living bodies it acts on."""
        entries = self.entries.get(kind)
        if entries is None:  # most laws of most worlds, in every substep
            return ()
        bodies = world.row_numbers(RigidBody)
        return [(law, bodies if entities is None else _rows(world, entities)) for law, entities in entries]


def _rows(world: World, entities: tuple[int, ...]) -> Integers:
    rows = []
    for entity in entities:
        try:
            rows.append(world.row(entity))
        except EntityError:
            continue  # despawned: its forces went with it
    return np.array(rows, np.int64)
