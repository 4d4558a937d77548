"""Meshes: nothing is missed, distances and normals are exact, and no edge within an area is felt."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import LEVEL, ROUNDS, SOLIDS, block, laid, nearest, sheet

from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.systems.detection.mesh_links import linked
from carom.systems.detection.meshes import joined, tree_of
from carom.systems.shapes.box import Box
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation


def test_the_tree_holds_every_triangle_once_within_its_bounds() -> None:
    """Every node encloses what is below it, and its leaves hold each triangle of the geometry once."""
    land = sheet(13, 8.0, 1.0, 0.3)
    tree = joined({2: tree_of(block()), 5: tree_of(land)})
    assert tree.root.tolist() == [-1, -1, 0, -1, -1, len(tree_of(block()).bounds) // 6]
    nodes, bounds = tree.nodes.reshape(-1, 3), tree.bounds.reshape(-1, 2, 3)
    corners = tree.triangles.reshape(-1, 15)[:, :9].reshape(-1, 3, 3)
    seen = np.zeros(len(corners), np.int64)
    for root, geometry in ((0, block()), (tree.root[5], land)):
        faces = []
        for node in range(root, nodes[root, 0]):
            below = nodes[node : nodes[node, 0]]
            held = np.concatenate([np.arange(first, first + count) for _, first, count in below])
            assert (corners[held] >= bounds[node, 0]).all()
            assert (corners[held] <= bounds[node, 1]).all()
            held = np.arange(nodes[node, 1], nodes[node, 1] + nodes[node, 2])
            seen[held] += 1
            faces += tree.links.reshape(-1, 8)[held, 7].tolist()
            assert (
                np.sort(corners[held], 1)
                == np.sort(geometry.vertices[geometry.faces][faces[len(faces) - len(held) :]], 1)
            ).all()
        assert sorted(faces) == list(range(len(geometry.faces)))
    assert (seen == 1).all()


def test_edges_know_what_they_are() -> None:
    """Of a block all twelve edges are active and no diagonal; on flat land only the rim; slivers are left out."""
    bits = linked(block()).active
    assert sum(int(b).bit_count() for b in bits) == 24
    surface = linked(sheet(5, 4.0, 0.0))
    assert sum(int(b).bit_count() for b in surface.active) == 20
    assert ((surface.across < 0).sum(axis=1) == [int(b).bit_count() for b in surface.active]).all()
    flat = sheet(2, 2.0, 0.0)
    faces = np.concatenate([flat.faces, [[0, 1, 1], [0, 1, 2]]])
    assert linked(Geometry(flat.vertices, faces)).source.tolist() == list(range(len(flat.faces)))


def test_a_valley_is_not_active_and_a_ridge_is() -> None:
    """Two triangles folded up share an inactive edge, folded down an active one."""
    for height, active in ((0.5, 0), (-0.5, 1), (0.0, 0)):
        vertices = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, height, 0.0], [-1.0, height, 0.0]])
        surface = linked(Geometry(vertices, np.array([[0, 1, 2], [1, 0, 3]])))
        inner = surface.across >= 0
        assert inner.sum() == 2
        assert [(bits >> int(np.nonzero(row)[0][0])) & 1 for bits, row in zip(surface.active, inner, strict=True)] == [
            active
        ] * 2


@pytest.mark.parametrize("radius", [0.0, 0.3])
def test_balls_over_land_against_brute_force(radius: float) -> None:
    """In 10,000 places before and behind the land: distance and normal of the nearest point to 1e-9."""
    land = sheet(13, 8.0, 1.0, 0.3)
    generator = np.random.default_rng(4)
    places = generator.uniform([-3.0, -0.3, -3.0], [3.0, 1.6, 3.0], (10_000, 3))
    reach = 0.2
    distance, at, facing = nearest(land, places)
    world = laid(land, Sphere(radius) if radius else Sphere(1e-12), 1000)
    there, turn = np.array([3.0, -2.0, 1.0]), quaternion.normalise(np.array([0.1, 0.7, -0.3, 0.6]))
    seen = behind = 0
    for k in range(0, len(places), 1000):
        for place, d, p, n, found in zip(
            *(c[k : k + 1000] for c in (places, distance, at, facing)),
            world.measure(places[k : k + 1000], np.tile(LEVEL, (1000, 1)), reach),
            strict=True,
        ):
            side = 1.0 if (place - p) @ n >= 0.0 else -1.0
            if abs((place - p) @ n) < 0.3 * d:
                continue  # beside a sharp edge the nearest triangle alone does not tell the side
            if d > radius + reach:
                assert len(found.depth) == 0
                continue
            seen += 1
            behind += side < 0.0
            deepest = int(found.depth.argmax())
            assert found.depth[deepest] == pytest.approx(radius - side * d, abs=1e-9)
            normal = quaternion.rotate(turn, (place - p) / d * side)
            assert found.normal[deepest] == pytest.approx(normal, abs=1e-9 / d)
            middle = p + (d * side - radius) / 2.0 * (place - p) / d * side
            assert found.point[deepest] == pytest.approx(there + quaternion.rotate(turn, middle), abs=1e-9)
    assert seen > 1000
    assert behind > 300


def test_a_box_is_the_hull_of_its_corners() -> None:
    """Its closed form finds on land what the kernel of hulls does, above, touching, and deep in."""
    land, shape = sheet(13, 8.0, 1.0, 0.3), Box((0.6, 0.4, 1.0))
    corners = np.array([(x, y, z) for x in (-0.3, 0.3) for y in (-0.2, 0.2) for z in (-0.5, 0.5)])
    generator = np.random.default_rng(7)
    places = generator.uniform([-3.0, -0.2, -3.0], [3.0, 1.8, 3.0], (2000, 3))
    turns = quaternion.normalise(generator.normal(size=(2000, 4)))
    boxes, hulls = (laid(land, one, 2000).measure(places, turns, 0.05) for one in (shape, Convex(hull_of(corners))))
    for box, hull in zip(boxes, hulls, strict=True):
        assert len(box.depth) == len(hull.depth)
        one, other = (np.lexsort(np.round(found.point, 6).T) for found in (box, hull))
        for column in ("depth", "normal", "point"):
            assert getattr(box, column)[one] == pytest.approx(getattr(hull, column)[other], abs=1e-7)
    assert sum(len(found.depth) > 0 for found in boxes) > 1000


@pytest.mark.parametrize("key", SOLIDS)
@pytest.mark.parametrize("flat", ["box", "sheet"])
def test_a_mesh_floor_gives_the_contacts_of_a_box(key: str, flat: str) -> None:
    """Lying, tilted or sunk in over the middle of a face: depths, normals and points are those of the closed form."""
    shape, turn, height = SOLIDS[key]
    floor = block() if flat == "box" else sheet(9, 4.0, 0.0, 0.3)
    spun = [quaternion.multiply(quaternion.from_axis_angle((0.0, 1.0, 0.0), angle), turn) for angle in (0.0, 0.3, 1.2)]
    turns = np.array(spun * 3)
    places = np.array([[0.1, height + gap, -0.2] for gap in (-0.01, 0.0, 0.004) for _ in range(3)])
    for place, one, found in zip(
        places, turns, laid(floor, shape, 9, turn=LEVEL).measure(places, turns, 0.005), strict=True
    ):
        corners, radius = shape.corners(tuple(quaternion.rotate(quaternion.conjugate(one), np.array([0.0, -1.0, 0.0]))))
        placed = place + quaternion.rotate(one, corners)
        gaps = placed[:, 1] - radius
        low = gaps < 0.005
        expected = placed[low] - np.outer((radius + gaps / 2.0)[low], [0.0, 1.0, 0.0])
        assert len(found.depth) == low.sum()
        order, wanted = (np.lexsort(np.round(points, 7).T) for points in (found.point, expected))
        assert found.point[order] == pytest.approx(expected[wanted], abs=1e-12)
        assert found.depth[order] == pytest.approx(-gaps[low][wanted], abs=1e-12)
        assert (found.normal == [0.0, 1.0, 0.0]).all()
        assert len(set(found.feature.tolist())) == len(found.feature)


def test_a_body_keeps_its_features_while_it_slides() -> None:
    """Over a hundred triangles a box's four corners keep their names, and stay four."""
    steps = 200
    places = np.stack([np.linspace(-1.2, 1.2, steps), np.full(steps, 0.499), np.linspace(0.3, -0.4, steps)], axis=1)
    turns = np.tile(quaternion.from_axis_angle((0.0, 1.0, 0.0), 0.4), (steps, 1))
    names = [
        tuple(found.feature.tolist())
        for found in laid(sheet(20, 4.0, 0.0, 0.3), Box((1.0, 1.0, 1.0)), steps).measure(places, turns, 0.005)
    ]
    assert len(names[0]) == 4
    assert set(names) == {names[0]}


