"""Prefabs take parameters, and groups are placed as one: what they hold is what one would write out by hand."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.ecs.components.joint import Joint
from carom.ecs.snapshot import state_hash
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text
from carom.worlds.condition import read_condition
from carom.worlds.terms import read_term

CART = """carom: 1
gravity: [0, 0, 0]
variables: {gap: 1 m}
prefabs:
  wheel:
    parameters: {radius: 0.1 m, width: "${radius / 2}"}
    collider: {cylinder: {radius: "${radius}", length: "${width}"}}
    body: {mass: "${radius / 1 m * 2}"}
  cart:
    parameters: {wheel: 0.2 m, speed: 0 m/s}
    entities:
      - {name: bed, collider: {box: {size: ["${gap}", 0.1, 1]}}, body: {mass: 5}, motion: {linear: ["${speed}", 0, 0]}}
      - {name: front, prefab: axle, parameters: {radius: "${wheel}"}, transform: {position: ["${gap / 2}", 0, 0]}}
      - {name: back, prefab: axle, parameters: {radius: "${wheel}"}, transform: {position: ["${-gap / 2}", 0, 0]}}
  axle:
    parameters: {radius: 0.1 m}
    entities:
      - {name: wheel, prefab: wheel, parameters: {radius: "${radius}"}, grid: {count: [1, 1, 2], spacing: 1, origin: [0, 0, -0.5]}}
      - {name: left, joint: {hinge: {a: bed, b: "wheel[0,0,0]", at: [0, 0, -0.5], axis: [0, 0, 1]}}}
      - {name: right, joint: {hinge: {a: bed, b: "wheel[0,0,1]", at: [0, 0, 0.5], axis: [0, 0, 1]}}}
entities:
  - {name: first, prefab: cart, parameters: {speed: 2 m/s}}
  - {name: second, prefab: cart, parameters: {wheel: 0.3 m}, transform: {position: [0, 0, 5], rotation: {axis: [0, 1, 0], angle: 90 deg}}}
  - {name: spare, prefab: wheel, parameters: {width: 1 cm}}
"""


def test_parameters_are_defaults_that_each_entity_may_state() -> None:
    """A parameter made of another follows it; what is not stated is the prefab's."""
    world = load_text(CART).simulation
    sizes = {
        name: world[name].collider.size[:2].tolist()
        for name in ("first.front.wheel[0,0,1]", "second.back.wheel[0,0,0]", "spare")
    }
    assert sizes == {
        "first.front.wheel[0,0,1]": [0.2, 0.1],
        "second.back.wheel[0,0,0]": [0.3, 0.15],
        "spare": [0.1, 0.01],
    }
    assert world["second.back.wheel[0,0,0]"].rigid_body.mass == 0.6


def test_a_group_is_placed_as_one() -> None:
    """Members, those of groups in it, velocities and joints are where the group's pose takes them."""
    world = load_text(CART).simulation
    half = np.sqrt(0.5)
    for name in ("bed", "front.wheel[0,0,0]", "back.wheel[0,0,1]"):
        one, other = world[f"first.{name}"].transform, world[f"second.{name}"].transform
        turned = np.add(quaternion.rotate((0.0, half, 0.0, half), one.position), (0.0, 0.0, 5.0))
        assert other.position == pytest.approx(turned, abs=1e-15)
        assert other.rotation == pytest.approx([0.0, half, 0.0, half], abs=1e-15)
    assert world["first.bed"].motion.linear.tolist() == [2.0, 0.0, 0.0]
    joint = world["second.front.left"].joint
    assert world.world.name(int(joint.a)) == "second.bed"
    assert world.world.name(int(joint.b)) == "second.front.wheel[0,0,0]"
    assert joint.anchor_a == pytest.approx([0.5, 0.0, -0.5], abs=1e-15)


