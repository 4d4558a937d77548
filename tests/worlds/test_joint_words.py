"""Files and Python state joints in the same words, and tell what is wrong with them at once."""

# ruff: noqa: E501, UP031 - messages stand whole, as a user sees them; braces are those of YAML

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs import DeclarationError, state_hash
from carom.ecs.components.joint import FREE, LIMITED, LINE, LOCKED, SWING_TWIST, Joint
from carom.ecs.spatial import quaternion
from carom.systems.freedom import AXES
from carom.systems.joints import JOINTS
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, json_schema, load_text

FILE = """carom: 1
gravity: [0, 0, 0]
entities:
  - {name: pivot, joint: {hinge: {a: post, b: door, at: [0, 1, 0], axis: [0, 1, 0], limits: [-90 deg, 0 deg]}}}
  - {name: slide, joint: {slider: {b: door, anchor_b: [0, 0, 0], axis_b: [1, 0, 0], motor: {speed: 360 km/h, most: 2 kN}}}}
  - {name: post, transform: {position: [0, 1, 0]}}
  - {name: door, body: {mass: 2}, transform: {position: [0.5, 1, 0], rotation: {axis: [0, 0, 1], angle: 90 deg}}}
  - {name: knob, parent: {entity: door, position: [0.4, 0, 0.1]}, collider: {sphere: {radius: 0.05}}}
  - {name: line, joint: {rope: {b: knob, anchor_a: [0, 3, 0], restitution: 50 %, break_force: 30 N}}}
"""
BODIES = """carom: 1
entities:
  - {name: post}
  - {name: door, body: {mass: 1}, transform: {position: [1, 0, 0]}}
  - {name: pivot, joint: %s}
"""


def built() -> Simulation:
    """Return what FILE states, from Python: by handles and by names."""
    simulation = Simulation(gravity=(0, 0, 0))
    turn = quaternion.from_axis_angle((0, 0, 1), np.deg2rad(90.0))
    post = simulation.add(name="post", transform={"position": (0, 1, 0)})
    door = simulation.add(name="door", body={"mass": 2}, transform={"position": (0.5, 1, 0), "rotation": turn})
    knob = {"collider": {"sphere": {"radius": 0.05}}, "parent": {"entity": door, "position": (0.4, 0, 0.1)}}
    simulation.add(name="knob", **knob)
    limits = (np.deg2rad(-90.0), 0.0)
    hinge = {"a": post, "b": door, "at": (0, 1, 0), "axis": (0, 1, 0), "limits": limits}
    simulation.add(name="pivot", joint={"hinge": hinge})
    motor = {"speed": 100.0, "most": 2000.0}
    slider = {"b": "door", "anchor_b": (0, 0, 0), "axis_b": (1, 0, 0), "motor": motor}
    simulation.add(name="slide", joint={"slider": slider})
    rope = {"b": "knob", "anchor_a": (0, 3, 0), "restitution": 0.5, "break_force": 30.0}
    simulation.add(name="line", joint={"rope": rope})
    return simulation


def columns(simulation: Simulation, name: str) -> dict[str, Any]:
    """Return every column of a joint, who it holds by name."""
    view = simulation[name].joint
    found = {column: np.asarray(getattr(view, column)).tolist() for column in Joint.columns}
    names = {who: "" if found[who] < 0 else simulation.world.name(found[who]) for who in ("a", "b")}
    return found | names


@pytest.mark.parametrize("name", ["pivot", "slide", "line"])
def test_files_and_python_state_the_same(name: str) -> None:
    """To the last bit, whether who is held comes before or after, by handle or by name."""
    assert columns(load_text(FILE).simulation, name) == columns(built(), name)


