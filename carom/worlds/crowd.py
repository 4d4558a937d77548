"""Crowds: entities that differ only in where they are and how they move are added together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.systems.simulation import Simulation
from carom.worlds.connections import Pointer
from carom.worlds.errors import Path
from carom.worlds.groups import Group

LONE = ("joint", "keyframes")  # words that say where one entity is


class Some(NamedTuple):
    """An entity of a file, or the copies that a generator makes of it, where they are.

    Positions (n, 3) in m; rotations (n, 4), and velocities by their words, of all or None where ``words`` say it.
    """

    path: Path
    group: Group
    words: dict[str, Any]
    positions: Floats
    names: list[str] | None = None
    rotations: Floats | None = None
    motion: dict[str, Any] | None = None
    pointers: Sequence[Pointer] = ()
    joint: dict[str, Any] | None = None
    weight: dict[str, Any] | None = None  # what is stated of a body whose mass depends on what it carries

    def joins(self, other: Some) -> bool:
        """Tell whether both can be added at once: what is said of them is the same."""
        return (
            self.rotations is not None
            and other.rotations is not None
            and (self.names is None) is (other.names is None)
            and (self.motion or {}).keys() == (other.motion or {}).keys()
            and (self.motion is None) is (other.motion is None)
            and self.words == other.words
        )


def add_together(simulation: Simulation, crowd: Sequence[Some]) -> Integers:
    """Add entities that can be added at once; return their handles. Raises DeclarationError."""
    positions, names, words = together(crowd)
    return simulation.add_many(positions, names=names, **words)


def together(crowd: Sequence[Some]) -> tuple[Floats, list[str] | None, dict[str, Any]]:
    """Return positions (n, 3), m, names and words of entities that can be added at once."""
    first, words = crowd[0], dict(crowd[0].words)
    counts = [len(some.positions) for some in crowd]
    if first.rotations is not None:
        words["transform"] = {
            "rotation": np.concatenate([some.rotations for some in crowd if some.rotations is not None])
        }
    if first.motion is not None:
        words["motion"] = {key: _spread([(some.motion or {})[key] for some in crowd], counts) for key in first.motion}
    names = None if first.names is None else [name for some in crowd for name in some.names or ()]
    return np.concatenate([some.positions for some in crowd]), names, words


def _spread(values: Sequence[Any], counts: Sequence[int]) -> Floats:
    return np.repeat(np.asarray(values, np.float64), counts, axis=0)
