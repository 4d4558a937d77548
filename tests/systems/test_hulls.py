"""Hulls: the kernels' distances, overlaps and points against coal, boxes, and themselves seen from elsewhere."""

from __future__ import annotations

import re
from itertools import combinations_with_replacement

import numpy as np
import pytest
from hulls import HULLS, PACKED, Measured, Placed, corners, extent, many_poses, measure
from pairs import degrees_between

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.polyhedron import hull_faces
from carom.systems.simulation import Simulation

AMONG_HULLS = list(combinations_with_replacement(HULLS, 2))
PAIRS = [(a, b) for a in ("sphere", "capsule", "box") for b in HULLS] + AMONG_HULLS
REACH = 0.02
ENOUGH = 3e-6  # m, what coal's own tolerance leaves
POSES = 10_000


def hold_points(found: Measured, distance: Floats) -> None:
    """Hold every point to be finite, of unit normal, no deeper than the pair and one of its kind."""
    used = int(found.count.sum())
    assert np.isfinite(found.normal[:used]).all() and np.isfinite(found.point[:used]).all()
    assert np.abs((found.normal[:used] ** 2).sum(axis=1) - 1.0).max() < 1e-12
    for k in np.nonzero(found.count)[0]:
        rows = slice(found.start[k], found.start[k] + found.count[k])
        assert len(set(found.feature[rows].tolist())) == found.count[k]
        assert (found.depth[rows] <= -distance[k] + ENOUGH).all()


@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_hulls_agree_with_coal(a: str, b: str) -> None:
    """In 10,000 poses: depth or gap to 3e-6 m, normal to 0.5 degrees or one that parts the two as soon to 3e-6 m."""
    placed, distance, normal = many_poses(a, b, POSES, seed=1)
    found = measure(a, b, placed, REACH)
    hold_points(found, distance)
    assert (found.count > 0).all()
    rows = found.deepest()
    assert np.abs(found.depth[rows] + distance).max() <= ENOUGH
    chosen = found.normal[rows]
    off = degrees_between(chosen, normal) > 0.5
    between = ((placed.position_b - placed.position_a) * chosen).sum(axis=1)
    parted = extent(a, placed.rotation_a, chosen) + extent(b, placed.rotation_b, -chosen) - between
    assert np.abs(parted[off] + distance[off]).max(initial=0.0) <= ENOUGH
    assert off.mean() < 0.02


@pytest.mark.parametrize(("a", "b"), AMONG_HULLS)
def test_swapping_sides_flips_normals(a: str, b: str) -> None:
    """Normals flip to the bit, depths and places are the same to the bit, whichever comes first."""
    placed, _, _ = many_poses(a, b, 500, seed=2)
    one, other = measure(a, b, placed, REACH), measure(b, a, placed.swapped(), REACH)
    assert (one.count == other.count).all()
    used = int(one.count.sum())
    assert (one.normal[:used] == -other.normal[:used]).all()
    assert (one.depth[:used] == other.depth[:used]).all()
    assert np.abs(one.point[:used] - other.point[:used]).max() < 1e-15


@pytest.mark.parametrize(("a", "b"), [("rounded", "rounded"), ("box", "wedge"), ("capsule", "rounded")])
def test_poses_seen_from_elsewhere(a: str, b: str) -> None:
    """Turned and moved as one, a pair has the same depths and features, and its normals turn along."""
    placed, _, _ = many_poses(a, b, 1000, seed=3)
    turn = quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))
    shift = np.array([3.0, -2.0, 5.0])
    moved = Placed(
        quaternion.rotate(turn, placed.position_a) + shift,
        quaternion.multiply(turn, placed.rotation_a),
        quaternion.rotate(turn, placed.position_b) + shift,
        quaternion.multiply(turn, placed.rotation_b),
    )
    here, there = measure(a, b, placed, REACH), measure(a, b, moved, REACH)
    rows, same = here.deepest(), there.deepest()
    assert np.abs(here.depth[rows] - there.depth[same]).max() < 2e-6
    turned = quaternion.rotate(turn, here.normal[rows])
    assert (degrees_between(turned, there.normal[same]) < 1e-4).mean() > 0.99
    assert (here.count == there.count).mean() > 0.97


