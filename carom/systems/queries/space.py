"""Space: what of a world can be asked about places, batches of them and single ones."""

from __future__ import annotations

from math import inf
from typing import Unpack

import numpy.typing as npt

from carom.ecs import World
from carom.ecs.column import Booleans
from carom.systems.queries import rays
from carom.systems.queries.filters import Filters
from carom.systems.queries.rays import AllRayHits, RayHit, RayHits


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
    ) -> RayHits:
        """Return what rays from ``origins`` (n, 3), m, along ``directions`` (n, 3) meet first, within ``reach``, m."""
        return rays.cast_rays(self._world, origins, directions, reach, **filters)

    def cast_ray(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]
    ) -> RayHit | None:
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
    ) -> AllRayHits:
        """Return every collider that rays meet, in order of rays and distance."""
        return rays.cast_rays_all(self._world, origins, directions, reach, **filters)

    def cast_ray_all(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, reach: float = inf, **filters: Unpack[Filters]
    ) -> AllRayHits:
        """Return every collider that one ray meets, in order of distance."""
        return rays.cast_rays_all(self._world, origin, direction, reach, **filters)
