"""Detection: no pair is missed, kernels agree with FCL, and what they stand on is what was asked for."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from meetings import touching
from pairs import SHAPES, Pair, Poses, turns

from carom.ecs import Collider, ColliderPose, RigidBody, World
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.constants import CONTACT_PERIODS, IMPACTS_AT_LEAST, IMPACTS_PER_PAIR
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import overlapping
from carom.systems.detection.narrow import measure_pairs
from carom.systems.shapes.shape import BY_NUMBER
from carom.systems.simulation import Simulation

BALLS = ("sphere", "point")
CLOSED = [(a, b) for a in BALLS for b in ("sphere", "point", "box", "plane")]
CLOSED += [(b, a) for a, b in CLOSED if b not in BALLS]


@pytest.mark.parametrize("count", [800, pytest.param(2000, marks=pytest.mark.slow)])
@pytest.mark.parametrize(("a", "b"), CLOSED)
def test_kernels_agree_with_fcl(a: str, b: str, count: int) -> None:
    """In random poses, near and deep: the same normal and depth to 1e-9, 2e-9 m with FCL's points.

    FCL's points have a radius of 1 nm, which also tilts what is nearer than that; no pose here is.
    """
    pair = Pair(SHAPES[a], SHAPES[b])
    generator = np.random.default_rng(11)
    pairs, reaches = np.array([[0, 1]]), np.array([0.3])
    within = 2.5e-9 if "point" in (a, b) else 1e-9
    seen = 0
    for _ in range(count):
        shift = generator.uniform(-1.2, 1.2, 3)
        poses = Poses(generator.normal(size=3), turns(generator), np.zeros(3), turns(generator))
        poses = poses._replace(position_b=poses.position_a + shift)
        points = pair.measure(poses, 0.3)
        found = measure_pairs(pair.world, pairs, reaches)
        assert not found.by_fcl.any()
        assert len(found.depth) == len(points)
        for place, normal, depth in points:
            seen += 1
            assert found.depth[0] == pytest.approx(depth, abs=within)
            if not ambiguous(a, b, poses):
                assert found.normal[0] == pytest.approx(normal, abs=2e-8 if "point" in (a, b) else 1e-9)
                assert found.point[0] == pytest.approx(place, abs=1e-8)
    assert seen > count / 200


def test_pairs_of_all_shapes_are_measured_at_once_as_they_are_one_by_one() -> None:
    """Whichever function measures each of them, and whichever way round; none of their points is refused."""
    simulation, generator = Simulation(), np.random.default_rng(3)
    for shape in [*SHAPES.values(), *reversed(SHAPES.values())] * 2:
        place = {"position": generator.uniform(-0.6, 0.6, 3), "rotation": turns(generator)}
        simulation.add(collider={"shape": shape}, transform=place, visual=False)
    world = simulation.world
    pairs = np.array([[i, o] for i, o in combinations(range(world.used()), 2) if can_be_measured(world, i, o)])
    with world.faces(None):
        reach_within(world, 1 / 60)
        at_once = measure_pairs(world, pairs, np.full(len(pairs), 0.05))
        one_by_one = [measure_pairs(world, pairs[p : p + 1], np.array([0.05])) for p in range(len(pairs))]
    for k, column in enumerate(at_once):
        assert np.array_equal(column, np.concatenate([found[k] for found in one_by_one]))
    assert at_once.by_fcl.any()
    assert not at_once.by_fcl.all()
    assert len({*zip(at_once.row_a.tolist(), at_once.row_b.tolist(), strict=True)}) < len(pairs)  # some are apart
    assert world[Answered].refused == 0


def can_be_measured(world: World, i: int, o: int) -> bool:
    """Tell whether two shapes are not both static."""
    return not all(BY_NUMBER[int(world[Collider].shape[row])].static for row in (i, o))


def ambiguous(a: str, b: str, poses: Poses) -> bool:
    """Tell whether a ball's centre is so deep in a box that two faces are equally near."""
    if "box" not in (a, b):
        return False
    box: Any = SHAPES["box"]
    ball, place, turn = (0, 2, 3) if b == "box" else (2, 0, 1)
    local = quaternion.rotate(quaternion.conjugate(poses[turn]), poses[ball] - poses[place])
    out = np.sort(np.array(box.size) / 2.0 - np.abs(local))
    return bool(out[0] > 0.0 and out[1] - out[0] < 1e-6)


