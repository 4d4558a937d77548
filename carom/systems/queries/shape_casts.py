"""Shape casts: what a shape that moves straight on, without turning, meets first."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from carom.ecs import World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.constants import CAST_BEGUN, FARTHEST_QUERY, ON_SURFACE
from carom.systems.detection.fcl_pairs import CORES
from carom.systems.detection.hulls import Hulls, PackedHulls
from carom.systems.kernels import shape_casts
from carom.systems.queries.arguments import Arguments, QueryError
from carom.systems.queries.asked import note
from carom.systems.queries.filters import Filters, seen
from carom.systems.queries.places import are_meshes, movable, within
from carom.systems.queries.rays import NOBODY, Hits
from carom.systems.queries.scene import Scene
from carom.systems.queries.stage import Measured, Placed, near
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import Shape


def cast_shapes(
    world: World,
    shape: Shape | Mapping[str, Any],
    positions: npt.ArrayLike,
    directions: npt.ArrayLike,
    reach: npt.ArrayLike = inf,
    rotations: npt.ArrayLike = quaternion.IDENTITY,
    **filters: Unpack[Filters],
) -> Hits:
    """Return what a shape at ``positions`` (n, 3), m, turned by ``rotations`` (n, 4), meets first along ``directions``.

    It moves as far as ``reach`` (n,), m; any of them may be one for all. Raises QueryError.
    """
    given, form = Arguments("cast_shapes"), movable("cast_shapes", shape)
    if type(form) not in CORES:
        raise QueryError(f"cast_shapes: shape: must be one of carom's own, received a {form.key}")
    position, direction = given.vectors("positions", positions), given.directions("directions", directions)
    limit, rotation = given.lengths("reach", reach), given.directions("rotations", rotations, 4)
    position, direction, limit, rotation = given.settle(position, direction, limit, rotation)
    limit = np.minimum(limit, FARTHEST_QUERY)
    scene = world[Scene].of_now(world)
    takes = seen(world, scene.rows, scene.body, filters)
    placed, best = Placed(form, position, rotation), _Best(limit)
    begun = within(world, scene, placed, np.full(len(limit), CAST_BEGUN), takes)
    told = best.begin(begun, direction, ~are_meshes(scene, begun.row))
    pairs = near(scene, *placed.box(), direction, best.distance, takes)
    names = (1, len(limit))
    pairs = pairs[~np.isin(pairs @ names, begun.query[told] + len(limit) * begun.row[told]) & best.moves[pairs[:, 0]]]
    best.search(world, scene, placed, direction, pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))])
    hits = best.hits(world, scene)
    met = np.nonzero(hits.hit)[0]
    note(world, "cast_shapes", filters, position, met, hits.entity[met], hits.point[met], direction, limit)
    return hits


class _Best:
    """What is met first from each place, as far as is known."""

    def __init__(self, limit: Floats) -> None:
        n = len(limit)
        self.row, self.part, self.distance = np.full(n, NOBODY), np.full(n, NOBODY), limit.copy()
        self.normal, self.point, self.moves = np.zeros((n, 3)), np.zeros((n, 3)), np.ones(n, np.bool_)

    def begin(self, begun: Measured, direction: Floats, convex: Booleans) -> Booleans:
        """Take what overlaps or touches the shape where it begins; return which pairs need no search.

        Of overlaps the deepest counts and ends the search. What only touches a convex collider, and does not lead into
        it, will never meet it.
        """
        closing = -(begun.normal * direction[begun.query]).sum(axis=1)
        deep, leads_in = begun.gap < -ON_SURFACE, convex & (closing > 0.0)
        way = np.where(deep, 0.0, np.maximum(begun.gap, 0.0) / np.where(leads_in, closing, 1.0))
        met = deep | (leads_in & (way <= self.distance[begun.query]))
        order = np.lexsort((begun.row, begun.gap, way, begun.query))
        order = order[met[order]]
        queries, first = np.unique(begun.query[order], return_index=True)
        best = order[first]
        self.row[queries], self.distance[queries], self.normal[queries] = begun.row[best], way[best], begun.normal[best]
        self.point[queries] = begun.middle[best] - 0.5 * begun.gap[best, None] * begun.normal[best]
        self.moves[begun.query[deep]] = False
        return deep | convex

    def search(self, world: World, scene: Scene, placed: Placed, direction: Floats, pairs: Integers) -> None:
        """Find what is met first on the way."""
        shape, hulls, number = placed.shape, scene.hulls, -1
        if (geometry := getattr(placed.shape, "geometry", None)) is not None:
            number = 1 + max(int(scene.geometry.max(initial=0)), len(world[Geometries].items))
            hulls = world[PackedHulls].and_further({number: geometry})
        shape_casts.cast_shapes(
            pairs, placed.position, placed.rotation, direction,
            np.append(scene.shape, shape.number), np.concatenate([scene.size, [shape.packed()]]),
            np.append(scene.geometry, number), _and_one(scene.position), _and_one(scene.rotation),
            hulls, scene.meshes, _vertices(hulls),
            self.row, self.distance, self.normal, self.point, self.part,
        )  # fmt: skip

    def hits(self, world: World, scene: Scene) -> Hits:
        """Return it in terms of entities."""
        hit = self.row >= 0
        entity, collider = np.full(len(hit), NOBODY), np.full(len(hit), NOBODY)
        entity[hit], collider[hit] = scene.entities(world, self.row[hit])
        return Hits(entity, collider, self.point, self.normal, np.where(hit, self.distance, inf), self.part)


def _and_one(column: Floats) -> Floats:
    return np.concatenate([column, np.zeros((1, column.shape[1]))])


def _vertices(hulls: Hulls) -> Floats:
    return np.concatenate([hulls.vertices, np.zeros((3, 3))])
