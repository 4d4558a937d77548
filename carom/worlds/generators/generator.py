"""Generators: words that stand for many copies of an entity or group, each in a file of its own, and their registry."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar, NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import angles
from carom.systems.registry import enter
from carom.worlds.values import Words

MOST_COPIES = 1_000_000  # of one entity; more would fill the memory before anything is told

GENERATORS: dict[str, type[Generator]] = {}


class Setting(NamedTuple):
    """What copies are made in: which axis is up, the seeded draws of the world, and how large one copy is.

    The box around it has ``edges`` (3,), m, along the axes of the world; it lies within ``reach`` (m) of its origin
    whichever way it is turned. Both are None of what has no collider, or one without end.
    """

    up: int
    draws: np.random.Generator
    edges: Floats | None = None
    reach: float | None = None

    @property
    def across(self) -> tuple[int, int]:
        """The two axes that are level; the first goes along a wall."""
        return (0, 2) if self.up == 1 else (0, 1)

    def size(self, key: str) -> Floats:
        """Return the edges (3,) of the box about a copy, m; raise DeclarationError where it has none."""
        if self.edges is None:
            raise _sizeless(key)
        return self.edges

    def radius(self, key: str) -> float:
        """Return the radius of the ball about a copy, m; raise DeclarationError where it has none."""
        if self.reach is None:
            raise _sizeless(key)
        return self.reach


def _sizeless(key: str) -> DeclarationError:
    mend = "give it a collider of finite size, or write line or grid, which say how far apart copies are"
    return DeclarationError(f"{key}: needs the size of what is copied; {mend}")


class Copies(NamedTuple):
    """Copies: positions (n, 3), m, from the entity's own; the numbers (n, k) in their names; rotations (n, 4) or None.

    A rotation goes before the entity's own. ``note`` is what a user should know.
    """

    positions: Floats
    numbers: Integers
    rotations: Floats | None = None
    note: str = ""

    def names(self, name: str) -> list[str]:
        """Return the name of each, such as ``rain[3,0,1]``."""
        return [f"{name}[{','.join(map(str, numbers))}]" for numbers in self.numbers.tolist()]


class Generator(Words):
    """Words that stand for many copies; ``key`` is their word on an entity."""

    key: ClassVar[str]
    sized: ClassVar[bool] = False  # whether copies are laid by how large they are

    @classmethod
    def __pydantic_init_subclass__(cls, **options: Any) -> None:
        """Enter a generator into the registry."""
        if "key" in vars(cls):
            enter(GENERATORS, cls.key, cls, clash="generators have the key", mend="give one of them another key")

    @abstractmethod
    def amount(self) -> int:
        """Return how many copies are asked for."""

    @abstractmethod
    def lay(self, setting: Setting) -> Copies:
        """Return the copies; raise DeclarationError for what cannot be laid."""

    def copies(self, setting: Setting) -> Copies:
        """Return the copies; raise DeclarationError for too many, and for what cannot be laid."""
        if self.amount() > MOST_COPIES:
            raise DeclarationError(f"{self.key}: asks for {self.amount()} copies, at most {MOST_COPIES} are made")
        return self.lay(setting)


def turns(draws: np.random.Generator, count: int) -> Floats:
    """Return random rotations (count, 4), all alike likely.

    K. Shoemake, Uniform Random Rotations, Graphics Gems III, 1992.
    """
    share, *angle = draws.uniform(size=(3, count))
    (sine, cosine), (other_sine, other_cosine) = (angles.sines_cosines(2.0 * np.pi * one) for one in angle)
    less, more = np.sqrt(1.0 - share), np.sqrt(share)
    return np.column_stack([less * sine, less * cosine, more * other_sine, more * other_cosine])


def numbered(*counts: int) -> Integers:
    """Return all places of a block of so many, (n, k), the last number running first."""
    return np.indices(counts).reshape(len(counts), -1).T
