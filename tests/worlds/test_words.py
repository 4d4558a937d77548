"""The words of a file become the world they say."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Collider, Combine, RigidBody, Transform, Visual
from carom.ecs.components.path import Repeat
from carom.ecs.relations.keyframe import Keyframe
from carom.systems.forces.law import Forces
from carom.systems.forces.region import Region, SphereRegion
from carom.systems.layers import Layers
from carom.worlds import LoadedWorld, WorldError, load_text

QUARTER = math.sqrt(0.5)


def load(text: str, **options: object) -> LoadedWorld:
    """Return the world of a text without its header."""
    return load_text("carom: 1\n" + text, **options)  # type: ignore[arg-type]


def test_an_empty_world_has_the_defaults() -> None:
    """A header alone makes a world with the defaults of Settings."""
    world = load("")
    settings = world.simulation.settings
    assert (settings.dt, settings.substeps, settings.gravity) == (1 / 60, 4, (0.0, -9.81, 0.0))
    assert (settings.integrator, settings.collision, settings.seed) == ("verlet", "auto", 0)
    assert (world.run.frames, world.up, world.expectations) == (300, (0.0, 1.0, 0.0), [])


def test_options_override_the_file() -> None:
    """What the caller states wins, None states nothing."""
    text = "seed: 3\ncollision: auto\nstep: {dt: 1/240, integrator: verlet}\nrun: {duration: 1 s}\n"
    world = load(text, dt=0.01, integrator="euler", collision="fcl", seed=7)
    settings = world.simulation.settings
    assert (settings.dt, settings.integrator, settings.collision, settings.seed) == (0.01, "euler", "fcl", 7)
    assert world.run.frames == 100
    assert load(text, dt=None).simulation.settings.dt == 1 / 240


def test_up_z_turns_gravity_cameras_and_display_but_not_data() -> None:
    """Positions stay as written."""
    world = load("up: z\nentities: [{name: a, transform: {position: [1, 2, 3]}, collider: {point: {}}}]\n")
    assert world.simulation.settings.gravity == (0.0, 0.0, -9.81)
    assert world.up == (0.0, 0.0, 1.0)
    assert list(world.simulation["a"].transform.position) == [1, 2, 3]
    assert load("up: z\ngravity: [0, -1, 0]\n").simulation.settings.gravity == (0.0, -1.0, 0.0)


def test_an_entity_lies_over_its_prefab_and_that_over_its_own() -> None:
    """The nearer word wins; rotations and shapes are taken whole."""
    world = load("""
materials: {ivory: {friction: 0.1, restitution: 0.9}}
prefabs:
  thing: {material: {friction: 0.2, density: 500}, transform: {rotation: {axis: [0, 1, 0], angle: 90 deg}}}
  ball: {prefab: thing, collider: {sphere: {radius: 1}, layer: none}, body: {mass: 2}}
entities:
  - {name: a, prefab: ball}
  - {name: b, prefab: ball, body: {mass: 3}, collider: {box: {size: [1, 1, 1]}}, material: {friction: 0.3}}
  - {name: c, prefab: ball, transform: {rotation: {euler: [0, 0, 90 deg]}}, material: ivory}
""").simulation
    a, b, c = (world[name] for name in "abc")
    assert (a.rigid_body.mass, a.collider.bound_radius, a.material.friction, a.collider.layer) == (2, 1, 0.2, 0)
    assert (b.rigid_body.mass, b.collider.bound_radius, b.material.friction, b.material.density) == (3, 0, 0.3, 500)
    assert b.collider.layer == 0
    np.testing.assert_allclose(a.transform.rotation, [0, QUARTER, 0, QUARTER], atol=1e-15)
    np.testing.assert_allclose(c.transform.rotation, [0, 0, QUARTER, QUARTER], atol=1e-15)
    assert (c.material.friction, c.material.restitution) == (0.1, 0.9)


def test_a_grid_places_named_copies() -> None:
    """Copies stand at origin plus spacing times index and are found by name and pattern."""
    world = load("""
entities:
  - name: rain
    grid: {count: [4, 1, 2], spacing: [25 cm, 1, 0.5], origin: [0, 3, 0]}
    transform: {position: [10, 0, 0]}
    collider: {sphere: {radius: 0.1}}
forces:
  - wind: {velocity: [1, 0, 0]}
    entities: ["rain[*,0,1]"]
    region: {sphere: {radius: 3 ft, position: [0, 1, 0]}}
    layers: [default, none]
    during: [500 ms, end]
