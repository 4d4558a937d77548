"""Space: what of a world can be asked about places, batches of them and single ones."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any, Unpack

import numpy.typing as npt

from carom.ecs import Collider, Parent, Transform, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.spatial.quaternion import IDENTITY
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.layers import Layers
from carom.systems.queries import places, rays, shape_casts
from carom.systems.queries.answers import Closest, Insides, Nearest, Overlap, Overlaps, deepest, nearest
from carom.systems.queries.asked import Asked
from carom.systems.queries.filters import Filters
from carom.systems.queries.rays import AllHits, Hit, Hits
from carom.systems.queries.scene import Scene
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Shape

#: What a system declares to read that asks.
ASKED = (Transform, Parent, Collider, Layers, Settings, Geometries, PackedHulls, PackedMeshes, Scene, Asked)


class Space:
    """The colliders of a world, to be asked at any time, before the first step too: ``simulation.space.cast_ray(...)``.

    Every query sees them where their entities are now, and changes nothing. ``filters`` are those of `Filters`.
    """

    def __init__(self, world: World) -> None:
        self._world = world

    def cast_rays(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        reach: npt.ArrayLike = inf,
        **filters: Unpack[Filters],
    ) -> Hits:
        """Return what rays from ``origins`` (n, 3), m, along ``directions`` (n, 3) meet first, within ``reach``, m."""
        return rays.cast_rays(self._world, origins, directions, reach, **filters)

    def cast_ray(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]
    ) -> Hit | None:
        """Return what one ray meets first, None where it meets nothing."""
        return rays.single(rays.cast_rays(self._world, origin, direction, reach, **filters))

    def cast_rays_any(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        reach: npt.ArrayLike = inf,
        **filters: Unpack[Filters],
    ) -> Booleans:
        """Return for each ray whether it meets anything."""
        return rays.cast_rays_any(self._world, origins, directions, reach, **filters)

    def cast_ray_any(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]
    ) -> bool:
        """Return whether one ray meets anything."""
        return bool(rays.cast_rays_any(self._world, origin, direction, reach, **filters)[0])

    def cast_rays_all(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        reach: npt.ArrayLike = inf,
        **filters: Unpack[Filters],
    ) -> AllHits:
        """Return every collider that rays meet, in order of rays and distance."""
        return rays.cast_rays_all(self._world, origins, directions, reach, **filters)

    def cast_ray_all(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]
    ) -> AllHits:
        """Return every collider that one ray meets, in order of distance."""
        return rays.cast_rays_all(self._world, origin, direction, reach, **filters)

    def cast_shapes(
        self,
        shape: Shape | Mapping[str, Any],
        positions: npt.ArrayLike,
        directions: npt.ArrayLike,
        reach: npt.ArrayLike = inf,
        rotations: npt.ArrayLike = IDENTITY,
        **filters: Unpack[Filters],
    ) -> Hits:
        """Return what a shape at ``positions`` (n, 3), m, meets first as it moves along ``directions`` (n, 3)."""
        return shape_casts.cast_shapes(self._world, shape, positions, directions, reach, rotations, **filters)

    def cast_shape(
        self,
        shape: Shape | Mapping[str, Any],
        position: npt.ArrayLike,
        direction: npt.ArrayLike,
        reach: float = inf,
        rotation: npt.ArrayLike = IDENTITY,
        **filters: Unpack[Filters],
    ) -> Hit | None:
        """Return what a shape meets first as it moves straight on, None where it meets nothing."""
        return rays.single(shape_casts.cast_shapes(self._world, shape, position, direction, reach, rotation, **filters))

    def closest_points(self, points: npt.ArrayLike, reach: npt.ArrayLike = inf, **filters: Unpack[Filters]) -> Closest:
        """Return the nearest place of each collider no farther than ``reach``, m, from ``points`` (n, 3), m."""
        return places.closest_points(self._world, points, reach, **filters)

    def closest_point(self, point: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]) -> Nearest | None:
        """Return the place nearest to one point, None where there is none within ``reach``, m."""
        return nearest(places.closest_points(self._world, point, reach, **filters))

    def closest_to_shapes(
        self,
        shape: Shape | Mapping[str, Any],
        positions: npt.ArrayLike,
        rotations: npt.ArrayLike = IDENTITY,
        reach: npt.ArrayLike = inf,
        **filters: Unpack[Filters],
    ) -> Closest:
        """Return the nearest place of each collider no farther than ``reach``, m, from a shape in several places."""
        return places.closest_to_shapes(self._world, shape, positions, rotations, reach, **filters)

    def closest_to_shape(
        self,
        shape: Shape | Mapping[str, Any],
        position: npt.ArrayLike,
        rotation: npt.ArrayLike = IDENTITY,
        reach: float = inf,
        **filters: Unpack[Filters],
    ) -> Nearest | None:
        """Return the place nearest to a shape, None where there is none within ``reach``, m."""
        return nearest(places.closest_to_shapes(self._world, shape, position, rotation, reach, **filters))

    def find_overlaps(
        self,
        shape: Shape | Mapping[str, Any],
        positions: npt.ArrayLike,
        rotations: npt.ArrayLike = IDENTITY,
        **filters: Unpack[Filters],
    ) -> Overlaps:
        """Return who overlaps a shape at ``positions`` (n, 3), m, turned by ``rotations`` (n, 4)."""
        return places.find_overlaps(self._world, shape, positions, rotations, **filters)

    def find_overlap(
        self,
        shape: Shape | Mapping[str, Any],
        position: npt.ArrayLike,
        rotation: npt.ArrayLike = IDENTITY,
        **filters: Unpack[Filters],
    ) -> Overlap | None:
        """Return who overlaps a shape most, None where nobody does."""
        return deepest(places.find_overlaps(self._world, shape, position, rotation, **filters))

    def points_inside(self, points: npt.ArrayLike, **filters: Unpack[Filters]) -> Insides:
        """Return which of ``points`` (n, 3), m, are inside of which colliders."""
        return places.points_inside(self._world, points, **filters)

    def point_inside(self, point: npt.ArrayLike, **filters: Unpack[Filters]) -> Integers:
        """Return the colliders that one point is inside of."""
        return places.points_inside(self._world, point, **filters).collider
