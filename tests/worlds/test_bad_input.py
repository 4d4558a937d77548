"""Whatever is wrong with a file is told in whole sentences, all of it at once, where it stands."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import pytest
from refusals import LENGTH, messages

MASS = "a number in kg, or one with a unit: kg, g, mg, t, lb, oz"
ROTATIONS = "[x, y, z, w] of length 1 within 1 %, {axis, angle}, {euler, order} or {look_at}"
SHAPES = "box, capsule, cone, convex, cylinder, ellipsoid, height_field, mesh, plane, point, sphere"
BALL = "entities:\n  - {name: ball, "


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("entities: [", "w.yaml:3:1: is not YAML: while parsing a flow node did not find expected node content"),
        ("seed: 1\nseed: 2\n", "w.yaml:3:1: seed: duplicate key 'seed', first at line 2"),
        ("seed: yes\n", "w.yaml:2:1: seed: must be a whole number; received 'yes'; accepted: 0 or more"),
        ("entities: {}\n", "w.yaml:2:1: entities: must be a list; received a mapping of nothing; accepted: [...], or lines that begin with -"),
        (
            BALL + "body: 3}\n",
            ("w.yaml:3:18: entities.0.body: must be a mapping; received 3; accepted: type, mass, inertia, "
            "principal_axes, center_of_mass, gravity_scale, linear_damping, angular_damping, continuous, sleeps, locked"),
        ),
        (
            BALL + "body: {friction: 0.5}}\n",
            ("w.yaml:3:25: entities.0.body.friction: unknown key; received 'friction'; accepted: type, mass, inertia, "
            "principal_axes, center_of_mass, gravity_scale, linear_damping, angular_damping, continuous, sleeps, "
            "locked; material has it"),
        ),
        (
            BALL + "parent: {entity: b, mass: 3}}\n",
            ("w.yaml:3:38: entities.0.parent.mass: unknown key; received 'mass'; accepted: entity, position, rotation; "
            "body and emitter have it"),
        ),
        (
            BALL + "grid: {count: 4, spacing: 1}}\n",
            "w.yaml:3:25: entities.0.grid.count: must be a list; received 4; accepted: a list of 3",
        ),
        (
            "events: [{at: 1 s, despawn: ball}]\n",
            "w.yaml:2:20: events.0.despawn: must be a list; received 'ball'; accepted: ['ball']",
        ),
        ("step: {dt: 0}\n", "w.yaml:2:8: step.dt: must be above 0 s; received 0"),
        ("step: {dt: -1/60}\n", "w.yaml:2:8: step.dt: must be above 0 s; received '-1/60'"),
        (
            "step: {integrator: eulr}\n",
            "w.yaml:2:8: step.integrator: unknown word; received 'eulr'; accepted: euler, semi_implicit, verlet",
        ),
        ("gravity: [0, -9.81]\n", "w.yaml:2:1: gravity: must be a list of 3 numbers; received [0, -9.81]; accepted: numbers in m/s2"),
        (
            BALL + "body: {mass: -1 kg}, collider: {point: {}}}\n",
            "w.yaml:3:25: entities.0.body.mass: must be above 0 kg; received '-1 kg'",
        ),
        (
            BALL + "body: {mass: 1, linear_damping: -1}}\n",
            "w.yaml:3:34: entities.0.body.linear_damping: must be at least 0 1/s; received -1",
        ),
        (
            BALL + "body: {mass: 1, locked: [rotation_w]}}\n",
            ("w.yaml:3:43: entities.0.body.locked.0: unknown word; received 'rotation_w'; "
            "accepted: x, y, z, rotation_x, rotation_y, rotation_z"),
        ),
        (
            BALL + "body: {mass: 1, locked: [x]}, motion: {linear: [2, 0, 0]}}\n",
            ("w.yaml:3:57: entities.0.motion.linear: must be 0 along x, which is locked, received 2 m/s; "
            "take x out of body.locked, or the velocity out of motion"),
        ),
        (
            "dimensions: 2\n" + BALL + "body: {mass: 1}, motion: {angular: [0, 1, 0]}}\n",
            ("w.yaml:4:44: entities.0.motion.angular: must be 0 about y with dimensions: 2, received 1 rad/s; "
            "bodies keep to the plane z = const"),
        ),
        (
            "dimensions: 2\n" + BALL + "body: {type: kinematic}, keyframes: [{at: 0}, {at: 1, position: [0, 0, 1]}]}\n",
            "w.yaml:4:43: entities.0.keyframes: must keep to one z and turn about z only with dimensions: 2",
        ),
        ("dimensions: 4\n", "w.yaml:2:1: dimensions: must be a whole number; received 4; accepted: 2 to 3"),
        (
            "dimensions: 2\nup: z\n",
            ("w.yaml:3:1: up: gravity must lie in the plane of dimensions: 2; "
            "received [0.0, 0.0, -9.81]; accepted: [x, y, 0]"),
        ),
        (
            "dimensions: 2\ngravity: [0, -1, 1]\n",
            ("w.yaml:3:1: gravity: gravity must lie in the plane of dimensions: 2; "
            "received [0.0, -1.0, 1.0]; accepted: [x, y, 0]"),
        ),
        (
            BALL + "collider: {sphere: {radius: 0}}}\n",
            "w.yaml:3:38: entities.0.collider.sphere.radius: must be above 0 m; received 0",
        ),
        (
            BALL + "collider: {sphere: {}}}\n",
            "w.yaml:3:29: entities.0.collider.sphere.radius: is missing; accepted: radius (m)",
        ),
        (
            BALL + "body: {mas: 1}}\n",
            ("w.yaml:3:25: entities.0.body.mas: unknown key; received 'mas'; "
            "accepted: type, mass, inertia, principal_axes, center_of_mass, gravity_scale, linear_damping, angular_damping, continuous, sleeps, locked; did you mean 'mass'?"),
        ),
        (
            BALL + "collider: {shpere: {radius: 1}}}\n",
            (f"w.yaml:3:29: entities.0.collider.shpere: unknown key; received 'shpere'; accepted: {SHAPES}, position, "
            "rotation, sensor, surface_velocity, layer, collides_with, on_enter; did you mean 'sphere'?"),
        ),
        (
            BALL + "collider: {}}\n",
            f"w.yaml:3:18: entities.0.collider: state exactly one shape of {SHAPES}; received none",
        ),
        (
            BALL + "transform: {rotation: [0, 0, 0, 0]}}\n",
            ("w.yaml:3:30: entities.0.transform.rotation: is a zero quaternion; "
            f"received [0.0, 0.0, 0.0, 0.0] of length 0; accepted: {ROTATIONS}"),
        ),
        (
            BALL + "transform: {rotation: [0, 0, 0, 1.02]}}\n",
            ("w.yaml:3:30: entities.0.transform.rotation: is not a unit quaternion; "
            f"received [0.0, 0.0, 0.0, 1.02] of length 1.02; accepted: {ROTATIONS}"),
        ),
        (
            "materials: {ivory: {}}\n" + BALL + "material: ivry}\n",
            "w.yaml:4:18: entities.0.material: unknown material; received 'ivry'; accepted: ivory; did you mean 'ivory'?",
        ),
        (
            "prefabs: {ball: {}}\n" + BALL + "prefab: bal}\n",
            "w.yaml:4:18: entities.0.prefab: unknown prefab; received 'bal'; accepted: ball; did you mean 'ball'?",
        ),
        (
            "prefabs: {a: {prefab: a}}\n",
            "w.yaml:2:15: prefabs.a.prefab: extends itself; received 'a'",
        ),
        (
            BALL + "collider: {sphere: {radius: 1 mtr}}}\n",
            f"w.yaml:3:38: entities.0.collider.sphere.radius: unknown unit 'mtr'; received '1 mtr'; accepted: {LENGTH}",
        ),
        (
            BALL + "collider: {sphere: {radius: 1 kg}}}\n",
            ("w.yaml:3:38: entities.0.collider.sphere.radius: must be a length; "
            f"received '1 kg', which is a mass; accepted: {LENGTH}"),
        ),
        (
            BALL + "body: {mass: 1}}\n  - {name: ball}\n",
            "w.yaml:4:6: entities.1.name: two entities of one name; received 'ball', also of entities.0 at line 3",
        ),
        (
            BALL + "motion: {linear: [1, 0, 0]}}\n",
            "w.yaml:3:18: entities.0.motion: a static entity does not move; give it a body",
        ),
        (
            BALL + "body: {}, collider: {point: {}}}\n",
            ("w.yaml:3:18: entities.0.body.mass: must be finite and above 0 kg, received 0; "
            "state mass, or a shape with volume"),
        ),
        (
            "layers: {pocket: [bal]}\n",
            "w.yaml:2:1: layers: unknown layer 'bal'; the layers are none, default, pocket",
        ),
        (
            "forces: [{wnd: {velocity: [1, 0, 0]}}]\n",
            ("w.yaml:2:11: forces.0.wnd: unknown key; received 'wnd'; accepted: attraction, buoyancy, constant_push, linear_drag, "
            "quadratic_drag, gravity_well, lift, magnus, mutual_gravitation, thruster, vortex, wind, entities, region, layers, during; "
            "did you mean 'wind'?"),
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, entities: [ball]}]\n",
            "w.yaml:2:51: forces.0.entities.0: unknown entity; received 'ball'; accepted: none is defined",
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, region: {box: {size: 1}, sphere: {radius: 1}}}]\n",
            ("w.yaml:2:55: forces.0.region.box.size: must be a list of 3 numbers; received 1; accepted: numbers in m"),
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, region: {box: {size: [1, 1, 1]}, sphere: {radius: 1}}}]\n",
            "w.yaml:2:40: forces.0.region: must state exactly one shape, box or sphere",
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, layers: [default, dust]}]\n",
            ("w.yaml:2:58: forces.0.layers.1: unknown layer; received 'dust'; accepted: none, default"),
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, during: 2 s}]\n",
            ("w.yaml:2:40: forces.0.during: is no time window; received '2 s'; "
            "accepted: [0.5 s, 2 s], or [0.5 s, end] for good"),
        ),
        (
            "forces: [{wind: {velocity: [1, 0, 0]}, during: [2 s, 1 s]}]\n",
            "w.yaml:2:40: forces.0.during: must end after it starts; received ['2 s', '1 s']",
        ),
        ("run: {}\n", "w.yaml:2:1: run: must state one end; received none; accepted: duration, frames or until"),
        (
            "cameras: {main: {position: [1, 1, 1]}}\nrender: {camera: man}\n",
            "w.yaml:3:10: render.camera: unknown camera; received 'man'; accepted: main; did you mean 'main'?",
        ),
    ],
)  # fmt: skip
def test_one_fault_one_line(text: str, message: str) -> None:
    """Each wrong word is told in one line: where, what, what was received and what is accepted."""
    assert messages(text) == [message]


def test_nan_and_infinity_are_refused_everywhere() -> None:
    """No number of a file may be NaN or infinite, however it is written."""
    text = """gravity: [0, .inf, 0]