def test_a_joint_is_where_bodies_are_stated() -> None:
    """Anchors and frames are what the world's point and axis are to each of the two."""
    joint = load_text(FILE).simulation["pivot"].joint
    half = math.sqrt(0.5)
    np.testing.assert_allclose(joint.anchor_a, [0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(joint.anchor_b, [0, 0.5, 0], atol=1e-15)
    np.testing.assert_allclose(joint.frame_a, [0, 0, half, half], atol=1e-15)  # x along y of the world
    np.testing.assert_allclose(joint.frame_b, [0, 0, 0, 1], atol=1e-15)  # and along x of the door
    assert joint.mode.tolist() == [LOCKED, LOCKED, LOCKED, LIMITED, LOCKED, LOCKED]
    assert (joint.lower[3], joint.upper[3]) == (-math.pi / 2, 0.0)


def test_a_joint_of_who_is_carried_holds_the_body() -> None:
    """A rope to the knob holds the door, at its origin where no anchor is stated."""
    simulation = load_text(FILE).simulation
    joint = simulation["line"].joint
    assert (joint.a, simulation.world.name(int(joint.b))) == (-1, "door")
    np.testing.assert_allclose(joint.anchor_b, [0, 0, 0], atol=1e-15)


def stated(words: str, name: str = "pivot") -> Any:
    """Return a joint between a post in the origin and a door at x = 1 m."""
    return load_text(BODIES % words).simulation[name].joint


def test_axes_of_both_sides_are_brought_together_by_the_shortest_turn() -> None:
    """The frames differ by the turn that takes one axis to the other, and by nothing about it."""
    joint = stated("{hinge: {a: post, b: door, at: [0, 0, 0], axis_a: [0, 0, 1], axis_b: [0, 1, 0]}}")
    of_a, of_b = quaternion.rotate(joint.frame_a, np.eye(3)), quaternion.rotate(joint.frame_b, np.eye(3))
    np.testing.assert_allclose(of_a[0], [0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(of_b[0], [0, 1, 0], atol=1e-15)
    across = (of_a @ [1, 0, 0], of_b @ [1, 0, 0])  # the turn is about x of the world, which it leaves alone
    np.testing.assert_allclose(*across, atol=1e-15)


def test_two_axes_are_x_and_z_of_the_frame() -> None:
    """The second is made square with the first."""
    joint = stated("{universal: {b: door, at: [0, 0, 0], axis: [0, 0, 2], second_axis: [3, 0, 1]}}")
    x, y, z = quaternion.rotate(joint.frame_a, np.eye(3))
    np.testing.assert_allclose([x, y, z], [[0, 0, 1], [0, -1, 0], [1, 0, 0]], atol=1e-15)
    assert joint.mode.tolist() == [LOCKED, LOCKED, LOCKED, FREE, LOCKED, FREE]


def test_lines_have_the_length_of_now_unless_stated() -> None:
    """A distance is locked at it, a rope at most so long; both tell it before the first step."""
    rod, rope = stated("{distance: {a: post, b: door}}"), stated("{rope: {a: post, b: door, length: 4 m}}")
    assert (rod.along, rod.mode[0], rod.lower[0], rod.position[0]) == (LINE, LOCKED, 1.0, 1.0)
    assert (rope.along, rope.mode[0], rope.lower[0], rope.upper[0], rope.position[0]) == (
        LINE,
        LIMITED,
        -math.inf,
        4,
        1,
    )


def test_springs_by_frequency_have_the_stiffness_of_the_reduced_mass() -> None:
    """Stiffness is m w^2 and damping 2 z m w with m = 1 / (1/m_a + 1/m_b); against the world m is the body's own."""
    simulation = Simulation()
    simulation.add(name="light", body={"mass": 1})
    simulation.add(name="heavy", body={"mass": 3}, transform={"position": (2, 0, 0)})
    softness = {"frequency": 0.5, "damping_ratio": 0.1}
    simulation.add(name="both", joint={"spring": {"a": "light", "b": "heavy", **softness}})
    simulation.add(name="one", joint={"spring": {"b": "heavy", "anchor_a": (0, 1, 0), "length": 3, **softness}})
    for name, mass, length in (("both", 0.75, 2.0), ("one", 3.0, 3.0)):
        joint = simulation[name].joint
        assert joint.stiffness[0] == pytest.approx(mass * math.pi**2, rel=1e-15)
        assert joint.damping[0] == pytest.approx(0.2 * mass * math.pi, rel=1e-15)
        assert (joint.target[0], joint.mode[0], bool(joint.driven[0])) == (length, FREE, True)


def test_motors_keep_a_speed_or_pull_to_a_place() -> None:
    """A speed alone is kept whatever it takes, up to the most; a target comes with its spring."""
    door = "b: door, at: [0, 0, 0], axis: [0, 0, 1]"
    by_speed, to_place = (
        stated("{hinge: {%s, motor: {%s}}}" % (door, words))
        for words in ("speed: 1 turn/s, most: 3 N m", "target: 90 deg, stiffness: 7 N m/rad")
    )
    assert (by_speed.speed[3], by_speed.damping[3], by_speed.most[3]) == (math.tau, math.inf, 3.0)
    assert (to_place.target[3], to_place.stiffness[3], to_place.damping[3]) == (math.pi / 2, 7.0, 0.0)
    assert to_place.most[3] == math.inf


def test_a_ball_bounds_swing_and_twist() -> None:
    """The cone is about its axis; a swing of 0 is at no limit, whatever the axis it is measured about."""
    joint = stated("{ball: {b: door, at: [0, 0, 0], axis: [1, 0, 0], swing: 30 deg, twist: [-10 deg, 0.2]}}")
    assert joint.about == SWING_TWIST
    assert joint.mode.tolist() == [LOCKED, LOCKED, LOCKED, LIMITED, LIMITED, FREE]
    np.testing.assert_allclose(joint.upper[3:], [0.2, math.pi / 6, 0], atol=1e-15)
    assert joint.lower[4] == -math.inf


def test_each_way_of_a_generic_joint_is_as_stated() -> None:
    """What is not stated is locked."""
    words = "x: free, z: {limits: [0, 10 cm], friction: 2 N}, rotation_y: {motor: {speed: 2, damping: 3}}"
    joint = stated("{generic: {b: door, at: [0, 0, 0], %s}}" % words)
    assert joint.mode.tolist() == [FREE, LOCKED, LIMITED, LOCKED, FREE, LOCKED]
    assert (joint.upper[2], joint.friction[2], joint.speed[4], joint.damping[4]) == (0.1, 2.0, 2.0, 3.0)
    assert joint.driven.tolist() == [False] * 4 + [True, False]


def test_a_prefab_may_hold_the_words_of_a_joint() -> None:
    """Another kind takes the place of the prefab's."""
    text = """carom: 1
prefabs: {stiff: {joint: {hinge: {at: [0, 0, 0], axis: [0, 0, 1], friction: 3}}}}
entities:
  - {name: door, body: {mass: 1}}
  - {name: one, prefab: stiff, joint: {hinge: {b: door, friction: 5}}}
  - {name: other, prefab: stiff, joint: {fixed: {b: door, at: [0, 1, 0]}}}
"""
    simulation = load_text(text).simulation
    assert [simulation[name].joint.friction[3] for name in ("one", "other")] == [5.0, 0.0]
    assert simulation["other"].joint.mode.tolist() == [LOCKED] * 6


KINDS = "ball, distance, fixed, framed, generic, hinge, rope, slider, spring, universal"
NO_ANCHOR = "states no anchor; accepted: at (world frame), anchor_a or anchor_b (frames of the bodies)"
NO_AXIS = "states no axis; accepted: axis (world frame), axis_a or axis_b (frames of the bodies)"
HINGE = "b: door, at: [0, 0, 0], axis: [0, 0, 1]"


@pytest.mark.parametrize(
    ("words", "faults"),
    [
        ("{}", ["19: entities.2.joint: must state one kind; received none; accepted: " + KINDS]),
        ("{ball: {b: door, at: [0, 0, 0]}, rope: {b: door}}", ["19: entities.2.joint: must state one kind; received ball, rope; accepted: " + KINDS]),
        ("{hinge: {b: door}}", ["27: entities.2.joint.hinge: " + NO_ANCHOR, "27: entities.2.joint.hinge: " + NO_AXIS]),
        ("{hinge: {b: dor, a: pst, at: [0, 0, 0], axis: [0, 0, 1], limits: [1, -1]}}", [
            "35: entities.2.joint.hinge.b: unknown entity; received 'dor'; accepted: post, door; did you mean 'door'?",
            "43: entities.2.joint.hinge.a: unknown entity; received 'pst'; accepted: post, door; did you mean 'post'?",
            "83: entities.2.joint.hinge.limits: the lower limit must not be above the upper; received [1, -1] rad; accepted: [lower, upper]",
        ]),
        ("{fixed: {a: post, at: [0, 0, 0]}}", ["27: entities.2.joint.fixed: holds nobody whom a force could move; a or b must have a dynamic body"]),
        ("{ball: {a: door, b: door, at: [0, 0, 0]}}", ["27: entities.2.joint.ball: holds a body to itself; a and b must be two"]),
        ("{ball: {b: door, at: [0, 0, 0], anchor_b: [0, 0, 0]}}", ["43: entities.2.joint.ball.at: is stated beside anchor_b; state one of them"]),
        ("{hinge: {b: door, at: [0, 0, 0], axis: [0, 0, 0]}}", ["59: entities.2.joint.hinge.axis: must have a direction; received [0, 0, 0]"]),
        ("{universal: {b: door, at: [0, 0, 0], axis: [0, 0, 1], second_axis: [0, 0, -3]}}", ["80: entities.2.joint.universal.second_axis: must not be along the axis"]),
        ("{universal: {b: door, at: [0, 0, 0], axis: [0, 0, 1]}}", ["27: entities.2.joint.universal.second_axis: is missing; it is fixed in b and across the axis"]),
        ("{rope: {b: door}}", ["27: entities.2.joint.rope: its end in the world is nowhere; state anchor_a"]),
        ("{distance: {b: door, anchor_a: [1, 0, 0]}}", ["27: entities.2.joint.distance: its anchors are at one place; state length, or hold a point by a ball"]),
        ("{distance: {a: post, b: door, length: 0}}", ["56: entities.2.joint.distance.length: must be above 0 m; received 0"]),
        ("{spring: {a: post, b: door}}", ["27: entities.2.joint.spring: states no stiffness; accepted: stiffness and damping, or frequency and damping_ratio"]),
        ("{spring: {a: post, b: door, stiffness: 3, damping_ratio: 1}}", ["68: entities.2.joint.spring.damping_ratio: is stated beside stiffness; state stiffness and damping, or the other two"]),
        ("{hinge: {%s, motor: {target: 1}}}" % HINGE, ["84: entities.2.joint.hinge.motor.target: a spring pulls to it: state stiffness, or speed in its place"]),
        ("{hinge: {%s, motor: {most: 1}}}" % HINGE, ["76: entities.2.joint.hinge.motor: states nothing to do; accepted: speed, target with stiffness, or damping"]),
        ("{hinge: {%s, motor: {speed: 1, stiffness: 2}}}" % HINGE, ["84: entities.2.joint.hinge.motor.speed: a damper drives to it beside a spring: state damping"]),
        ("{hinge: {%s, friction: 2 kg}}" % HINGE, ["76: entities.2.joint.hinge.friction: must be a torque; received '2 kg', which is a mass; accepted: a number in N m, or one with a unit: N m, J, mJ, kJ, MJ"]),
        ("{generic: {b: door, at: [0, 0, 0], x: fre, y: {limits: [0, 3 deg]}}}", [
            "61: entities.2.joint.generic.x: unknown word; received 'fre'; accepted: free, locked",
            "85: entities.2.joint.generic.y.limits.1: must be a length; received '3 deg', which is an angle; accepted: a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi",
        ]),
        ("{ball: {b: door, at: [0, 0, 0]}}, body: {mass: 1}", ["19: entities.2.joint: is at no place of its own; remove body"]),
        ("{ball: {b: door, at: [0, 0, 0]}}, grid: {count: [2, 1, 1], spacing: 1}", ["19: entities.2.joint: all copies would hold the same; add them one by one"]),
    ],
)  # fmt: skip
def test_faults_of_files(words: str, faults: list[str]) -> None:
    """All at once, where they stand."""
    with pytest.raises(WorldError) as caught:
        load_text(BODIES % words)
    told = [line.replace("post, door, pivot", "post, door") for line in str(caught.value).split("\n")]
    assert told == [f"world.yaml:5:{fault}" for fault in faults]


def test_what_was_reported_itself_is_not_missed() -> None:
    """A joint of an entity that is faulty says nothing about it."""
    text = "carom: 1\nentities:\n  - {name: a, body: {mass: -1}}\n  - {joint: {ball: {b: a, at: [0, 0, 0]}}}\n"
    with pytest.raises(WorldError) as caught:
        load_text(text)
    assert str(caught.value) == "world.yaml:3:22: entities.0.body.mass: must be above 0 kg; received -1"


def test_python_tells_the_same_and_adds_nothing() -> None:
    """In one line, with what only Python can state wrongly."""
    simulation = Simulation()
    simulation.add(name="door", body={"mass": 1})
    before = state_hash(simulation.world)
    for words, told in (
        (
            {"hinge": {"b": "dor", "limits": (1, -1), "axs": 3, "friction": "much", "collide": 1}},
            ("joint.hinge.axs: unknown key; received 'axs'; accepted: a, b, anchor_a, anchor_b, break_force, collide, at, break_torque, "
            "axis, axis_a, axis_b, restitution, limits, motor, friction; did you mean 'axis'?; "
            "joint.hinge.collide: must be true or false; received 1; "
            "joint.hinge.limits: the lower limit must not be above the upper; received [1, -1] rad; accepted: [lower, upper]; "
            "joint.hinge.friction: must be a number, received 'much'; "
            "joint.hinge.b: unknown entity; received 'dor'; accepted: door; did you mean 'door'?"),
        ),
        ({"hing": {}}, f"joint.hing: unknown kind of joint; received 'hing'; accepted: {KINDS}; did you mean 'hinge'?"),
        ({"rope": 3}, "joint.rope: must be a mapping; received 3; accepted: a, b, anchor_a, anchor_b, break_force, collide, length, restitution"),
        ({"ball": {"b": "door", "at": (0, 0, math.nan)}}, "joint.ball.at: must be finite, received nan"),
        ({"ball": {"b": 99, "at": (0, 0, 0)}}, "joint.ball.b: entity 99, generation 0, never was in this world"),
    ):  # fmt: skip
        with pytest.raises(DeclarationError) as caught:
            simulation.add(name="pivot", joint=words)
        assert str(caught.value) == told
    with pytest.raises(DeclarationError, match=r"^joint: all copies would hold the same; add them one by one$"):
        simulation.add_many(np.zeros((2, 3)), joint={"ball": {"b": "door", "at": (0, 0, 0)}})
    assert (simulation.world.names(), state_hash(simulation.world)) == (["door"], before)


def test_the_schema_has_every_kind_with_unit_and_meaning() -> None:
    """Made from what each declares."""
    definitions = json_schema()["$defs"]
    assert set(definitions["Joint"]["properties"]) == set(JOINTS)
    assert set(AXES) <= set(definitions["Generic"]["properties"])
    limits = definitions["Hinge"]["properties"]["limits"]
    assert (limits["description"], limits["anyOf"][0]["items"]["x-unit"]) == ("least and greatest angle (rad)", "rad")
    most = definitions["LinearMotor"]["properties"]["most"]
    assert (most["description"], most["x-unit"]) == ("greatest force (N)", "N")
    assert most["anyOf"][0]["exclusiveMinimum"] == 0.0
