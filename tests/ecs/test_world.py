"""The world: entities come, go and are found; queries and handles stay right through it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from faults import error

from carom.ecs import AccessError, EntityError, Material, Motion, Name, Transform, World
from carom.ecs.component import Resource
from carom.ecs.relations.contact import Contact


class Weather(Resource):
    """A resource nobody added."""


def test_spawn_fills_defaults_and_values() -> None:
    """Columns that a bundle does not give take their default."""
    world = World()
    ball = world.spawn(Transform(position=(1.0, 2.0, 3.0)), Material(friction=0.1))
    assert world[ball].transform.position.tolist() == [1.0, 2.0, 3.0]
    assert world[ball].transform.rotation.tolist() == [0.0, 0.0, 0.0, 1.0]
    assert world[ball].material.friction == 0.1
    assert world[ball].material.density == 1000.0


def test_spawn_many_takes_one_value_for_all_or_one_for_each() -> None:
    """Entities made together are told apart by the first axis."""
    world = World()
    balls = world.spawn_many(3, Transform(position=np.eye(3)), Motion(linear=(0.0, 1.0, 0.0)), names=["a", "b", "c"])
    assert balls.tolist() == [0, 1, 2]
    assert world[Transform].position[:3].tolist() == np.eye(3).tolist()
    assert world[Motion].linear[:3].tolist() == [[0.0, 1.0, 0.0]] * 3
    assert world.names() == ["a", "b", "c"]


def test_a_despawned_entity_leaves_zeros_and_its_row_is_used_again() -> None:
    """The next entity gets the lowest free row with another generation, and nothing of the one before."""
    world = World()
    first, second, third = world.spawn_many(3, Transform(position=(1.0, 1.0, 1.0)), names=["a", "b", "c"])
    world.despawn(second, first)
    assert world[Transform].rotation[:2].tolist() == [[0.0] * 4] * 2
    assert world.names() == ["c"]
    again = world.spawn(Transform())
    assert world.row(again) == 0
    assert again != first
    assert world[again].transform.position.tolist() == [0.0, 0.0, 0.0]
    assert world.row(third) == 2
    assert world.name(again) == "[0]"


def test_a_stale_handle_says_when_the_entity_went() -> None:
    """Neither reading, writing nor removing again reaches whoever has the row now."""
    world = World()
    ball = world.spawn(Transform())
    world.frame = 7
    world.despawn(ball)
    other = world.spawn(Transform())
    message = "entity 0, generation 0, was despawned in frame 7"
    for use in (lambda: world[ball], lambda: world.despawn(ball), lambda: world.attach(ball, Motion())):
        with error(EntityError, message):
            use()
    assert world.row(other) == 0


@pytest.mark.parametrize(
    ("handle", "message"),
    [
        (5, "entity 5, generation 0, never was in this world"),
        (1 << 32, "entity 0, generation 1, never was in this world"),
        (-1, "-1 is no entity: handles are 0 or more, and -1 stands for none"),
    ],
    ids=["never spawned", "later generation", "none"],
)
def test_a_handle_that_never_was(handle: int, message: str) -> None:
    """A number that is no handle is refused, alone and among others."""
    world = World()
    ball = world.spawn(Transform())
    for use in (lambda: world.row(handle), lambda: world[handle], lambda: world.despawn(np.array([ball, handle]))):
        with error(EntityError, message):
            use()
    assert ball in world


def test_attach_and_detach() -> None:
    """Components come and go; what is detached is zeroed and leaves the queries."""
    world = World()
    ball = world.spawn(Transform())
    assert world.rows(Transform, Motion) == slice(0, 0)
    world.attach(ball, Motion(linear=(1.0, 0.0, 0.0)))
    assert world.rows(Transform, Motion) == slice(0, 1)
    world.detach(ball, Motion)
    assert world.rows(Transform, Motion) == slice(0, 0)
    assert world.rows(Transform, without=[Motion]) == slice(0, 1)
    assert not world[Motion].linear.any()
    with error(EntityError, "entity '[0]' has no motion, only transform"):
        _ = world[ball].motion


def test_growth_keeps_rows_and_handles() -> None:
    """Beyond the capacity every table grows, also those that the new entities do not touch."""
    world = World(capacity=4)
    first = world.spawn(Transform(position=(1.0, 2.0, 3.0)), Motion(linear=(4.0, 5.0, 6.0)), name="first")
    before = world[Transform].position
    world.spawn_many(100, Transform())
    assert world[Transform].position is not before
    assert world.capacity >= 101
    assert world[Motion].linear.shape == (world.capacity, 3)
    assert world[first].transform.position.tolist() == [1.0, 2.0, 3.0]
    assert world[first].motion.linear.tolist() == [4.0, 5.0, 6.0]
    assert world.find("first") == first
    assert world.rows(Transform) == slice(0, 101)
    assert not world[Transform].position.flags.writeable


def test_rows_are_a_slice_where_contiguous_else_sorted() -> None:
    """The cheap form wherever it exists; `row_numbers` is always an array."""
    world = World()
    balls = world.spawn_many(5, Transform())
    for ball in balls[[0, 1, 4]]:
        world.attach(ball, Motion())
    rows = world.rows(Motion)
    assert isinstance(rows, np.ndarray)
    assert rows.tolist() == [0, 1, 4]
    assert world.rows(Transform, without=[Motion]) == slice(2, 4)
    assert world.row_numbers(Transform).tolist() == [0, 1, 2, 3, 4]
    assert world.row_numbers(Transform).dtype == np.int64


@pytest.mark.parametrize(
    "change",
    [
        lambda world, ball: world.spawn(Transform()),
        lambda world, ball: world.despawn(ball),
        lambda world, ball: world.attach(ball, Motion()),
        lambda world, ball: world.detach(ball, Transform),
    ],
    ids=["spawn", "despawn", "attach", "detach"],
)
def test_a_query_is_cached_until_the_structure_changes(change: Callable[[World, int], object]) -> None:
    """The same object is returned while nothing came or went; writing values changes no structure."""
    world = World()
    world.spawn(Transform())
    ball = world.spawn(Transform())
    rows, moving = world.row_numbers(Transform), world.row_numbers(Transform, Motion)
    world[ball].transform.position = (1.0, 0.0, 0.0)
    assert world.row_numbers(Transform) is rows
    change(world, ball)
    present = np.nonzero(world.table(Transform).present)[0]
    assert world.row_numbers(Transform).tolist() == present.tolist()
    assert world.row_numbers(Transform, Motion) is not moving


def test_find_by_name() -> None:
    """A name leads to its entity; a wrong one names the near ones."""
    world = World()
    world.spawn_many(3, Transform(), names=["left_ball", "right_ball", "floor"])
    assert world.find("floor") == 2
    assert world.name(1) == "right_ball"
    with error(EntityError, "no entity is named 'lift_ball'; did you mean 'left_ball' or 'right_ball'?"):
        world.find("lift_ball")
    with error(EntityError, "no entity is named 'sky'"):
        world.find("sky")
    world.despawn(2)
    with error(EntityError, "no entity is named 'floor'"):
        world.find("floor")


def test_a_resource_that_is_not_there() -> None:
    """A missing resource says how to add it."""
    with error(EntityError, "the world has no resource 'Weather'; add it with world.add(...)"):
        World()[Weather]


def test_columns_are_read_only_outside_systems() -> None:
    """Only `edit` and the entity's setter write; relations are resized by systems alone."""
    world = World()
    ball = world.spawn(Transform(), Name(text="ball"))
    with error(ValueError, "assignment destination is read-only"):
        world[Transform].position[0] = 1.0
    with error(AccessError, "only a system that writes Contact may resize it"):
        world.resize(Contact, 1)
    with world.edit(Transform) as transform:
        transform.position[0] = 1.0
    assert world[ball].transform.position.tolist() == [1.0, 1.0, 1.0]
    with error(ValueError, "assignment destination is read-only"):
        world[Transform].position[0] = 1.0