@st.composite
def crowds(draw: st.DrawFn) -> Simulation:
    """Draw a crowd of shapes, moving, kinematic and static, on several layers."""
    simulation = Simulation(dt=1 / 60)
    simulation.layers({"left": ["left", "default"], "right": ["right", "left"], "ghost": []})
    generator = np.random.default_rng(draw(st.integers(0, 2**32)))
    for _ in range(draw(st.integers(2, 25))):
        key = draw(st.sampled_from(["sphere", "box", "capsule", "plane", "point"]))
        shape = SHAPES[key]
        moves = not shape.static and draw(st.booleans())
        kind = draw(st.sampled_from(["dynamic", "kinematic"]))
        layer = draw(st.sampled_from(["default", "left", "right", "ghost", "none"]))
        simulation.add(
            collider={"shape": shape, "layer": layer, "sensor": draw(st.integers(0, 9)) == 0},
            body={"mass": 1.0, "type": kind} if moves else None,
            motion={"linear": generator.normal(size=3) * 20.0, "angular": generator.normal(size=3)} if moves else None,
            transform={"position": generator.uniform(-2.0, 2.0, 3), "rotation": turns(generator)},
            visual=False,
        )
    return simulation


@given(crowds())
@settings(max_examples=60)
def test_the_broad_phase_finds_the_pairs_of_brute_force(simulation: Simulation) -> None:
    """Every pair that something can push, or that a sensor notices, with bounds that overlap and layers that accept.

    Each is there once, lower row first.
    """
    world = simulation.world
    with world.faces(None):
        reach_within(world, 1 / 60)
        found = [tuple(pair) for pair in overlapping(world).tolist()]
    assert found == sorted(pair for pair in combinations(range(world.used()), 2) if meets(world, *pair))


def meets(world: World, i: int, j: int) -> bool:
    """Say what must be a pair, in so many words."""
    collider, pose = world[Collider], world[ColliderPose]
    if pose.body_row[i] < 0 and pose.body_row[j] < 0:
        return False
    if not (collider.mask[i] & collider.layer[j] and collider.mask[j] & collider.layer[i]):
        return False
    if collider.sensor[i] and collider.sensor[j]:
        return False
    pushed = any(pose.body_row[k] >= 0 and world[RigidBody].inverse_mass[pose.body_row[k]] > 0.0 for k in (i, j))
    if not (pushed or collider.sensor[i] or collider.sensor[j]):
        return False
    for one, other in ((i, j), (j, i)):
        if not np.isfinite(collider.bound_half[one]).all():
            normal = quaternion.rotate(pose.rotation[one], collider.size[one, :3])
            corners = np.where(normal > 0.0, pose.lower[other], pose.upper[other]) - pose.position[one]
            return bool(normal @ corners <= collider.size[one, 3])
    return bool((pose.lower[i] <= pose.upper[j]).all() and (pose.lower[j] <= pose.upper[i]).all())


def test_bounds_hold_what_a_body_may_do_in_a_step() -> None:
    """A turning, falling box stays within the bounds it had at the start of the step."""
    simulation = Simulation(dt=1 / 30)
    box = simulation.add(
        collider={"box": {"size": (0.2, 1.0, 0.4)}},
        body={"mass": 1.0},
        motion={"linear": (3.0, -4.0, 5.0), "angular": (9.0, 5.0, -7.0)},
    )
    corners = np.array([[x, y, z] for x in (-0.1, 0.1) for y in (-0.5, 0.5) for z in (-0.2, 0.2)])
    for _ in range(20):
        simulation.step()
        placed = simulation[box].transform.position + quaternion.rotate(simulation[box].transform.rotation, corners)
        assert (placed >= simulation[box].collider_pose.lower).all()
        assert (placed <= simulation[box].collider_pose.upper).all()


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_contacts_say_who_measured_them(collision: str) -> None:
    """Contacts carry ``by_fcl``, the lower entity is a, and the counts of the run add up."""
    simulation = touching({}, {}, collision)
    contact, answered = simulation.world[Contact], simulation.world[Answered]
    assert contact.by_fcl[0] == (collision == "fcl")
    assert (int(contact.a[0]), int(contact.b[0])) == (0, 1)
    assert contact.normal[0] == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)
    assert contact.depth[0] == pytest.approx(0.01, abs=1e-12)
    assert contact.point[0] == pytest.approx([0.495, 0.0, 0.0], abs=1e-12)
    assert (answered.fcl, answered.kernels) == ((1, 0) if collision == "fcl" else (0, 1))