seed: .nan
entities:
  - {name: ball, body: {mass: 1e999}, collider: {sphere: {radius: 1e999 m}}, transform: {position: [.nan, 0, 0]}}
expect:
  - {at: .inf, ball.position: {is: [0, 0, 0], within: 1}}
  - {at: 0, ground.position: {is: [0, 0, 0], within: .nan}}
"""
    assert messages(text + "  - {at: 0, ball.position: {is: [0, -.inf, 0], within: 1}}\n") == [
        "w.yaml:2:14: gravity.1: must be finite; received inf; accepted: a number in m/s2, or one with a unit: m/s2, ft/s2",
        "w.yaml:3:1: seed: must be a whole number; received nan; accepted: 0 or more",
        f"w.yaml:5:25: entities.0.body.mass: must be finite; received inf; accepted: {MASS}",
        f"w.yaml:5:59: entities.0.collider.sphere.radius: must be finite; received '1e999 m'; accepted: {LENGTH}",
        f"w.yaml:5:101: entities.0.transform.position.0: must be finite; received nan; accepted: {LENGTH}",
        (
            "w.yaml:7:6: expect.0.at: must be finite; received inf; accepted: a number in s, or one with a unit: "
            "s, ms, us, min, h, d"
        ),
        "w.yaml:8:13: expect.1.ground.position: unknown entity; received 'ground'; accepted: none is defined",
    ]
    within = (
        "entities: [{name: ball, body: {mass: 1}}]\nexpect: [{at: 0, ball.position: {is: [0, .nan, 0], within: 1}}]\n"
    )
    assert messages(within) == [
        f"w.yaml:3:18: expect.0.ball.position: must be finite; received nan; accepted: {LENGTH}"
    ]


def test_everything_wrong_with_keyframes_is_told_at_once() -> None:
    """Times, poses, the body and the words beside them, each where it stands."""
    text = """entities:
  - name: lift
    collider: {box: {size: [1, 1, 1]}}
    body: {mass: 1}
    motion: {linear: [0, 1, 0]}
    transform: {position: [1, 0, 0]}
    grid: {count: [2, 1, 1], spacing: 1}
    keyframes: [{at: 0 s, position: [0, 0, 0]}, {at: 2 s, position: [0, 3, 0]}, {at: 2 s}]
  - {name: wall, keyframes: [{at: 0}]}
  - name: table
    body: {type: kinematic}
    keyframes: {frames: [{at: 0, position: [0, 0, 0]}, {at: 1 s, position: [1, 0, 0]}], repeat: loop}
  - {name: lever, body: {type: kinematic}, keyframes: [{at: -1 s}, {at: 1 m, place: [0, 0, 0]}]}
