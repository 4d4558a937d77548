"""Queries: who has what, in rows and one by one; refused where they would mislead."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from faults import error

from carom.ecs import AccessError, Material, Motion, Phase, RigidBody, Schedule, Transform, World, system, tag
from carom.ecs.commands import Commands

RED = tag("red_in_queries")


@pytest.fixture
def world() -> World:
    """Give six entities: all have a Transform, 0 2 4 a Motion, 4 5 a RigidBody, 3 is red."""
    world = World()
    world.spawn_many(6, Transform())
    for kind, rows in ((Motion, (0, 2, 4)), (RigidBody, (4, 5)), (RED, (3,))):
        for row in rows:
            world.attach(row, kind())
    return world


@pytest.mark.parametrize(
    ("words", "rows"),
    [
        ({"any_of": (Motion, RigidBody)}, [0, 2, 4, 5]),
        ({"any_of": [RigidBody, RED]}, [3, 4, 5]),
        ({"any_of": RigidBody}, [4, 5]),
        ({"without": Motion}, [1, 3, 5]),
        ({"without": [Motion, RED]}, [1, 5]),
        ({"any_of": (Motion, RigidBody), "without": RigidBody}, [0, 2]),
        ({"any_of": Material}, []),
        ({"without": Material}, [0, 1, 2, 3, 4, 5]),
        ({}, [0, 1, 2, 3, 4, 5]),
    ],
)
def test_queries_take_one_kind_or_several(world: World, words: dict[str, Any], rows: list[int]) -> None:
    """All of these, none of those, one of these; a slice where contiguous; a kind nobody has is no fault."""
    assert world.row_numbers(Transform, **words).tolist() == rows
    found = world.rows(Transform, **words)
    contiguous = not rows or rows[-1] - rows[0] == len(rows) - 1
    assert found == slice(rows[0], rows[-1] + 1) if rows and contiguous else isinstance(found, slice) == contiguous
    query = world.query(Transform, **words)
    assert len(query) == len(rows)
    assert query.entities.tolist() == rows
    assert query.rows is found
    assert query.numbers is world.row_numbers(Transform, **words)


def test_no_kind_at_all_means_everybody(world: World) -> None:
    """Also those who have no component."""
    bare = world.spawn()
    assert world.row_numbers().tolist() == [0, 1, 2, 3, 4, 5, world.row(bare)]


def test_one_query_is_one_object_that_stays_right(world: World) -> None:
    """However its options are written; writing values finds nothing anew, structure does."""
    query = world.query(Transform, without=Motion)
    assert world.query(Transform, without=[Motion]) is query
    assert world.query(Transform, without=(Motion,), any_of=()) is query
    assert world.query(Transform, without=Motion, optional=RED) is not query
    numbers = query.numbers
    world[1].transform.position = (1.0, 0.0, 0.0)
    assert query.numbers is numbers
    world.attach(1, Motion())
    assert query.numbers.tolist() == [3, 5]


def test_optional_selects_nothing_and_has_tells_who(world: World) -> None:
    """A mask over the rows of the query, in their order."""
    query = world.query(Transform, optional=(RigidBody, Material))
    assert query.numbers.tolist() == [0, 1, 2, 3, 4, 5]
    assert query.has(RigidBody).tolist() == [False] * 4 + [True] * 2
    assert query.has(Material).tolist() == [False] * 6
    assert query.optional == (RigidBody, Material)
    assert world.query(Motion).has(RigidBody).tolist() == [False, False, True]


def test_a_query_is_iterated_over_like_objects(world: World) -> None:
    """In order of rows; values may be written meanwhile."""
    for k, mover in enumerate(world.query(Motion)):
        mover.motion.linear = (float(k), 0.0, 0.0)
    assert world[Motion].linear[[0, 2, 4], 0].tolist() == [0.0, 1.0, 2.0]


@pytest.mark.parametrize("change", ["spawn", "despawn", "attach", "detach"])
def test_iterating_refuses_a_change_of_structure(world: World, change: str) -> None:
    """The message says how else; over a list it may be done."""
    what = {
        "spawn": lambda entity: world.spawn(Transform()),
        "despawn": lambda entity: world.despawn(entity),
        "attach": lambda entity: world.attach(entity, Material()),
        "detach": lambda entity: world.detach(entity, Motion),
    }[change]
    message = (
        "entities came, went or changed their components while a query was iterated over; "
        "iterate over list(query), or ask for the change: world[Commands].spawn(...)"
    )
    with error(AccessError, message):
        for mover in world.query(Motion):
            what(mover.entity)
    for mover in list(world.query(Motion)):
        what(mover.entity)
    assert world.count(Motion) == (0 if change in ("despawn", "detach") else 3)


def test_commands_may_be_asked_for_while_iterating(world: World) -> None:
    """They wait for the end of the phase."""
    world.add(Commands())

    @system(reads=(Motion,), writes=(Commands,))
    def clear(world: World, dt: float) -> None:
        for mover in world.query(Motion):
            world[Commands].despawn(mover.entity)

    Schedule(Phase("only", clear)).run(world, 0.1, checked=True)
    assert world.count(Motion) == 0
    assert world.count(Transform) == 3


@pytest.mark.parametrize(
    "words",
    [{"without": RED}, {"any_of": (Motion, RED)}, {"optional": [RED]}, None],
    ids=["without", "any_of", "optional", "has"],
)
def test_a_checked_system_asks_only_for_what_it_declares(world: World, words: dict[str, Any] | None) -> None:
    """Who has a component is read of that component."""

    @system(reads=(Transform, Motion))
    def peek(world: World, dt: float) -> None:
        if words is None:
            world.query(Transform).has(RED)
        else:
            world.query(Transform, **words)

    message = (
        f"system 'peek' touches {RED.__name__} but declares only Transform, Motion; "
        f"add {RED.__name__} to reads=, writes= or adds= of @system"
    )
    with error(AccessError, message):
        Schedule(Phase("only", peek)).run(world, 0.1, checked=True)
    Schedule(Phase("only", peek)).run(world, 0.1)


def test_rows_of_a_query_index_every_column(world: World) -> None:
    """What the documentation promises: the same rows in all of them."""
    rows = world.rows(Transform, Motion)
    with world.edit(Motion) as motion:
        motion.linear[rows] = 1.0
    assert np.nonzero(world[Motion].linear.any(axis=1))[0].tolist() == [0, 2, 4]
