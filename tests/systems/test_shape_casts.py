"""Shape casts: the first touch is where formulas and the narrow phase have it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from meshes import block, sheet
from ray_worlds import EXACT, PLACE, TURN, alone, rays_at, searched
from solids import SOLIDS, about_axis, reaching

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.queries.arguments import QueryError
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.stating import shape_of
from carom.systems.simulation import Simulation

RADIUS = 0.25  # m, of the balls that are cast
BALL: dict[str, Any] = {"sphere": {"radius": RADIUS}}
CUBE: dict[str, Any] = {"box": {"size": (1.0, 1.0, 1.0)}}
DOWN = (0.0, -1.0, 0.0)


def outside_box(x: Floats, half: Any) -> Floats:
    """Return how far points are from a box."""
    return np.asarray(np.linalg.norm(np.maximum(np.abs(x) - half, 0.0), axis=1))


def outside_cone(x: Floats) -> Floats:
    """Return how far points are from a cone of 0.5 m by 1.2 m, by the two edges that are turned about its axis."""
    place = np.stack([about_axis(x), x[:, 1]], axis=1)
    ends = [np.array(end) for end in ((0.0, 0.6), (0.5, -0.6), (0.0, -0.6))]
    nearest = np.full(len(x), np.inf)
    for start, end in pairwise(ends):
        along = end - start
        share = np.clip((place - start) @ along / (along @ along), 0.0, 1.0)
        nearest = np.minimum(nearest, np.linalg.norm(place - start - share[:, None] * along, axis=1))
    return np.where(SOLIDS["cone"][1](x) > 0.0, nearest, 0.0)


#: How far points are from solids, which is all that a ball of that radius knows of them.
DISTANCES: dict[str, Callable[[Floats], Floats]] = {
    "sphere": SOLIDS["sphere"][1],
    "plane": SOLIDS["plane"][1],
    "capsule": SOLIDS["capsule"][1],
    "box": lambda x: outside_box(x, np.array([0.5, 0.3, 0.7])),
    "cylinder": lambda x: np.hypot(np.maximum(about_axis(x) - 0.4, 0.0), np.maximum(np.abs(x[:, 1]) - 0.5, 0.0)),
    "cone": outside_cone,
}
STRAIGHT = {"sphere", "box", "capsule", "convex", "plane", "mesh"}  # of straight edges, or round about them


@pytest.mark.parametrize("far", [3.0, 1e5])
@pytest.mark.parametrize("name", DISTANCES)
def test_balls_touch_where_the_rounded_solid_begins(name: str, far: float) -> None:
    """From near and from 100 km: against a search for where the distance to the solid is the radius."""
    space = alone(SOLIDS[name][0], position=PLACE, rotation=TURN).space
    origin, direction = rays_at(1, 400, far, spread=0.7)
    skipped = max(far - 4.0, 0.0)
    hits = space.cast_shapes(BALL, origin, direction, skipped + 8.0)
    expected, clear = searched(lambda x: DISTANCES[name](x) - RADIUS, origin, direction, skipped)
    assert (hits.hit == np.isfinite(expected))[clear].all()
    met = clear & hits.hit
    assert met.sum() > 60
    assert np.abs(hits.distance[met] - expected[met]).max() < EXACT
    center = origin[met] + hits.distance[met, None] * direction[met]
    assert np.abs(center - RADIUS * hits.normal[met] - hits.point[met]).max() < EXACT


@pytest.mark.parametrize("asks", ["box", "capsule", "cylinder", "cone", "ellipsoid", "convex"])
@pytest.mark.parametrize("name", [*SOLIDS, "mesh"])
def test_every_shape_is_free_until_it_touches(asks: str, name: str) -> None:
    """The gap is above 0 on all of the way, 0 at its end, and above 0 for ever where nothing is met."""
    collider: dict[str, Any] = {"shape": Mesh(block())} if name == "mesh" else SOLIDS[name][0]
    shape, generator = SOLIDS[asks][0], np.random.default_rng(3)
    simulation = Simulation()
    turn = quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))
    simulation.add(collider=collider, transform={"rotation": turn})
    origin, direction = rays_at(4, 40, 6.0, spread=0.7)
    rotation = quaternion.normalise(generator.normal(size=(40, 4)))
    space = simulation.space
    apart = np.isin(np.arange(40), space.find_overlaps(shape, origin, rotation).query, invert=True)
    origin, direction, rotation = origin[apart], direction[apart], rotation[apart]
    hits = space.cast_shapes(shape, origin, direction, 12.0, rotation)
    way = np.where(hits.hit, hits.distance, 12.0)
    assert hits.hit.sum() > 8
    for share in (0.0, 0.5, 0.9, 0.99, 0.999):
        gaps = space.closest_to_shapes(shape, origin + (share * way)[:, None] * direction, rotation)
        assert len(gaps.query) == len(way)
        assert (gaps.distance > 0.0).all()
    origin, direction, rotation, way = (column[hits.hit] for column in (origin, direction, rotation, way))
    normal = hits.normal[hits.hit]
    closing = -(normal * direction).sum(axis=1)
    assert (closing > 0.0).all()
    end = origin + way[:, None] * direction
    assert np.abs(space.closest_to_shapes(shape, end, rotation).distance).max() < 2e-7
    if name not in ("mesh", "plane"):  # a plane parts the two, and not for much longer
        exact = EXACT if {asks, name} <= STRAIGHT else 1e-5  # the square of how far the normal of a round one is off
        gap = -reaching(shape_of(shape), end, rotation, -normal) - reaching(shape_of(collider), 0.0, turn, normal)
        assert np.abs(gap).max() < exact
        beyond = end + (3.0 * exact / closing)[:, None] * direction
        assert len(space.find_overlaps(shape, beyond, rotation).query) == len(way)


def test_boxes_falling_flat_on_edge_and_on_a_corner() -> None:
    """A cube of 1 m reaches 1/2, sqrt 2 / 2 and sqrt 3 / 2 down; each lands where its lowest place meets the floor."""
    simulation = Simulation()
    simulation.add(collider={"box": {"size": (10.0, 1.0, 10.0)}}, transform={"position": (0.0, -0.5, 0.0)})
    simulation.add(collider={"shape": Mesh(block())}, transform={"position": (20.0, 0.0, 0.0)})
    simulation.add(collider={"plane": {"offset": -3.0}})
    edge = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi / 4)
    corner = quaternion.multiply(quaternion.from_axis_angle((1.0, 0.0, 0.0), np.arctan(np.sqrt(0.5))), edge)
    turns = np.array([quaternion.IDENTITY, edge, corner])
    for x, floor in ((0.2, 0.0), (20.2, 0.0), (-30.0, -3.0)):
        hits = simulation.space.cast_shapes(CUBE, np.tile((x, 7.0, 0.3), (3, 1)), DOWN, rotations=turns)
        low = np.sqrt([0.25, 0.5, 0.75])
        assert np.abs(hits.distance - (7.0 - floor - low)).max() < EXACT
        assert np.abs(hits.normal - [0.0, 1.0, 0.0]).max() < 1e-9
        assert np.abs(hits.point[:, 1] - floor).max() < EXACT


def test_a_cast_that_begins_in_an_overlap_ends_at_once() -> None:
    """At distance 0, with the normal out of where it is deepest, whichever way it goes; touching it may leave."""
    simulation = Simulation()
    floor = simulation.add(collider={"box": {"size": (10.0, 1.0, 10.0)}}, transform={"position": (0.0, -0.5, 0.0)})
    wall = simulation.add(collider=CUBE, transform={"position": (3.0, 0.5, 0.0)})
    space = simulation.space
    for direction in np.concatenate([np.eye(3), -np.eye(3)]):
        hit = space.cast_shape(CUBE, (0.0, 0.4, 0.0), direction)
        assert hit is not None
        assert (hit.entity, hit.distance) == (floor, 0.0)
        assert np.abs(hit.normal - [0.0, 1.0, 0.0]).max() < 1e-12
    for shape in (CUBE, {"sphere": {"radius": 0.5}}, {"cylinder": {"radius": 0.5, "length": 1.0}}):
        assert space.cast_shape(shape, (0.0, 0.5, 0.0), (0.0, 1.0, 0.0)) is None
        into = space.cast_shape(shape, (0.0, 0.5, 0.0), (0.1, -1.0, 0.0))
        assert into is not None
        assert (into.entity, into.distance) == (floor, 0.0)
        along = space.cast_shape(shape, (0.0, 0.5, 0.0), (1.0, 0.0, 0.0))
        assert along is not None
        assert (along.entity, along.distance) == (wall, pytest.approx(2.0, abs=1e-9))


def test_a_shape_on_a_mesh_slides_into_another_part_of_it() -> None:
    """What touches a mesh where it begins may meet it elsewhere; deep in it it ends at once."""
    floor, wall = sheet(4, 8.0, 0.0), sheet(4, 8.0, 0.0)
    upright = wall.vertices @ np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) + [2.5, 0.0, 0.0]
    both = Geometry(np.concatenate([floor.vertices, upright]), np.concatenate([floor.faces, wall.faces + 25]))
    simulation = Simulation()
    simulation.add(collider={"shape": Mesh(both)})
    for shape in ({"sphere": {"radius": 0.5}}, CUBE, {"capsule": {"radius": 0.5, "length": 1e-3}}):
        height = 0.5 if "capsule" not in shape else 0.5005
        hit = simulation.space.cast_shape(shape, (0.1, height + 1e-10, 0.2), (1.0, 0.0, 0.0))
        assert hit is not None
        assert hit.distance == pytest.approx(1.9, abs=1e-7)
        assert np.abs(hit.normal - [-1.0, 0.0, 0.0]).max() < 1e-6
        assert hit.face >= len(floor.faces)
    deep = simulation.space.cast_shape(CUBE, (0.1, 0.3, 0.2), (1.0, 0.0, 0.0))
    assert deep is not None
    assert deep.distance == 0.0


def test_reach_filters_points_and_ties() -> None:
    """A point that is cast is a ray; as far as reach; of two at one distance the lower row; alone as in a batch."""
    simulation = Simulation()
    made = [simulation.add(collider=CUBE, body={}, transform={"position": (0.0, 0.0, z)}) for z in (1.0, -1.0, 0.0)]
    space = simulation.space
    assert space.cast_shape(BALL, (0.0, 5.0, 0.0), DOWN, 4.24) is None
    hit = space.cast_shape(BALL, (0.0, 5.0, 0.0), DOWN, 4.26)
    assert hit is not None
    assert (hit.entity, hit.distance) == (made[2], pytest.approx(4.25, abs=1e-12))
    wide = {"box": {"size": (0.5, 0.5, 3.0)}}
    assert [space.cast_shape(wide, (0.0, 5.0, 0.0), DOWN, without=made[:k]).entity for k in range(3)] == made  # type: ignore[union-attr]
    origin, direction = rays_at(5, 50, spread=0.7)
    every = space.cast_shapes({"point": {}}, origin, direction)
    rays = space.cast_rays(origin, direction)
    assert (every.hit == rays.hit).all()
    assert np.abs(every.distance[rays.hit] - rays.distance[rays.hit]).max() < EXACT
    for k in range(50):
        one = space.cast_shape(CUBE, origin[k], direction[k])
        batch = space.cast_shapes(CUBE, origin, direction)
        assert (one is not None) == batch.hit[k]
        if one is not None:
            assert one.distance == batch.distance[k]
            break


def test_what_is_refused() -> None:
    """Shapes that no body may have, and every fault of the numbers at once."""
    simulation = Simulation()
    with pytest.raises(QueryError, match=r"^cast_shapes: shape: must be one that a body may have, received a plane$"):
        simulation.space.cast_shape({"plane": {}}, (0.0, 0.0, 0.0), DOWN)
    with pytest.raises(QueryError) as fault:
        simulation.space.cast_shapes(BALL, np.zeros((2, 3)), np.zeros((2, 3)), [np.nan, 1.0], (0.0, 0.0, np.nan, 1.0))
    assert str(fault.value).splitlines() == [
        "cast_shapes: directions: must have a direction, received a zero vector in rows 0, 1",
        "cast_shapes: reach: must be 0 m or more, received nan in row 0",
        "cast_shapes: rotations: must be finite, received [0.0, 0.0, nan, 1.0] in row 0",
    ]