@pytest.mark.parametrize("b", HULLS)
def test_a_cube_of_triangles_is_a_box(b: str) -> None:
    """A hull with a box's corners is measured as that box is."""
    placed, _, _ = many_poses("box", b, 1000, seed=4)
    box, hull = measure("box", b, placed, REACH), measure("cube", b, placed, REACH)
    rows, same = box.deepest(), hull.deepest()
    assert (box.count == hull.count).mean() > 0.99
    assert np.abs(box.depth[rows] - hull.depth[same]).max() < 2e-6
    assert (degrees_between(box.normal[rows], hull.normal[same]) < 1e-4).mean() > 0.99


@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_deep_and_degenerate_poses(a: str, b: str) -> None:
    """Concentric, deep and axis-aligned: some point, finite, unit, and deep enough to part the two."""
    generator = np.random.default_rng(5)
    quarters = np.array([quaternion.IDENTITY, *(quaternion.from_axis_angle(axis, np.pi / 2) for axis in np.eye(3))])
    n = 2000
    at = generator.normal(size=(n, 3)) * generator.choice([0.0, 1e-12, 1e-6, 0.1], size=(n, 1))
    at[generator.random(n) < 0.3, 1:] = 0.0
    placed = Placed(
        np.zeros((n, 3)), quarters[generator.integers(4, size=n)], at, quarters[generator.integers(4, size=n)]
    )
    found = measure(a, b, placed, 1.0)
    rows = found.deepest()
    assert (found.count > 0).all()
    assert np.isfinite(found.point).all()
    assert np.abs((found.normal[rows] ** 2).sum(axis=1) - 1.0).max() < 1e-12
    chosen = found.normal[rows]
    parted = extent(a, placed.rotation_a, chosen) + extent(b, placed.rotation_b, -chosen) - (at * chosen).sum(axis=1)
    assert np.abs(found.depth[rows] - parted).max() < ENOUGH


@pytest.mark.parametrize("gap", [-1e-3, -1e-9, 0.0, 1e-12, 1e-9, 1e-8, 1e-3])
@pytest.mark.parametrize("shift", [(0.0, 0.0), (0.1, 0.0), (0.2, 0.4), (-0.29, 0.1)])
def test_cubes_face_to_face(gap: float, shift: tuple[float, float]) -> None:
    """Stacked level, wholly or partly, the normal is upright and all four points are as deep, to 1e-9 m."""
    level = np.array([quaternion.IDENTITY])
    at = np.array([[*shift, 0.8 + gap]])
    found = measure("cube", "cube", Placed(np.zeros((1, 3)), level, at, level), REACH)
    assert found.count[0] == 4
    assert found.depth[:4] == pytest.approx(-gap, abs=1e-9)
    assert found.normal[:4] == pytest.approx(np.tile([0.0, 0.0, 1.0], (4, 1)), abs=1e-6)
    assert np.abs(found.point[:4, 2] - 0.4 - gap / 2.0).max() < 1e-9


@pytest.mark.parametrize("gap", [-1e-9, 0.0, 1e-12, 1e-9, 1e-8, 1e-3])
@pytest.mark.parametrize("shift", [(0.3, 0.0), (0.3, 0.5), (0.3 + 1e-9, 0.5)])
def test_cubes_edge_to_edge(gap: float, shift: tuple[float, float]) -> None:
    """Stacked level with an edge or corner in common: seen, with a unit normal and the gap exact to 3e-9 m."""
    level = np.array([quaternion.IDENTITY])
    found = measure("cube", "cube", Placed(np.zeros((1, 3)), level, np.array([[*shift, 0.8 + gap]]), level), REACH)
    count = int(found.count[0])
    assert count > 0
    assert found.depth[:count].max() == pytest.approx(-gap, abs=3e-9)
    assert (found.normal[:count] ** 2).sum(axis=1) == pytest.approx(1.0, abs=1e-12)


