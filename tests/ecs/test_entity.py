"""One entity reads like an object, and what is assigned to it is written through to the table."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from faults import error

from carom.ecs import DeclarationError, EntityError, Material, Motion, RigidBody, Transform, World, state_hash


def test_an_entity_reads_and_writes_like_an_object() -> None:
    """Assignment through a view is seen by the columns, and the other way round."""
    world = World()
    ball = world.spawn(Transform(), Motion(), Material())
    world[ball].motion.linear = (1.0, 2.0, 3.0)
    world[ball].material.friction = 0.25
    assert world[Motion].linear[0].tolist() == [1.0, 2.0, 3.0]
    with world.edit(Motion) as motion:
        motion.linear[0, 1] = 9.0
    assert world[ball].motion.linear.tolist() == [1.0, 9.0, 3.0]
    assert world[ball].material.friction == 0.25
    world[ball].motion.linear += (0.0, 1.0, 0.0)
    world[ball].motion.linear[0] = -1.0
    world[ball].motion.linear[1:] *= 2.0
    assert world[Motion].linear[0].tolist() == [-1.0, 20.0, 6.0]


def test_an_entity_refuses_what_it_does_not_have() -> None:
    """Unknown components and columns name what there is."""
    world = World()
    ball = world.spawn(Motion(), name="ball")
    with error(EntityError, "entity 'ball' has no transform, only motion, name"):
        _ = world[ball].transform
    accepted = "linear, angular, linear_acceleration, angular_acceleration, still, asleep"
    with error(AttributeError, f"Motion has no column 'speed', only {accepted}"):
        _ = world[ball].motion.speed
    with error(AttributeError, f"Motion has no column 'speed', only {accepted}"):
        world[ball].motion.speed = 1.0
    with error(AttributeError, "assign to a column: world[entity].motion.<column> = value"):
        world[ball].motion = (1.0, 0.0, 0.0)


def test_values_are_written_element_by_element_and_in_place() -> None:
    """Also where the value was kept under a name; what is computed from it is an array of its own."""
    world = World()
    ball = world[world.spawn(Transform(position=(1.0, 2.0, 3.0)), RigidBody())]
    position = ball.transform.position
    position += 1.0
    position[0] = -5.0
    position[1:] -= (1.0, 2.0)
    assert world[Transform].position[0].tolist() == [-5.0, 2.0, 2.0]
    ball.transform.position *= 2.0
    assert position.tolist() == [-10.0, 4.0, 4.0]
    apart = position * 1.0
    apart[0] = 7.0
    assert world[Transform].position[0, 0] == -10.0
    ball.rigid_body.mass += 1
    assert ball.rigid_body.mass == 2.0
    assert ball[Transform].position[2] == 4.0
    assert Transform in ball and Motion not in ball


@pytest.mark.parametrize(
    ("write", "message"),
    [
        (
            lambda ball: setattr(ball.transform, "position", (1.0, 2.0)),
            "Transform.position takes 3 per row, received an array of shape (2,); give shape (3,)",
        ),
        (
            lambda ball: setattr(ball.transform, "position", "far"),
            "Transform.position takes numbers, received 'far'",
        ),
        (lambda ball: setattr(ball.rigid_body, "type", 1.7), "RigidBody.type takes whole numbers, received 1.7"),
        (lambda ball: setattr(ball.rigid_body, "type", 2**63), f"RigidBody.type takes whole numbers, received {2**63}"),
        (
            lambda ball: ball.transform.position.__setitem__(0, "far"),
            "Transform.position takes numbers, received 'far'",
        ),
        (
            lambda ball: setattr(ball.name, "text", "x" * 49),
            f"Name.text holds at most 48 characters, received 49: '{'x' * 49}'",
        ),
        (lambda ball: setattr(ball.name, "text", 5), "Name.text takes texts, received 5"),
    ],
    ids=["shape", "dtype", "fraction", "too large", "element", "too long", "no text"],
)
def test_a_value_that_does_not_fit_is_refused(write: Callable[[Any], None], message: str) -> None:
    """Nothing is cut, rounded or repeated in silence."""
    world = World()
    ball = world[world.spawn(Transform(), RigidBody(), name="ball")]
    before = state_hash(world)
    with error(DeclarationError, message):
        write(ball)
    assert state_hash(world) == before


def test_a_stale_view_neither_reads_nor_writes() -> None:
    """A view that was kept reaches nobody who has the row now."""
    world = World()
    entity = world.spawn(Transform())
    transform, position = world[entity].transform, world[entity].transform.position
    world.frame = 2
    world.despawn(entity)
    world.spawn(Transform(position=(1.0, 1.0, 1.0)))

    def write() -> None:
        transform.position = (0.0, 0.0, 0.0)

    def write_element() -> None:
        position[0] = 0.0

    for use in (lambda: transform.position, write, write_element):
        with error(EntityError, "entity 0, generation 0, was despawned in frame 2"):
            use()
    assert world[Transform].position[0].tolist() == [1.0, 1.0, 1.0]