"""
    closed = "must have the pose of the first, for the path to begin anew there; close it, or state ping_pong"
    assert messages(text) == [
        "w.yaml:5:5: entities.0.body.type: only a kinematic body follows keyframes; received dynamic",
        "w.yaml:6:5: entities.0.motion: keyframes say how it moves; remove motion or keyframes",
        "w.yaml:7:17: entities.0.transform.position: the first keyframe says where it is; remove one of the two",
        "w.yaml:8:5: entities.0.grid: all copies would go the same way; remove grid or keyframes",
        "w.yaml:9:82: entities.0.keyframes.2.at: must be later than the keyframe before, 2 s; received 2 s",
        "w.yaml:10:18: entities.1.keyframes: must be two or more; received 1",
        "w.yaml:10:18: entities.1.keyframes: only a kinematic body follows keyframes; give it body: {type: kinematic}",
        f"w.yaml:13:56: entities.2.keyframes.frames.1: {closed}",
        "w.yaml:14:57: entities.3.keyframes.0.at: must be at least 0 s; received '-1 s'",
        "w.yaml:14:69: entities.3.keyframes.1.at: must be a time; received '1 m', which is a length; accepted: a number in s, or one with a unit: s, ms, us, min, h, d",
        "w.yaml:14:78: entities.3.keyframes.1.place: unknown key; received 'place'; accepted: at, position, rotation",
    ]


def test_all_faults_at_once_in_order_of_position() -> None:
    """One run tells everything, and does not complain of names whose entity it complained of."""
    text = """step: {dt: 0}
