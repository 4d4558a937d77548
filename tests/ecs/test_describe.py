"""Describe and display: what a prompt and a notebook show, whole texts."""

from __future__ import annotations

import textwrap
from xml.etree import ElementTree

import numpy as np
from faults import error

from carom.ecs import (
    Component,
    EntityError,
    ExternalForce,
    Motion,
    Parent,
    Relation,
    Transform,
    World,
    column,
    state_hash,
    tag,
)
from carom.ecs.components.flight import Flight


class Sail(Component):
    """A column of each way to be told."""

    area = column(unit="m2", doc="area of the cloth", default=2.0)
    weave = column(2, 2, unit="1", doc="how it is woven")
    reefs = column(12, unit="m", doc="height of each reef")
    maker = column(unit="1", doc="who sewed it", dtype="U8", default="")
    torn = column(unit="1", doc="has a hole", dtype="bool")
    crew = column(2, unit="1", doc="who holds the sheets", holds="entities")
    luff = column(unit="1", doc="scratch", role="cache")


class Rope(Relation):
    """Who is tied to whom."""

    a = column(unit="1", doc="first", holds="entities")
    length = column(unit="m", doc="length at rest")
    tension = column(unit="N", doc="what it pulls with", role="derived")


def boat() -> tuple[World, int]:
    """Return a world of a boat with a crew and its handle."""
    world = World()
    boat = world.spawn(
        Transform(position=(0.0, 1 / 3, -0.0)), Motion(), Flight(), tag("afloat")(), tag("racing")(), name="boat"
    )
    mate, gone = world.spawn_many(2, Transform())
    world.attach(
        boat,
        Sail(weave=[[1, 2], [3, 4]], reefs=np.arange(12) * 1e-5, maker="Lee", torn=True, crew=(mate, gone)),
    )
    world.spawn_many(10, Transform(), Parent(entity=boat))
    world.spawn(Transform(), Parent(entity=mate))
    world.frame = 4
    world.despawn(gone)
    return world, boat


def test_an_entity_in_words() -> None:
    """What differs from the default with its meaning, the rest in short; names for entities; no caches."""
    world, ship = boat()
    told = """\
        boat, entity 0
          motion, default: linear (0, 0, 0) m/s, angular (0, 0, 0) rad/s,
            linear_acceleration (0, 0, 0) m/s2, angular_acceleration (0, 0, 0) rad/s2, still 0 s,
            asleep false
          sail
            weave  ((1, 2), (3, 4))                                                    how it is woven
            reefs  (0, 1e-05, 2e-05, 3e-05, 4e-05, 5e-05, 6e-05, 7e-05, ... 4 more) m  height of each reef
            maker  'Lee'                                                               who sewed it
            torn   true                                                                has a hole
            crew   ([1], none (entity 2, generation 0, was despawned in frame 4))      who holds the sheets
            default: area 2 m2
          transform
            position  (0, 0.333333, 0) m  position of the origin in the world frame
            default: rotation (0, 0, 0, 1)
          tags: afloat, racing
          carries: [3], [4], [5], [6], [7], [8], [9], [10], ... 2 more
          derived: flight"""
    before = state_hash(world)
    assert world.describe(ship) == textwrap.dedent(told)
    assert state_hash(world) == before
    assert repr(world[ship]) == str(world[ship]) == world.describe(ship)


def test_an_entity_without_a_name_and_with_a_parent() -> None:
    """Whoever carries it stands where the column is."""
    world, _ = boat()
    told = """\
        entity 3
          parent
            entity  boat  who carries it
            default: position (0, 0, 0) m, rotation (0, 0, 0, 1)
          transform, default: position (0, 0, 0) m, rotation (0, 0, 0, 1)"""
    assert world.describe(3) == textwrap.dedent(told)
    bare = World()
    assert bare.describe(bare.spawn()) == "entity 0"


def test_an_entity_that_is_gone() -> None:
    """Asking for its description fails; showing a view of it in a debugger does not."""
    world, ship = boat()
    view = world[ship]
    world.despawn(ship)
    fate = "entity 0, generation 0, was despawned in frame 4"
    with error(EntityError, fate):
        world.describe(ship)
    assert repr(view) == fate
    assert view._repr_html_() is None


def test_a_component_of_an_entity_in_a_line() -> None:
    """As it is read at a prompt, caches included."""
    world, ship = boat()
    assert repr(world[ship].transform) == "transform: position (0, 0.333333, 0) m, rotation (0, 0, 0, 1)"
    assert repr(world[ship].racing) == "racing"