def test_features_stay_while_a_pair_moves_little() -> None:
    """A cube trembling by a nanometre on another keeps its features, edge on edge or turned."""
    generator = np.random.default_rng(6)
    for angle, count in ((0.0, 4), (0.4, 8)):
        n = 200
        turn = quaternion.from_axis_angle((0.0, 0.0, 1.0), angle)
        shaken = quaternion.normalise(turn + 1e-9 * generator.normal(size=(n, 4)))
        at = np.array([0.0, 0.0, 0.8]) + 1e-9 * generator.normal(size=(n, 3))
        level = np.tile(np.array(quaternion.IDENTITY), (n, 1))
        found = measure("cube", "cube", Placed(np.zeros((n, 3)), level, at, shaken), REACH)
        assert (found.count == count).all()
        assert len(np.unique(np.sort(found.feature[: n * count].reshape(n, count), axis=1), axis=0)) == 1


def test_a_capsule_lying_on_a_face_has_two_points() -> None:
    """Its straight part is cut at the face's edges; both points are as deep."""
    turn = np.array([quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi / 2)])
    at = np.array([[0.0, 0.0, 0.59]])
    found = measure("capsule", "cube", Placed(at, turn, np.zeros((1, 3)), np.array([quaternion.IDENTITY])))
    assert found.count[0] == 2
    assert found.feature[:2].tolist() == [1, 2]
    assert found.depth[:2] == pytest.approx(0.01, abs=1e-12)
    assert np.sort(found.point[:2, 0]) == pytest.approx([-0.15, 0.15], abs=2e-5)
    assert found.normal[:2] == pytest.approx(np.tile([0.0, 0.0, -1.0], (2, 1)), abs=1e-12)


@pytest.mark.parametrize("hull", HULLS)
def test_hulls_on_planes(hull: str) -> None:
    """Every point is a vertex under the plane, named by its number; the deepest is among them."""
    placed, distance, normal = many_poses(hull, "plane", 500, seed=7)
    placed = placed._replace(position_a=placed.position_a - placed.position_b, position_b=0.0 * placed.position_b)
    found = measure(hull, "plane", placed, REACH)
    hold_points(found, distance)
    near = distance <= REACH
    assert ((found.count > 0) == near).all()
    rows = found.deepest()[near]
    assert np.abs(found.depth[rows] + distance[near]).max() <= 2e-6
    assert degrees_between(found.normal[rows], normal[near]).max() < 1e-4
    vertices = PACKED.vertices[PACKED.vertex_start[PACKED.polyhedron[list(HULLS).index(hull)]] :]
    for k in np.nonzero(found.count)[0]:
        for row in range(found.start[k], found.start[k] + found.count[k]):
            place = placed.position_a[k] + quaternion.rotate(placed.rotation_a[k], vertices[found.feature[row]])
            assert found.point[row] == pytest.approx(place - 0.5 * found.depth[row] * found.normal[row], abs=1e-12)


@pytest.mark.parametrize("noise", [0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5])
def test_faces_of_noisy_hulls(noise: float) -> None:
    """A grid of points that rounding moved off its planes still closes a volume, with nothing in front of a face."""
    generator = np.random.default_rng(8)
    for _ in range(30):
        points = generator.integers(-2, 3, size=(40, 3)) + noise * generator.normal(size=(40, 3))
        turned = quaternion.rotate(quaternion.normalise(generator.normal(size=4)), points)
        faces = hull_faces(hull_of(turned))
        assert faces.closes()
        vertices = np.array(faces.vertices)
        for loop, normal in zip(faces.loops, faces.normals, strict=True):
            heights = (vertices * np.array(normal)).sum(axis=1)
            assert heights.max() - heights[list(loop)].min() < 1e-4


def test_a_hull_with_a_point_beyond_all_others_is_refused() -> None:
    """Of the bow of a ship that lies 2 million km off nothing is left but faces of one corner each; it can be seen."""
    bow, sides = (7.0, 2.0**31, 0.0), [(x, y, z) for x in (-4.0, 4.0) for y in (0.0, 1.6) for z in (-1.5, 1.5)]
    points = np.array([*sides, bow, (7.0, 1.6, 0.0)])
    told = (
        "points: rounding leaves the faces of the hull in doubt, of 10 corners over 2.15e+09 m, "
        "the nearest 1.6 m apart; leave out those that nearly coincide, or that lie far off"
    )
    for make in (lambda: hull_faces(hull_of(points)), lambda: Convex.stated(points=points)):
        with pytest.raises(DeclarationError, match=f"^{re.escape(told)}$"):
            make()
    assert len(Convex.seen(points=points).geometry.vertices) == 10