entities:
  - {name: left, body: {mass: -1}, collider: {sphere: {radius: 0}}}
  - {name: right, material: ivory, collider: {box: {size: [1, 1, -1]}}}
  - {name: middle, material: ivory}
entites: []
expect:
  - never: left.position.y < 0
  - never: lft.position.y < 0
"""
    assert [line.partition("; ")[0] for line in messages(text)] == [
        "w.yaml:2:8: step.dt: must be above 0 s",
        "w.yaml:4:25: entities.0.body.mass: must be above 0 kg",
        "w.yaml:4:56: entities.0.collider.sphere.radius: must be above 0 m",
        "w.yaml:5:66: entities.1.collider.box.size.2: must be above 0 m",
        "w.yaml:6:20: entities.2.material: unknown material",
        "w.yaml:7:1: entites: unknown key",
        "w.yaml:10:5: expect.1.never: unknown entity",
    ]


def test_a_fault_of_a_prefab_is_told_once_and_there() -> None:
    """A prefab is checked where it stands, not where it is used."""
    text = "prefabs:\n  ball: {body: {mass: -1}}\nentities:\n  - {name: a, prefab: ball}\n  - {name: b, prefab: ball}\n"
    assert messages(text) == ["w.yaml:3:17: prefabs.ball.body.mass: must be above 0 kg; received -1"]
