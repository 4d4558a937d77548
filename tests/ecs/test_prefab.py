"""Prefabs and tags: kinds of things under one name."""

from __future__ import annotations

import pytest
from faults import error

from carom.ecs import DeclarationError, Material, Motion, Prefab, Tag, Transform, World, state_hash, tag
from carom.ecs.component import Record


def test_the_last_value_stated_counts() -> None:
    """Of a column, not of a component: what a prefab says and nobody changes stays."""
    ball = Prefab(Material(friction=0.1, restitution=0.9), Transform(position=(0.0, 1.0, 0.0)))
    rubber = Prefab(ball, Material(restitution=0.5), Motion())
    world = World()
    made = world[world.spawn(rubber, Material(friction=0.7), Transform(rotation=(1.0, 0.0, 0.0, 0.0)))]
    assert (made.material.friction, made.material.restitution) == (0.7, 0.5)
    assert made.transform.position.tolist() == [0.0, 1.0, 0.0]
    assert made.transform.rotation.tolist() == [1.0, 0.0, 0.0, 0.0]
    plain = world[world.spawn(ball)]
    assert (plain.material.friction, plain.material.restitution) == (0.1, 0.9)
    assert Motion not in plain


def test_many_of_a_prefab_with_a_value_each() -> None:
    """As with components."""
    world = World()
    ball = Prefab(Transform(), Material(friction=0.1))
    world.spawn_many(2, ball, Transform(position=[(1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]))
    assert world[Transform].position[:2, 0].tolist() == [1.0, 2.0]
    assert world[Material].friction[:2].tolist() == [0.1, 0.1]


def test_attach_takes_prefabs() -> None:
    """What was there of these kinds is replaced."""
    world = World()
    entity = world.spawn(Transform(position=(1.0, 1.0, 1.0)))
    world.attach(entity, Prefab(Transform(), Motion()))
    assert not world[entity].transform.position.any()
    assert Motion in world[entity]


def test_a_tag_is_a_component_that_queries_know() -> None:
    """One of each name; who has it is state."""
    red = tag("red_in_prefabs")
    assert tag("red_in_prefabs") is red
    assert issubclass(red, Tag)
    assert (red.key, red.__name__) == ("red_in_prefabs", "RedInPrefabs")
    world = World()
    world.spawn_many(3, Transform())
    before = state_hash(world)
    world.attach(1, red())
    assert state_hash(world) != before
    assert world.rows(Transform, red) == slice(1, 2)
    world.detach(1, red)
    assert state_hash(world) == before


def test_names_that_look_alike_are_different_tags(monkeypatch: pytest.MonkeyPatch) -> None:
    """Underscores count."""
    monkeypatch.setattr(Record, "registry", dict(Record.registry))
    names = ["a_b", "ab", "x2_3", "x23", "x_2_3"]
    assert len({tag(name) for name in names}) == len(names)
    assert [tag(name).key for name in names] == names


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("Red Team", "tags: 'Red Team' is no tag; write lower-case words joined by _, like 'red_team'"),
        ("", "tags: '' is no tag; write lower-case words joined by _, like 'red_team'"),
        ("red_", "tags: 'red_' is no tag; write lower-case words joined by _, like 'red_team'"),
        ("transform", "tags: 'transform' is the key of the component Transform; choose another"),
    ],
)
def test_a_name_that_is_no_tag_is_refused(name: str, message: str) -> None:
    """With what to write instead."""
    with error(DeclarationError, message):
        tag(name)
