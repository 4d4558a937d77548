"""The first difference between two states is named to the element and the last place."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from heaps import stack_of_boxes

from carom.ecs import (
    Collider,
    Difference,
    Motion,
    Name,
    Parent,
    Snapshot,
    Transform,
    World,
    first_difference,
    restore_snapshot,
    state_hash,
    take_snapshot,
)
from carom.ecs.difference import ulps_between
from carom.ecs.relations.contact import Contact
from carom.systems.settings import Random
from carom.systems.simulation import Simulation


def standing() -> World:
    """Return a stack of boxes in contact."""
    simulation = stack_of_boxes()
    simulation.step(40)
    return simulation.world


@pytest.fixture(scope="module")
def stood() -> Snapshot:
    """Return the state of such a stack."""
    return take_snapshot(standing())


@pytest.fixture
def pair(stood: Snapshot) -> tuple[World, World]:
    """Return two equal worlds."""
    worlds = stack_of_boxes().world, stack_of_boxes().world
    for world in worlds:
        restore_snapshot(world, stood)
    return worlds


def test_equal_states_have_none(pair: tuple[World, World], stood: Snapshot) -> None:
    """Worlds and snapshots in any mixture; derived columns and the place of rows do not count."""
    a, b = pair
    ghost = b.spawn(Transform())
    b.despawn(ghost)
    a.despawn(a.spawn(Transform()))
    with b.edit(Contact) as contact:
        contact.rolling[:] = 7.0
    assert first_difference(a, b) is None
    for world in (a, b):
        world.despawn(world.find("box1"))
    b.compact()
    assert state_hash(a) == state_hash(b)
    assert first_difference(a, b) is None
    assert first_difference(take_snapshot(a), b) is None
    assert first_difference(stood, stood) is None


def nudge(world: World) -> None:
    """Change one velocity by one place."""
    row = world.row(world.find("box2"))
    with world.edit(Motion) as motion:
        motion.angular[row, 1] = np.nextafter(motion.angular[row, 1], 1.0)
        motion.linear[row + 1] += 1.0  # in a later row, though in an earlier column


def test_one_place_of_one_velocity(pair: tuple[World, World], stood: Snapshot) -> None:
    """By frame, entity, component, column, element, both values and how far they are apart."""
    nudge(pair[1])
    values = [float(world[Motion].angular[world.row(world.find("box2")), 1]) for world in pair]
    expected = Difference(
        f"Motion.angular[1] of entity 'box2' is {values[0]!r} in the first and {values[1]!r} in the second, "
        "1 ulp apart",
        40,
        *values,
        entity="box2",
        component="Motion",
        column="angular",
        index=(1,),
        ulps=1,
    )
    assert first_difference(*pair) == expected
    assert first_difference(stood, pair[1]) == expected
    assert str(expected) == f"frame 40: {expected.what}"


def rename(world: World) -> None:
    """Take a name away."""
    world.detach(world.find("box3"), Name)
    world[Random].generator.normal()


def move_contact(world: World) -> None:
    """Let a contact be of somebody else."""
    with world.edit(Contact) as contact:
        contact.b[1] = world.find("box3")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda w: w.spawn(Transform(), name="extra"), "entity 'extra' lives only in the second"),
        (lambda w: w.despawn(w.find("box0")), "entity 'box0' lives only in the first"),
        (lambda w: w.attach(w.find("floor"), Motion()), "entity 'floor' has Motion only in the second"),
        (lambda w: w.detach(w.find("floor"), Collider), "entity 'floor' has Collider only in the first"),
        (rename, "entity 'box3' has Name only in the first"),
        (move_contact, "Contact.b in row 1 (floor, box0) is 'box0' in the first and 'box3' in the second"),
        (lambda w: w[Random].generator.normal(), "resource Random holds something else"),
        (lambda w: w.despawn(w.spawn()), "times that id 5 was given back: 0 in the first and 1 in the second"),
        (lambda w: setattr(w, "frame", 41), "the second is in frame 41"),
    ],
)
def test_other_differences(pair: tuple[World, World], change: Callable[[World], Any], message: str) -> None:
    """Who lives, who has what, relations with whom they hold, resources, handles, frames."""
    change(pair[1])
    assert str(first_difference(*pair)) == f"frame 40: {message}"
    assert state_hash(pair[0]) != state_hash(pair[1])


def test_a_relation_with_more_rows(pair: tuple[World, World]) -> None:
    """Told when all rows both have are equal."""
    count = pair[0].count(Contact)
    with pair[1].faces(None):
        pair[1].resize(Contact, count - 1)
    found = first_difference(*pair)
    assert found == Difference(
        f"Contact has {count} rows in the first and {count - 1} in the second",
        40,
        count,
        count - 1,
        component="Contact",
        row=count - 1,
    )


def test_another_order_of_the_same_entities() -> None:
    """The order of rows is the order of results."""
    worlds = World(), World()
    for world in worlds:
        entities = world.spawn_many(4, Transform())
        world.despawn(*entities[[1, 2]] if world is worlds[0] else entities[[2, 1]])
    assert first_difference(*worlds) is None
    worlds[1].compact()
    for world in worlds:
        world.spawn(Transform())
    assert str(first_difference(*worlds)) == "frame 0: the same entities stand in another order"
    assert state_hash(worlds[0]) != state_hash(worlds[1])


def test_nameless_and_nobody() -> None:
    """An entity without a name is shown by its number, and no entity as none."""
    worlds = World(), World()
    for k, world in enumerate(worlds):
        entities = world.spawn_many(2, Transform(position=(float(k), 0.0, 0.0)), Parent(entity=-1))
        if k:
            with world.edit(Transform) as transform, world.edit(Parent) as parent:
                transform.position[:] = 0.0
                parent.entity[1] = entities[0]
    assert str(first_difference(*worlds)) == (
        "frame 0: Parent.entity of entity '[1]' is 'none' in the first and '[0]' in the second"
    )


def test_ulps_are_counted_across_zero_and_in_every_width() -> None:
    """Zeros of either sign are one place; whole numbers, texts and NaN have no places."""
    tiny = np.nextafter(0.0, 1.0)
    for x, y, ulps in (
        (np.float64(1.0), np.nextafter(1.0, 2.0), 1),
        (tiny, -tiny, 2),
        (np.float64(-0.0), np.float64(0.0), 0),
        (np.float64(-np.inf), np.float64(np.inf), 2 * 0x7FF0000000000000),
        (np.float32(1.0), np.float32(2.0), 1 << 23),
        (np.float64(np.nan), np.float64(0.0), None),
        (np.int64(1), np.int64(2), None),
        (np.str_("a"), np.str_("b"), None),
    ):
        assert ulps_between(x, y) == ulps_between(y, x) == ulps


def test_a_sign_of_zero_is_a_difference() -> None:
    """Of no place, but another bit."""
    worlds = World(), World()
    for world, zero in zip(worlds, (0.0, -0.0), strict=True):
        world.spawn(Transform(position=(0.0, zero, 0.0)))
    assert re.match(r".*Transform.position\[1\].* is 0.0 .* -0.0 .*, 0 ulps apart$", str(first_difference(*worlds)))


def test_a_simulation_knows_no_name_of_another(stood: Snapshot) -> None:
    """A world compared with a snapshot of another kind of world."""
    assert str(first_difference(Simulation().world, stood)) == "frame 0: the second is in frame 40"
