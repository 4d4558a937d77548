"""Crowds: entities of one make-up are added together, each with values of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Component
from carom.systems.assembly import bundles_of
from carom.systems.compound import StatedBodies
from carom.systems.simulation import Simulation
from carom.worlds.connections import Pointer
from carom.worlds.errors import Path
from carom.worlds.groups import Group

LONE = ("joint", "keyframes")  # words that say where one entity is


class Some(NamedTuple):
    """An entity of a file, or the copies that a generator makes of it, where they are.

    Positions (n, 3) in m; rotations (n, 4), and the components of all, or None where ``words`` say them.
    """

    path: Path
    group: Group
    words: dict[str, Any]
    positions: Floats
    names: list[str] | None = None
    rotations: Floats | None = None
    bundles: Sequence[Component] | None = None
    pointers: Sequence[Pointer] = ()
    joint: dict[str, Any] | None = None
    weight: dict[str, Any] | None = None  # what is stated of a body whose mass depends on what it carries

    def joins(self, other: Some) -> bool:
        """Tell whether both can be added at once: the same columns are stated of them."""
        return (
            self.bundles is not None
            and other.bundles is not None
            and (self.names is None) is (other.names is None)
            and [(type(part), *vars(part)) for part in self.bundles]
            == [(type(part), *vars(part)) for part in other.bundles]
        )


def add_together(simulation: Simulation, crowd: Sequence[Some]) -> Integers:
    """Add entities that can be added at once; return their handles. Raises DeclarationError."""
    world = simulation.world
    if crowd[0].bundles is None:
        return simulation.add_many(crowd[0].positions, names=crowd[0].names, **crowd[0].words)
    positions, names, bundles = together(world, crowd)
    entities = world.spawn_many(len(positions), *bundles, names=names)
    bodies = [some.words.get("body") for some in crowd for _ in some.positions]
    stated = zip(entities.tolist(), bodies, strict=True)
    world[StatedBodies].words.update({entity: body for entity, body in stated if body is not None})
    return entities


def together(world: World, crowd: Sequence[Some]) -> tuple[Floats, list[str] | None, list[Component]]:
    """Return positions (n, 3), m, names and components of entities that can be added at once."""
    first = crowd[0]
    if first.bundles is None:
        return first.positions, first.names, bundles_of(world, **first.words)
    counts = [len(some.positions) for some in crowd]
    positions = np.concatenate([some.positions for some in crowd])
    rotations = np.concatenate([some.rotations for some in crowd if some.rotations is not None])
    names = None if first.names is None else [name for some in crowd for name in some.names or ()]
    kinds = range(len(first.bundles))
    bundles = [_stacked([some.bundles[kind] for some in crowd if some.bundles], counts) for kind in kinds]
    return positions, names, [*bundles, Transform(position=positions, rotation=rotations)]


def _stacked(parts: Sequence[Component], counts: Sequence[int]) -> Component:
    """Return one bundle of all, each value as often as its entity is there."""
    first = parts[0]
    if all(part is first for part in parts):
        return first
    return type(first)(
        **{name: np.repeat(np.stack([getattr(part, name) for part in parts]), counts, axis=0) for name in vars(first)}
    )