def test_shapes_without_a_kernel_are_left_to_fcl() -> None:
    """In the same world balls are measured by kernels and cylinders by FCL."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 0.5, 0.0)})
    simulation.add(
        collider={"cylinder": {"radius": 0.5, "length": 1.0}}, body={}, transform={"position": (3.0, 0.5, 0.0)}
    )
    simulation.step()
    contact = simulation.world[Contact]
    assert contact.count > 1
    assert contact.by_fcl[: contact.count].tolist() == [False] + [True] * (contact.count - 1)


@pytest.mark.parametrize("slow", [True, False])
def test_impacts_beyond_the_cap_are_counted(slow: bool) -> None:
    """A ball that rattles in a slit of a micrometre strikes 10 million times a second: cut, and counted.

    Within the cap nothing is cut, and every impact is in the table.
    """
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0), substeps=1)
    hard = {"restitution": 1.0, "friction": 0.0}
    for normal in ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)):
        simulation.add(collider={"plane": {"normal": normal, "offset": -0.5 - 5e-7}}, material=hard)
    speed = 1e-3 if slow else 10.0
    simulation.add(
        collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0}, material=hard, motion={"linear": (speed, 0.0, 0.0)}
    )
    simulation.step()
    answered, impacts = simulation.world[Answered], simulation.world.count(Impact)
    if slow:
        assert answered.impacts_cut == 0
        assert impacts == pytest.approx(1e-3 / 60 / 1e-6, abs=1)
    else:
        assert answered.impacts_cut == 1
        assert impacts == IMPACTS_AT_LEAST + 2 * IMPACTS_PER_PAIR


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_four_boxes_stand_for_ten_seconds(collision: str) -> None:
    """A tower sinks by what the springs between its boxes give (tests/laws/test_resting.py), and comes to rest."""
    simulation = Simulation(dt=1 / 60, collision=collision)
    simulation.add(collider={"plane": {}})
    box = {"box": {"size": (1.0, 1.0, 1.0)}}
    tower = [simulation.add(collider=box, body={}, transform={"position": (0.0, 0.5 + k, 0.0)}) for k in range(4)]
    simulation.step(600)
    for k, entity in enumerate(tower):
        body = simulation[entity]
        sunk = sum((3 - j) * 2.0 * 9.81 for j in range(k)) / (2.0 * np.pi * CONTACT_PERIODS * 240.0) ** 2
        assert body.transform.position == pytest.approx([0.0, 0.5 + k - sunk, 0.0], abs=1e-4)
        assert body.transform.rotation == pytest.approx([0.0, 0.0, 0.0, 1.0], abs=1e-5)
        assert np.abs(body.motion.linear).max() < 1e-9


def test_a_box_on_its_edge_lands_where_it_touches() -> None:
    """Balanced on an edge it comes to rest on the floor box, neither above it nor in it, to 0.1 mm."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"box": {"size": (5.0, 1.0, 5.0)}}, transform={"position": (0.0, -0.5, 0.0)})
    turned = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi / 4)
    place = {"position": (0.0, np.sqrt(0.5) + 0.05, 0.0), "rotation": turned}
    box = simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place)
    simulation.step(30)
    assert simulation[box].transform.position[1] == pytest.approx(np.sqrt(0.5), abs=1e-4)
