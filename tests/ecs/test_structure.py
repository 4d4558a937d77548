"""Structure: where new entities stand, what goes with whom, and what compact leaves as it was."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from faults import error

from carom.ecs import (
    DeclarationError,
    EntityError,
    Motion,
    Parent,
    Prefab,
    RigidBody,
    Transform,
    World,
    restore_snapshot,
    state_hash,
    tag,
    take_snapshot,
)
from carom.ecs.relations.contact import Contact
from carom.worlds.builder import load_world


def rows_of(world: World, entities: np.ndarray) -> list[int]:
    """Return the rows of entities."""
    return [world.row(entity) for entity in entities.tolist()]


def test_those_made_together_stand_together_in_the_lowest_gap_that_holds_them() -> None:
    """A gap that is too small is left to whoever fits; without any, rows are added at the end."""
    world = World()
    first = world.spawn_many(10, Transform())
    world.despawn(first[[1, 4, 5, 8]])
    assert rows_of(world, world.spawn_many(2, Transform())) == [4, 5]
    assert rows_of(world, world.spawn_many(3, Transform())) == [10, 11, 12]
    assert rows_of(world, world.spawn_many(1, Transform())) == [1]
    assert rows_of(world, world.spawn_many(1, Transform())) == [8]
    assert world.rows(Transform) == slice(0, 13)
    assert world.spawn_many(0, Transform()).tolist() == []


def test_the_highest_rows_are_given_back() -> None:
    """Where the last ones go, the next stand: a world whose entities come and go does not grow."""
    world = World(capacity=8)
    for _ in range(100):
        made = world.spawn_many(6, Transform())
        assert rows_of(world, made) == list(range(6))
        world.despawn(made)
    assert (world.used(), world.capacity) == (0, 8)


def test_growth_in_the_middle_of_a_gap_keeps_everything() -> None:
    """Handles, values, names and the zeros of who is gone survive the move to larger arrays."""
    world = World(capacity=4)
    made = world.spawn_many(4, Transform(position=np.arange(12.0).reshape(4, 3)), names=list("abcd"))
    world.despawn(made[1])
    more = world.spawn_many(5, Motion(linear=(1.0, 2.0, 3.0)))
    assert rows_of(world, more) == [4, 5, 6, 7, 8]
    assert world[Transform].position[:4].tolist() == [[0, 1, 2], [0, 0, 0], [6, 7, 8], [9, 10, 11]]
    assert world[Motion].linear[4:9].tolist() == [[1.0, 2.0, 3.0]] * 5
    assert world.find("d") == made[3]


@pytest.mark.parametrize(
    "choose",
    [
        lambda world, made: (int(made[1]), int(made[2])),
        lambda world, made: (made[1:3],),
        lambda world, made: (made[[2, 1, 2]], made[1], made[1:2]),
        lambda world, made: (world.query(Motion),),
    ],
    ids=["one by one", "an array", "some twice", "a query"],
)
def test_despawn_takes_handles_arrays_and_queries(choose: Callable[[World, np.ndarray], tuple[Any, ...]]) -> None:
    """However they are named, they go once."""
    world = World()
    made = world.spawn_many(4, Transform())
    for entity in made[1:3].tolist():
        world.attach(entity, Motion())
    world.despawn(*choose(world, made))
    assert [entity in world for entity in made.tolist()] == [True, False, False, True]
    assert rows_of(world, world.spawn_many(2, Transform())) == [1, 2]


def test_a_stale_handle_among_others_changes_nothing() -> None:
    """Everybody lives on, names included."""
    world = World()
    made = world.spawn_many(3, Transform(), names=list("abc"))
    world.frame = 4
    world.despawn(made[0])
    before = state_hash(world)
    with error(EntityError, "entity 0, generation 0, was despawned in frame 4"):
        world.despawn(made[2], made)
    assert state_hash(world) == before
    assert world.find("c") == made[2]


def test_a_handle_of_long_ago_says_so() -> None:
    """Only the last despawn of a row is known by its frame."""
    world = World()
    first = world.spawn(Transform())
    for frame in (3, 9):
        world.frame = frame
        world.despawn(int(world.query(Transform).entities[0]))
        world.spawn(Transform())
    with error(EntityError, "entity 0, generation 0, was despawned before frame 9"):
        world.row(first)


def test_a_column_of_entities_takes_living_ones_only() -> None:
    """-1 stands for none; a stale handle is refused before anything was made."""
    world = World()
    gone = world.spawn(Transform())
    world.despawn(gone)
    with error(EntityError, "entity 0, generation 0, was despawned in frame 0"):
        world.spawn(Transform(), Parent(entity=gone))
    assert len(world.row_numbers()) == 0


@pytest.mark.parametrize(
    ("spawn", "message"),
    [
        (
            lambda world: world.spawn(Transform),
            "an entity is made of components and prefabs, received the class Transform; write Transform(...)",
        ),
        (
            lambda world: world.attach(0, Prefab(Transform(), 3.5)),
            "an entity is made of components and prefabs, received float 3.5",
        ),
        (lambda world: world.spawn_many(-1, Transform()), "spawn_many makes 0 entities or more, received -1"),
        (
            lambda world: world.spawn_many(3, Transform(), names=["a", "b"]),
            "names: one for each of 3 entities, received 2",
        ),
        (lambda world: world.spawn_many(3, names=["a"]), "names: one for each of 3 entities, received 1"),
        (
            lambda world: world.spawn_many(3, Motion(linear=np.ones((2, 3)))),
            (
                "Motion.linear takes 3 per row, received an array of shape (2, 3); "
                "give shape (3,) for all, or (3, 3) for each"
            ),
        ),
        (
            lambda world: world.spawn(Transform(position=[(0.0, 0.0), (1.0,)])),
            "Transform.position takes 3 per row, received rows of different length",
        ),
        (lambda world: world.spawn(RigidBody(type=0.5)), "RigidBody.type takes whole numbers, received 0.5"),
        (lambda world: world.query(Transform, "motion"), "a query takes component classes, received 'motion'"),
        (lambda world: world.rows(Transform, without=Contact), f"a query takes component classes, received {Contact}"),
    ],
    ids=[
        "a class",
        "a number",
        "less than none",
        "names",
        "a name",
        "some values",
        "ragged",
        "a fraction",
        "a text",
        "a relation",
    ],
)
def test_misuse_is_told_and_changes_nothing(spawn: Callable[[World], object], message: str) -> None:
    """What was received, what is accepted."""
    world = World()
    world.spawn(Motion())
    before = state_hash(world)
    with error(DeclarationError, message):
        spawn(world)
    assert state_hash(world) == before


def test_compact_closes_gaps_and_keeps_handles_order_and_hash() -> None:
    """Queries find contiguous rows again; snapshots from before are restored with the gaps of then."""
    world = World()
    made = world.spawn_many(6, Transform(position=np.arange(18.0).reshape(6, 3)), names=list("abcdef"))
    world.despawn(made[[0, 3]])
    saved, before = take_snapshot(world), state_hash(world)
    living = made[[1, 2, 4, 5]]
    world.compact()
    assert world.rows(Transform) == slice(0, 4)
    assert rows_of(world, living) == [0, 1, 2, 3]
    assert world.names() == ["b", "c", "e", "f"]
    assert world[int(made[4])].transform.position.tolist() == [12.0, 13.0, 14.0]
    assert not world[Transform].rotation[4:].any()
    assert state_hash(world) == before
    with error(EntityError, "entity 3, generation 0, was despawned in frame 0"):
        world.row(int(made[3]))
    assert rows_of(world, world.spawn_many(1, Transform())) == [4]
    restore_snapshot(world, saved)
    assert rows_of(world, living) == [1, 2, 4, 5]
    assert state_hash(world) == before


@pytest.mark.parametrize(("collision", "frames"), [("auto", 200), ("fcl", 20)])
def test_compact_in_the_middle_of_a_break_changes_no_bit_of_what_follows(collision: str, frames: int) -> None:
    """Three balls are taken from the table; two hundred frames later the hash is the same, compacted or not."""
    found = []
    for compact in (False, True):
        simulation = load_world("billiards").simulation
        simulation.settings = replace(simulation.settings, collision=collision)
        simulation.step(120)
        world = simulation.world
        world.despawn(*(world.find(name) for name in ("ball_1", "ball_8", "ball_12")))
        if compact:
            world.compact()
            assert isinstance(world.rows(RigidBody), slice)
        simulation.step(frames // 2)
        if compact:
            world.compact()
        simulation.step(frames // 2)
        found.append(state_hash(world))
    assert found[0] == found[1]


def test_compact_renumbers_rows_that_relations_hold() -> None:
    """A contact still names the rows of its colliders; -1 stands for who is gone."""
    world = World()
    made = world.spawn_many(5, Transform())
    with world.faces(None):
        world.resize(Contact, 3)
        contact = world[Contact]
        contact.row_a[:3], contact.row_b[:3] = (0, 2, 3), (2, 4, -1)
    world.despawn(made[[0, 3]])
    world.compact()
    assert world[Contact].row_a[:3].tolist() == [-1, 1, -1]
    assert world[Contact].row_b[:3].tolist() == [1, 2, -1]


def test_many_are_given_and_lose_components_at_once() -> None:
    """An array of handles in any order, or a query; values follow the order in which the entities are named."""
    world = World()
    balls = world.spawn_many(4, Transform())
    world.attach(balls[[3, 1]], Motion(linear=[(3.0, 0.0, 0.0), (1.0, 0.0, 0.0)]), tag("fast")())
    assert world.row_numbers(Motion, tag("fast")).tolist() == [1, 3]
    assert world[Motion].linear[:4, 0].tolist() == [0.0, 1.0, 0.0, 3.0]
    world.detach(world.query(tag("fast")), Motion, tag("fast"))
    assert not len(world.query(any_of=(Motion, tag("fast"))))
    assert not world[Motion].linear.any()
