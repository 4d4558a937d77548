"""Structure: where new entities stand, what goes with whom, and what compact leaves as it was."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carom.ecs import (
    AccessError,
    DeclarationError,
    EntityError,
    Material,
    Motion,
    Name,
    Parent,
    Phase,
    Prefab,
    RigidBody,
    Schedule,
    Transform,
    World,
    restore_snapshot,
    state_hash,
    system,
    tag,
    take_snapshot,
)
from carom.ecs.commands import Commands
from carom.ecs.relations.contact import Contact
from carom.worlds.builder import load_world


def error(kind: type[Exception], message: str) -> Any:
    """Expect an error with exactly this message."""
    return pytest.raises(kind, match=f"^{re.escape(message)}$")


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
        simulation.world.add(simulation.settings)
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


# From inside systems ------------------------------------------------------------------------------------------------
def frame(world: World, function: Callable[[World], object]) -> None:
    """Run one frame of one system."""

    @system(reads=(Transform,), writes=(Commands, Motion))
    def meddle(world: World, dt: float) -> None:
        function(world)

    Schedule(Phase("only", meddle)).run(world, 0.1, checked=True)


@pytest.mark.parametrize(
    ("verb", "change"),
    [
        ("spawn", lambda world: world.spawn(Transform())),
        ("despawn", lambda world: world.despawn(0)),
        ("attach", lambda world: world.attach(0, Material())),
        ("detach", lambda world: world.detach(0, Transform)),
        ("compact", lambda world: world.compact()),
    ],
)
def test_a_structural_change_inside_a_system_is_refused(verb: str, change: Callable[[World], object]) -> None:
    """The message says how to ask for it; afterwards the world is open again."""
    world = World()
    world.add(Commands())
    ball = world.spawn(Transform())
    message = (
        f"system 'meddle' asks the world to {verb} while the step runs; "
        f"ask for it instead: world[Commands].ask(lambda world: world.{verb}(...)), with Commands in writes="
    )
    with error(AccessError, message):
        frame(world, change)
    assert world.rows(Transform) == slice(0, 1)
    change(world)
    assert (ball in world) == (verb != "despawn")


def test_commands_come_true_in_the_order_asked() -> None:
    """Whoever is despawned twice, or gone when a change was asked for it, is no fault."""
    world = World()
    world.add(Commands())
    first, second, third = world.spawn_many(3, Transform(), names=list("abc")).tolist()

    def ask(world: World) -> None:
        commands = world[Commands]
        commands.spawn(Transform(), name="new")
        commands.spawn_many(2, Transform(), Motion(), names=["x", "y"])
        commands.attach(second, Material())
        commands.detach(third, Name)
        commands.despawn(first)
        commands.despawn(np.array([first, second]), world.query(Motion))
        commands.attach(first, Motion())
        commands.detach(first, Transform)
        commands.ask(lambda world: world.attach(world.find("new"), Motion()))
        assert world.count(Transform) == 3

    frame(world, ask)
    assert world.names() == ["new", "x", "y"]
    assert [entity in world for entity in (first, second, third)] == [False, False, True]
    assert world.query(Motion).entities.tolist() == [world.find("new"), world.find("x"), world.find("y")]


def test_commands_take_one_many_and_queries_like_the_world() -> None:
    """Values follow their entities, also where some of these are gone by then."""
    world = World()
    world.add(Commands())
    first, second, third = world.spawn_many(3, Transform()).tolist()

    def ask(world: World) -> None:
        commands = world[Commands]
        commands.despawn(second)
        commands.attach(np.array([third, second, first]), Motion(linear=np.outer([3.0, 2.0, 1.0], (1.0, 0.0, 0.0))))
        commands.attach(world.query(Transform), RigidBody(mass=[5.0, 6.0, 7.0], center_of_mass=(0.0, 1.0, 0.0)))
        commands.detach(np.array([second, first]), Transform)

    frame(world, ask)
    assert world[Motion].linear[:3, 0].tolist() == [1.0, 0.0, 3.0]
    assert world[RigidBody].mass[:3].tolist() == [5.0, 0.0, 7.0]
    assert world[RigidBody].center_of_mass[:3, 1].tolist() == [1.0, 0.0, 1.0]
    assert world.query(Transform).entities.tolist() == [third]


# One entity like an object --------------------------------------------------------------------------------------------
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
