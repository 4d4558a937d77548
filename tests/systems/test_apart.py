"""Pairs that are known to be apart are not measured again, and are apart."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from heaps import add_walls

from carom.ecs import Collider, Motion, System, Transform, state_hash
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.systems.detection.answered import Answered, uncounted
from carom.systems.detection.apart import Apart
from carom.systems.detection.bounds import reaches_of
from carom.systems.detection.narrow import measure_pairs
from carom.systems.kernels.apart import add_ways, leave_apart
from carom.systems.kernels.crew import ALONE
from carom.systems.shapes.box import Box
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation

HULL = {"convex": {"points": [(0.2, 0.0, 0.0), (-0.1, 0.0, 0.2), (-0.1, 0.0, -0.2), (0.0, 0.3, 0.0)]}}


def box_heap(count: int = 120) -> Simulation:
    """Return boxes, capsules, hulls and balls of all turns that fall into a bin and come to rest, without sleep."""
    simulation, random = Simulation(sleeping=False), np.random.default_rng(5)
    simulation.add(collider={"box": {"size": (8.0, 1.0, 8.0)}}, transform={"position": (0.0, -0.5, 0.0)})
    add_walls(simulation, 1.1, 6.0)
    for k in range(count):
        solid: dict[str, Any] = {"box": {"size": (0.4, 0.3, 0.2)}}
        if k % 5 == 0:
            solid = {"capsule": {"radius": 0.1, "length": 0.3}} if k % 10 else HULL
        if k % 40 == 39:
            solid = {"sphere": {"radius": 0.15}}
        x, z = random.uniform(-0.7, 0.7, 2)
        simulation.add(
            name=f"body{k}",
            collider=solid,
            body={},
            transform={
                "position": (x, 0.3 + 0.12 * k, z),
                "rotation": quaternion.normalise(random.normal(size=4)),
            },
        )
    return simulation


def test_pairs_left_out_have_no_contact() -> None:
    """In a heap that falls, comes to rest and is stirred: measured all the same, none of them has a point."""
    simulation = box_heap()
    world, left = simulation.world, 0
    apart = world[Apart]

    def look(system: System) -> None:
        nonlocal left
        if system.name != "find_contacts" or not len(apart.pairs):
            return
        with world.faces(None), uncounted(world):
            reaches = reaches_of(world, apart.pairs, world[Flight].reach)
            away = apart.until - apart.way[apart.pairs].sum(axis=1) > reaches
            assert len(measure_pairs(world, apart.pairs[away], reaches[away]).row_a) == 0
        left += int(away.sum())

    simulation.hearers.append(look)
    simulation.step(240)
    with world.edit(Motion) as motion:
        motion.angular[world.row(world.find("body30"))] = (0.0, 20.0, 5.0)
        motion.linear[world.row(world.find("body60"))] = (0.0, 5.0, 0.0)
    simulation.step(60)
    assert left > 10_000


def test_what_rests_apart_is_not_measured_again() -> None:
    """In a heap at rest less than one of twenty pairs whose bounds overlap is measured in a step."""
    simulation = box_heap()
    simulation.step(600)
    answered = simulation.world[Answered]
    before = answered.kernels
    simulation.step(10)
    assert len(simulation.world[Apart].pairs) > 125
    assert answered.kernels - before < 0.05 * 10 * len(simulation.world[Apart].pairs)


def test_the_future_is_the_same_without_a_cache() -> None:
    """Dropped now and then, in a heap that comes to rest: the same state to the last bit."""
    found = []
    for drop in (False, True):
        simulation = box_heap(60)
        for frame in range(200):
            if drop and frame % 7 == 3:
                simulation.world.add(Apart())
            simulation.step()
        found.append(state_hash(simulation.world))
    assert found[0] == found[1]


@pytest.mark.parametrize("edit", ["size", "position"])
def test_who_comes_to_be_larger_or_elsewhere_is_measured(edit: str) -> None:
    """A box half as large again meets those around it in the next step, and so does one that is put among others."""
    found = []
    for drop in (False, True):
        simulation = box_heap()
        world = simulation.world
        simulation.step(300)
        row = world.row(world.find("body55"))
        assert len(world[Apart].pairs) > 0
        if edit == "size":
            with world.edit(Collider) as collider:
                collider.size[row, :3] *= 1.5
        else:
            with world.edit(Transform) as transform:
                transform.position[row] = transform.position[world.row(world.find("body33"))]
        if drop:
            world.add(Apart())
        simulation.step()
        found.append(state_hash(world))
        assert world[Contact].depth[: world[Contact].count].max() > 0.03
    assert found[0] == found[1]


def test_no_point_goes_farther_than_the_way_of_its_collider() -> None:
    """For random moves of corners of boxes, their quaternions of either sign; by no more than twice in most."""
    random, n = np.random.default_rng(2), 2000
    half = random.uniform(0.1, 2.0, (n, 3))
    places = random.normal(size=(2, n, 3)) * [[[0.0]], [[0.3]]]
    turns = quaternion.normalise(random.normal(size=(2, n, 4)))
    turns[1, : n // 2] = quaternion.normalise(turns[0, : n // 2] + 0.1 * random.normal(size=(n // 2, 4)))
    turns[1, ::2] *= -1.0
    seen, way = np.concatenate([places[0], turns[0]], axis=1), np.zeros(n)
    add_ways(ALONE, np.arange(n), np.zeros((n, 3)), half, np.zeros(n), places[1], turns[1], seen, way)
    corner = half * random.choice([-1.0, 1.0], (n, 3))
    went = [place + quaternion.rotate(turn, corner) for place, turn in zip(places, turns, strict=True)]
    gone = np.linalg.norm(went[1] - went[0], axis=1)
    assert (gone <= way * (1.0 + 1e-12)).all()
    assert np.median(way / gone) < 2.0
    assert np.array_equal(seen, np.concatenate([places[1], turns[1]], axis=1))
    again = way.copy()
    add_ways(ALONE, np.arange(n), np.zeros((n, 3)), half, np.zeros(n), places[1], turns[1], seen, way)
    assert np.array_equal(way, again)


def test_balls_are_left_out_only_where_their_contacts_leave() -> None:
    """What of a table stays hangs on how far it is, and not on whether that was known: balls stay a quarter farther."""
    boxes, balls = (0, 1), (0, 2)
    pairs, shape = np.array([boxes, balls]), np.array([Box.number, Box.number, Sphere.number])
    way, reaches = np.array([0.1, 0.2, 0.2]), np.array([0.04, 0.04])
    for gap, left in ((0.039, [boxes, balls]), (0.041, [balls]), (0.049, [balls]), (0.051, [])):
        near, near_reaches = np.empty_like(pairs), np.empty(2)
        count = leave_apart(pairs, reaches, np.full(2, gap + 0.3), way, shape, near, near_reaches)
        assert near[:count].tolist() == [list(pair) for pair in left]
