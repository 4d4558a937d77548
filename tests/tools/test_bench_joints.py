"""The bench of joints gives every engine the same scenes and measures gaps and energy by closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import RigidBody
from carom.ecs.components.joint import Joint
from carom.ecs.spatial import quaternion
from carom.tools.bench import joint_scenes, joints, race
from carom.tools.bench.contact_scenes import Joints, Scene, at_rest
from carom.tools.bench.engines import Carom
from carom.tools.bench.joint_gaps import gaps
from carom.tools.bench.joints import ROWS, Row, compare, fall, gained, weights


def test_chains_hang_from_their_tops_45_degrees_off_vertical() -> None:
    """64 chains of 32 capsules of 0.4 m, each held at both ends but the last; joints begin closed."""
    scene = ROWS["chains"].scene()
    assert scene.joints is not None
    assert scene.count == len(scene.joints.a) == 2048
    assert np.array_equal(scene.joints.a[:34], [-1, *range(31), -1, 32])
    tops = scene.joints.at[::32]
    assert tops == pytest.approx(np.stack([np.arange(64.0), np.zeros(64), np.full(64, 20.0)], axis=1))
    away = scene.joints.at[31] - scene.joints.at[0]
    assert away == pytest.approx(31 * 0.4 * math.sqrt(0.5) * np.array([0.0, 1.0, -1.0]))
    assert gaps(scene, scene.joints, scene.position, scene.rotation).max() < 1e-14


def test_a_net_has_19800_joints_beside_those_that_hold_it() -> None:
    """Neighbours are joined halfway, every fourth ball of one edge is held where it is."""
    scene = ROWS["net"].scene()
    assert scene.joints is not None
    between = scene.joints.a >= 0
    assert (scene.count, between.sum(), (~between).sum()) == (10_000, 19_800, 25)
    apart = scene.position[scene.joints.b[between]] - scene.position[scene.joints.a[between]]
    assert np.linalg.norm(apart, axis=1) == pytest.approx(1.0)
    assert np.array_equal(scene.joints.at[~between], scene.position[scene.joints.b[~between]])


def test_gaps_are_how_far_anchors_are_apart() -> None:
    """A body 3 mm aside, and one turned by a right angle about its centre, 0.5 m from its joint."""
    scene = at_rest(1, np.array([[0.0, 0.0, -0.5], [0.0, 0.0, -1.5]]), 0.1, ball=True)
    held = Joints(np.array([-1, 0]), np.array([0, 1]), np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0]]))
    position, rotation = scene.position.copy(), scene.rotation.copy()
    position[0, 0] = 0.003
    assert gaps(scene, held, position, rotation) == pytest.approx([0.003, 0.003])
    rotation[1] = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi)
    assert gaps(scene, held, scene.position, rotation) == pytest.approx([0.0, 0.5 * math.sqrt(2.0)])


def test_carom_is_given_the_chains() -> None:
    """As many joints, of bodies that weigh 1000 kg/m3 and touch nobody; where they begin no energy has come or gone."""
    scene = joint_scenes.chains(2)
    assert scene.joints is not None
    engine = Carom(scene, 1)
    assert engine.simulation.world.count(Joint) == len(scene.joints.a)
    assert np.array_equal(engine.poses()[0], scene.position)
    mass, inertia = weights(engine)
    assert mass == pytest.approx(1000.0 * math.pi * 0.05**2 * (0.3 + 4.0 / 3.0 * 0.05))
    assert np.array_equal(inertia, engine.simulation.world[RigidBody].inertia[engine.rows])
    assert gained(scene, *engine.poses(), *engine.velocities(), mass, inertia) == 0.0
    assert fall(scene, scene.joints, mass) == pytest.approx(64 * 9.81 * mass[0] * 16 * 0.4 * math.sqrt(0.5))
    engine.step()
    apart = gaps(scene, scene.joints, *engine.poses())
    assert 0.0 < apart.max() < 1e-3
    falls, _ = engine.velocities()
    assert falls[:, 2].max() < 0.0


def test_energy_is_that_of_moving_turning_and_of_height() -> None:
    """2 kg at 3 m/s, turning at 4 rad/s about an axis of 0.5 kg m2 that lies across, and 1 m up."""
    scene = at_rest(1, np.zeros((1, 3)), 0.1)
    turned = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi)[None]  # local y along z
    motion = np.array([[3.0, 0.0, 0.0]]), np.array([[0.0, 0.0, 4.0]])
    more = gained(scene, np.array([[0.0, 0.0, 1.0]]), turned, *motion, np.array([2.0]), np.array([[9.0, 0.5, 9.0]]))
    assert more == pytest.approx(9.0 + 4.0 + 2.0 * 9.81)


def test_a_scene_is_told_with_its_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Times of both, their ratio with its bound, and the same quality of both; a peer's is not bounded."""
    monkeypatch.setattr(race, "ENGINES", {"carom": Carom, "json": Carom})  # a module that is always there
    monkeypatch.setattr(joints, "PEERS", ("json",))

    def scene() -> Scene:
        made = joint_scenes.chains(1)
        made.steps = 6
        return made

    monkeypatch.setitem(ROWS, "one", Row(scene, 5.0, worst=0.008, mean=0.003, drift=0.02))
    figures = list(compare("one"))
    assert [(figure.name, figure.unit, figure.bound) for figure in figures] == [
        ("one, carom", "ms a step", math.inf),
        ("one, json", "ms a step", math.inf),
        ("one, carom by json", "x", 5.0),
        ("one, carom, mean from the start", "ms a step", math.inf),
        ("one, json, mean from the start", "ms a step", math.inf),
        ("one, carom, worst gap", "mm", 8.0),
        ("one, carom, mean gap", "mm", 3.0),
        ("one, carom, energy gained or lost", "%", 2.0),
        ("one, json, worst gap", "mm", math.inf),
        ("one, json, mean gap", "mm", math.inf),
        ("one, json, energy gained or lost", "%", math.inf),
    ]
    assert 0.0 < figures[5].wall == figures[8].wall
    assert all(figure.holds for figure in figures[5:])
