"""Cylinders, cones and ellipsoids on meshes: round to the last digit, whichever way they are asked for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from meshes import LEVEL, LYING, ROUNDS, block, laid, sheet

from carom.ecs import ColliderPose
from carom.ecs.spatial import quaternion
from carom.systems.detection.narrow import measure_pairs
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation


def test_a_cylinder_rolls_as_on_a_plane() -> None:
    """At 1 m/s over 200 triangles for 2 s: never 10 um up or down, and no slower by 1e-9 m/s."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"shape": Mesh(sheet(10, 6.0, 0.0, 0.3))})
    body = simulation.add(
        collider={"shape": Cylinder(0.3, 0.8)},
        body={},
        transform={"position": (-1.05, 0.3, 0.13), "rotation": LYING},
        motion={"linear": (1.0, 0.0, 0.0), "angular": (0.0, 0.0, -1.0 / 0.3)},
    )
    for _ in range(120):
        simulation.step()
        assert simulation[body].transform.position[1] == pytest.approx(0.3, abs=1e-5)
    assert simulation[body].motion.linear[0] == pytest.approx(1.0, abs=1e-9)
    assert simulation[body].motion.angular[2] == pytest.approx(-1.0 / 0.3, abs=1e-8)
    assert simulation[body].transform.position[0] == pytest.approx(0.95, abs=1e-9)


@pytest.mark.parametrize("gap", [-0.01, 0.004])
def test_a_cylinder_along_an_edge_has_both_ends(gap: float) -> None:
    """Half over the edge of a block, at 45 degrees: two points, a length apart."""
    out = (0.3 + gap) / np.sqrt(2.0)
    (found,) = laid(block(), Cylinder(0.3, 0.8), 1, turn=LEVEL).measure(
        np.array([[2.0 + out, out, 0.3]]), LYING[None], 0.01
    )
    assert found.depth == pytest.approx([-gap, -gap], abs=1e-12)
    assert np.abs(found.normal) == pytest.approx(np.tile(np.sqrt([0.5, 0.5, 0.0]), (2, 1)), abs=1e-9)
    assert np.sort(found.point[:, 2]) == pytest.approx([-0.1, 0.7], abs=1e-9)


def test_a_cylinder_across_an_edge_has_one_point() -> None:
    """Leaning over the edge of a block by 45 degrees, its side touches at one point."""
    turn = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi / 4)
    out = 0.29 / np.sqrt(2.0)
    (found,) = laid(block(), Cylinder(0.3, 0.8), 1, turn=LEVEL).measure(
        np.array([[2.0 + out, out, 0.3]]), turn[None], 0.01
    )
    assert found.depth == pytest.approx([0.01], abs=1e-12)
    assert found.point == pytest.approx(np.array([[2.0, 0.0, 0.3]]) - 0.005 * np.sqrt([0.5, 0.5, 0.0]), abs=1e-9)


@pytest.mark.parametrize("key", ROUNDS)
def test_either_order_and_setting_gives_the_same(key: str) -> None:
    """Points and depths are the same with the mesh second, and where no kernel may stand in elsewhere; normals flip."""
    shape = ROUNDS[key][0]
    generator = np.random.default_rng(3)
    places = generator.uniform([-2.0, 0.2, -2.0], [2.0, 1.0, 2.0], (60, 3))
    turns = quaternion.normalise(generator.normal(size=(60, 4)))
    land = sheet(13, 8.0, 0.5, 0.3)
    first, last = laid(land, shape, 60), laid(land, shape, 60, mesh_first=False)
    touched = 0
    for one, other in zip(first.measure(places, turns, 0.02), last.measure(places, turns, 0.02), strict=True):
        touched += len(one.depth) > 0
        assert (one.depth == other.depth).all()
        assert (one.point == other.point).all()
        assert (one.normal == -other.normal).all()
    assert touched > 20
    assert_same_by_fcl(first.simulation)


def assert_same_by_fcl(simulation: Simulation) -> None:
    """Assert that of a mesh, at row 0, and 60 bodies both settings say the same."""
    pairs = np.stack([np.zeros(60, np.int64), 1 + np.arange(60)], axis=1)
    ways: list[Any] = [measure_pairs(simulation.world, pairs, np.full(60, 0.02), way) for way in ("auto", "fcl")]
    assert len(simulation.world[ColliderPose].position) > 60
    for column, other in zip(*ways, strict=True):
        assert (column == other).all()
