"""Who is carried follows who carries, to any depth and whatever the order of rows."""

from __future__ import annotations

import numpy as np
import pytest
from faults import error

from carom.ecs import EntityError, Motion, Parent, Transform, World
from carom.ecs.hierarchy import compose
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

TURN = (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5))  # a quarter about y


def test_grandchildren_before_their_parents_in_row_order() -> None:
    """Poses are put together from the root down: x = x_p + q_p x_l, q = q_p q_l."""
    world = World()
    leaf, branch, root = world.spawn_many(3, Transform()).tolist()
    world[root].transform.position = (1.0, 0.0, 0.0)
    world[root].transform.rotation = TURN
    world.attach(leaf, Parent(entity=branch, position=(0.0, 1.0, 0.0)))
    world.attach(branch, Parent(entity=root, position=(0.0, 0.0, 2.0), rotation=TURN))
    compose(world)
    np.testing.assert_allclose(world[branch].transform.position, (3.0, 0.0, 0.0), atol=1e-15)
    np.testing.assert_allclose(world[leaf].transform.position, (3.0, 1.0, 0.0), atol=1e-15)
    np.testing.assert_allclose(world[leaf].transform.rotation, (0.0, 1.0, 0.0, 0.0), atol=1e-15)


def test_a_chain_against_the_order_of_rows() -> None:
    """Fifty of one another, the last row first."""
    world = World()
    chain = world.spawn_many(50, Transform())
    for child, carrier in zip(chain[:-1].tolist(), chain[1:].tolist(), strict=True):
        world.attach(child, Parent(entity=carrier, position=(1.0, 0.0, 0.0)))
    compose(world)
    assert world[Transform].position[:50, 0].tolist() == list(range(49, -1, -1))


def circle(world: World) -> None:
    """Let three carry each other."""
    made = world.spawn_many(3, Transform(), names=list("abc")).tolist()
    for child, carrier in zip(made, made[1:] + made[:1], strict=True):
        world.attach(child, Parent(entity=carrier))


def on_nothing(world: World) -> None:
    """Let one be carried by another that is nowhere."""
    carrier = world.spawn(Motion(), name="ghost")
    world.spawn(Transform(), Parent(entity=carrier), name="hat")


def orphan(world: World) -> None:
    """Let one have a Parent without a parent."""
    world.spawn(Transform(), Parent(), name="hat")


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (circle, "entities carry each other in a circle: 'a', 'b', 'c'; detach one from its parent"),
        (on_nothing, "entity 'hat' is carried by 'ghost', which has no transform; give it one"),
        (orphan, "entity 'hat' has a parent component but no parent; set parent.entity, or detach it"),
    ],
    ids=["circle", "no transform", "no parent"],
)
def test_what_cannot_be_carried_is_told(build: object, message: str) -> None:
    """By name, with what to do."""
    world = World()
    build(world)  # type: ignore[operator]
    with error(EntityError, message):
        compose(world)


def test_despawn_takes_whom_they_carry() -> None:
    """Also through others, whatever the order, and when both are named; children() lists only the nearest."""
    world = World()
    made = world.spawn_many(6, Transform(), names=list("abcdef")).tolist()
    for child, carrier in ((0, 3), (3, 4), (1, 4), (2, 5)):
        world.attach(made[child], Parent(entity=made[carrier]))
    assert world.children(made[4]).tolist() == [made[1], made[3]]
    assert world.children(made[0]).tolist() == []
    world.despawn(made[4], made[0])
    assert world.names() == ["c", "f"]
    circle_world = World()
    circle(circle_world)
    circle_world.despawn(1)
    assert len(circle_world.row_numbers()) == 0


@pytest.mark.parametrize("compact", [False, True])
def test_a_child_follows_a_spinning_falling_body_exactly(compact: bool) -> None:
    """After every step its pose is that of its parent followed by its own, to the last bit."""
    simulation = Simulation(dt=1 / 60)
    extra = simulation.add(transform={})
    rider = simulation.add(transform={}, name="rider")
    horse = simulation.add(
        transform={"position": (0.0, 5.0, 0.0)},
        motion={"angular": (0.3, 2.0, -0.7), "linear": (1.0, 0.0, 0.5)},
        collider={"box": {"size": (1.0, 0.5, 0.25)}},
        body={},
        name="horse",
    )
    world = simulation.world
    world.attach(rider, Parent(entity=horse, position=(0.0, 0.5, 0.1), rotation=TURN))
    world.despawn(extra)
    for frame in range(60):
        if compact and frame == 20:
            world.compact()
        simulation.step()
        carrier, child = world[horse].transform, world[rider].transform
        turn = np.array([carrier.rotation])
        moved = quaternion.rotate(turn, np.array([[0.0, 0.5, 0.1]]))[0]
        assert child.position.tolist() == (carrier.position + moved).tolist()
        assert child.rotation.tolist() == quaternion.multiply(turn, np.array([TURN]))[0].tolist()
    assert world[horse].transform.position[1] < 1.0
    assert abs(world[horse].transform.rotation[3]) < 0.9