def test_worlds_tables_bundles_and_queries_in_a_line() -> None:
    """What there is, and how much of it."""
    world, _ = boat()
    counts = "afloat 1, flight 1, motion 1, name 1, parent 11, racing 1, sail 1, transform 13"
    assert repr(world) == f"World in frame 4, 13 entities: {counts}"
    assert repr(World()) == "World in frame 0, 0 entities"
    assert repr(world[Transform]) == "Transform, 13 rows: position (3) m, rotation (4)"
    assert repr(world[Rope]) == "Rope, 0 rows: a, length m, and 1 derived"
    assert repr(world[tag("racing")]) == "Racing, 1 row"
    assert repr(Transform(position=(0, 1, 0))) == "Transform(position=(0, 1, 0))"
    query = world.query(Transform, without=Parent, any_of=(Motion, Sail), optional=tag("racing"))
    assert repr(query) == "1 entity; with transform; without parent; any of motion, sail; optional racing"


def cells(html: str) -> tuple[str, list[list[str]]]:
    """Return caption and texts of a table that must be well-formed."""
    table = ElementTree.fromstring(html)
    assert table.tag == "table"
    caption, *lines = table
    return caption.text or "", [[cell.text or "" for cell in line] for line in lines]


def test_a_query_in_a_notebook() -> None:
    """Units in the header, names escaped, nothing where an entity lacks a component."""
    world = World()
    world.spawn(Transform(position=(0.0, 1.0, 0.0)), Motion(), name="<b>&'\"")
    world.spawn(Transform(), tag("racing")())
    html = world.query(Transform, optional=(ExternalForce, tag("racing")))._repr_html_()
    assert "<b>" not in html
    assert cells(html) == (
        "2 entities; with transform; optional external_force, racing",
        [
            [
                *("entity", "name", "transform.position (m)", "transform.rotation"),
                *("external_force.force (N)", "external_force.torque (N m)", "racing"),
            ],
            ["0", "<b>&'\"", "(0, 1, 0)", "(0, 0, 0, 1)", "", "", "false"],
            ["1", "", "(0, 0, 0)", "(0, 0, 0, 1)", "", "", "true"],
        ],
    )


def test_a_long_table_in_a_notebook() -> None:
    """Twenty rows and how many more."""
    world = World()
    world.spawn_many(50, Transform())
    shown = world[Transform]._repr_html_()
    assert shown is not None
    assert shown == world.query(Transform)._repr_html_()
    caption, lines = cells(shown)
    assert caption == "50 entities; with transform"
    assert [line[0] for line in lines] == ["entity", *map(str, range(20)), "... 30 more"]
    assert Transform()._repr_html_() is None


def test_a_relation_in_a_notebook() -> None:
    """Entities by name; what is derived is left out."""
    world, ship = boat()
    world.table(Rope).resize(1)
    with world.edit(Rope) as rope:
        rope.a[0], rope.length[0] = ship, 2.5
    assert cells(world[Rope]._repr_html_() or "") == ("Rope, 1 row", [["a", "length (m)"], ["boat", "2.5"]])


def test_an_entity_in_a_notebook() -> None:
    """The same as in words, column by column."""
    world, _ = boat()
    world.attach(1, Motion(linear=(1.0, 0.0, 0.0)))
    zeros = (
        "angular (0, 0, 0) rad/s, linear_acceleration (0, 0, 0) m/s2, angular_acceleration (0, 0, 0) rad/s2, "
        "still 0 s, asleep false"
    )
    assert cells(world[1]._repr_html_() or "") == (
        "entity 1",
        [
            ["component", "column", "value", "meaning"],
            ["motion", "linear", "(1, 0, 0) m/s", "velocity of the centre of mass"],
            ["motion", "default", zeros, ""],
            ["transform", "default", "position (0, 0, 0) m, rotation (0, 0, 0, 1)", ""],
            ["carries", "", "[13]", ""],
        ],
    )


def test_a_world_in_a_notebook() -> None:
    """Its tables that have rows."""
    world = World()
    world.spawn(Transform(), tag("racing")(), name="a")
    assert cells(world._repr_html_()) == (
        "World in frame 0, 1 entity",
        [
            ["table", "rows", "columns"],
            ["name", "1", "text"],
            ["racing", "1", ""],
            ["transform", "1", "position (3) m, rotation (4)"],
        ],
    )


def test_a_notebook_asks_for_what_no_entity_has() -> None:
    """IPython takes objects that answer to every name, or fail otherwise than Python does, for broken."""
    world, ship = boat()
    shown = (world, world[Transform], world[Rope], world.query(Transform), world[ship], world[ship].sail)
    assert [getattr(one, "_ipython_canary_method_should_not_exist_", None) for one in shown] == [None] * 6