def test_a_group_is_what_one_would_write_out() -> None:
    """Every word that says where something is, is of the group; those of a joint too, where it holds the world."""
    inside = """
      - {name: ball, collider: {sphere: {radius: 0.1}}, body: {mass: 1}, transform: {position: [1, 0, 0]}, motion: {angular: [0, 3, 0]}}
      - {name: hook, joint: {rope: {b: ball, anchor_a: [1, 1, 0]}}}
      - {name: pivot, joint: {generic: {b: ball, at: [1, 0, 0], x: free}}}
      - {name: slide, body: {type: kinematic}, keyframes: [{at: 0, position: [0, 0, 0]}, {at: 1, position: [0, 1, 0]}]}
      - {name: rope, chain: {end: [2, 0, 0], count: 2, radius: 0.1, b: ball}, transform: {position: [4, 0, 0]}}
"""
    outside = """
  - {name: g.ball, collider: {sphere: {radius: 0.1}}, body: {mass: 1}, transform: {position: [0, 1, 2], rotation: [0, 0, R, R]}, motion: {angular: [-3, 0, 0]}}
  - {name: g.hook, joint: {rope: {b: g.ball, anchor_a: [-1, 1, 2]}}}
  - {name: g.pivot, joint: {generic: {b: g.ball, at: [0, 1, 2], x: free, axis: [0, 1, 0], second_axis: [0, 0, 1]}}}
  - {name: g.slide, body: {type: kinematic}, transform: {rotation: [0, 0, R, R]}, keyframes: [{at: 0, position: [0, 0, 2]}, {at: 1, position: [-1, 0, 2]}]}
  - {name: g.rope, chain: {end: [0, 2, 2], count: 2, radius: 0.1, b: g.ball}, transform: {position: [0, 4, 2]}}
"""
    pose = "transform: {position: [0, 0, 2], rotation: {axis: [0, 0, 1], angle: 90 deg}}"
    group = load_text(f"carom: 1\nentities:\n  - name: g\n    {pose}\n    entities:{inside}").simulation
    flat = load_text(f"carom: 1\nentities:{outside}".replace("R", "0.7071067811865476").replace("g.", "g_")).simulation
    assert group.world.names() == [name.replace("g_", "g.") for name in flat.world.names()]
    assert columns(group) == pytest.approx(columns(flat), abs=1e-12)
    assert [group.world.name(int(row.b)) for row in (group["g.hook"].joint, group["g.rope.joint[2]"].joint)] == [
        "g.ball"
    ] * 2


PLACED = {
    Transform: ("position", "rotation"),
    Motion: ("linear", "angular"),
    Joint: ("anchor_a", "anchor_b", "frame_a", "frame_b"),
}


def columns(simulation: Simulation) -> list[float]:
    """Return all numbers that say where things are, how they move and where they hold each other."""
    world = simulation.world
    return [
        number
        for kind, names in PLACED.items()
        for name in names
        for number in np.ravel(getattr(world[kind], name)[world.row_numbers(kind)]).tolist()
    ]


def test_groups_are_copied_as_entities_are() -> None:
    """A grid of groups has one for each place, called by it."""
    text = """carom: 1
entities:
  - name: pair
    grid: {count: [2, 1, 1], spacing: 3, origin: [0, 1, 0]}
    entities:
      - {name: left, collider: {sphere: {radius: 0.1}}}
      - {name: right, collider: {sphere: {radius: 0.1}}, transform: {position: [1, 0, 0]}}
"""
    world = load_text(text).simulation.world
    assert world.names() == ["pair[0,0,0].left", "pair[0,0,0].right", "pair[1,0,0].left", "pair[1,0,0].right"]
    assert world[Transform].position[:4].tolist() == [[0, 1, 0], [1, 1, 0], [3, 1, 0], [4, 1, 0]]


def test_names_of_members_are_terms_and_patterns() -> None:
    """A dot leads to a column or to a member, whichever is there; a group's name means all of it."""
    world = load_text(CART).simulation.world
    assert read_term("first.bed.position.x", world).names == ("first.bed.position.x",)
    assert read_term("first.front.wheel[0,0,0].rigid_body.mass", world).read(world).tolist() == [[0.4]]
    assert read_term("speed(first.bed)", world).read(world).tolist() == [[2.0]]
    assert len(read_term("first.*.wheel[*].position", world).names) == 4
    verdict = read_condition("first.front.left.angle < 1 deg and speed(second.bed) < 1 m/s", world).evaluate(world)
    assert verdict.holds.all()
    forced = CART + "forces:\n  - {wind: {velocity: [1, 0, 0]}, entities: [second.front.wheel, first.bed]}\n"
    assert load_text(forced).simulation.world.names() == world.names()


