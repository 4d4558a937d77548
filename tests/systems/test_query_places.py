"""Closest points, overlaps and insides: each answer carries the proof that it is right, and the proof is held."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from meshes import block, nearest, sheet
from solids import SOLIDS, reaching

from carom.ecs.spatial import quaternion
from carom.systems.queries.arguments import QueryError
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.stating import shape_of
from carom.systems.simulation import Simulation

EXACT = 1e-9  # m
CONVEX = [name for name in SOLIDS if name != "plane"]


@pytest.mark.parametrize("name", CONVEX)
def test_the_closest_place_of_a_solid_and_how_deep_a_point_is_in_it(name: str) -> None:
    """Outside, no part of the solid is beyond the plane there; inside, no way out is shorter."""
    collider, outside = SOLIDS[name]
    shape = shape_of(collider)
    position, rotation = np.array([0.3, -0.2, 0.1]), quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))
    simulation = Simulation()
    simulation.add(collider=collider, transform={"position": position, "rotation": rotation})
    generator = np.random.default_rng(1)
    points = position + generator.uniform(-1.0, 1.0, (600, 3)) * np.where(generator.random((600, 1)) < 0.5, 0.4, 1.5)
    local = quaternion.rotate(quaternion.conjugate(rotation), points - position)
    found = simulation.space.closest_points(points)
    assert found.query.tolist() == list(range(600))
    assert ((found.distance < 0.0) == (outside(local) < 0.0))[np.abs(outside(local)) > 1e-7].all()
    assert (found.distance < 0.0).sum() > 40
    assert np.abs(found.own - points).max() < 1e-12
    assert np.abs(found.point + found.distance[:, None] * found.normal - points).max() < 1e-12
    height = (found.normal * points).sum(axis=1) - reaching(shape, position, rotation, found.normal)
    assert np.abs(height - found.distance).max() < EXACT
    at = quaternion.rotate(quaternion.conjugate(rotation), found.point - position)
    assert outside(at).max() < 1e-7  # on it
    ways = generator.normal(size=(200, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    for k in np.nonzero(found.distance < 0.0)[0][:40]:
        out = reaching(shape, position, rotation, ways) - ways @ points[k]
        assert out.min() > -found.distance[k] - EXACT


@pytest.mark.parametrize("asks", CONVEX)
@pytest.mark.parametrize("name", CONVEX)
def test_the_gap_between_shapes_is_the_widest_between_planes(asks: str, name: str) -> None:
    """No shape is beyond its plane, the planes are as far apart as is told, and so are the places on them."""
    one, other = SOLIDS[asks][0], SOLIDS[name][0]
    simulation, generator = Simulation(), np.random.default_rng(2)
    position, rotation = np.array([0.3, -0.2, 0.1]), quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))
    simulation.add(collider=other, transform={"position": position, "rotation": rotation})
    places = position + 3.0 * generator.normal(size=(60, 3))
    turns = quaternion.normalise(generator.normal(size=(60, 4)))
    found = simulation.space.closest_to_shapes(one, places, turns)
    assert found.query.tolist() == list(range(60))
    apart = found.distance > 0.0
    assert apart.sum() > 40
    normal = found.normal
    planes = -reaching(shape_of(one), places, turns, -normal) - reaching(shape_of(other), position, rotation, normal)
    assert np.abs(planes - found.distance)[apart].max() < 2e-8
    assert np.abs(np.linalg.norm(found.own - found.point, axis=1) - found.distance)[apart].max() < 1e-12
    for shape, outside, at, where, turn in (
        (other, SOLIDS[name][1], found.point, position, rotation),
        (one, SOLIDS[asks][1], found.own, places, turns),
    ):
        local = quaternion.rotate(quaternion.conjugate(turn), at - where)
        assert outside(local)[apart].max() < 2e-5, shape
    assert (simulation.space.find_overlaps(one, places, turns).query == np.nonzero(~apart)[0]).all()


def test_points_above_and_below_planes_and_land() -> None:
    """Distances to a half space are heights; under land they are below 0."""
    simulation = Simulation()
    simulation.add(collider={"plane": {"normal": (0.0, 0.6, 0.8), "offset": 0.5}})
    points = np.random.default_rng(3).uniform(-9.0, 9.0, (50, 3))
    found = simulation.space.closest_points(points)
    assert np.abs(found.distance - (points @ (0.0, 0.6, 0.8) - 0.5)).max() < 1e-14
    land = Simulation()
    land.add(collider={"height_field": {"heights": np.zeros((5, 5)), "spacing": 1.0}})
    found = land.space.closest_points([(0.3, 0.7, 0.2), (0.3, -0.7, 0.2), (0.3, -1.9, 0.2)], 1.0)
    assert found.query.tolist() == [0, 1, 2]
    assert np.abs(found.distance - [0.7, -0.7, -1.9]).max() < 1e-15
    assert found.normal.tolist() == [[0.0, 1.0, 0.0]] * 3


def test_points_around_and_in_a_mesh() -> None:
    """The nearest of all triangles, by brute force; deep inside too, whatever the reach."""
    ground = sheet(6, 6.0, 1.0, 0.3)
    simulation = Simulation()
    simulation.add(collider={"shape": Mesh(ground)})
    points = np.random.default_rng(4).uniform(-2.0, 2.0, (200, 3)) + np.array([0.0, 3.5, 0.0])
    found = simulation.space.closest_points(points)
    distance, place, _ = nearest(ground, points)
    assert found.query.tolist() == list(range(200))
    assert np.abs(found.distance - distance).max() < 1e-12
    assert np.abs(found.point - place).max() < 1e-12
    remote = Simulation()  # its origin is elsewhere
    remote.add(collider={"shape": Mesh(Geometry(ground.vertices + 500.0, ground.faces))})
    assert np.abs(remote.space.closest_points(points + 500.0).distance - distance).max() < 1e-12
    solid = Simulation()
    solid.add(collider={"shape": Mesh(block())})
    for reach in (0.0, 0.1, np.inf):
        deep = solid.space.closest_point((0.1, -0.9, 0.3), reach)
        assert deep is not None
        assert deep.distance == pytest.approx(-0.9, abs=1e-15)
        assert np.abs(deep.normal - [0.0, 1.0, 0.0]).max() < 1e-15
    cube = {"box": {"size": (0.2, 0.2, 0.2)}}
    assert solid.space.find_overlap(cube, (0.1, -0.9, 0.3)) is not None
    assert solid.space.find_overlap(cube, (0.1, 0.2, 0.3)) is None
    assert solid.space.find_overlap(cube, (0.1, 0.09, 0.3)) is not None


@pytest.mark.parametrize("name", [*SOLIDS, "mesh"])
def test_points_inside(name: str) -> None:
    """By the formula of each solid, turned and moved."""
    collider: dict[str, Any] = {"shape": Mesh(block())} if name == "mesh" else SOLIDS[name][0]
    position, rotation = np.array([0.3, -0.2, 0.1]), quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))
    simulation = Simulation()
    made = simulation.add(collider=collider, transform={"position": position, "rotation": rotation})
    points = np.random.default_rng(5).uniform(-1.5, 1.5, (4000, 3))
    local = quaternion.rotate(quaternion.conjugate(rotation), points - position)
    outside = np.abs(local - [0.0, -1.0, 0.0]).max(axis=1, where=[True, False, True], initial=0.0) - 2.0
    outside = np.maximum(outside, np.abs(local[:, 1] + 1.0) - 1.0) if name == "mesh" else SOLIDS[name][1](local)
    clear = np.abs(outside) > 1e-6
    found = simulation.space.points_inside(points[clear])
    assert found.point.tolist() == np.nonzero(outside[clear] < 0.0)[0].tolist()
    assert len(found.point) > 20
    assert set(found.collider.tolist()) == {made}


def test_reach_order_and_filters() -> None:
    """Nearest first, no farther than reach; a body and its parts by filters; singles are the first of a batch."""
    simulation = Simulation()
    balls = [
        simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (x, 0.0, 0.0)})
        for x in (4.0, 2.0, 8.0)
    ]
    found = simulation.space.closest_points([(0.0, 0.0, 0.0), (9.0, 0.0, 0.0)], 3.6)
    assert found.query.tolist() == [0, 0, 1]
    assert found.entity.tolist() == [balls[1], balls[0], balls[2]]
    assert found.distance.tolist() == [1.5, 3.5, 0.5]
    one = simulation.space.closest_point((0.0, 0.0, 0.0), without=balls[1])
    assert one is not None
    assert (one.entity, one.distance, one.point.tolist()) == (balls[0], 3.5, [3.5, 0.0, 0.0])
    assert simulation.space.closest_point((0.0, 9.0, 0.0), 1.0) is None
    rod = {"capsule": {"radius": 0.1, "length": 4.0}}
    lying = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi / 2)
    overlap = simulation.space.find_overlap(rod, (3.0, 0.55, 0.0), lying)
    assert overlap is not None
    assert (overlap.entity, overlap.depth) == (balls[0], pytest.approx(0.05))
    assert simulation.space.find_overlaps(rod, (3.0, 0.55, 0.0), lying).entity.tolist() == balls[:2]
    by_rod = simulation.space.closest_to_shape(rod, (3.0, 2.0, 0.0), lying)
    assert by_rod is not None
    assert by_rod.distance == pytest.approx(1.4)
    assert simulation.space.point_inside((4.2, 0.0, 0.0)).tolist() == [balls[0]]


def test_asking_leaves_no_trace() -> None:
    """A hull that only asks is no geometry of the world, and its pairs are in no count."""
    from carom.systems.detection.answered import Answered
    from carom.systems.shapes.geometry import Geometries

    simulation = Simulation()
    simulation.add(collider={"cone": {"radius": 0.5, "length": 1.0}})
    assert simulation.space.find_overlap({"convex": {"points": np.eye(4, 3)}}, (0.0, 0.0, 0.0)) is not None
    assert simulation.world[Geometries].items == []
    assert simulation.world[Answered] == Answered()


def test_what_is_refused() -> None:
    """Shapes no body may have, and every fault of the numbers at once."""
    simulation = Simulation()
    with pytest.raises(QueryError, match=r"^find_overlaps: shape: must be one that a body may have, received a plane$"):
        simulation.space.find_overlaps({"plane": {}}, (0.0, 0.0, 0.0))
    with pytest.raises(QueryError) as fault:
        simulation.space.closest_to_shapes({"sphere": {"radius": 1.0}}, (0.0, np.inf, 0.0), np.zeros(4), -1.0)
    assert str(fault.value).splitlines() == [
        "closest_to_shapes: positions: must be finite and at most 1e+100, received [0.0, inf, 0.0] in row 0",
        "closest_to_shapes: rotations: must have a direction, received a zero vector in row 0",
        "closest_to_shapes: reach: must be 0 m or more, received -1.0 in row 0",
    ]
