"""Looked: what is looked at of pairs that are fast."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.detection.meshes import Indices, Singles
from carom.systems.kernels.cores import CORE
from carom.systems.kernels.fast_pairs import TRIANGLE_CORNERS
from carom.systems.kernels.swinging import NUMBERS


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


class Land(NamedTuple):
    """The trees of meshes, and the vertices of all hulls with room for those of a triangle behind them."""

    bounds: Singles
    nodes: Indices
    triangles: Floats
    room: Floats


class LeftOut(NamedTuple):
    """Contacts of pairs that are looked after, too far to be trusted, as `when_near` follows them.

    Places (n, 2, 3) are in the frames of their ``bodies`` (n, 2).
    """

    bodies: Integers
    normals: Floats
    gaps: Floats
    nears: Floats
    places: Floats

    @classmethod
    def room(cls, count: int) -> LeftOut:
        """Return room for so many, to be written."""
        return cls(
            np.empty((count, 2), np.int64), np.empty((count, 3)), np.empty(count), np.empty(count),
            np.empty((count, 2, 3)),
        )  # fmt: skip


class Told(NamedTuple):
    """Where contacts of pairs that are looked after are on the cores of both bodies, as `write_told` says it."""

    spans: Integers
    around: Floats
    places: Floats

    @classmethod
    def room(cls, pairs: int, count: int) -> Told:
        """Return room for ``count`` contacts of so many pairs, to be written."""
        return cls(np.empty((pairs, 2), np.int64), np.empty(count), np.empty((count, 2, 3)))


class FastPairs(NamedTuple):
    """Pairs (n, 2) of collider rows that are fast, a mesh first, and what is looked at of them.

    Those are ``asked`` whose contacts, followed straight on, do not say when they meet. ``left`` is how far (m) their
    bodies may still move before what is known of their contacts is no longer trusted, 0 where nothing is known. Who has
    been ``near`` since contacts were found is trusted anew in each substep. In so many seconds (``times``) from the
    last look on they are to be looked at again, 0 where that is not known.
    ``linear`` and ``angular`` are all velocities when they were found.
    """

    pairs: Integers
    looked: Looked
    asked: Booleans
    near: Booleans
    left: Floats
    times: Floats
    linear: Floats
    angular: Floats

    @classmethod
    def of(cls, pairs: Integers, looked: Looked, linear: Floats, angular: Floats) -> FastPairs:
        """Return pairs of whom nothing is known yet, as bodies move."""
        n = len(pairs)
        ones = np.ones(n, np.bool_)
        return cls(pairs, looked, ones, ones.copy(), np.zeros(n), np.zeros(n), linear.copy(), angular.copy())


NOWHERE = Land(np.empty(0, np.float32), np.empty(0, np.int32), np.empty(0), np.zeros((TRIANGLE_CORNERS, 3)))
NONE_LEFT_OUT = LeftOut.room(0)
NONE_TOLD = Told.room(0, 0)
NO_PAIRS = FastPairs.of(np.empty((0, 2), np.int64), Looked.room(np.empty((0, NUMBERS))), *np.empty((2, 0, 3)))