def test_entities_written_one_by_one_are_those_that_are_alike_or_not() -> None:
    """Being added together changes no bit: neither rows nor values."""
    alike = "  - {{name: a{0}, collider: {{box: {{size: [1, 1, {1}]}}}}, body: {{}}, transform: {{position: [{0}, 0, 0], rotation: {{axis: [0, 1, 0], angle: {0} deg}}}}, motion: {{linear: [0, {0}, 0]}}}}\n"
    together = "carom: 1\nentities:\n" + "".join(alike.format(number, 1) for number in range(5))
    tagged = together
    for number in range(0, 5, 2):
        tagged = tagged.replace(f"name: a{number},", f"name: a{number}, visual: {{visible: true}},")
    assert state_hash(load_text(together).simulation.world) == state_hash(load_text(tagged).simulation.world)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            ("parameters: {speed: 2 m/s}", "parameters: {sped: 2 m/s}"),
            "22:46: entities.0.parameters.sped: unknown parameter; received 'sped'; accepted: wheel, speed; did you mean 'speed'?",
        ),
        (
            ("a: bed, b: \"wheel[0,0,1]\"", "a: bad, b: \"wheel[0,0,1]\""),
            ("20:39: prefabs.axle.entities.2.joint.hinge.a: unknown entity; received 'bad'; accepted: first.bed, first.front.wheel[0,0,0], "
            "first.front.wheel[0,0,1], first.front.left, first.front.right, first.back.wheel[0,0,0], first.back.wheel[0,0,1], "
            "first.back.left, first.back.right, second.bed, second.front.wheel[0,0,0], second.front.wheel[0,0,1], ..."),
        ),
        (
            ("width: 1 cm", "width: 1 kg"),
            ("7:48: prefabs.wheel.collider.cylinder.length: must be a length; received 1 kg, which is a mass; "
            "accepted: a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi"),
        ),
        (
            ("  cart:\n", "  cart:\n    body: {}\n"),
            ("10:5: prefabs.cart.body: unknown key; received 'body'; "
            "accepted: name, transform, grid, heap, line, pyramid, random, ring, stack, wall, parameters"),
        ),
        (
            ("{name: second, prefab: cart", "{prefab: cart"),
            "23:5: entities.1.name: is missing; accepted: unique name, which goes before those of its entities",
        ),
        (
            ("name: bed, coll", "name: bed, matrial: ice, coll"),
            ("12:21: prefabs.cart.entities.0.matrial: unknown key; received 'matrial'; accepted: "),
        ),
        (
            ("    entities:\n      - {name: wheel", "    entities:\n      - {name: again, prefab: cart}\n      - {name: wheel"),
            "prefabs.axle.entities.0: is a group that holds itself",
        ),
        (
            ("name: first", "name: a_name_of_forty_eight_characters_is_very_long"),
            "is too long in its group: 'a_name_of_forty_eight_characters_is_very_long.bed' exceeds 48 characters",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_group_is_told_where_it_is_written(change: tuple[str, str], message: str) -> None:
    """Once, however often it is placed."""
    assert change[0] in CART
    with pytest.raises(WorldError) as caught:
        load_text(CART.replace(*change), "w.yaml")
    assert message in str(caught.value), str(caught.value)


def test_groups_of_groups_cannot_fill_the_memory() -> None:
    """Ten in each of ten in each of ten ... are counted before they are made."""
    prefabs = "".join(
        f"  g{n}: {{entities: [{', '.join(f'{{name: m{k}, prefab: g{n + 1}}}' for k in range(10))}]}}\n"
        for n in range(12)
    )
    with pytest.raises(WorldError, match="groups of a world may have 20000 entities in all"):
        load_text(f"carom: 1\nprefabs:\n{prefabs}  g12: {{}}\nentities: [{{name: all, prefab: g0}}]\n")


def test_a_fault_of_a_prefab_is_told_once() -> None:
    """Where it is written, whether the prefab is used alone, in groups or both."""
    with pytest.raises(WorldError) as caught:
        load_text(
            """carom: 1
prefabs:
  wheel: {collider: {sphere: {radius: 1}}, body: {mass: 0}}
  cart: {entities: [{name: left, prefab: wheel}, {name: right, prefab: wheel}]}
entities:
  - {name: a, prefab: wheel}
  - {name: b, prefab: cart}
""",
            "w.yaml",
        )
    assert str(caught.value) == "w.yaml:3:51: prefabs.wheel.body.mass: must be above 0 kg; received 0"


def test_a_member_whose_name_is_near_is_told_as_such() -> None:
    """Not as a column that the group has not."""
    with pytest.raises(WorldError) as caught:
        load_text(
            """carom: 1
entities:
  - name: cart
    entities: [{name: bed, body: {mass: 1}}, {name: wheel, body: {mass: 1}}]
expect: [{never: cart.weel.position.y < 0}, {never: cart.positon.y < 0}]
""",
            "w.yaml",
        )
    first, second = str(caught.value).split("\n")
    assert first == (
        "w.yaml:5:11: expect.0.never: unknown entity; received 'cart.weel'; accepted: cart.bed, cart.wheel; "
        "did you mean 'cart.wheel'?"
    )
    assert second.startswith("w.yaml:5:46: expect.1.never: cart.bed has no such column; received 'positon'; accepted: ")