""").simulation.world
    assert world.names()[:3] == ["rain[0,0,0]", "rain[0,0,1]", "rain[1,0,0]"]
    assert list(world[world.find("rain[3,0,1]")].transform.position) == [10.75, 3, 0.5]
    (((_, reach),),) = world[Forces].entries.values()
    assert [world.name(entity) for entity in reach.entities or ()] == [f"rain[{i},0,1]" for i in range(4)]
    assert reach.region == Region(sphere=SphereRegion(0.9144, (0.0, 1.0, 0.0)))
    assert (reach.layers, reach.during) == ((1, 0), (0.5, math.inf))


def test_jitter_is_drawn_from_the_seed_in_the_order_of_the_file() -> None:
    """The same seed gives the same places, bit by bit."""
    place = "transform: {position: [1, 1, 1], jitter: [0, 1 mm, 1]}"
    text = f"seed: 5\nentities: [{{name: a, {place}, grid: {{count: [9, 1, 1], spacing: 0}}}}]\n"
    first, same, other = (load(text, seed=seed).simulation.world[Transform].position[:9] for seed in (None, 5, 6))
    generator = np.random.Generator(np.random.PCG64(5))
    expected = [np.ones(3) + generator.uniform([0, -0.001, -1], [0, 0.001, 1]) for _ in range(9)]
    np.testing.assert_array_equal(first, expected)
    np.testing.assert_array_equal(first, same)
    assert (first[:, 1:] != other[:, 1:]).all()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("[0, 0, 0, 1]", [0, 0, 0, 1]),
        ("[0, 0.707, 0, 0.707]", [0, QUARTER, 0, QUARTER]),
        ("{axis: [0, 3, 0], angle: 90 deg}", [0, QUARTER, 0, QUARTER]),
        ("{euler: [90 deg, 0, 90 deg]}", [0.5, -0.5, 0.5, 0.5]),
        ("{euler: [90 deg, 0, 90 deg], order: xyz}", [0.5, 0.5, 0.5, 0.5]),
        ("{look_at: [-2, 0, 0]}", [0, QUARTER, 0, QUARTER]),
    ],
)
def test_rotations(words: str, expected: list[float]) -> None:
    """All four forms give the same quaternions."""
    rotation = load(f"entities: [{{name: a, transform: {{rotation: {words}}}}}]").simulation["a"].transform.rotation
    np.testing.assert_allclose(rotation, expected, atol=1e-12)


def test_bodies_colliders_and_visuals() -> None:
    """Words of bodies, colliders and visuals arrive in their columns."""
    world = load("""
layers: {ball: [cloth, ball], cloth: all, pocketed: []}
entities:
  - {name: ball, collider: {sphere: {radius: 57.15/2 mm}, layer: ball}, body: {mass: 170 g}, visual: {color: "#ff8000"}}
  - {name: lift, collider: {box: {size: [1, 1, 1]}}, body: {type: kinematic}, motion: {angular: [0, 60 rpm, 0]}}
  - name: pocket
    collider: {cylinder: {radius: 6 cm, length: 0.1}, sensor: true, on_enter: {layer: pocketed}, collides_with: [ball]}
  - {name: ghost, collider: {point: {}}, visual: false}
  - {name: lamp, visual: {sphere: {radius: 0.1}, color: gold, visible: false}}
  - {name: heavy, collider: {box: {size: [1, 1, 1]}}, body: {}, material: {density: 2 g/cm3}}
  - {name: belt, collider: {box: {size: [9, 1, 1]}, surface_velocity: [3.6 km/h, 0, 0]}}
""").simulation
    layers = world.world[Layers]
    assert world["ball"].rigid_body.mass == 0.17
    assert world["ball"].collider.size[0] == 0.05715 / 2
    assert world["ball"].collider.mask == layers.bit("cloth") | layers.bit("ball")
    np.testing.assert_allclose(world["ball"].visual.color, [1, 128 / 255, 0, 1])
    assert world["lift"].rigid_body.inverse_mass == 0
    assert world["lift"].motion.angular[1] == 2 * math.pi
    assert (world["pocket"].collider.sensor, world["pocket"].collider.enter_layer) == (True, layers.bit("pocketed"))
    assert world["pocket"].collider.mask == layers.bit("ball")
    present = world.world.table(Visual).present
    assert not present[world.world.row(world.world.find("ghost"))]
    assert not world["lamp"].visual.visible
    assert not world.world.table(Collider).present[world.world.row(world.world.find("lamp"))]
    assert world["heavy"].rigid_body.mass == pytest.approx(2000)
    assert world["belt"].collider.surface_velocity.tolist() == [1, 0, 0]
    assert world.world.count(RigidBody) == 3


def test_keyframes() -> None:
    """A list, or with how it repeats; times and rotations are in any of their forms."""
    world = load("""
