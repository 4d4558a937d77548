"""Stage: a world of nothing but the colliders of a query and those it may meet, in which the narrow phase measures."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.detection.answered import Answered
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.narrow import measure_pairs
from carom.systems.kernels.boxes_near import find_near
from carom.systems.queries.scene import PLACED_BY, Scene
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Shape
from carom.systems.threads import Threads

ROOM = 16  # colliders that a query has room for at first


class Placed(NamedTuple):
    """A shape in many places."""

    shape: Shape
    position: Floats  # (n, 3), m
    rotation: Floats  # (n, 4)

    def box(self) -> tuple[Floats, Floats]:
        """Return the middle and the half extents (n, 3), m, of the bounds in each place."""
        bounds = self.shape.bounds()
        half = (np.abs(quaternion.matrix(self.rotation)) * np.asarray(bounds.half)).sum(axis=-1) + bounds.radius
        return self.position + quaternion.rotate(self.rotation, np.asarray(bounds.center)), half


class Measured(NamedTuple):
    """How each pair of a query and a collider (row) is, where they are nearest or deepest; a gap below 0 is depth."""

    query: Integers
    row: Integers
    gap: Floats  # m
    normal: Floats  # unit, out of the collider
    middle: Floats  # m, between the two surfaces

    def take(self, which: Integers | Booleans) -> Measured:
        """Return some of the pairs."""
        return Measured._make(column[which] for column in self)


def near(scene: Scene, center: Floats, half: Floats, direction: Floats, reach: Floats, takes: Booleans) -> Integers:
    """Return pairs (n, 2) of a query and the colliders (rows) whose boxes its own meets as it moves straight on."""
    room = ROOM * len(center)
    while True:
        pairs: Integers = np.empty((room, 2), np.int64)
        count = find_near(center, half, direction, reach, takes, scene.endless, scene.members, scene.tree, pairs)
        if count >= 0:
            return pairs[:count]
        room *= 2


def measure(world: World, scene: Scene, placed: Placed, pairs: Integers, reaches: Floats) -> Measured:
    """Return the pairs (query, row) that are no farther apart than their ``reaches`` (n,), m, and how they are."""
    if not len(pairs):
        return Measured(pairs[:, 0], pairs[:, 1], np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)))
    rows, target = np.unique(pairs[:, 1], return_inverse=True)
    asked, query = np.unique(pairs[:, 0], return_inverse=True)
    stage = _staged(world, scene, rows, Placed(placed.shape, placed.position[asked], placed.rotation[asked]))
    with stage.faces(None):
        found = measure_pairs(stage, np.stack([target, len(rows) + query], axis=1), reaches, "auto")
    order = np.lexsort((-found.depth, found.row_a, found.row_b))
    one, other = found.row_a[order], found.row_b[order]
    first = np.ones(len(order), np.bool_)
    first[1:] = (one[1:] != one[:-1]) | (other[1:] != other[:-1])
    best = order[first]
    return Measured(
        asked[found.row_b[best] - len(rows)], rows[found.row_a[best]],
        -found.depth[best], found.normal[best], found.point[best],
    )  # fmt: skip


def _staged(world: World, scene: Scene, rows: Integers, placed: Placed) -> World:
    """Return a world with the colliders of ``rows``, then the shape in its places."""
    geometries, known = Geometries(), world[Geometries]
    geometries.items, geometries.numbers = list(known.items), dict(known.numbers)
    geometry = getattr(placed.shape, "geometry", None)
    bounds = placed.shape.bounds()
    own: dict[str, Any] = {
        "shape": placed.shape.number,
        "size": placed.shape.packed(),
        "geometry": -1 if geometry is None else geometries.number(geometry),
        "position": np.zeros(3),
        "rotation": quaternion.IDENTITY,
        "bound_center": bounds.center,
        "bound_half": bounds.half,
        "bound_radius": bounds.radius,
    }
    n, collider = len(placed.position), world[Collider]
    columns = {
        name: np.concatenate([held := getattr(collider, name)[rows], np.broadcast_to(own[name], (n, *held.shape[1:]))])
        for name in PLACED_BY
    }
    position = np.concatenate([scene.position[rows], placed.position])
    rotation = np.concatenate([scene.rotation[rows], placed.rotation])
    stage = World(capacity=max(len(rows) + n, 1))
    packed = world[PackedHulls].forked(), world[PackedMeshes].forked()
    for resource in (world[Settings], geometries, Threads(), Answered(), FclObjects(), *packed):
        stage.add(resource)
    stage.spawn_many(len(rows) + n, Collider(**columns), ColliderPose(position=position, rotation=rotation))
    return stage
