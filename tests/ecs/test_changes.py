"""Changed since a mark: exactly who came or holds other bits, found by entity."""

from __future__ import annotations

import numpy as np
import pytest
from faults import error

from carom.ecs import AccessError, Motion, Transform, World, restore_snapshot, tag, take_snapshot

RED = tag("red_in_changes")


@pytest.fixture
def world() -> World:
    """Give five entities in a row, the first three of which move."""
    world = World()
    world.spawn_many(5, Transform())
    for row in range(3):
        world.attach(row, Motion(linear=(0.0, float("nan"), 1.0)))
    return world


def changed(world: World, mark: int, *kinds: type) -> list[int]:
    """Return the entities that changed."""
    rows = world.row_numbers(*kinds, changed_since=mark)
    found = world.rows(*kinds, changed_since=mark)
    assert np.r_[found].tolist() == rows.tolist()
    return list(world.entities(rows).tolist())


def test_exactly_those_that_hold_something_else(world: World) -> None:
    """Writing what is there already is no change; marks that are newer know less."""
    first = world.mark(Transform)
    assert changed(world, first, Transform) == []
    world[3].transform.position = (0.0, 1.0, 0.0)
    world[1].transform.position = (0.0, 0.0, 0.0)
    second = world.mark()
    world[4].transform.rotation[0] = 1e-300
    assert changed(world, first, Transform) == [3, 4]
    assert changed(world, second, Transform) == [4]
    assert world.rows(Transform, changed_since=second) == slice(4, 5)
    assert changed(world, world.mark(), Transform) == []


@pytest.mark.parametrize(
    ("value", "changes"), [(float("nan"), False), (0.0, True), (-0.0, True)], ids=["NaN again", "a zero", "minus zero"]
)
def test_bits_are_compared(world: World, value: float, changes: bool) -> None:
    """NaN is what it was; -0.0 is not 0.0."""
    mark = world.mark(Motion)
    with world.edit(Motion) as motion:
        motion.linear[1, 1] = value
    assert changed(world, mark, Motion) == ([1] if changes else [])
    between = world.mark()
    with world.edit(Motion) as motion:
        motion.linear[0, 0] = -0.0
    assert changed(world, between, Motion) == [0]


def test_whoever_comes_has_changed_also_in_the_row_of_another(world: World) -> None:
    """With the same values too; whoever went is not asked for."""
    mark = world.mark(Transform)
    world.despawn(2)
    assert changed(world, mark, Transform) == []
    new = world.spawn(Transform())
    assert world.row(new) == 2
    assert changed(world, mark, Transform) == [new]


def test_a_component_that_comes_is_a_change(world: World) -> None:
    """Of that component, not of others; a tag can be watched as well."""
    mark = world.mark(Transform, Motion, RED)
    world.attach(4, Motion())
    world.attach(0, RED())
    assert changed(world, mark, Motion) == [4]
    assert changed(world, mark, Transform) == []
    assert changed(world, mark, RED) == [0]
    assert changed(world, mark, Transform, Motion) == [4]
    world.detach(4, Motion)
    world.attach(4, Motion())
    assert changed(world, world.mark(), Motion) == []


def test_to_be_moved_is_no_change(world: World) -> None:
    """Neither by compact, nor by a snapshot from before; what the snapshot brings back otherwise is."""
    world.despawn(1)
    saved = take_snapshot(world)
    mark = world.mark(Transform)
    world.compact()
    assert changed(world, mark, Transform) == []
    world[4].transform.position = (9.0, 0.0, 0.0)
    after = world.mark()
    restore_snapshot(world, saved)
    assert changed(world, after, Transform) == [4]


def test_growth_is_no_change(world: World) -> None:
    """Only those who came with it."""
    mark = world.mark(Transform)
    made = world.spawn_many(100, Transform())
    assert changed(world, mark, Transform) == made.tolist()


def test_nobody_watched(world: World) -> None:
    """What was watched too late is told like what was not watched at all."""
    early = world.mark(Transform)
    late = world.mark(Motion)
    assert changed(world, late, Motion) == []
    for mark, kinds, listed in ((early, (Motion,), "Motion"), (early, (Transform, Motion, RED), None)):
        names = listed or f"Motion, {RED.__name__}"
        message = f"nobody watched {names} at mark {mark}; take the mark with world.mark({names}) before things change"
        with error(AccessError, message):
            world.rows(*kinds, changed_since=mark)


def test_a_mark_in_an_empty_world() -> None:
    """The first that comes is a change."""
    world = World()
    mark = world.mark(Transform)
    assert world.rows(Transform, changed_since=mark) == slice(0, 0)
    world.spawn(Transform())
    assert world.rows(Transform, changed_since=mark) == slice(0, 1)