entities:
  - name: lift
    body: {type: kinematic}
    transform: {position: [0, 1, 0]}
    keyframes: [{at: 0 s}, {at: 1500 ms, position: [0, 3 m, 0]}, {at: 2, rotation: {axis: [0, 1, 0], angle: 90 deg}}]
  - name: shuttle
    body: {type: kinematic}
    keyframes: {frames: [{at: 0, position: [0, 0, 0]}, {at: 1 s, position: [1, 0, 0]}], repeat: ping_pong}
""").simulation
    keyframe = world.world[Keyframe]
    assert keyframe.at[: keyframe.count].tolist() == [0.0, 1.5, 2.0, 0.0, 1.0]
    assert keyframe.position[: keyframe.count, 1].tolist() == [1.0, 3.0, 3.0, 0.0, 0.0]
    np.testing.assert_allclose(keyframe.rotation[2], [0, math.sqrt(0.5), 0, math.sqrt(0.5)], atol=1e-12)
    assert [world[name].path.repeat for name in ("lift", "shuttle")] == [Repeat.ONCE, Repeat.PING_PONG]
    world.step(90)
    np.testing.assert_allclose(world["lift"].transform.position, [0, 3, 0], atol=1e-12)
    np.testing.assert_allclose(world["shuttle"].transform.position, [0.5, 0, 0], atol=1e-12)


def test_bodies_say_what_gravity_and_rest_are_to_them() -> None:
    """Gravity's scale and the dampings are columns of the body."""
    words = "{mass: 1, gravity_scale: 50 %, linear_damping: 2 1/s, angular_damping: 3 Hz}"
    body = load(f"entities: [{{name: a, body: {words}}}, {{name: b, body: {{mass: 1}}}}]").simulation
    read = ("gravity_scale", "linear_damping", "angular_damping")
    assert [getattr(body["a"].rigid_body, name) for name in read] == [0.5, 2.0, 3.0]
    assert [getattr(body["b"].rigid_body, name) for name in read] == [1.0, 0.0, 0.0]


def test_bodies_say_what_is_locked() -> None:
    """Axes of the world, and one line of a file locks three of every body."""
    ball = "{name: a, body: {mass: 1, locked: [x, rotation_z]}}"
    assert load(f"entities: [{ball}]").simulation["a"].rigid_body.freedom.tolist() == [0, 1, 1, 1, 1, 0]
    assert load(f"dimensions: 2\nentities: [{ball}]").simulation["a"].rigid_body.freedom.tolist() == [0, 1, 0, 0, 0, 0]


def test_materials_say_how_they_combine() -> None:
    """A quantity may come with its rule."""
    words = "{friction: {value: 20 %, combine: min}, restitution: 0.5, color: [1, 0, 0, 0.5]}"
    material = load(f"entities: [{{name: a, material: {words}}}]").simulation["a"].material
    assert (material.friction, material.friction_combine) == (0.2, Combine.MIN)
    assert (material.restitution, material.restitution_combine) == (0.5, Combine.DEFAULT)
    assert list(material.color) == [1, 0, 0, 0.5]


def test_hulls_of_stated_points() -> None:
    """A hull weighs what its volume does."""
    points = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]"
    world = load(f"entities: [{{name: a, collider: {{convex: {{points: {points}}}}}, body: {{}}}}]").simulation
    assert world["a"].rigid_body.mass == pytest.approx(1000 / 6)


def test_runs() -> None:
    """A run ends after its frames, its duration, or at rest."""
    still = "entities: [{body: {mass: 1}, collider: {sphere: {radius: 1}}}]\ngravity: [0, 0, 0]\n"
    world = load(still + "run: {until: rest, at_most: 3 s}\n")
    assert world.run.frames == 180
    assert not world.run.finished(world.simulation)
    world.simulation.step()
    assert world.run.finished(world.simulation)
    assert load("run: {frames: 7}\n").run.frames == 7
    assert load("run: {duration: 0.1 s}\nstep: {dt: 0.01}\n").run.frames == 10


def test_a_refused_file_leaves_nothing_behind() -> None:
    """The next file starts afresh."""
    with pytest.raises(WorldError):
        load("entities: [{name: a}, {name: a}]\n")
    assert load("entities: [{name: a}]\n").simulation.world.names() == ["a"]