@pytest.mark.parametrize("key", SOLIDS)
def test_swapping_sides_flips_normals_and_nothing_else(key: str) -> None:
    """To the bit, whichever of the two has the lower row."""
    land, shape = sheet(13, 8.0, 1.0, 0.3), SOLIDS[key][0]
    generator = np.random.default_rng(6)
    places = generator.uniform([-3.0, 0.0, -3.0], [3.0, 1.5, 3.0], (200, 3))
    turns = quaternion.normalise(generator.normal(size=(200, 4)))
    one, other = (laid(land, shape, 200, mesh_first=first).measure(places, turns, 0.1) for first in (True, False))
    assert sum(len(found.depth) for found in one) > 100
    for a, b in zip(one, other, strict=True):
        assert (a.normal == -b.normal).all()
        for column in ("feature", "depth", "point"):
            assert (getattr(a, column) == getattr(b, column)).all()


def test_a_body_beside_a_thin_wall_is_not_pulled_through() -> None:
    """Against a wall of 5 cm a box of 1 m sunk in by 2 cm is pushed back the way it came."""
    import trimesh

    mesh = trimesh.creation.box(extents=(0.05, 4.0, 4.0))
    wall = Geometry(np.array(mesh.vertices), np.array(mesh.faces, np.int64), "wall")
    for shape in (Box((1.0, 1.0, 1.0)), Sphere(0.5)):
        (found,) = laid(wall, shape, 1, turn=LEVEL).measure(np.array([[0.505, 0.3, 0.1]]), LEVEL[None], 0.01)
        assert found.normal == pytest.approx(np.tile([1.0, 0.0, 0.0], (len(found.depth), 1)))
        assert found.depth == pytest.approx(0.02, abs=1e-12)


