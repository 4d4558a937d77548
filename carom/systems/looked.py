"""Looked: what is looked at of pairs that are fast."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.detection.meshes import Indices, Singles
from carom.systems.kernels.cores import CORE
from carom.systems.kernels.fast_pairs import NUMBERS, TRIANGLE_CORNERS


class Looked(NamedTuple):
    """What `foresee_meetings` reads of pairs that are looked after, a mesh first; poses are those on their bodies."""

    bodies: Integers
    numbers: Floats
    cores: Floats
    roots: Integers  # of a mesh's tree, -1 of another shape
    position: Floats
    rotation: Floats

    @classmethod
    def room(cls, numbers: Floats) -> Looked:
        """Return room for as many pairs as there are ``numbers`` of, to be written."""
        n = len(numbers)
        return cls(
            np.empty((n, 2), np.int64), numbers, np.zeros((n, 2 * CORE)), np.empty(n, np.int64),
            np.empty((n, 2, 3)), np.empty((n, 2, 4)),
        )  # fmt: skip

    def take(self, which: Any) -> Looked:
        """Return some of them."""
        return Looked(*(column[which] for column in self))


class Land(NamedTuple):
    """The trees of meshes, and the vertices of all hulls with room for those of a triangle behind them."""

    bounds: Singles
    nodes: Indices
    triangles: Floats
    room: Floats


class FastPairs(NamedTuple):
    """All pairs (n, 2) of collider rows that are fast, a mesh first, and what is looked at of them.

    ``left`` is how far (m) their bodies may move before what is known of their contacts is not trusted any more. Those
    are ``asked`` whose contacts, followed straight on, do not say when they meet.
    """

    pairs: Integers
    looked: Looked
    left: Floats
    asked: Booleans

    @classmethod
    def of(cls, pairs: Integers, looked: Looked) -> FastPairs:
        """Return pairs of whom nothing is known."""
        return cls(pairs, looked, np.zeros(len(pairs)), np.zeros(len(pairs), np.bool_))


NOBODY = Looked.room(np.empty((0, NUMBERS)))
NOWHERE = Land(np.empty(0, np.float32), np.empty(0, np.int32), np.empty(0), np.zeros((TRIANGLE_CORNERS, 3)))
NO_PAIRS = FastPairs.of(np.empty((0, 2), np.int64), NOBODY)
