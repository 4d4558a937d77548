"""Ghosts: bodies where they would be otherwise, by a closed form or in another future, as translucent copies."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.compound import bodies_of
from carom.tools.batch import Batch
from carom.tools.coloring import Legend
from carom.tools.marks import Color, Lines, tinted
from carom.worlds.oracle import Oracle

ALPHA = 0.45
PATH_WIDTH = 1.6  # px


class Ghost(ABC):
    """Copies of some of a world's bodies elsewhere; ``color`` is theirs, None: that of the bodies."""

    name: str
    color: Color | None = None

    @abstractmethod
    def rows(self, world: World) -> Integers:
        """Return the rows of the world that is drawn which have a copy."""

    @abstractmethod
    def poses(self, world: World, shown: Transform, time: float) -> Transform:
        """Return where the copies of all rows are at a time (s), when the world's own are as ``shown``."""

    def path(self, since: int = 0) -> Floats:
        """Return where its bodies have been, (times, bodies, 3) in m, from a time on; most ghosts do not tell."""
        return np.zeros((0, 0, 3))

    def tinted(self, colors: Floats) -> Floats:
        """Return the colours (n, 4) of copies by those of the bodies."""
        ghostly = np.array(colors, np.float64)
        if self.color is not None:
            ghostly[:, :3] = self.color
        ghostly[:, 3] *= ALPHA
        return ghostly


class Foretold(Ghost):
    """Where the oracle of a world says that bodies are."""

    name = "oracle"

    def rows(self, world: World) -> Integers:
        """Return who has a closed form, and what belongs to them."""
        foretold = np.isin(np.arange(world.used()), world[Oracle].rows(world))
        owner = owners(world)
        return np.nonzero(foretold[owner])[0]

    def poses(self, world: World, shown: Transform, time: float) -> Transform:
        """Return poses moved to where the oracle says, turned as they are; who is nowhere is not a number."""
        foretold = world[Oracle].rows(world)
        moved = np.zeros((world.used(), 3))
        moved[foretold] = world[Oracle].positions(world, foretold, time) - shown.position[foretold]
        poses = Transform()
        poses.position = shown.position[: world.used()] + moved[owners(world)]
        poses.rotation = shown.rotation[: world.used()]
        return poses


class Ghosts(Resource):
    """The ghosts of a world beside those of its oracle."""

    def __init__(self, ghosts: Sequence[Ghost] = ()) -> None:
        self.ghosts = list(ghosts)


def ghosts_of(world: World) -> list[Ghost]:
    """Return all ghosts of a world, that of its oracle last."""
    others = world[Ghosts].ghosts if Ghosts in world else []
    return [*others, Foretold()] if Oracle in world else others


def legend_of_ghosts(world: World) -> Legend | None:
    """Return the names of ghosts that have a colour of their own beside it; None where there are none."""
    told = {ghost.name: ghost.color for ghost in ghosts_of(world) if ghost.color is not None}
    return Legend("futures", tuple(told), tuple(told.values())) if told else None


def owners(world: World) -> Integers:
    """Return for each row the row of the body it belongs to, or itself where there is none."""
    body = bodies_of(world)
    return np.where(body >= 0, body, np.arange(len(body)))


def elsewhere(world: World, shown: Transform, time: float, blur: float) -> list[tuple[Ghost, Transform, Integers]]:
    """Return each ghost with its poses and those of its rows that are farther than ``blur`` (m) from all before it.

    Two copies at one place would shine through each other in spots.
    """
    taken, found = [shown.position[: world.used()]], []
    for ghost in ghosts_of(world):
        poses, rows = ghost.poses(world, shown, time), ghost.rows(world)
        gaps = np.array([np.linalg.norm(poses.position[rows] - place[rows], axis=1) for place in taken])
        taken.append(poses.position)
        found.append((ghost, poses, rows[(gaps > blur).all(axis=0)]))
    return found


def copies(ghost: Ghost, batches: Sequence[Batch], rows: Integers) -> list[Batch]:
    """Return what is drawn of some rows in the colours of a ghost."""
    parts = [batch.take(np.nonzero(np.isin(batch.ids, rows))[0]) for batch in batches]
    return [replace(part, colors=ghost.tinted(part.colors)) for part in parts if len(part.ids)]


def path_lines(ghost: Ghost) -> Lines | None:
    """Return the way a ghost has gone so far as lines in its colour; None where it does not tell."""
    path = ghost.path()
    if len(path) < 2 or ghost.color is None:
        return None
    starts, ends = path[:-1].reshape(-1, 3), path[1:].reshape(-1, 3)
    there = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
    return Lines(starts[there], ends[there], tinted(ghost.color, int(there.sum())), PATH_WIDTH, behind=0.25)
