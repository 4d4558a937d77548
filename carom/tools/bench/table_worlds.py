"""Worlds of the bench of the table: rows next to each other, and rows with gaps among those of other entities."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Integers

GONE = 0.1  # the part that is despawned at random
SETS = 3  # sets of components that take turns, of which two have a Motion


def contiguous(count: int) -> World:
    """Return ``count`` bodies in rows next to each other."""
    world = World(capacity=count)
    world.spawn_many(count, Transform(position=numbers(count, 1)), Motion(linear=numbers(count, 2)), RigidBody())
    return world


def fragmented(count: int) -> World:
    """Return about ``count`` entities that move, row by row among others, of which a tenth was despawned."""
    total = round(count * SETS / (SETS - 1) / (1 - GONE))
    world = World(capacity=total)
    entities = world.spawn_many(total, Transform(position=numbers(total, 1)))
    turn = np.arange(total) % SETS  # spawning them one by one would take minutes
    moving = np.nonzero(turn < 2)[0]
    world.table(Motion).fill(moving, Motion(linear=numbers(len(moving), 2)))
    world.table(RigidBody).fill(np.nonzero(turn == 1)[0], RigidBody())
    world.structure += 1
    world.despawn(some(entities, round(total * GONE)))
    return world


def some(entities: Integers, count: int) -> Integers:
    """Return ``count`` of these entities at random."""
    return np.random.default_rng(count).choice(entities, count, replace=False)


def numbers(count: int, seed: int) -> np.ndarray:
    """Return (count, 3) numbers at random."""
    return np.random.default_rng(seed).normal(size=(count, 3))