def test_coplanar_triangles_are_one_face() -> None:
    """A cube has 6 faces, 12 edges and 8 vertices, also where more points lie on its faces and edges."""
    points = np.concatenate([corners(1.0, 1.0, 1.0), 0.5 * corners(2.0, 1.0, 1.0), [(0.0, 1.0, 1.0)]])
    cube = hull_faces(hull_of(points))
    assert (len(cube.loops), {len(loop) for loop in cube.loops}) == (6, {4})
    assert (len(cube.edges), len(cube.vertices)) == (12, 8)


@pytest.mark.parametrize("sides", [3, 4, 6, 20])
def test_a_tower_of_prisms_stands(sides: int) -> None:
    """Five prisms, each turned against the one below, stay for ten seconds and come to rest.

    On the springs of their contacts they sink by 1.4 to 1.7 mm, and lean while they settle by as much on half a metre.
    """
    turn = np.arange(sides) * 2.0 * np.pi / sides
    ring = [(0.5 * np.cos(t), y, 0.5 * np.sin(t)) for t in turn for y in (-0.5, 0.5)]
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"plane": {}})
    prism = {"shape": Convex(hull_of(np.array(ring)))}
    tower = []
    for k in range(5):
        rotation = quaternion.from_axis_angle((0.0, 1.0, 0.0), 0.3 * k)
        tower.append(
            simulation.add(collider=prism, body={}, transform={"position": (0.0, 0.5 + k, 0.0), "rotation": rotation})
        )
    simulation.step(600)
    for k, body in enumerate(tower):
        assert simulation[body].transform.position == pytest.approx([0.0, 0.5 + k, 0.0], abs=3e-3)
        assert np.abs(simulation[body].motion.linear).max() < 1e-9


def test_a_capsule_along_an_edge_has_two_points() -> None:
    """Both ends of what is beside the edge, as on a box of the same size; where it turns away from the edge, one."""
    generator = np.random.default_rng(7)
    poses, half = 600, np.array([0.15, 0.25, 0.4])
    along = generator.integers(3, size=poses)
    side = np.where(generator.random((poses, 3)) < 0.5, -1.0, 1.0) * (along[:, None] != np.arange(3))
    way = side * generator.uniform(0.3, 1.0, (poses, 3))
    way /= np.sqrt((way**2).sum(axis=1))[:, None]
    tilt = np.where(np.arange(poses) % 3 == 0, 1e-2, 1e-6)[:, None] * generator.normal(size=(poses, 3))
    edge, quarters = np.eye(3)[along], np.array([(0.0, 0.0, -1.0, 1.0), (0.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0)])
    turn = quaternion.normalise(np.concatenate([tilt, np.ones((poses, 1))], axis=1))
    turn = quaternion.multiply(turn, quaternion.normalise(quarters)[along])
    turned = quaternion.rotate(turn, np.array([[0.0, 1.0, 0.0]]))
    lower = 0.35 * np.abs((turned * way).sum(axis=1))
    at = side * half + edge * generator.uniform(-0.2, 0.2, (poses, 1)) + way * (0.19 + lower)[:, None]
    still = np.tile(quaternion.IDENTITY, (poses, 1))
    placed = Placed(at, turn, np.zeros((poses, 3)), still)
    hull, box = measure("capsule", "cube", placed, REACH), measure("capsule", "box", placed, REACH)
    nearly = np.arange(poses) % 3 > 0
    assert (box.count[nearly] == 2).all() and (hull.count[nearly] == 2).all()
    assert (hull.count <= box.count).all() and (hull.count < box.count).any()
    assert hull.depth[hull.deepest()] == pytest.approx(box.depth[box.deepest()], abs=2e-6)
    for k in np.nonzero(nearly)[0]:
        rows = [slice(found.start[k], found.start[k] + found.count[k]) for found in (hull, box)]
        ends = [
            found.point[row][np.argsort(found.point[row] @ edge[k])]
            for found, row in zip((hull, box), rows, strict=True)
        ]
        assert ends[0] == pytest.approx(ends[1], abs=1e-4)