@pytest.mark.parametrize("key", SOLIDS | ROUNDS)
def test_a_body_driven_in_beyond_its_middle_comes_out_in_front(key: str) -> None:
    """20 cm under land, with its middle behind the surface: depth and normal lead up and out."""
    shape, turn, height = (SOLIDS | ROUNDS)[key]
    (found,) = laid(sheet(9, 4.0, 0.0, 0.3), shape, 1, turn=LEVEL).measure(
        np.array([[0.1, -0.2, 0.2]]), turn[None], 0.01
    )
    assert found.normal == pytest.approx(np.tile([0.0, 1.0, 0.0], (len(found.depth), 1)), abs=1e-12)
    assert found.depth.max() == pytest.approx(height + 0.2, abs=1e-12)


@pytest.mark.parametrize("key", SOLIDS | ROUNDS)
@pytest.mark.parametrize("drop", [0.0, 0.3])
def test_bodies_rest_on_200_triangles_as_on_a_plane(key: str, drop: float) -> None:
    """After 5 s: the same place within 1e-6 m, at rest."""
    shape, turn, height = (SOLIDS | ROUNDS)[key]
    ends = []
    for ground in ({"shape": Mesh(sheet(10, 6.0, 0.0, 0.3))}, {"plane": {}}):
        simulation = Simulation(dt=1 / 60)
        simulation.add(collider=ground)
        place = {"position": (-1.05, height + drop, 0.13), "rotation": turn}
        body = simulation.add(collider={"shape": shape}, body={}, transform=place)
        simulation.step(300)
        ends.append(simulation[body].transform.position.copy())
        assert np.abs(simulation[body].motion.linear).max() < 1e-9
        assert np.abs(simulation[body].motion.angular).max() < 1e-9
    assert ends[0] == pytest.approx(ends[1], abs=1e-6)


@pytest.mark.parametrize("key", ["sphere", "box"])
def test_no_ghosts_on_3200_flat_triangles(key: str) -> None:
    """Sliding without friction at 5 m/s for 4 s: at most 2 mm/s slower, 1 mm higher, and not turned."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"shape": Mesh(sheet(40, 30.0, 0.0, 0.3))}, material={"friction": 0.0})
    body = simulation.add(
        collider={"shape": SOLIDS[key][0]},
        body={},
        material={"friction": 0.0},
        transform={"position": (-9.987, 0.5, 0.07)},
        motion={"linear": (5.0, 0.0, 0.31)},
    )
    for _ in range(240):
        simulation.step()
        assert simulation[body].transform.position[1] == pytest.approx(0.5, abs=1e-3)
    assert simulation[body].motion.linear == pytest.approx([5.0, 0.0, 0.31], abs=2e-3)
    assert np.abs(simulation[body].motion.angular).max() < 1e-6


def test_meshes_may_come_later() -> None:
    """A mesh added while the world runs is seen from the next step on, beside the first."""
    simulation = Simulation(dt=1 / 60)
    for k in range(2):
        simulation.add(collider={"shape": Mesh(sheet(4 + k, 2.0, 0.0))}, transform={"position": (3.0 * k, 0.0, 0.0)})
        simulation.add(collider={"sphere": {"radius": 0.3}}, body={}, transform={"position": (3.0 * k, 0.3, 0.1)})
        simulation.step()
        assert simulation.world.count(Contact) == 1 + k
        assert not simulation.world[Contact].by_fcl[: 1 + k].any()
