"""Rays: what they meet first, whether they meet anything, or all of it."""

from __future__ import annotations

from math import inf
from typing import NamedTuple, Unpack

import numpy as np
import numpy.typing as npt

from carom.ecs import Entity, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.kernels.rays import ALL, ANY, FIRST, cast, face_hits
from carom.systems.queries.arguments import Arguments
from carom.systems.queries.asked import note
from carom.systems.queries.filters import Filters, seen
from carom.systems.queries.scene import Scene

NOBODY = -1  # the entity and the face of a ray that meets nothing
ROOM = 4  # hits a ray has room for at first


class Hits(NamedTuple):
    """What rays meet first, one row per ray: where one meets nothing, `entity` is -1 and `distance` infinite."""

    entity: Integers  # the body, or the collider's own where it stands
    collider: Integers
    point: Floats  # (n, 3), m; 0 where a ray meets nothing
    normal: Floats  # (n, 3), unit, out of what is met; 0 where a ray meets nothing
    distance: Floats  # m along the ray
    face: Integers  # -1 where a ray begins inside

    @property
    def hit(self) -> Booleans:
        """Which rays meet something."""
        return np.asarray(self.entity >= 0)


class AllHits(NamedTuple):
    """All that rays meet, in order of rays and distance: every collider once, where the ray enters it."""

    ray: Integers
    entity: Integers
    collider: Integers
    point: Floats
    normal: Floats
    distance: Floats
    face: Integers


class Hit(NamedTuple):
    """What one ray meets; see `Hits`."""

    entity: Entity
    collider: Entity
    point: Floats
    normal: Floats
    distance: float
    face: int


def cast_rays(
    world: World,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    reach: npt.ArrayLike = inf,
    **filters: Unpack[Filters],
) -> Hits:
    """Return what rays from ``origins`` (n, 3), m, along ``directions`` (n, 3), of any length but 0, meet first.

    They look as far as ``reach`` (n,), m; either of the three may be one for all. Raises QueryError.
    """
    n, hits = _cast("cast_rays", FIRST, world, origins, directions, reach, filters)
    entity, collider, face = np.full(n, NOBODY), np.full(n, NOBODY), np.full(n, NOBODY)
    point, normal, distance = np.zeros((n, 3)), np.zeros((n, 3)), np.full(n, inf)
    columns = entity, collider, point, normal, distance, face
    for column, values in zip(columns, hits[1:], strict=True):
        column[hits.ray] = values
    return Hits(*columns)


def cast_rays_any(
    world: World,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    reach: npt.ArrayLike = inf,
    **filters: Unpack[Filters],
) -> Booleans:
    """Return for each ray whether it meets anything, sooner than `cast_rays` tells what."""
    n, hits = _cast("cast_rays_any", ANY, world, origins, directions, reach, filters)
    found = np.zeros(n, np.bool_)
    found[hits.ray] = True
    return found


def cast_rays_all(
    world: World,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    reach: npt.ArrayLike = inf,
    **filters: Unpack[Filters],
) -> AllHits:
    """Return every collider that rays meet, in the terms of `cast_rays`, in order of rays, distance and collider."""
    _, hits = _cast("cast_rays_all", ALL, world, origins, directions, reach, filters)
    order = np.lexsort((hits.collider, hits.distance, hits.ray))
    return AllHits._make(column[order] for column in hits)


def single(hits: Hits) -> Hit | None:
    """Return the first ray's hit by itself, None where there is none."""
    if not hits.hit[0]:
        return None
    entity, collider, point, normal, distance, face = (column[0] for column in hits)
    return Hit(Entity(int(entity)), Entity(int(collider)), point, normal, float(distance), int(face))


def _cast(
    query: str,
    wanted: int,
    world: World,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    reach: npt.ArrayLike,
    filters: Filters,
) -> tuple[int, AllHits]:
    """Return how many rays there are, and their hits as the kernel comes upon them."""
    given = Arguments(query)
    origin, direction = given.vectors("origins", origins), given.directions("directions", directions)
    limit = given.lengths("reach", reach)
    origin, direction, limit = given.settle(origin, direction, limit)
    scene = world[Scene].of_now(world)
    takes = seen(world, scene.rows, scene.body, filters)
    ray, row, distance, face = meet(scene, takes, wanted, origin, direction, limit)
    normal = np.empty((len(ray), 3))
    face_hits(origin, direction, ray, row, distance, *scene.colliders, face, normal)
    point = origin[ray] + distance[:, None] * direction[ray]
    entity, collider = scene.entities(world, row)
    note(world, query, filters, origin, ray, entity, point, direction, limit)
    return len(origin), AllHits(ray, entity, collider, point, normal, distance, face)


def meet(
    scene: Scene, takes: Booleans, wanted: int, origin: Floats, direction: Floats, limit: Floats
) -> tuple[Integers, Integers, Floats, Integers]:
    """Return (ray, row, distance, part) of what rays meet, as `cast` comes upon it."""
    room = ROOM * len(origin) if wanted == ALL else len(origin)
    while True:
        ray, row, part = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room, np.int64)
        distance = np.empty(room)
        count = cast(
            wanted, origin, direction, limit, takes, scene.endless, scene.members, scene.tree, *scene.colliders,
            scene.mesh_tree, ray, row, distance, part,
        )  # fmt: skip
        if count >= 0:
            return ray[:count], row[:count], distance[:count], part[:count]
        room *= 2
