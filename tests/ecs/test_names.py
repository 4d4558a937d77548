"""Names are unique, found by themselves and by patterns, and stay right however they change."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from faults import error

from carom.ecs import (
    DeclarationError,
    EntityError,
    Name,
    Phase,
    Schedule,
    Transform,
    World,
    restore_snapshot,
    system,
    take_snapshot,
)


@pytest.fixture
def world() -> World:
    """Give a floor, two balls and four drops."""
    world = World()
    world.spawn(Transform(), name="floor")
    world.spawn_many(2, Transform(), names=["ball_1", "ball_2"])
    world.spawn_many(4, names=["rain[0]", "rain[1]", "rain[1,2]", "rainbow"])
    world.spawn(Transform())
    return world


@pytest.mark.parametrize(
    ("name_it", "name"),
    [
        (lambda world: world.spawn(Transform(), name="floor"), "floor"),
        (lambda world: world.spawn_many(2, names=["new", "floor"]), "floor"),
        (lambda world: world.spawn_many(2, names=["new", "new"]), "new"),
        (lambda world: world.spawn_many(2, Name(text="new")), "new"),
        (lambda world: world.attach(1, Name(text="floor")), "floor"),
        (lambda world: setattr(world[1].name, "text", "floor"), "floor"),
    ],
    ids=["spawn", "one of many", "twice", "one for many", "attach", "edit"],
)
def test_a_name_that_is_taken_is_refused(world: World, name_it: Callable[[World], object], name: str) -> None:
    """Everybody keeps theirs."""
    before = world.names()
    with error(DeclarationError, f"two entities would be named {name!r}; names are unique, choose another"):
        name_it(world)
    assert world.names() == before
    assert world.find("ball_1") == 1
    assert world.find("floor") == 0


def test_a_name_that_is_too_long_is_refused(world: World) -> None:
    """It is not cut, which could make two of one."""
    long = "x" * 60
    with error(DeclarationError, f"Name.text holds at most 48 characters, received 60: '{long}'"):
        world.spawn(Transform(), name=long)
    world.spawn(Transform(), name="x" * 48)
    assert world.find("x" * 48)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("rain", ["rain[0]", "rain[1]", "rain[1,2]"]),
        ("rain[1]", ["rain[1]"]),
        ("rain*", ["rain[0]", "rain[1]", "rain[1,2]", "rainbow"]),
        ("*1", ["ball_1"]),
        ("ball_*", ["ball_1", "ball_2"]),
        ("*", ["floor", "ball_1", "ball_2", "rain[0]", "rain[1]", "rain[1,2]", "rainbow"]),
        ("ball_.", []),
        ("", []),
    ],
)
def test_patterns(world: World, text: str, names: list[str]) -> None:
    """Itself, all copies, or any text for a star; nothing else has a meaning."""
    assert [world.name(entity) for entity in world.find_all(text).tolist()] == names


def test_renamed(world: World) -> None:
    """By an entity, by the table, by attaching another name: the old one is free."""
    world[1].name.text = "cue"
    assert world.find("cue") == 1
    assert world.spawn(name="ball_1") == world.find("ball_1")
    with world.edit(Name) as name:
        name.text[2] = "eight"
        name.text[0] = "ground"
        assert world.find("eight") == 2
        name.text[2] = "nine"
    assert world.find("nine") == 2
    world.attach(0, Name(text="table"))
    world[0].name.text = "table"
    assert world.find("table") == 0
    for gone in ("eight", "ground", "floor", "ball_2"):
        with pytest.raises(EntityError, match=f"^no entity is named '{gone}'"):
            world.find(gone)


def test_renamed_by_a_system(world: World) -> None:
    """Systems write the column itself; found is what it says."""

    @system(writes=(Name,))
    def swap(world: World, dt: float) -> None:
        text = world[Name].text
        text[1], text[2] = text[2], text[1]

    assert world.find("ball_1") == 1
    Schedule(Phase("only", swap)).run(world, 0.1, checked=True)
    assert (world.find("ball_1"), world.find("ball_2")) == (2, 1)


def test_names_come_and_go_with_entities_and_components(world: World) -> None:
    """And with what is restored."""
    saved = take_snapshot(world)
    world.detach(1, Name)
    world.despawn(2)
    world.compact()
    assert world.name(1) == "[1]"
    world.spawn_many(2, names=["ball_1", "ball_2"])
    assert world.find("ball_1") > 2
    restore_snapshot(world, saved)
    assert (world.find("ball_1"), world.find("ball_2"), world.name(1)) == (1, 2, "ball_1")


def test_an_empty_text_is_no_name(world: World) -> None:
    """Any number of entities may have none."""
    world.spawn_many(2, Name())
    world[1].name.text = ""
    assert world.names() == ["floor", "ball_2", "rain[0]", "rain[1]", "rain[1,2]", "rainbow"]
    assert world.name(1) == "[1]"
    with error(EntityError, "no entity is named ''"):
        world.find("")
