"""Places: what is nearest to points and shapes, what they overlap and what they are inside."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from carom.ecs import World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.kernels.rays import ALL
from carom.systems.queries.answers import Closest, Insides, Overlaps
from carom.systems.queries.arguments import Arguments, QueryError
from carom.systems.queries.asked import note
from carom.systems.queries.filters import Filters, seen
from carom.systems.queries.rays import meet
from carom.systems.queries.scene import Scene
from carom.systems.queries.stage import Measured, Placed, measure, near
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.point import Point
from carom.systems.shapes.shape import Shape
from carom.systems.shapes.stating import shape_of

ASKANCE = (0.48, 0.6, 0.64)  # a direction that few faces lie along


def closest_points(
    world: World, points: npt.ArrayLike, reach: npt.ArrayLike = inf, **filters: Unpack[Filters]
) -> Closest:
    """Return the nearest place of each collider no farther than ``reach``, m, from ``points`` (n, 3), m."""
    given = Arguments("closest_points")
    position, limit = given.vectors("points", points), given.lengths("reach", reach)
    position, limit = given.settle(position, limit)
    return _closest("closest_points", world, Placed(Point(), position, _level(len(position))), limit, filters)


def closest_to_shapes(
    world: World,
    shape: Shape | Mapping[str, Any],
    positions: npt.ArrayLike,
    rotations: npt.ArrayLike = quaternion.IDENTITY,
    reach: npt.ArrayLike = inf,
    **filters: Unpack[Filters],
) -> Closest:
    """Return the nearest place of each collider no farther than ``reach``, m, from a shape in several places."""
    given, form = Arguments("closest_to_shapes"), movable("closest_to_shapes", shape)
    position, rotation = given.vectors("positions", positions), given.directions("rotations", rotations, 4)
    position, rotation, limit = given.settle(position, rotation, given.lengths("reach", reach))
    return _closest("closest_to_shapes", world, Placed(form, position, rotation), limit, filters)


def find_overlaps(
    world: World,
    shape: Shape | Mapping[str, Any],
    positions: npt.ArrayLike,
    rotations: npt.ArrayLike = quaternion.IDENTITY,
    **filters: Unpack[Filters],
) -> Overlaps:
    """Return who overlaps or touches a shape at ``positions`` (n, 3), m, turned by ``rotations`` (n, 4)."""
    given, form = Arguments("find_overlaps"), movable("find_overlaps", shape)
    position, rotation = given.vectors("positions", positions), given.directions("rotations", rotations, 4)
    position, rotation = given.settle(position, rotation)
    scene = world[Scene].of_now(world)
    takes = seen(world, scene.rows, scene.body, filters)
    found = within(world, scene, Placed(form, position, rotation), np.zeros(len(position)), takes)
    entity, collider = scene.entities(world, found.row)
    note(world, "find_overlaps", filters, position, found.query, entity, found.middle)
    return Overlaps(found.query, entity, collider, -found.gap, found.middle, found.normal)


def points_inside(world: World, points: npt.ArrayLike, **filters: Unpack[Filters]) -> Insides:
    """Return which of ``points`` (n, 3), m, are inside of which colliders, surfaces counted in."""
    given = Arguments("points_inside")
    (position,) = given.settle(given.vectors("points", points))
    scene = world[Scene].of_now(world)
    point, row = _inside(scene, position, seen(world, scene.rows, scene.body, filters))
    entity, collider = scene.entities(world, row)
    note(world, "points_inside", filters, position, point, entity, position[point])
    return Insides(point, entity, collider)


def movable(query: str, shape: Shape | Mapping[str, Any]) -> Shape:
    """Return a shape by its words; raise QueryError for one that no body may have."""
    form = shape if isinstance(shape, Shape) else shape_of(shape)
    if form.static:
        raise QueryError(f"{query}: shape: must be one that a body may have, received a {form.key}")
    return form


def _level(count: int) -> Floats:
    return np.tile(np.asarray(quaternion.IDENTITY), (count, 1))


def _closest(query: str, world: World, placed: Placed, reach: Floats, filters: Filters) -> Closest:
    scene = world[Scene].of_now(world)
    found = within(world, scene, placed, reach, seen(world, scene.rows, scene.body, filters))
    half = (0.5 * found.gap)[:, None] * found.normal
    entity, collider = scene.entities(world, found.row)
    point, own = found.middle - half, found.middle + half
    note(world, query, filters, placed.position, found.query, entity, point)
    return Closest(found.query, entity, collider, found.gap, point, own, found.normal)


def within(world: World, scene: Scene, placed: Placed, reach: Floats, takes: Booleans) -> Measured:
    """Return all that is within reach of a shape in its places, in order of queries, gaps and rows."""
    center, half = placed.box()
    pairs = near(scene, center, half + reach[:, None], np.zeros_like(center), np.zeros(len(center)), takes)
    query, row = pairs.T
    apart = np.linalg.norm(center[query] - scene.middle[row], axis=1)
    wide = 2.0 * np.linalg.norm(half, axis=1)[query]
    most = apart + wide + scene.width[row]  # no pair is farther apart
    found = measure(world, scene, placed, pairs, np.minimum(reach[query], most))
    missed = _deep_in_meshes(scene, placed, takes)
    missed = missed[~np.isin(missed @ (1, len(reach)), found.query + len(reach) * found.row)]
    if len(missed):
        which = np.isin(pairs @ (1, len(reach)), missed @ (1, len(reach)))
        deep = measure(world, scene, placed, pairs[which], most[which])
        found = Measured._make(np.concatenate(columns) for columns in zip(found, deep, strict=True))
    return found.take(np.lexsort((found.row, found.gap, found.query)))


def _deep_in_meshes(scene: Scene, placed: Placed, takes: Booleans) -> Integers:
    """Return the pairs (query, row) of meshes and those in them, of which no triangle may be within reach."""
    meshes = np.zeros(len(scene.shape), np.bool_)
    meshes[scene.rows] = are_meshes(scene, scene.rows)
    if not meshes.any():
        return np.empty((0, 2), np.int64)
    tip = placed.shape.support(np.array([[1.0, 0.0, 0.0]]))[0]
    inside = _inside(scene, placed.position + quaternion.rotate(placed.rotation, tip), takes & meshes[: len(takes)])
    return np.stack(inside, axis=1)


def are_meshes(scene: Scene, rows: Integers) -> Booleans:
    """Return which colliders (rows) are made of triangles, or met as if they were."""
    return np.isin(scene.shape[rows], (Mesh.number, HeightField.number))


def _inside(scene: Scene, points: Floats, takes: Booleans) -> tuple[Integers, Integers]:
    """Return which points are inside of which colliders (rows)."""
    n = len(points)
    point, row, _, _ = meet(scene, takes, ALL, points, np.tile(ASKANCE, (n, 1)), np.zeros(n))
    order = np.lexsort((row, point))
    return point[order], row[order]
